// State of a tile: fields side by side (structure of arrays) in global memory that stays in
// the cache of the core that works on the tile. A slot is one path in flight; only it writes its numbers.
#ifndef CLRT_KERNELS_STAGES_STATE_H
#define CLRT_KERNELS_STAGES_STATE_H

#include "base/vec.h"
#include "shared/params.h"
#include "shared/state_fields.h"

// Fields of reals. A field is TILE_SLOTS numbers.
enum {
    RAY_ORG,                    // 3: the ray in flight, in render space
    RAY_DIR = RAY_ORG + 3,      // 3: unit
    RAY_T = RAY_DIR + 3,        // of its hit, INFINITY for a miss
    THROUGHPUT,                 // 3: product of the weights along the path
#if HAS_CLAMP
    CLAMPED = THROUGHPUT,       // 3: once no ray of the sample is in flight, what it lost to the limit
#endif
    RADIANCE = THROUGHPUT + 3,  // 3: of the sample so far
    RADIANCE_END = RADIANCE + 3,
#if HAS_SHADOWS
    SHADOW_ORG = RADIANCE_END,  // 3: hit point moved off the surface
    SHADOW_LIGHTS = SHADOW_ORG + 3, // SHADOW_FIELDS for each light of a pass
    SHADOW_DIR = 0,             // 3: unit, towards the light
    SHADOW_T = 3,               // distance of the light; 0: no shadow ray
    SHADOW_GAIN = 4,            // 3: radiance that arrives at the camera where nothing blocks
    SHADOW_FIELDS = 7
#endif
};

// Fields of integers.
enum {
    SELF,        // primitive that the ray starts on, as BatchHits.self
    PRIMITIVE,   // hit
    DEPTH,       // of the ray in flight
    FLAGS,       // of the last stage, for compaction
#if HAS_INSTANCES
    SELF_INSTANCE,
    INSTANCE,
#endif
#if HAS_SHADOWS
    SHADOW_SELF,
#endif
#if HAS_BRANCHING
    PENDING_COUNT,
#endif
#if HAS_HIT_RANDOM
    PATH,        // of the ray in flight: seed of its random numbers
#endif
    QUEUE,       // slots with a ray in flight, compacted
    QUEUE_NEXT,  // slots of the shadow rays or the next queue
    INT_FIELDS
};
#if HAS_PATH
// Further fields of a path, and where those of the waiting camera rays and of finished samples begin.
enum {
    DENSITY = RADIANCE_END + HAS_SHADOWS * 10, // of the ray's direction, as drawn; 0: it had no choice
    POOL_REALS,
    RING_REALS = POOL_REALS + RADIANCE_END // 3 for each round
};
enum {
    JOB = INT_FIELDS,   // number of the sample among those of the launch that the group has begun
    SAMPLE,             // its number in the pixel
    SHADOW_LEFT_OUT,    // as BatchHits.left_out, planes_out
    SHADOW_PLANES,
    POOL_INTS
};
typedef char path_reals_check[POOL_REALS == PATH_SLOT_REALS(HAS_SHADOWS) ? 1 : -1];
typedef char path_ints_check[POOL_INTS == PATH_SLOT_INTS(HAS_SHADOWS, HAS_INSTANCES) ? 1 : -1];
#endif
// A parked ray is 3 org, 3 dir, 3 throughput; self, depth and, where there are any, instance and path.

typedef char state_reals_check[RADIANCE_END == STATE_REALS(0, 0) ? 1 : -1];
typedef char state_ints_check
    [INT_FIELDS == STATE_INTS(HAS_SHADOWS, HAS_BRANCHING, HAS_INSTANCES, HAS_HIT_RANDOM) ? 1 : -1];

typedef struct {
    global real *reals;
    global int *ints;
    uint pending_reals; // first field of parked rays
#if HAS_HIT_RANDOM
    int sample_begin, sample_mask; // slot s is of sample sample_begin + (s & sample_mask) of its pixel
#endif
} State;

// LANES slots that are worked on together.
typedef struct {
    vi index;   // valid slots in every lane
    vm valid;   // lanes that are really meant
    int first;  // where consecutive: the slot of lane 0
    bool consecutive;
} Slots;

static inline Slots slots_make(global const int *queue, uint position, uint count)
{
    Slots slots;
    slots.index = VI_LOAD(queue + position);
    slots.valid = LANE_IOTA < (vi)((int)(count - position));
    slots.first = queue[position];
    slots.consecutive = vm_all(slots.valid & (slots.index == (vi)(slots.first) + LANE_IOTA));
    return slots;
}

// The LANES slots from `first` on.
static inline Slots slots_all(uint first)
{
    Slots slots;
    slots.index = (vi)((int)first) + LANE_IOTA;
    slots.valid = slots.index >= (vi)(0);
    slots.first = (int)first;
    slots.consecutive = true;
    return slots;
}

static inline vf state_load(const State *s, uint field, const Slots *slots)
{
    global const real *base = s->reals + field * TILE_SLOTS;
    return slots->consecutive ? VF_LOAD(base + slots->first) : real_gather(base, slots->index);
}

static inline vi state_load_int(const State *s, uint field, const Slots *slots)
{
    global const int *base = s->ints + field * TILE_SLOTS;
    return slots->consecutive ? VI_LOAD(base + slots->first) : vi_gather(base, slots->index);
}

static inline v3 state_load3(const State *s, uint field, const Slots *slots)
{
    return v3_make(state_load(s, field, slots), state_load(s, field + 1, slots),
                   state_load(s, field + 2, slots));
}

// Stores in the lanes of m, which must be valid ones. Where the slots follow each other a whole vector is
// written, old numbers in the other lanes.
static inline void state_store(const State *s, uint field, const Slots *slots, vf value, vm m)
{
    global real *base = s->reals + field * TILE_SLOTS;
    if (slots->consecutive)
        VF_STORE(m ? value : VF_LOAD(base + slots->first), base + slots->first);
    else
        vf_scatter(base, slots->index, value, m);
}

static inline void state_store_int(const State *s, uint field, const Slots *slots, vi value, vm m)
{
    global int *base = s->ints + field * TILE_SLOTS;
    if (slots->consecutive)
        VI_STORE(m ? value : VI_LOAD(base + slots->first), base + slots->first);
    else
        vi_scatter(base, slots->index, value, m);
}

static inline void state_store3(const State *s, uint field, const Slots *slots, v3 value, vm m)
{
    state_store(s, field, slots, value.x, m);
    state_store(s, field + 1, slots, value.y, m);
    state_store(s, field + 2, slots, value.z, m);
}

#endif
