// Probe: the kernels of the self-test on a device. Tables of rays or numbers go in, what the device makes of
// them comes out; knows no right answer.
#ifndef CLRT_SELFTEST_PROBE_H
#define CLRT_SELFTEST_PROBE_H

#include "base/arena.h"
#include "base/error.h"
#include "device/device.h"
#include "layout/layout.h"
#include "render/plan.h"
#include "shared/self_test.h"

typedef struct Probe Probe;

typedef enum ProbeProgram {
    PROBE_ALL,    // everything below
    PROBE_NUMBERS // the functions of numbers but FUNCTION_MEAN, compiled in a fraction of the time
} ProbeProgram;

// Builds the program as a render's is, with the features that the cases need, and launches it once so that
// its code is there. Fails with ERROR_DEVICE or ERROR_MEMORY.
Probe *probe_create(Device *device, ProbeProgram program, Error *error);
void probe_destroy(Probe *probe);

DeviceShape probe_shape(const Probe *probe);

// Rays and what they meet: columns of `stride` numbers (shared/self_test.h).
typedef struct RayTable {
    u32 count, stride;
    f32 *rays;    // PROBE_RAY_REALS columns
    i32 *targets; // PROBE_RAY_INTS columns
    f32 *hits;    // PROBE_HIT_REALS columns
    i32 *found;   // PROBE_HIT_INTS columns
} RayTable;

// Room for `capacity` rays, in the arena; NULL where memory is exhausted.
RayTable *ray_table_create(Arena *arena, u32 capacity);

// Adds a ray from 0 to infinity at the primitive, outside of instances, that starts on nothing. There must be
// room.
void ray_table_add(RayTable *table, u32 primitive, const f32 org[3], const f32 dir[3]);
// The same, rounded to float.
void ray_table_add_vec(RayTable *table, u32 primitive, Vec3 org, Vec3 dir);

static inline f32 ray_number(const RayTable *table, u32 ray, u32 column)
{
    return table->rays[(size_t)column * table->stride + ray];
}

static inline f32 hit_number(const RayTable *table, u32 ray, u32 column)
{
    return table->hits[(size_t)column * table->stride + ray];
}

static inline i32 found_number(const RayTable *table, u32 ray, u32 column)
{
    return table->found[(size_t)column * table->stride + ray];
}

Vec3 ray_vector(const RayTable *table, u32 ray, u32 column);
Vec3 hit_vector(const RayTable *table, u32 ray, u32 column);

// How rays are traced.
typedef struct ProbeHow {
    u32 mode;   // PROBE_X
    u32 steps;  // PROBE_HIERARCHY: crossings that are counted, at least 1
    bool shade; // columns of hits beyond PROBE_T
} ProbeHow;

bool probe_rays(Probe *probe, const Layout *layout, ProbeHow how, RayTable *table, Error *error);

// Arguments and results of a function of numbers: NUMBERS_OUT columns of results, `columns` of arguments.
typedef struct NumberTable {
    u32 count, stride, columns;
    f32 *in, *out;
} NumberTable;

// columns: 4 to NUMBERS_IN. NULL where memory is exhausted.
NumberTable *number_table_create(Arena *arena, u32 count, u32 columns);

static inline void number_set(NumberTable *table, u32 place, u32 column, f64 value)
{
    table->in[(size_t)column * table->stride + place] = (f32)value;
}

// function: FUNCTION_X of shared/self_test.h.
bool probe_numbers(Probe *probe, u32 function, NumberTable *table, Error *error);

// A layout of single primitives, each in render space, all of one material, for PROBE_OWN. NULL and *error
// where there is no memory; the caller's to destroy.
Layout *probe_layout(const Primitive *primitives, u32 count, const MaterialRecord *material, Error *error);

#endif
