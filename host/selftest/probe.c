#include "selftest/probe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "bundle/bundle.h"
#include "device/buffer.h"
#include "device/program.h"
#include "render/render.h"

enum { PLACES = 32 }; // tables are in whole batches of any shape

struct Probe {
    Device *device;
    DeviceShape shape;
    Program *program;
    Kernel *numbers;
    Kernel *rays; // PROBE_ALL
};

static FeatureSet features_of_probe(void)
{
    static const Feature WITHOUT[] = {FEATURE_TRIANGLE_EXTRA, FEATURE_MESH_NORMALS, FEATURE_MESH_UVS, FEATURE_TERMINATOR,
                                      FEATURE_EMISSION,       FEATURE_AMBIENT,      FEATURE_BACKGROUND,
                                      FEATURE_BRANCHING,      FEATURE_ORTHOGRAPHIC, FEATURE_SAMPLES,
                                      FEATURE_PATH,           FEATURE_MANY_LIGHTS};
    FeatureSet set = ((FeatureSet)1 << FEATURE_COUNT) - 1;
    for (size_t i = 0; i < sizeof WITHOUT / sizeof WITHOUT[0]; i++)
        set &= ~feature_bit(WITHOUT[i]);
    return set;
}

static bool build(Probe *probe, ProbeProgram program, Error *error)
{
    const bool all = program == PROBE_ALL;
    char options[2048];
    if (render_program_options(features_of_probe(), device_info(probe->device), MATH_EXACT, options,
                               sizeof options) >= sizeof options)
        return error_set(error, ERROR_DEVICE, "the options of the self-test are too long");
    const char *source = all ? clrt_self_test_source : clrt_known_answers_source;
    const size_t size = all ? clrt_self_test_source_size : clrt_known_answers_source_size;
    probe->program = program_create(probe->device, source, size, options, error);
    return probe->program && (probe->numbers = kernel_create(probe->program, "self_test_numbers", error)) &&
           (!all || (probe->rays = kernel_create(probe->program, "self_test_rays", error)));
}

// A launch of each kernel, for the code that drivers generate then.
static bool warm_up(Probe *probe, Error *error)
{
    Arena *arena = arena_create();
    const Primitive none = {.kind = PRIMITIVE_SPHERE, .p0 = 1};
    NumberTable *numbers = arena ? number_table_create(arena, 1, 4) : NULL;
    RayTable *rays = arena ? ray_table_create(arena, 1) : NULL;
    Layout *layout = NULL;
    bool ok = false;
    if (!numbers || !rays) {
        error_set(error, ERROR_MEMORY, "no memory for the self-test");
    } else {
        ray_table_add(rays, 0, (f32[3]){0, 0, 0}, (f32[3]){0, 0, 1});
        layout = probe_layout(&none, 1, NULL, error);
        ok = layout && probe_numbers(probe, FUNCTION_SIN, numbers, error) &&
             (!probe->rays || probe_rays(probe, layout, (ProbeHow){.mode = PROBE_OWN}, rays, error));
    }
    layout_destroy(layout);
    arena_destroy(arena);
    return ok;
}

Probe *probe_create(Device *device, ProbeProgram program, Error *error)
{
    Probe *probe = calloc(1, sizeof *probe);
    if (!probe) {
        error_set(error, ERROR_MEMORY, "no memory for the self-test");
        return NULL;
    }
    probe->device = device;
    probe->shape = plan_device_shape(device_info(device), MATH_EXACT);
    if (build(probe, program, error) && warm_up(probe, error))
        return probe;
    probe_destroy(probe);
    return NULL;
}

void probe_destroy(Probe *probe)
{
    if (!probe)
        return;
    kernel_destroy(probe->rays);
    kernel_destroy(probe->numbers);
    program_destroy(probe->program);
    free(probe);
}

DeviceShape probe_shape(const Probe *probe)
{
    return probe->shape;
}

// ---- tables -----------------------------------------------------------------------------------

static u32 padded(u32 count)
{
    return (count + PLACES - 1) / PLACES * PLACES;
}

RayTable *ray_table_create(Arena *arena, u32 capacity)
{
    const u32 stride = padded(capacity ? capacity : 1);
    RayTable *table = arena_alloc(arena, 1, sizeof *table);
    if (!table)
        return NULL;
    table->stride = stride;
    table->rays = arena_alloc(arena, (size_t)PROBE_RAY_REALS * stride, sizeof(f32));
    table->targets = arena_alloc(arena, (size_t)PROBE_RAY_INTS * stride, sizeof(i32));
    table->hits = arena_alloc(arena, (size_t)PROBE_HIT_REALS * stride, sizeof(f32));
    table->found = arena_alloc(arena, (size_t)PROBE_HIT_INTS * stride, sizeof(i32));
    return table->rays && table->targets && table->hits && table->found ? table : NULL;
}

