// Stage: shade_aov. A property of what the camera rays hit in place of the light that it sends; nothing
// follows.
#ifndef CLRT_KERNELS_STAGES_AOV_H
#define CLRT_KERNELS_STAGES_AOV_H

#include "shared/aov.h"
#include "stages/shade.h"

#if HAS_SURFACES
// Instances and primitives of lanes without a hit must be valid all the same, as in Hit.
static inline v3 aov_id(const Hierarchy *scene, const Hit *hit, vi instance)
{
    LanesI primitives, instances, materials;
    LanesF low, high, material;
    primitives.v = hit->primitive;
    instances.v = instance;
    materials.v = hit->material.offset;
    for (int k = 0; k < LANES; k++) {
        const ulong order = hit_order(scene, instances.s[k], primitives.s[k]);
        low.s[k] = (real)(uint)(order & 0xffffffu);
        high.s[k] = (real)(uint)(order >> 24);
        material.s[k] = (real)(materials.s[k] / MATERIAL_NUMBERS);
    }
    return v3_make(low.v, high.v, material.v);
}

OUTLINE v3 aov_value(const Hierarchy *scene, const Shading *shading, const Hit *hit, vi instance, vf t, uint kind)
{
    switch (kind) {
    case AOV_DEPTH:
        return v3_make(t, t, t);
    case AOV_NORMAL:
        return hit->ns;
    case AOV_POSITION:
        return hit->point;
    case AOV_ALBEDO:
        return hit_diffuse(hit, shading);
    default:
        return aov_id(scene, hit, instance);
    }
}
#endif

static inline v3 aov_of_nothing(uint kind)
{
    return v3_splat(kind == AOV_DEPTH || kind == AOV_POSITION ? INFINITY : kind == AOV_ID ? -1.0f : 0.0f);
}

OUTLINE void shade_aov(const State *s, const Hierarchy *scene, const Shading *shading,
                       constant RenderParams *params, uint count)
{
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, count);
        v3 value = aov_of_nothing(params->aov);
#if HAS_SURFACES
        const vf t = state_load(s, RAY_T, &slots);
        const vm found = slots.valid & (t < (vf)(INFINITY));
        if (vm_any(found)) {
            vi instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            instance = found ? state_load_int(s, INSTANCE, &slots) : instance;
#endif
            const Hit hit = hit_make(scene, shading, state_load3(s, RAY_ORG, &slots),
                                     state_load3(s, RAY_DIR, &slots), t,
                                     state_load_int(s, PRIMITIVE, &slots), instance);
            value = v3_select(found, aov_value(scene, shading, &hit, instance, t, params->aov), value);
        }
#endif
        state_store3(s, RADIANCE, &slots, value, slots.valid);
        state_store_int(s, FLAGS, &slots, (vi)(0), slots.valid);
    }
}

#endif
