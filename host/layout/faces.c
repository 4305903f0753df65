#include "layout/faces.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "layout/records.h"

static const u64 FACES_MAX = FACE_TRANSMITS - 1;
// Kernels count corners, and the numbers of normals and uvs, in 31 bits.
static const u64 CORNERS_MAX = 0x7fffffff, NORMALS_MAX = 0x7fffffff / 3, UVS_MAX = 0x7fffffff / 2;

// Where a placed mesh has the indices of its corners.
typedef struct Corners {
    u32 normals, uvs; // first one's index in mesh_indices; NO_INDEX: none
} Corners;

// Numbers handed out so far, or in all.
typedef struct Totals {
    u64 faces, runs, indices, normals, uvs, meshes;
} Totals;

typedef struct FaceWork {
    Layout *layout;
    const Scene *scene;
    u32 *uv_corners; // of each mesh of the scene; NO_INDEX: not there yet
    bool uvs;        // some texture that can be seen needs them
    Totals at;
} FaceWork;

bool mesh_has_normals(const PlacedMesh *mesh)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    return mesh->shape->as.mesh.smooth != 0 && data->face_normals && data->normals;
}

bool mesh_has_uvs(const PlacedMesh *mesh)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    return data->face_uvs && data->uvs;
}

// ---- runs -----------------------------------------------------------------------------------

// The material of a part where no instance names one.
static u32 part_material(const PlacedMesh *mesh, u32 part)
{
    const i32 material =
        mesh->material >= 0 ? mesh->material : mesh->shape->as.mesh.mesh->parts[part].material;
    return material < 0 ? 0 : (u32)material;
}

static u32 part_end(const Mesh *data, u32 part)
{
    return part + 1 < data->part_count ? data->parts[part + 1].first : data->face_count;
}

// The first part behind the run that begins with `part`: neighbours of the same material need one run.
static u32 run_end(const PlacedMesh *mesh, u32 part)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    u32 next = part + 1;
    while (next < data->part_count && (part_material(mesh, next) == part_material(mesh, part) ||
                                       data->parts[next].first == part_end(data, next)))
        next++;
    return next;
}

static u32 count_runs(const PlacedMesh *mesh)
{
    u32 count = 0;
    for (u32 part = 0; part < mesh->shape->as.mesh.mesh->part_count; part = run_end(mesh, part))
        count++;
    return count;
}

// Whether some instance of the level makes faces transmit whose material otherwise is this one.
static bool face_transmits(const FaceWork *work, const Level *level, const PlacedMesh *mesh, u32 material)
{
    const bool own = material_transmits(&work->scene->materials[material]);
    return mesh->inherits ? level->transmits_named || (level->unnamed && own) : own;
}

static void add_runs(FaceWork *work, Level *level, u32 index, Corners corners)
{
    const PlacedMesh *mesh = &level->meshes.meshes[index];
    const Mesh *data = mesh->shape->as.mesh.mesh;
    u32 flags = affine_determinant(mesh->to_space) < 0 ? MESH_MIRRORED : 0;
    flags |= (corners.normals != NO_INDEX ? MESH_NORMALS : 0) | (corners.uvs != NO_INDEX ? MESH_UVS : 0);
    if ((flags & MESH_NORMALS) && mesh->shape->as.mesh.terminator)
        flags |= MESH_TERMINATOR;
    for (u32 part = 0; part < data->part_count; part = run_end(mesh, part)) {
        const u32 first = data->parts[part].first, material = part_material(mesh, part);
        const u64 order = mesh->order + first;
        level->sources[work->at.runs - level->first_run] =
            (FaceSource){ index, face_transmits(work, level, mesh, material) ? FACE_TRANSMITS : 0 };
        work->layout->mesh_runs[work->at.runs++] = (MeshRun){
            .first = level->first_face + mesh->first_face + first,
            .material = material | (mesh->inherits ? MATERIAL_INHERITED : 0),
            .order_low = (u32)order,
            .order_high = (u32)(order >> 32),
            .flags = flags,
            .corner_normals = flags & MESH_NORMALS ? corners.normals + 3 * first : NO_INDEX,
            .corner_uvs = flags & MESH_UVS ? corners.uvs + 3 * first : NO_INDEX,
            .frame = work->layout->primitive_count + (u32)work->at.meshes,
        };
    }
}

