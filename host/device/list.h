// DeviceList: the OpenCL devices of this machine and the choice of one. Knows nothing of what is run on them.
#ifndef CLRT_DEVICE_LIST_H
#define CLRT_DEVICE_LIST_H

#include "base/error.h"
#include "base/types.h"

typedef enum DeviceType { DEVICE_CPU, DEVICE_GPU, DEVICE_OTHER } DeviceType;

typedef struct DeviceInfo {
    u32 index;            // place among all devices, from 0: the N of --device
    u32 platform, device; // the P:D of --device
    char name[256];
    char platform_name[256];
    char driver[128]; // version of the driver
    DeviceType type;
    u64 memory;         // bytes of global memory
    u64 allocation_max; // bytes of the largest buffer
    u32 compute_units;
    u32 float_width;   // preferred floats in a vector; 1 where the hardware vectorises by itself
    bool fp64;
    bool exact_divide; // float division and square root can be requested correctly rounded
    char unusable[128]; // why nothing can run on it; "" where it can
    void *platform_id;  // cl_platform_id
    void *device_id;    // cl_device_id
} DeviceInfo;

typedef struct PlatformInfo {
    char name[256];
    char version[128];
    u32 device_count;
    char problem[128]; // why it has no devices; "" where it has
} PlatformInfo;

typedef struct DeviceList {
    DeviceInfo *devices;
    u32 count; // at least 1
    PlatformInfo *platforms;
    u32 platform_count; // at least 1
} DeviceList;

// Asks every OpenCL platform for its devices. Returns NULL and sets *error (ERROR_DEVICE) with what to
// install where there is no platform or no device at all.
DeviceList *device_list_create(Error *error);
void device_list_destroy(DeviceList *list);

// "CPU", "GPU" or "other".
const char *device_type_name(DeviceType type);

// The device that spec names:
//   NULL     the first usable GPU, else the first usable CPU, else any usable device
//   cpu gpu  the first usable device of that type
//   N        index in the list
//   P:D      device D of platform P
//   text     the only device whose name, or name of platform, contains text, case ignored; a name that is
//            text exactly goes before names that contain it
// An explicit spec never falls back to another device. Fails with ERROR_USAGE for an empty spec, for `all`
// and for a text that fits several devices (named in the message), with ERROR_DEVICE where there is no such
// device (the message lists what there is) or where it is unusable (with the reason).
bool device_choose(const DeviceList *list, const char *spec, u32 *index, Error *error);

#endif
