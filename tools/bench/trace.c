#include "trace.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "device/buffer.h"
#include "device/program.h"
#include "render/plan.h"
#include "render/render.h"

// rays.cl with all that it includes, as clrt-bundle writes it.
extern const char bench_kernel_source[];
extern const size_t bench_kernel_source_size;

enum { KERNELS = 2 }; // closest hit, any hit

struct Tracer {
    Device *device;
    const Layout *layout;
    DeviceShape shape;
    bool count_visits;
    Program *program;
    Kernel *kernels[KERNELS];
    Buffer *scene[LAYOUT_ARRAYS];
    Buffer *rays, *reals, *wholes, *visits;
    u32 *numbers; // of the primitives at their places in the layout: of their kind in the order of definition
    u32 count, stride;
    Kernel *kernel; // of the rays in hand
    f64 compile_seconds;
};

static bool compile(Tracer *tracer, Error *error)
{
    char options[2048];
    const size_t length = render_program_options(tracer->layout->features, device_info(tracer->device),
                                                 MATH_EXACT, options, sizeof options);
    const char *counting = tracer->count_visits ? " -DCOUNT_VISITS=1" : "";
    if (length + strlen(counting) >= sizeof options)
        return error_set(error, ERROR_DEVICE, "the options of the program are too long");
    strcat(options, counting);
    const f64 start = clock_seconds();
    tracer->program =
        program_create(tracer->device, bench_kernel_source, bench_kernel_source_size, options, error);
    if (!tracer->program)
        return false;
    tracer->kernels[0] = kernel_create(tracer->program, "intersect_rays", error);
    tracer->kernels[1] = tracer->kernels[0] ? kernel_create(tracer->program, "occluded_rays", error) : NULL;
    tracer->compile_seconds = clock_seconds() - start;
    return tracer->kernels[1] != NULL;
}

static bool set_number(Tracer *tracer, const char *name, u32 value, Error *error)
{
    for (u32 k = 0; k < KERNELS; k++)
        if (kernel_has(tracer->kernels[k], name) && !kernel_set_u32(tracer->kernels[k], name, value, error))
            return false;
    return true;
}

static bool set_buffer(Tracer *tracer, const char *name, const Buffer *buffer, Error *error)
{
    if (!buffer)
        return false;
    for (u32 k = 0; k < KERNELS; k++)
        if (kernel_has(tracer->kernels[k], name) &&
            !kernel_set_buffer(tracer->kernels[k], name, buffer, error))
            return false;
    return true;
}

static bool add_scene(Tracer *tracer, Error *error)
{
    const Layout *layout = tracer->layout;
    LayoutArray arrays[LAYOUT_ARRAYS];
    layout_arrays(layout, arrays);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++) {
        if (!kernel_has(tracer->kernels[0], arrays[i].name))
            continue;
        tracer->scene[i] =
            buffer_wrap(tracer->device, arrays[i].name, arrays[i].data, arrays[i].bytes, error);
        if (!set_buffer(tracer, arrays[i].name, tracer->scene[i], error))
            return false;
    }
    return set_number(tracer, "plane_count", layout->plane_count, error) &&
           set_number(tracer, "root", layout->root, error) &&
           set_number(tracer, "mesh_run_count", layout->mesh_run_count, error);
}

// A primitive's place in the layout and in the order of definition.
typedef struct Place {
    u64 order;
    u32 index;
    bool instance;
} Place;

static int compare_places(const void *a, const void *b)
{
    const Place *x = a, *y = b;
    if (x->instance != y->instance)
        return x->instance ? 1 : -1;
    return x->order < y->order ? -1 : x->order > y->order;
}