// ---- corners --------------------------------------------------------------------------------

// Copies indices of the file, counted from `base` on; returns where they are.
static u32 add_indices(FaceWork *work, u32 (*from)[3], u32 count, u64 base)
{
    const u64 first = work->at.indices;
    u32 *to = work->layout->mesh_indices + first;
#pragma omp parallel for if (count >= MESH_PARALLEL)
    for (u32 f = 0; f < count; f++)
        for (u32 k = 0; k < 3; k++)
            to[3 * (size_t)f + k] = from[f][k] == MESH_NO_INDEX ? NO_INDEX : (u32)base + from[f][k];
    work->at.indices += 3 * (u64)count;
    return (u32)first;
}

// Normals go by the transpose of the way back. One common factor keeps the interpolation that of the mesh's
// own space; with it the longest normal has length 1.
static void carry_normals(const PlacedMesh *mesh, f32 (*to)[3])
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    f32(*const from)[3] = data->normals;
    const u32 count = data->normal_count;
    const Vec3 *inverse = affine_inverse(mesh->to_space).row;
    f64 size = 0, longest = 0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, fmax(fabs(inverse[i].x), fmax(fabs(inverse[i].y), fabs(inverse[i].z))));
    const Vec3 x = vec_scale(inverse[0], 1 / size), y = vec_scale(inverse[1], 1 / size),
               z = vec_scale(inverse[2], 1 / size);
#pragma omp parallel for if (count >= MESH_PARALLEL) reduction(max : longest)
    for (u32 i = 0; i < count; i++) {
        const f64 a = (f64)from[i][0], b = (f64)from[i][1], c = (f64)from[i][2];
        const f64 u = x.x * a + y.x * b + z.x * c, v = x.y * a + y.y * b + z.y * c,
                  w = x.z * a + y.z * b + z.z * c;
        const f64 square = u * u + v * v + w * w;
        longest = square > longest ? square : longest;
    }
    const f64 factor = longest > 0 ? 1 / sqrt(longest) : 0;
#pragma omp parallel for if (count >= MESH_PARALLEL)
    for (u32 i = 0; i < count; i++) {
        const f64 a = (f64)from[i][0], b = (f64)from[i][1], c = (f64)from[i][2];
        to[i][0] = (f32)((x.x * a + y.x * b + z.x * c) * factor);
        to[i][1] = (f32)((x.y * a + y.y * b + z.y * c) * factor);
        to[i][2] = (f32)((x.z * a + y.z * b + z.z * c) * factor);
    }
}

static u32 *uv_corners_of(const FaceWork *work, const PlacedMesh *mesh)
{
    const ptrdiff_t index = mesh->shape->as.mesh.mesh - work->scene->meshes;
    assert(index >= 0 && index < (ptrdiff_t)work->scene->mesh_count);
    return &work->uv_corners[index];
}

static bool wants_uvs(const FaceWork *work, const PlacedMesh *mesh)
{
    return work->uvs && mesh_has_uvs(mesh);
}

static Corners add_corners(FaceWork *work, const PlacedMesh *mesh)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    Layout *layout = work->layout;
    Corners corners = { NO_INDEX, NO_INDEX };
    if (mesh_has_normals(mesh)) {
        corners.normals = add_indices(work, data->face_normals, data->face_count, work->at.normals);
        carry_normals(mesh, layout->mesh_normals + work->at.normals);
        work->at.normals += data->normal_count;
    }
    if (wants_uvs(work, mesh)) {
        u32 *known = uv_corners_of(work, mesh);
        if (*known == NO_INDEX) {
            *known = add_indices(work, data->face_uvs, data->face_count, work->at.uvs);
            memcpy(layout->mesh_uvs + work->at.uvs, data->uvs, data->uv_count * sizeof *data->uvs);
            work->at.uvs += data->uv_count;
        }
        corners.uvs = *known;
    }
    return corners;
}

// ---- all of them ----------------------------------------------------------------------------

static void clear_uv_corners(FaceWork *work)
{
    for (u32 i = 0; i < work->scene->mesh_count; i++)
        work->uv_corners[i] = NO_INDEX;
}

