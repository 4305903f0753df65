// What embree.c (building) and embree_trace.c know of each other.
#ifndef CLRT_BENCH_EMBREE_INTERNAL_H
#define CLRT_BENCH_EMBREE_INTERNAL_H

#include <stdatomic.h>

#include "embree.h"
#include "embree_api.h"

struct EmbreeScene {
    RTCDevice device;
    RTCScene inner, scene; // inner: of the mesh that is instanced, or NULL
    f32 *vertices;         // 3 a position, or centre and radius of each sphere
    u32 *indices;
    f64 build_seconds;
    _Atomic i64 bytes, bytes_peak;
};

#endif
