// Numbers that host and device share bit by bit. This folder is C11 and OpenCL C at once.
#ifndef CLRT_SHARED_TYPES_H
#define CLRT_SHARED_TYPES_H

#ifdef __OPENCL_C_VERSION__
typedef float f32;
typedef int i32;
typedef uint u32;
typedef float4 f32x4;
// One size check a struct; on the device a negative array size is the error.
#define LAYOUT_SIZE(type, bytes) typedef char type##_size_check[sizeof(type) == (bytes) ? 1 : -1]
#define LAYOUT_OFFSET(type, member, bytes)
#else
#ifndef CLRT_BASE_TYPES_H
#error "host code includes base/types.h before the shared headers" // kernels include nothing from host/
#endif
typedef struct f32x4 {
    _Alignas(16) f32 x;
    f32 y, z, w;
} f32x4;
#define LAYOUT_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), "size of " #type)
#define LAYOUT_OFFSET(type, member, bytes) \
    _Static_assert(offsetof(type, member) == (bytes), "offset of " #type "." #member)
#endif

#endif
