// Buffer: named bytes on a device. Offsets and counts are in bytes; ranges beyond the end are errors.
#ifndef CLRT_DEVICE_BUFFER_H
#define CLRT_DEVICE_BUFFER_H

#include "device/device.h"

typedef struct Buffer Buffer;

// A buffer with undefined content; 0 bytes are taken as 16. Its name (copied) stands in messages and
// statistics. On a CPU device it lies in huge pages where possible. Returns NULL and sets *error:
// ERROR_MEMORY, with the name and the size, where the device refuses.
Buffer *buffer_create(Device *device, const char *name, u64 bytes, Error *error);

// A buffer with the bytes at memory. A CPU device uses them in place where they are aligned for it
// (device_memory_alloc), so memory must outlive the buffer and is undefined while kernels write to it;
// elsewhere they are copied.
Buffer *buffer_wrap(Device *device, const char *name, void *memory, u64 bytes, Error *error);

void buffer_destroy(Buffer *buffer);

const char *buffer_name(const Buffer *buffer);
u64 buffer_bytes(const Buffer *buffer);

// All three take their place in the queue after what was launched before. Upload and download return when
// the bytes are copied; fill returns at once.
bool buffer_upload(Buffer *buffer, u64 offset, const void *from, u64 bytes, Error *error);
bool buffer_download(Buffer *buffer, u64 offset, void *to, u64 bytes, Error *error);
// Writes value to every 4 bytes; offset and bytes are multiples of 4.
bool buffer_fill_u32(Buffer *buffer, u64 offset, u32 value, u64 bytes, Error *error);

// The buffers of a device, newest first: NULL is none or the end.
const Buffer *device_buffers(const Device *device);
const Buffer *buffer_next(const Buffer *buffer);

#endif
