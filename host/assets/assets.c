#include "assets/assets.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "assets/finish.h"
#include "assets/import.h"
#include "assets/materials.h"
#include "assets/named_files.h"
#include "assets/obj.h"
#include "assets/textures.h"

// What is made of a file that shapes name.
typedef struct MeshFile {
    const NamedFile *named;
    bool wanted[2];        // [1]: by a shape that is `smooth on`, [0]: by another
    const Mesh *meshes[2]; // what these shapes get, NULL after an error
} MeshFile;

typedef struct Loader {
    Scene *scene;
    Arena *arena;
    Arena *scratch; // for as long as assets_load runs
    Diagnostics *diagnostics;
    NamedFiles named;
    MeshFile *files; // one for each of the named
} Loader;

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "no memory for the meshes");
}

static bool is_mesh(const Shape *shape)
{
    return shape->kind == SHAPE_MESH;
}

static u32 wanted_by(const Shape *shape)
{
    return shape->as.mesh.smooth > 0;
}

static void refuse(const Loader *loader, const MeshFile *file, const char *what, const char *reason)
{
    named_file_refuse(&loader->named, file->named, what, reason);
}

// The file of each shape, and how the shapes want it.
static bool list_files(Loader *loader)
{
    for (u32 i = 0; i < loader->scene->shape_count; ++i) {
        const Shape *shape = &loader->scene->shapes[i];
        if (is_mesh(shape) &&
            !named_files_add(&loader->named, shape->as.mesh.file, shape->as.mesh.file_at, NULL))
            return false;
    }
    loader->files = arena_alloc(loader->scratch, loader->named.count, sizeof *loader->files);
    if (!loader->files)
        return false;
    for (u32 i = 0; i < loader->named.count; ++i)
        loader->files[i].named = &loader->named.files[i];
    for (u32 i = 0; i < loader->scene->shape_count; ++i) {
        const Shape *shape = &loader->scene->shapes[i];
        if (!is_mesh(shape))
            continue;
        const u32 file = named_files_find(&loader->named, shape->as.mesh.file);
        loader->files[file].wanted[wanted_by(shape)] = true;
    }
    return true;
}

// ---- meshes ---------------------------------------------------------------------------------

// Without a suffix it may be an OBJ as well as anything.
static bool is_obj(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    return !dot || strcasecmp(dot, ".obj") == 0;
}

static MaterialContext context_of(const Loader *loader, const MeshFile *file)
{
    return (MaterialContext){.scene = loader->scene, .arena = loader->arena,
                             .diagnostics = loader->diagnostics, .path = file->named->path,
                             .at = file->named->at};
}

static void map_parts(Mesh *mesh, const i32 *indices)
{
    for (u32 i = 0; i < mesh->part_count; ++i) {
        MeshPart *part = &mesh->parts[i];
        part->material = part->material < 0 ? -1 : indices[part->material];
    }
}

// Each of the two readers gives *mesh with the scene's materials, or leaves it empty and reports why.
static bool read_obj(const Loader *loader, const MeshFile *file, Mesh *mesh, Error *error)
{
    ObjFile obj = {0};
    const u32 errors = diagnostics_error_count(loader->diagnostics);
    const bool read = obj_read(file->named->path, loader->diagnostics, &obj, error);
    if (!read && error->code == ERROR_MEMORY)
        return error_set(error, ERROR_MEMORY, "%s: no memory for the mesh", file->named->path);
    if (!read)
        refuse(loader, file, "read", error->text);
    bool ok = true;
    if (read && diagnostics_error_count(loader->diagnostics) == errors) {
        const MaterialContext context = context_of(loader, file);
        i32 *indices = arena_alloc(loader->scratch, obj.material_count, sizeof *indices);
        ok = indices ? materials_add_obj(&context, &obj, indices, error) : no_memory(error);
        if (ok) {
            map_parts(&obj.mesh, indices);
            *mesh = obj.mesh;
            memset(&obj.mesh, 0, sizeof obj.mesh);
        }
    }
    obj_destroy(&obj);
    return ok;
}