void ray_table_add(RayTable *table, u32 primitive, const f32 org[3], const f32 dir[3])
{
    const size_t i = table->count++, n = table->stride;
    for (size_t k = 0; k < 3; k++) {
        table->rays[(PROBE_ORG + k) * n + i] = org[k];
        table->rays[(PROBE_DIR + k) * n + i] = dir[k];
    }
    table->rays[PROBE_TMIN * n + i] = 0;
    table->rays[PROBE_TFAR * n + i] = INFINITY;
    table->targets[PROBE_PRIMITIVE * n + i] = (i32)primitive;
    table->targets[PROBE_INSTANCE * n + i] = -1;
    table->targets[PROBE_SELF * n + i] = -1;
    table->targets[PROBE_SELF_INSTANCE * n + i] = -1;
}

void ray_table_add_vec(RayTable *table, u32 primitive, Vec3 org, Vec3 dir)
{
    ray_table_add(table, primitive, (f32[3]){(f32)org.x, (f32)org.y, (f32)org.z},
                  (f32[3]){(f32)dir.x, (f32)dir.y, (f32)dir.z});
}

Vec3 ray_vector(const RayTable *table, u32 ray, u32 column)
{
    return (Vec3){ray_number(table, ray, column), ray_number(table, ray, column + 1),
                  ray_number(table, ray, column + 2)};
}

Vec3 hit_vector(const RayTable *table, u32 ray, u32 column)
{
    return (Vec3){hit_number(table, ray, column), hit_number(table, ray, column + 1),
                  hit_number(table, ray, column + 2)};
}

// Places without a ray repeat the last one.
static void pad_rays(RayTable *table)
{
    const u32 n = table->stride;
    for (u32 i = table->count; i < padded(table->count); i++) {
        for (u32 k = 0; k < PROBE_RAY_REALS; k++)
            table->rays[k * n + i] = table->rays[k * n + table->count - 1];
        for (u32 k = 0; k < PROBE_RAY_INTS; k++)
            table->targets[k * n + i] = table->targets[k * n + table->count - 1];
    }
}

NumberTable *number_table_create(Arena *arena, u32 count, u32 columns)
{
    NumberTable *table = arena_alloc(arena, 1, sizeof *table);
    if (!table)
        return NULL;
    *table = (NumberTable){.count = count, .stride = padded(count), .columns = columns};
    table->in = arena_alloc(arena, (size_t)columns * table->stride, sizeof(f32));
    table->out = arena_alloc(arena, (size_t)NUMBERS_OUT * table->stride, sizeof(f32));
    return table->in && table->out ? table : NULL;
}

Layout *probe_layout(const Primitive *primitives, u32 count, const MaterialRecord *material, Error *error)
{
    const MaterialRecord plain = {.diffuse = {1, 1, 1}, .ior = 1, .inverse_ior = 1, .diffuse_texture = -1};
    Layout *layout = calloc(1, sizeof *layout);
    if (layout) {
        layout->primitive_count = layout->frame_count = count;
        layout->material_count = 1;
        layout->root = NO_INDEX;
        layout->primitives = page_alloc(count * sizeof *layout->primitives);
        layout->infos = page_alloc(count * sizeof *layout->infos);
        layout->frames = page_alloc(count * sizeof *layout->frames);
        layout->materials = page_alloc(sizeof *layout->materials);
    }
    if (!layout || !layout->primitives || !layout->infos || !layout->frames || !layout->materials) {
        layout_destroy(layout);
        error_set(error, ERROR_MEMORY, "no memory for %u primitives", count);
        return NULL;
    }
    memcpy(layout->primitives, primitives, count * sizeof *primitives);
    for (u32 i = 0; i < count; i++)
        layout->infos[i] = (PrimitiveInfo){.extra = NO_INDEX, .order_low = i};
    layout->materials[0] = material ? *material : plain;
    return layout;
}

// ---- launches ---------------------------------------------------------------------------------

// A buffer bound to the argument of its name; content NULL: none.
static bool bind(Probe *probe, Kernel *kernel, const char *name, const void *content, u64 bytes,
                 Buffer **buffer, Error *error)
{
    *buffer = buffer_create(probe->device, name, bytes, error);
    return *buffer && (!content || bytes == 0 || buffer_upload(*buffer, 0, content, bytes, error)) &&
           kernel_set_buffer(kernel, name, *buffer, error);
}

