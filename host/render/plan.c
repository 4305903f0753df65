#include "render/plan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    GROUPS_A_UNIT_CPU = 8,        // enough to balance, few enough to stay in the caches
    GROUPS_GPU = 4096,
    GROUP_GPU = 64,
    BATCH_CPU = 32,
    BAND_PIXELS = 1 << 20,        // a band's film stays near the cache, a band keeps every core busy
    FIRST_PIXEL_SAMPLES = 2 << 20
};

static bool can_compile(DeviceShape shape, MathMode math)
{
    const bool lanes = shape.lanes == 1 || shape.lanes == 4 || shape.lanes == 8 || shape.lanes == 16;
    const u32 batch_max = math == MATH_DOUBLE ? 1 : BATCH_CPU;
    return lanes && shape.batch >= 1 && shape.batch <= batch_max && shape.batch % shape.lanes == 0 &&
           shape.group >= 1 && shape.group <= TILE_SLOTS;
}

DeviceShape plan_device_shape(const DeviceInfo *info, MathMode math)
{
    DeviceShape shape = { 1, 1, GROUP_GPU };
    if (info->type == DEVICE_CPU) {
        shape.lanes = info->float_width >= 16 ? 16 : info->float_width >= 8 ? 8 : 4;
        shape.batch = BATCH_CPU;
        shape.group = 1;
    }
    if (math == MATH_DOUBLE)
        shape.lanes = shape.batch = 1;
    const char *wish = getenv("CLRT_SHAPE");
    DeviceShape asked;
    if (wish && sscanf(wish, "%u,%u,%u", &asked.lanes, &asked.batch, &asked.group) == 3 &&
        can_compile(asked, math))
        shape = asked;
    return shape;
}

u32 plan_tiles(const Plan *plan, u32 rows)
{
    const u32 side = TILE_SIDE >> plan->slots_log2 / 2;
    return (plan->width + side - 1) / side * ((rows + side - 1) / side);
}

u64 plan_state_bytes(const Plan *plan, u32 groups)
{
    const u64 slot = (u64)plan->real_fields * plan->real_bytes + (u64)plan->int_fields * 4;
    return groups * slot * TILE_SLOTS +
           (u64)groups * plan->shape.group * plan->ray_kinds * 4;
}

u64 plan_film_bytes(const Plan *plan, u32 rows)
{
    const u64 pixel = (plan->samples ? 12 + 12 + 4 : 12) + (plan->clamp ? 16u : 0u);
    return (u64)plan->width * rows * pixel;
}

u32 plan_first_samples(const Plan *plan)
{
    const u64 samples = FIRST_PIXEL_SAMPLES / ((u64)plan->width * plan->band_rows);
    const u32 round = 1u << plan->slots_log2;
    return samples < round ? round : samples > 64 ? 64 : (u32)samples / round * round;
}

static u64 scene_bytes(const Layout *layout)
{
    LayoutArray arrays[LAYOUT_ARRAYS];
    layout_arrays(layout, arrays);
    u64 bytes = sizeof(RenderParams);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        bytes += arrays[i].bytes;
    return bytes;
}

static void count_fields(Plan *plan, const Layout *layout)
{
    const FeatureSet set = layout->features;
    const u32 shadows = features_have(set, FEATURE_SHADOWS), samples = features_have(set, FEATURE_SAMPLES);
    const u32 instances = features_have(set, FEATURE_INSTANCES);
    const u32 branching = features_have(set, FEATURE_BRANCHING), random = features_have(set, FEATURE_HIT_RANDOM);
    const u32 pending = branching ? layout->params.max_depth : 0; // at most one parked ray a depth
    const u32 lights = layout->light_count;
    plan->lights_per_pass = lights < LIGHTS_PER_PASS_MAX ? lights : LIGHTS_PER_PASS_MAX;
    plan->samples = samples;
    plan->clamp = features_have(set, FEATURE_CLAMP);
    plan->slots_log2 = layout->params.samples >= 16 ? 4 : layout->params.samples >= 4 ? 2 : 0;
    plan->ray_kinds = RAYS_KINDS;
    plan->pending_reals = STATE_REALS(shadows, plan->lights_per_pass);
    plan->real_fields = plan->pending_reals + pending * PENDING_REALS;
    plan->int_fields =
        STATE_INTS(shadows, branching, instances, random) + pending * PENDING_INTS(instances, random);
    if (!features_have(set, FEATURE_PATH))
        return;
    plan->ray_kinds = PATH_RAYS_KINDS;
    plan->real_fields = PATH_REALS(shadows);
    plan->int_fields = PATH_INTS(shadows, instances);
}

// At most `groups`, so many that the buffer of their states is not larger than the device allows.
static u64 groups_that_fit(const Plan *plan, const DeviceInfo *info, u64 groups)
{
    const u64 reals = (u64)plan->real_fields * plan->real_bytes, ints = (u64)plan->int_fields * 4;
    const u64 most = info->allocation_max / ((reals > ints ? reals : ints) * TILE_SLOTS);
    return groups < most ? groups : most > 1 ? most : 1;
}

bool plan_make(Plan *plan, const Layout *layout, const DeviceInfo *info, MathMode math, u32 width, u32 height,
               u64 memory_limit, Error *error)
{
    memset(plan, 0, sizeof *plan);
    plan->shape = plan_device_shape(info, math);
    plan->real_bytes = math == MATH_DOUBLE ? 8 : 4;
    plan->width = width;
    count_fields(plan, layout);
    const u64 scene = scene_bytes(layout);
    const u64 limit = memory_limit && memory_limit < info->memory ? memory_limit : info->memory;
    const u64 least = scene + plan_state_bytes(plan, 1) + plan_film_bytes(plan, TILE_SIDE);
    if (least > limit)
        return error_set(error, ERROR_MEMORY,
                         "the scene and one row of tiles need %llu MiB on the device, more than the limit of "
                         "%llu MiB",
                         (unsigned long long)((least >> 20) + 1), (unsigned long long)(limit >> 20));
    // Half of what is left for the tiles, the rest for the film.
    const u64 free_bytes = limit - least;
    const u64 tile = plan_state_bytes(plan, 1), strip = plan_film_bytes(plan, TILE_SIDE);
    const u32 wanted = info->type == DEVICE_CPU ? info->compute_units * GROUPS_A_UNIT_CPU : GROUPS_GPU;
    const u64 strips_wanted = BAND_PIXELS / ((u64)width * TILE_SIDE) + 1;
    const u64 groups = groups_that_fit(plan, info, 1 + free_bytes / 2 / tile);
    const u64 strips = 1 + free_bytes / 2 / strip;
    plan->groups = groups < wanted ? (u32)groups : wanted;
    const u64 rows = (strips < strips_wanted ? strips : strips_wanted) * TILE_SIDE;
    plan->band_rows = rows < height ? (u32)rows : height;
    const u32 tiles = plan_tiles(plan, plan->band_rows);
    plan->groups = plan->groups < tiles ? plan->groups : tiles;
    return true;
}