static void count_mesh(FaceWork *work, const PlacedMesh *mesh, Totals *totals)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    totals->meshes++;
    totals->faces += data->face_count;
    totals->runs += count_runs(mesh);
    if (mesh_has_normals(mesh)) {
        totals->normals += data->normal_count;
        totals->indices += 3 * (u64)data->face_count;
    }
    if (wants_uvs(work, mesh) && *uv_corners_of(work, mesh) == NO_INDEX) {
        *uv_corners_of(work, mesh) = 0;
        totals->uvs += data->uv_count;
        totals->indices += 3 * (u64)data->face_count;
    }
}

static bool reserve(Layout *layout, const Totals *totals, Error *error)
{
    if (totals->faces > FACES_MAX || totals->indices > CORNERS_MAX || totals->normals > NORMALS_MAX ||
        totals->uvs > UVS_MAX)
        return error_set(error, ERROR_MEMORY, "%llu triangles, with their normals and uvs, are too many",
                         (unsigned long long)totals->faces);
    layout->mesh_run_count = (u32)totals->runs;
    layout->mesh_index_count = (u32)totals->indices;
    layout->mesh_normal_count = (u32)totals->normals;
    layout->mesh_uv_count = (u32)totals->uvs;
    layout->mesh_runs = page_alloc(totals->runs * sizeof *layout->mesh_runs);
    layout->mesh_indices = page_alloc(totals->indices * sizeof *layout->mesh_indices);
    layout->mesh_normals = page_alloc(totals->normals * sizeof *layout->mesh_normals);
    layout->mesh_uvs = page_alloc(totals->uvs * sizeof *layout->mesh_uvs);
    return (layout->mesh_runs && (layout->mesh_indices || totals->indices == 0) &&
            (layout->mesh_normals || totals->normals == 0) && (layout->mesh_uvs || totals->uvs == 0)) ||
           error_set(error, ERROR_MEMORY, "no memory for the shading of %llu triangles",
                     (unsigned long long)totals->faces);
}

// Numbers the level and its faces from where the ones before it end.
static bool add_level(FaceWork *work, Level *level, Error *error)
{
    level->first_face = (u32)work->at.faces;
    level->first_run = (u32)work->at.runs;
    for (u32 i = 0; i < level->meshes.count; i++)
        level->run_count += count_runs(&level->meshes.meshes[i]);
    level->sources = malloc((level->run_count + (size_t)1) * sizeof *level->sources);
    if (!level->sources)
        return error_set(error, ERROR_MEMORY, "no memory for %u parts of meshes", level->run_count);
    for (u32 i = 0; i < level->meshes.count; i++) {
        const PlacedMesh *mesh = &level->meshes.meshes[i];
        const Corners corners = add_corners(work, mesh);
        add_runs(work, level, i, corners);
        if (work->layout->frames)
            work->layout->frames[work->layout->primitive_count + work->at.meshes] = mesh->frame;
        work->at.meshes++;
    }
    work->at.faces += level->meshes.face_count;
    return true;
}

bool faces_add(Layout *layout, const Scene *scene, Level *const *levels, u32 level_count, Error *error)
{
    FaceWork work = { .layout = layout, .scene = scene,
                      .uvs = features_have(layout->features, FEATURE_MESH_UVS) };
    Totals totals;
    memset(&totals, 0, sizeof totals);
    work.uv_corners = malloc((scene->mesh_count + (size_t)1) * sizeof *work.uv_corners);
    if (!work.uv_corners)
        return error_set(error, ERROR_MEMORY, "no memory for %u meshes", scene->mesh_count);
    clear_uv_corners(&work);
    for (u32 i = 0; i < level_count; i++)
        for (u32 k = 0; k < levels[i]->meshes.count; k++)
            count_mesh(&work, &levels[i]->meshes.meshes[k], &totals);
    clear_uv_corners(&work);
    bool ok = totals.faces == 0 || reserve(layout, &totals, error);
    for (u32 i = 0; ok && totals.faces > 0 && i < level_count; i++)
        ok = add_level(&work, levels[i], error);
    free(work.uv_corners);
    return ok;
}