// Leaves hold primitives in an order of their own; the bench speaks of those of the scene.
static bool number_primitives(Tracer *tracer, Error *error)
{
    const Layout *layout = tracer->layout;
    const u32 count = layout->primitive_count;
    Place *places = malloc((count + (size_t)1) * sizeof *places);
    tracer->numbers = malloc((count + (size_t)1) * sizeof *tracer->numbers);
    if (!places || !tracer->numbers) {
        free(places);
        return error_set(error, ERROR_MEMORY, "no memory for the numbers of %u primitives", count);
    }
    for (u32 i = 0; i < count; i++) {
        const PrimitiveInfo *info = &layout->infos[i];
        places[i] = (Place){(u64)info->order_high << 32 | info->order_low, i,
                            (layout->primitives[i].kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE};
    }
    qsort(places, count, sizeof *places, compare_places);
    u32 next = 0;
    for (u32 i = 0; i < count; i++) {
        if (i > 0 && places[i].instance != places[i - 1].instance)
            next = 0;
        tracer->numbers[places[i].index] = next++;
    }
    free(places);
    return true;
}

Tracer *tracer_create(Device *device, const Layout *layout, bool count_visits, Error *error)
{
    Tracer *tracer = calloc(1, sizeof *tracer);
    if (!tracer) {
        error_set(error, ERROR_MEMORY, "no memory for the tracer");
        return NULL;
    }
    tracer->device = device;
    tracer->layout = layout;
    tracer->count_visits = count_visits;
    tracer->shape = plan_device_shape(device_info(device), MATH_EXACT);
    if (compile(tracer, error) && add_scene(tracer, error) && number_primitives(tracer, error))
        return tracer;
    tracer_destroy(tracer);
    return NULL;
}

static void unload(Tracer *tracer)
{
    buffer_destroy(tracer->rays);
    buffer_destroy(tracer->reals);
    buffer_destroy(tracer->wholes);
    buffer_destroy(tracer->visits);
    tracer->rays = tracer->reals = tracer->wholes = tracer->visits = NULL;
}

void tracer_destroy(Tracer *tracer)
{
    if (!tracer)
        return;
    unload(tracer);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        buffer_destroy(tracer->scene[i]);
    for (u32 k = 0; k < KERNELS; k++)
        kernel_destroy(tracer->kernels[k]);
    program_destroy(tracer->program);
    free(tracer->numbers);
    free(tracer);
}

f64 tracer_compile_seconds(const Tracer *tracer)
{
    return tracer->compile_seconds;
}

static u32 batches(const Tracer *tracer)
{
    return (tracer->count + tracer->shape.batch - 1) / tracer->shape.batch;
}

bool tracer_load(Tracer *tracer, const RaySet *rays, Error *error)
{
    unload(tracer);
    tracer->count = rays->count;
    tracer->stride = rays->stride;
    tracer->kernel = tracer->kernels[rays->any_hit ? 1 : 0];
    const u64 column = rays->stride * (u64)sizeof(f32);
    const u64 visits = tracer->count_visits ? 2 * (u64)batches(tracer) * sizeof(u32) : 0;
    Device *device = tracer->device;
    return (tracer->rays = buffer_create(device, "rays_in", RAY_COLUMNS * column, error)) &&
           (tracer->reals = buffer_create(device, "reals", 3 * column, error)) &&
           (tracer->wholes = buffer_create(device, "wholes", 2 * column, error)) &&
           (tracer->visits = buffer_create(device, "visits", visits, error)) &&
           buffer_upload(tracer->rays, 0, rays->columns, RAY_COLUMNS * column, error) &&
           set_buffer(tracer, "rays_in", tracer->rays, error) &&
           set_buffer(tracer, "reals", tracer->reals, error) &&
           set_buffer(tracer, "wholes", tracer->wholes, error) &&
           set_buffer(tracer, "visits", tracer->visits, error) &&
           set_number(tracer, "stride", rays->stride, error) &&
           set_number(tracer, "count", rays->count, error);
}

bool tracer_run(Tracer *tracer, Error *error)
{
    return kernel_launch(tracer->kernel, batches(tracer), tracer->shape.group, error) &&
           device_finish(tracer->device, error);
}

// From places in the layout to the scene's own numbers.
static void name_hits(const Tracer *tracer, RayHits *hits)
{
    const bool faces = tracer->layout->mesh_run_count > 0;
    for (u32 i = 0; i < hits->count; i++) {
        const u32 instance = hits->instance[i];
        hits->instance[i] = instance == NO_PRIMITIVE ? 0 : tracer->numbers[instance];
        if (!faces && hits->primitive[i] != NO_PRIMITIVE)
            hits->primitive[i] = tracer->numbers[hits->primitive[i]];
    }
}

bool tracer_read(Tracer *tracer, RayHits *hits, Error *error)
{
    const u64 column = tracer->stride * (u64)sizeof(f32), bytes = tracer->count * (u64)sizeof(f32);
    hits->count = tracer->count;
    if (!buffer_download(tracer->wholes, 0, hits->primitive, bytes, error))
        return false;
    if (tracer->kernel == tracer->kernels[1])
        return true;
    if (!buffer_download(tracer->reals, 0, hits->t, bytes, error) ||
        !buffer_download(tracer->reals, column, hits->u, bytes, error) ||
        !buffer_download(tracer->reals, 2 * column, hits->v, bytes, error) ||
        !buffer_download(tracer->wholes, column, hits->instance, bytes, error))
        return false;
    name_hits(tracer, hits);
    return true;
}

bool tracer_visits(Tracer *tracer, Visits *visits, Error *error)
{
    const u32 count = batches(tracer);
    u32 *pairs = malloc((2 * (size_t)count + 1) * sizeof *pairs);
    *visits = (Visits){0, 0};
    if (!pairs)
        return error_set(error, ERROR_MEMORY, "no memory for the visits of %u batches", count);
    const bool ok =
        buffer_download(tracer->visits, 0, pairs, 2 * (u64)count * sizeof *pairs, error);
    for (u32 i = 0; ok && i < count; i++) {
        visits->nodes += pairs[2 * i];
        visits->leaves += pairs[2 * i + 1];
    }
    free(pairs);
    return ok;
}
