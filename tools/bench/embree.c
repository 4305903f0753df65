#include "embree_internal.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"

const char *embree_version(void)
{
    return RTC_VERSION_STRING;
}

const char *embree_mode_name(EmbreeMode mode)
{
    static const char *const NAMES[EMBREE_MODES] = {"1",           "8",      "16",
                                                    "16 coherent", "stream", "stream coherent"};
    return NAMES[mode];
}

bool embree_has_mode(EmbreeMode mode)
{
    return CLRT_EMBREE == 3 || (mode != EMBREE_STREAM && mode != EMBREE_STREAM_COHERENT);
}

static bool count_bytes(void *context, ssize_t bytes, bool post)
{
    EmbreeScene *scene = context;
    (void)post;
    const i64 now = atomic_fetch_add(&scene->bytes, (i64)bytes) + (i64)bytes;
    i64 peak = atomic_load(&scene->bytes_peak);
    while (now > peak && !atomic_compare_exchange_weak(&scene->bytes_peak, &peak, now))
        ;
    return true;
}

// Embree may read 16 bytes from the last vertex on.
static bool copy_mesh(EmbreeScene *embree, const Mesh *mesh, Error *error)
{
    embree->vertices = malloc((3 * (size_t)mesh->position_count + 1) * sizeof *embree->vertices);
    embree->indices = malloc(3 * (size_t)mesh->face_count * sizeof *embree->indices);
    if (!embree->vertices || !embree->indices)
        return error_set(error, ERROR_MEMORY, "no memory for %u triangles", mesh->face_count);
    for (size_t i = 0; i < mesh->position_count; i++) {
        embree->vertices[3 * i] = (f32)mesh->positions[i].x;
        embree->vertices[3 * i + 1] = (f32)mesh->positions[i].y;
        embree->vertices[3 * i + 2] = (f32)mesh->positions[i].z;
    }
    for (size_t i = 0; i < mesh->face_count; i++)
        for (int k = 0; k < 3; k++)
            embree->indices[3 * i + (size_t)k] = mesh->faces[i][k];
    return true;
}

static bool copy_spheres(EmbreeScene *embree, const BenchScene *bench, Error *error)
{
    embree->vertices = malloc(4 * (size_t)bench->primitive_count * sizeof *embree->vertices);
    if (!embree->vertices)
        return error_set(error, ERROR_MEMORY, "no memory for %u spheres", bench->primitive_count);
    for (size_t i = 0; i < bench->primitive_count; i++) {
        const Shape *shape = &bench->scene->shapes[i];
        const Vec3 c = shape->as.sphere.center;
        const f64 numbers[4] = {c.x, c.y, c.z, shape->as.sphere.radius};
        for (size_t k = 0; k < 4; k++)
            embree->vertices[4 * i + k] = (f32)numbers[k];
    }
    return true;
}

static void attach(RTCScene scene, RTCGeometry geometry)
{
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

static void attach_shapes(EmbreeScene *embree, RTCScene scene, const BenchScene *bench)
{
    const Mesh *mesh = bench->mesh;
    const enum RTCGeometryType type = mesh ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_SPHERE_POINT;
    RTCGeometry geometry = rtcNewGeometry(embree->device, type);
    const f32 *vertices = embree->vertices;
    if (mesh) {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0,
                                   3 * sizeof(f32), mesh->position_count);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, embree->indices, 0,
                                   3 * sizeof(u32), mesh->face_count);
    } else {
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, vertices, 0,
                                   4 * sizeof(f32), bench->primitive_count);
    }
    attach(scene, geometry);
}

static void attach_instances(EmbreeScene *embree, const BenchScene *bench)
{
    for (u32 i = 0; i < bench->instance_count; i++) {
        const Affine *m = &bench->scene->instances[i].transform;
        f32 columns[12];
        for (int r = 0; r < 3; r++) {
            const Vec3 row = m->row[r];
            columns[r] = (f32)row.x;
            columns[3 + r] = (f32)row.y;
            columns[6 + r] = (f32)row.z;
        }
        columns[9] = (f32)m->translation.x;
        columns[10] = (f32)m->translation.y;
        columns[11] = (f32)m->translation.z;
        RTCGeometry geometry = rtcNewGeometry(embree->device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, embree->inner);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
        attach(embree->scene, geometry);
    }
}

static RTCScene new_scene(const EmbreeScene *embree, EmbreeBuild build)
{
    RTCScene scene = rtcNewScene(embree->device);
    rtcSetSceneBuildQuality(scene, build.high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene, build.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    return scene;
}

static void commit(EmbreeScene *embree, RTCScene scene)
{
    const f64 start = clock_seconds();
    rtcCommitScene(scene);
    embree->build_seconds += clock_seconds() - start;
}

static bool build_scene(EmbreeScene *embree, const BenchScene *bench, EmbreeBuild build, Error *error)
{
    char config[64];
    snprintf(config, sizeof config, "threads=%u", build.threads);
    embree->device = rtcNewDevice(config);
    if (!embree->device)
        return error_set(error, ERROR_DEVICE, "rtcNewDevice: error %d", (int)rtcGetDeviceError(NULL));
    rtcSetDeviceMemoryMonitorFunction(embree->device, count_bytes, embree);
    embree->scene = new_scene(embree, build);
    if (bench->instance_count > 0) {
        embree->inner = new_scene(embree, build);
        attach_shapes(embree, embree->inner, bench);
        commit(embree, embree->inner);
        attach_instances(embree, bench);
    } else {
        attach_shapes(embree, embree->scene, bench);
    }
    commit(embree, embree->scene);
    const enum RTCError trouble = rtcGetDeviceError(embree->device);
    if (trouble != RTC_ERROR_NONE)
        return error_set(error, trouble == RTC_ERROR_OUT_OF_MEMORY ? ERROR_MEMORY : ERROR_DEVICE,
                         "Embree could not build %s: error %d", bench->name, (int)trouble);
    return true;
}

EmbreeScene *embree_scene_create(const BenchScene *bench, EmbreeBuild build, Error *error)
{
    EmbreeScene *embree = calloc(1, sizeof *embree);
    if (!embree) {
        error_set(error, ERROR_MEMORY, "no memory for Embree's scene");
        return NULL;
    }
    const bool copied =
        bench->mesh ? copy_mesh(embree, bench->mesh, error) : copy_spheres(embree, bench, error);
    if (copied && build_scene(embree, bench, build, error))
        return embree;
    embree_scene_destroy(embree);
    return NULL;
}

void embree_scene_destroy(EmbreeScene *embree)
{
    if (!embree)
        return;
    if (embree->scene)
        rtcReleaseScene(embree->scene);
    if (embree->inner)
        rtcReleaseScene(embree->inner);
    if (embree->device) {
        // What is freed with the device is nobody's news any more.
        rtcSetDeviceMemoryMonitorFunction(embree->device, NULL, NULL);
        rtcReleaseDevice(embree->device);
    }
    free(embree->vertices);
    free(embree->indices);
    free(embree);
}

f64 embree_build_seconds(const EmbreeScene *embree)
{
    return embree->build_seconds;
}

i64 embree_bytes(const EmbreeScene *embree)
{
    return atomic_load(&embree->bytes);
}

i64 embree_bytes_peak(const EmbreeScene *embree)
{
    return atomic_load(&embree->bytes_peak);
}