static bool bind_scene(Probe *probe, const Layout *layout, Buffer *buffers[LAYOUT_ARRAYS], Error *error)
{
    LayoutArray arrays[LAYOUT_ARRAYS];
    layout_arrays(layout, arrays);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        if (kernel_has(probe->rays, arrays[i].name) &&
            !bind(probe, probe->rays, arrays[i].name, arrays[i].data, arrays[i].bytes, &buffers[i], error))
            return false;
    return kernel_set_u32(probe->rays, "primitive_count", layout->primitive_count, error) &&
           kernel_set_u32(probe->rays, "block_count", layout->block_count, error) &&
           kernel_set_u32(probe->rays, "mesh_run_count", layout->mesh_run_count, error) &&
           kernel_set_u32(probe->rays, "plane_count", layout->plane_count, error) &&
           kernel_set_u32(probe->rays, "light_count", layout->light_count, error) &&
           kernel_set_u32(probe->rays, "root", layout->root, error);
}

enum { BUFFER_RAYS, BUFFER_TARGETS, BUFFER_HITS, BUFFER_FOUND, BUFFERS };

static bool bind_rays(Probe *probe, ProbeHow how, const RayTable *table, Buffer *buffers[BUFFERS],
                      Error *error)
{
    Kernel *kernel = probe->rays;
    const u64 column = table->stride * (u64)sizeof(f32);
    return bind(probe, kernel, "ray_reals", table->rays, PROBE_RAY_REALS * column, &buffers[BUFFER_RAYS],
                error) &&
           bind(probe, kernel, "ray_ints", table->targets, PROBE_RAY_INTS * column, &buffers[BUFFER_TARGETS],
                error) &&
           bind(probe, kernel, "hit_reals", NULL, PROBE_HIT_REALS * column, &buffers[BUFFER_HITS], error) &&
           bind(probe, kernel, "hit_ints", NULL, PROBE_HIT_INTS * column, &buffers[BUFFER_FOUND], error) &&
           kernel_set_u32(kernel, "stride", table->stride, error) &&
           kernel_set_u32(kernel, "count", padded(table->count), error) &&
           kernel_set_u32(kernel, "mode", how.mode, error) &&
           kernel_set_u32(kernel, "steps", how.steps, error) &&
           kernel_set_u32(kernel, "shade", how.shade ? 1 : 0, error);
}

bool probe_rays(Probe *probe, const Layout *layout, ProbeHow how, RayTable *table, Error *error)
{
    Buffer *scene[LAYOUT_ARRAYS] = {NULL}, *buffers[BUFFERS] = {NULL};
    const u64 column = table->stride * (u64)sizeof(f32);
    pad_rays(table);
    const u64 items = padded(table->count) / probe->shape.batch;
    const bool ok =
        bind_scene(probe, layout, scene, error) && bind_rays(probe, how, table, buffers, error) &&
        kernel_launch(probe->rays, items, probe->shape.group, error) &&
        buffer_download(buffers[BUFFER_HITS], 0, table->hits, (how.shade ? PROBE_HIT_REALS : 1) * column,
                        error) &&
        buffer_download(buffers[BUFFER_FOUND], 0, table->found, PROBE_HIT_INTS * column, error);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        buffer_destroy(scene[i]);
    for (u32 i = 0; i < BUFFERS; i++)
        buffer_destroy(buffers[i]);
    return ok;
}

bool probe_numbers(Probe *probe, u32 function, NumberTable *table, Error *error)
{
    Kernel *kernel = probe->numbers;
    Buffer *in = NULL, *out = NULL;
    const u64 column = table->stride * (u64)sizeof(f32);
    const bool ok = bind(probe, kernel, "numbers_in", table->in, table->columns * column, &in, error) &&
                    bind(probe, kernel, "numbers_out", NULL, NUMBERS_OUT * column, &out, error) &&
                    kernel_set_u32(kernel, "function", function, error) &&
                    kernel_set_u32(kernel, "stride", table->stride, error) &&
                    kernel_set_u32(kernel, "count", table->stride, error) &&
                    kernel_launch(kernel, table->stride / probe->shape.lanes, probe->shape.group, error) &&
                    buffer_download(out, 0, table->out, NUMBERS_OUT * column, error);
    buffer_destroy(in);
    buffer_destroy(out);
    return ok;
}
