// Buffer: named bytes on a device. Offsets and counts are in bytes; ranges beyond the end are errors.
#ifndef CLRT_DEVICE_BUFFER_H
#define CLRT_DEVICE_BUFFER_H

#include "device/device.h"

typedef struct Buffer Buffer;

// A buffer with undefined content; 0 bytes are taken as 16. Its name (copied) stands in messages. On a CPU
// device it lies in huge pages where possible. Returns NULL and sets *error: ERROR_MEMORY, with the name and
// the size, where the device refuses.
Buffer *buffer_create(Device *device, const char *name, u64 bytes, Error *error);

// A buffer that kernels only read, with the content of memory (from page_alloc). A CPU device uses that
// memory in place, so it must stay as it is as long as the buffer is there; others get a copy. Errors as
// above.
Buffer *buffer_wrap(Device *device, const char *name, const void *memory, u64 bytes, Error *error);

void buffer_destroy(Buffer *buffer);

// Both take their place in the queue after what was launched before, and return when the bytes are copied.
bool buffer_upload(Buffer *buffer, u64 offset, const void *from, u64 bytes, Error *error);
bool buffer_download(Buffer *buffer, u64 offset, void *to, u64 bytes, Error *error);
#endif
