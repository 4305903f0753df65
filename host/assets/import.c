// Nodes are placed first, so that everything can be counted and allocated once; then each is copied.
#include "assets/import.h"

#ifdef CLRT_ASSIMP

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assets/assimp.h"
#include "assets/import_materials.h"
#include "assets/placements.h"
#include "assets/ply_head.h"
#include "assets/weld.h"

typedef struct Import {
    const char *path;
    const struct aiScene *scene;
    ImportFile *file;
    Placements placements;
    bool facets; // normals are the facets' own, and say nothing new
    bool gltf;
    u32 *map; // of vertices to positions, for one placement
} Import;

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "out of memory");
}

// ---- room -----------------------------------------------------------------------------------

typedef struct Counts {
    u64 positions, normals, uvs, faces;
    u32 vertices_most; // of a placement
} Counts;

static bool has_normals(const Import *import, const struct aiMesh *mesh)
{
    return mesh->mNormals && !import->facets;
}

static i32 material_of(const Import *import, const struct aiMesh *mesh)
{
    return mesh->mMaterialIndex < import->file->material_count ? (i32)mesh->mMaterialIndex : -1;
}

// The uvs that the material's maps want, NULL where the mesh lacks them.
static const struct aiVector3D *uvs_of(const Import *import, const struct aiMesh *mesh)
{
    const i32 material = material_of(import, mesh);
    const u32 set = material < 0 ? 0 : import->file->materials[material].uvs.set;
    return set < AI_MAX_NUMBER_OF_TEXTURECOORDS ? mesh->mTextureCoords[set] : NULL;
}

static Counts count_all(const Import *import)
{
    Counts counts = {0};
    for (u32 i = 0; i < import->placements.count; ++i) {
        const struct aiMesh *mesh = import->placements.list[i].mesh;
        counts.positions += mesh->mNumVertices;
        counts.normals += has_normals(import, mesh) ? mesh->mNumVertices : 0;
        counts.uvs += uvs_of(import, mesh) ? mesh->mNumVertices : 0;
        for (u32 f = 0; f < mesh->mNumFaces; ++f)
            counts.faces += mesh->mFaces[f].mNumIndices > 2 ? mesh->mFaces[f].mNumIndices - 2 : 0;
        if (mesh->mNumVertices > counts.vertices_most)
            counts.vertices_most = mesh->mNumVertices;
    }
    return counts;
}

static bool allocate(Import *import, const Counts *counts, Error *error)
{
    if (counts->faces > 1u << 30 || counts->positions >= 1u << 31)
        return error_set(error, ERROR_SCENE, "more than 2^30 triangles or 2^31 vertices");
    Mesh *mesh = &import->file->mesh;
    const size_t faces = (size_t)counts->faces;
    mesh->positions = malloc((size_t)counts->positions * sizeof *mesh->positions);
    mesh->faces = malloc(faces * sizeof *mesh->faces);
    mesh->parts = malloc(import->placements.count * sizeof *mesh->parts);
    import->map = malloc(counts->vertices_most * sizeof *import->map);
    bool ok = mesh->positions && mesh->faces && mesh->parts && import->map;
    if (counts->normals > 0) {
        mesh->normals = malloc((size_t)counts->normals * sizeof *mesh->normals);
        mesh->face_normals = malloc(faces * sizeof *mesh->face_normals);
        ok = ok && mesh->normals && mesh->face_normals;
    }
    if (counts->uvs > 0) {
        mesh->uvs = malloc((size_t)counts->uvs * sizeof *mesh->uvs);
        mesh->face_uvs = malloc(faces * sizeof *mesh->face_uvs);
        ok = ok && mesh->uvs && mesh->face_uvs;
    }
    return ok || no_memory(error);
}

// ---- copies ---------------------------------------------------------------------------------

// Whether the value is finite, also as a float.
static bool in_range(f64 value)
{
    return fabs(value) <= (f64)FLT_MAX;
}

static Vec3 vec_of(const struct aiVector3D *v)
{
    return (Vec3){(f64)v->x, (f64)v->y, (f64)v->z};
}

static bool every_corner_alone(const struct aiMesh *mesh)
{
    u64 corners = 0;
    for (u32 i = 0; i < mesh->mNumFaces; ++i)
        corners += mesh->mFaces[i].mNumIndices;
    return corners == mesh->mNumVertices;
}