static bool read_other(const Loader *loader, const MeshFile *file, Mesh *mesh, Error *error)
{
    ImportFile import = {0};
    if (!import_read(file->named->path, &import, error)) {
        if (error->code == ERROR_MEMORY)
            return error_set(error, ERROR_MEMORY, "%s: no memory for the mesh", file->named->path);
        refuse(loader, file, "read", error->text);
        return true;
    }
    const MaterialContext context = context_of(loader, file);
    i32 *indices = arena_alloc(loader->scratch, import.material_count, sizeof *indices);
    const bool ok = indices ? materials_add_import(&context, &import, indices, error) : no_memory(error);
    if (ok) {
        map_parts(&import.mesh, indices);
        *mesh = import.mesh;
        memset(&import.mesh, 0, sizeof import.mesh);
    }
    import_destroy(&import);
    return ok;
}

// The error of a step that is about the file becomes one of the scene; others end the loading.
static bool settle(const Loader *loader, MeshFile *file, Error *error)
{
    file->meshes[0] = file->meshes[1] = NULL;
    if (error->code != ERROR_SCENE)
        return false;
    refuse(loader, file, "use", error->text);
    return true;
}

static Mesh *next_mesh(Scene *scene)
{
    return &scene->meshes[scene->mesh_count++]; // assets_load made room for two a file
}

static bool finish(const Loader *loader, MeshFile *file, Mesh *mesh, Error *error)
{
    if (!mesh_finish(mesh, error))
        return settle(loader, file, error);
    file->meshes[0] = file->meshes[1] = mesh;
    if (!file->wanted[1] || !mesh_lacks_normals(mesh))
        return true;
    Mesh *smooth = mesh;
    if (file->wanted[0]) {
        smooth = next_mesh(loader->scene);
        if (!mesh_copy(mesh, smooth, error))
            return settle(loader, file, error);
    }
    file->meshes[1] = smooth;
    return mesh_make_normals(smooth, error) || settle(loader, file, error);
}

static bool load_file(const Loader *loader, MeshFile *file, Error *error)
{
    if (!file->named->readable)
        return true;
    const u32 errors = diagnostics_error_count(loader->diagnostics);
    Mesh *mesh = next_mesh(loader->scene);
    const bool read = is_obj(file->named->path) ? read_obj(loader, file, mesh, error)
                                         : read_other(loader, file, mesh, error);
    if (!read || diagnostics_error_count(loader->diagnostics) > errors)
        return read;
    return finish(loader, file, mesh, error);
}

static void point_shapes(Loader *loader)
{
    for (u32 i = 0; i < loader->scene->shape_count; ++i) {
        Shape *shape = &loader->scene->shapes[i];
        if (!is_mesh(shape))
            continue;
        const u32 file = named_files_find(&loader->named, shape->as.mesh.file);
        shape->as.mesh.mesh = loader->files[file].meshes[wanted_by(shape)];
    }
}

static bool load(Loader *loader, Error *error)
{
    if (!loader->scratch || !list_files(loader))
        return no_memory(error);
    Scene *scene = loader->scene;
    scene->mesh_count = 0;
    scene->meshes = arena_alloc(loader->arena, 2 * (size_t)loader->named.count, sizeof *scene->meshes);
    if (!scene->meshes)
        return no_memory(error);
    for (u32 i = 0; i < loader->named.count; ++i) {
        if (!load_file(loader, &loader->files[i], error))
            return false;
    }
    point_shapes(loader);
    return true;
}

bool assets_load(Scene *scene, Arena *arena, Diagnostics *diagnostics, Error *error)
{
    Loader loader = {
        .scene = scene, .arena = arena, .scratch = arena_create(), .diagnostics = diagnostics};
    loader.named = (NamedFiles){.scene = scene, .arena = loader.scratch, .diagnostics = diagnostics};
    // Meshes first: their materials may name images, too.
    const bool ok = load(&loader, error) && textures_load(scene, arena, diagnostics, error);
    arena_destroy(loader.scratch);
    return ok;
}

void assets_release(Scene *scene)
{
    if (!scene)
        return;
    textures_release(scene);
    for (u32 i = 0; i < scene->mesh_count; ++i)
        mesh_destroy(&scene->meshes[i]);
    scene->meshes = NULL;
    scene->mesh_count = 0;
    for (u32 i = 0; i < scene->shape_count; ++i) {
        if (is_mesh(&scene->shapes[i]))
            scene->shapes[i].as.mesh.mesh = NULL;
    }
}