static bool copy_positions(Import *import, const Placement *placement, Error *error)
{
    Mesh *mesh = &import->file->mesh;
    const struct aiMesh *from = placement->mesh;
    Vec3 *to = mesh->positions + mesh->position_count;
    for (u32 i = 0; i < from->mNumVertices; ++i) {
        to[i] = affine_point(placement->map, vec_of(&from->mVertices[i]));
        if (!in_range(to[i].x) || !in_range(to[i].y) || !in_range(to[i].z))
            return error_set(error, ERROR_SCENE, "a vertex is not finite");
        import->map[i] = i;
    }
    u32 count = from->mNumVertices;
    if (every_corner_alone(from)) {
        count = weld_points(to, count, import->map);
        if (count == MESH_NO_INDEX)
            return no_memory(error);
    }
    for (u32 i = 0; i < from->mNumVertices; ++i)
        import->map[i] += mesh->position_count;
    mesh->position_count += count;
    return true;
}

// A normal without a direction is left as 0, which no face will use.
static void copy_normals(Mesh *mesh, const Placement *placement)
{
    const struct aiMesh *from = placement->mesh;
    const f64 determinant = affine_determinant(placement->map);
    const bool regular = isfinite(determinant) && determinant != 0;
    for (u32 i = 0; i < from->mNumVertices; ++i) {
        f32 *to = mesh->normals[mesh->normal_count++];
        const Vec3 n = vec_of(&from->mNormals[i]);
        Vec3 carried = {0, 0, 0};
        if (regular && in_range(n.x) && in_range(n.y) && in_range(n.z) && (n.x != 0 || n.y != 0 || n.z != 0))
            carried = affine_normal(placement->map, n);
        const bool sound = in_range(carried.x) && in_range(carried.y) && in_range(carried.z);
        to[0] = sound ? (f32)carried.x : 0;
        to[1] = sound ? (f32)carried.y : 0;
        to[2] = sound ? (f32)carried.z : 0;
    }
}

// The library turns v so that it is 0 at the bottom of an image, whatever the format says.
static void copy_uvs(const Import *import, const struct aiMesh *from)
{
    Mesh *mesh = &import->file->mesh;
    const struct aiVector3D *uvs = uvs_of(import, from);
    const i32 material = material_of(import, from);
    for (u32 i = 0; i < from->mNumVertices; ++i) {
        f32 *to = mesh->uvs[mesh->uv_count++];
        to[0] = uvs[i].x;
        to[1] = uvs[i].y;
        for (u32 k = 0; k < 2 && material >= 0; ++k) {
            const f64 *row = import->file->materials[material].uvs.row[k];
            to[k] = (f32)(row[0] * (f64)uvs[i].x + row[1] * (f64)uvs[i].y + row[2]);
        }
    }
}

// Corners of a triangle as indices of the library's mesh; behind base in ours where all of them are usable.
static void index_normals(const Mesh *mesh, u32 base, const u32 corners[3], u32 indices[3])
{
    bool usable = true;
    for (u32 k = 0; k < 3; ++k) {
        const f32 *n = mesh->normals[base + corners[k]];
        usable = usable && (n[0] != 0 || n[1] != 0 || n[2] != 0);
    }
    for (u32 k = 0; k < 3; ++k)
        indices[k] = usable ? base + corners[k] : MESH_NO_INDEX;
}

static void index_uvs(const Mesh *mesh, u32 base, const u32 corners[3], u32 indices[3])
{
    bool usable = true;
    for (u32 k = 0; k < 3; ++k) {
        const f32 *uv = mesh->uvs[base + corners[k]];
        usable = usable && isfinite(uv[0]) && isfinite(uv[1]);
    }
    for (u32 k = 0; k < 3; ++k)
        indices[k] = usable ? base + corners[k] : MESH_NO_INDEX;
}

// Where the vertices of the placement begin; MESH_NO_INDEX: it has none of the kind.
typedef struct Bases {
    u32 normal, uv;
} Bases;

static void add_triangle(Import *import, const u32 corners[3], Bases bases)
{
    static const u32 NONE[3] = {MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX};
    Mesh *mesh = &import->file->mesh;
    const u32 face = mesh->face_count++;
    for (u32 k = 0; k < 3; ++k)
        mesh->faces[face][k] = import->map[corners[k]];
    if (bases.normal != MESH_NO_INDEX)
        index_normals(mesh, bases.normal, corners, mesh->face_normals[face]);
    else if (mesh->face_normals)
        memcpy(mesh->face_normals[face], NONE, sizeof NONE);
    if (bases.uv != MESH_NO_INDEX)
        index_uvs(mesh, bases.uv, corners, mesh->face_uvs[face]);
    else if (mesh->face_uvs)
        memcpy(mesh->face_uvs[face], NONE, sizeof NONE);
}

static bool copy_faces(Import *import, const Placement *placement, Bases bases, Error *error)
{
    const struct aiMesh *from = placement->mesh;
    const bool mirrored = affine_determinant(placement->map) < 0;
    for (u32 f = 0; f < from->mNumFaces; ++f) {
        const struct aiFace *face = &from->mFaces[f];
        for (u32 k = 0; k < face->mNumIndices; ++k) {
            if (face->mIndices[k] >= from->mNumVertices)
                return error_set(error, ERROR_SCENE, "face %u names vertex %u of %u", f, face->mIndices[k],
                                 from->mNumVertices);
        }
        for (u32 k = 2; k < face->mNumIndices; ++k) {
            const u32 second = face->mIndices[k - 1], third = face->mIndices[k];
            const u32 corners[3] = {face->mIndices[0], mirrored ? third : second, mirrored ? second : third};
            add_triangle(import, corners, bases);
        }
    }
    return true;
}

static bool copy_placement(Import *import, const Placement *placement, Error *error)
{
    Mesh *mesh = &import->file->mesh;
    const struct aiMesh *from = placement->mesh;
    Bases bases = {MESH_NO_INDEX, MESH_NO_INDEX};
    if (!copy_positions(import, placement, error))
        return false;
    if (has_normals(import, from)) {
        bases.normal = mesh->normal_count;
        copy_normals(mesh, placement);
    }
    if (uvs_of(import, from)) {
        bases.uv = mesh->uv_count;
        copy_uvs(import, from);
    }
    const u32 first = mesh->face_count;
    if (!copy_faces(import, placement, bases, error))
        return false;
    if (mesh->face_count > first)
        mesh->parts[mesh->part_count++] = (MeshPart){first, material_of(import, from)};
    return true;
}

// ---- the file -------------------------------------------------------------------------------

static bool is_colored(const struct aiMesh *mesh)
{
    bool colored = false;
    for (u32 i = 0; mesh->mColors[0] && i < mesh->mNumVertices && !colored; ++i) {
        const struct aiColor4D *c = &mesh->mColors[0][i];
        colored = c->r < 1 || c->g < 1 || c->b < 1;
    }
    return colored;
}

static void note_colors(Import *import)
{
    for (u32 i = 0; i < import->scene->mNumMeshes; ++i) {
        const struct aiMesh *mesh = import->scene->mMeshes[i];
        const i32 material = material_of(import, mesh);
        if (material >= 0 && is_colored(mesh))
            import->file->materials[material].left_out |= 1u << IMPORT_VERTEX_COLORS;
    }
}

static bool format_begins(const struct aiScene *scene, const char *name)
{
    const struct aiMetadata *data = scene->mMetaData;
    for (u32 i = 0; data && i < data->mNumProperties; ++i) {
        if (strcmp(data->mKeys[i].data, AI_METADATA_SOURCE_FORMAT) != 0 ||
            data->mValues[i].mType != AI_AISTRING)
            continue;
        const struct aiString *value = data->mValues[i].mData;
        return strncmp(value->data, name, strlen(name)) == 0;
    }
    return false;
}

static bool convert(const Assimp *assimp, Import *import, Error *error)
{
    import->facets = format_begins(import->scene, "Stereolithography");
    import->gltf = format_begins(import->scene, "glTF2");
    if ((import->gltf && !import_materials(assimp, import->scene, import->path, import->file, error)) ||
        !placements_make(import->scene, &import->placements, error))
        return false;
    note_colors(import);
    const Counts counts = count_all(import);
    if (counts.faces == 0)
        return true;
    bool ok = allocate(import, &counts, error);
    for (u32 i = 0; ok && i < import->placements.count; ++i)
        ok = copy_placement(import, &import->placements.list[i], error);
    return ok;
}

bool import_available(void)
{
    return true;
}

bool import_read(const char *path, ImportFile *file, Error *error)
{
    memset(file, 0, sizeof *file);
    Assimp assimp;
    if (!ply_head_check(path, error) || !assimp_open(&assimp, error))
        return false;
    Import import = {.path = path, .file = file, .scene = assimp.import_file(path, 0)};
    bool ok = import.scene ? convert(&assimp, &import, error)
                           : error_set(error, ERROR_SCENE, "%.1000s", assimp.error_string());
    placements_free(&import.placements);
    free(import.map);
    assimp.release_import(import.scene);
    assimp_close(&assimp);
    if (!ok)
        import_destroy(file);
    return ok;
}

void import_destroy(ImportFile *file)
{
    import_materials_destroy(file);
    mesh_destroy(&file->mesh);
    memset(file, 0, sizeof *file);
}

#endif
