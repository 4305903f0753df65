#include "assets/assets.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "assets/finish.h"
#include "assets/import.h"
#include "assets/materials.h"
#include "assets/obj.h"
#include "scene/names.h"
#include "scene/report.h"

// A file that shapes name.
typedef struct MeshFile {
    const char *path; // as the first of them resolves it
    SourcePos at;     // of that one's `file`
    u64 device, inode;
    bool readable;           // it is a regular file
    bool wanted[2];          // [1]: by a shape that is `smooth on`, [0]: by another
    const Mesh *meshes[2];   // what these shapes get, NULL after an error
} MeshFile;

typedef struct Loader {
    Scene *scene;
    Arena *arena;
    Arena *scratch; // for as long as assets_load runs
    Diagnostics *diagnostics;
    Names paths;
    u32 *path_files; // index of the file, one a path
    MeshFile *files;
    u32 file_count;
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

// ---- files ----------------------------------------------------------------------------------

static void refuse(const Loader *loader, const MeshFile *file, const char *what, const char *reason)
{
    scene_report(loader->scene, loader->diagnostics, SEVERITY_ERROR, file->at, "cannot %s '%s': %s", what,
                 file->path, reason);
}

// Looks whether the file can be read and which it is.
static MeshFile look_up(const Loader *loader, const Shape *shape)
{
    MeshFile file = {.path = shape->as.mesh.file, .at = shape->as.mesh.file_at};
    struct stat status;
    if (stat(file.path, &status) != 0) {
        refuse(loader, &file, "read", strerror(errno));
    } else if (S_ISDIR(status.st_mode)) {
        refuse(loader, &file, "read", strerror(EISDIR));
    } else if (!S_ISREG(status.st_mode)) {
        refuse(loader, &file, "read", "not a regular file");
    } else {
        file.readable = true;
        file.device = (u64)status.st_dev;
        file.inode = (u64)status.st_ino;
    }
    return file;
}

// The index of the file that shape names, new or known by another name.
static bool find_file(Loader *loader, const Shape *shape, u32 *index)
{
    const MeshFile file = look_up(loader, shape);
    for (u32 i = 0; file.readable && i < loader->file_count; ++i) {
        const MeshFile *other = &loader->files[i];
        if (other->readable && other->device == file.device && other->inode == file.inode) {
            *index = i;
            return true;
        }
    }
    MeshFile *files = arena_grow(loader->scratch, loader->files, loader->file_count, sizeof *files);
    if (!files)
        return false;
    loader->files = files;
    *index = loader->file_count;
    files[loader->file_count++] = file;
    return true;
}

// The index of the file of a shape; a path is looked up once.
static bool file_of(Loader *loader, const Shape *shape, u32 *index)
{
    const char *path = shape->as.mesh.file;
    const size_t length = strlen(path);
    const i32 known = names_find(&loader->paths, path, length);
    if (known >= 0) {
        *index = loader->path_files[known];
        return true;
    }
    u32 *path_files =
        arena_grow(loader->scratch, loader->path_files, loader->paths.count, sizeof *path_files);
    if (!path_files || !find_file(loader, shape, index))
        return false;
    loader->path_files = path_files;
    path_files[loader->paths.count] = *index;
    return names_add(&loader->paths, loader->scratch, path, length);
}

static bool list_files(Loader *loader)
{
    for (u32 i = 0; i < loader->scene->shape_count; ++i) {
        const Shape *shape = &loader->scene->shapes[i];
        u32 index;
        if (!is_mesh(shape))
            continue;
        if (!file_of(loader, shape, &index))
            return false;
        loader->files[index].wanted[wanted_by(shape)] = true;
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
                             .diagnostics = loader->diagnostics, .path = file->path, .at = file->at};
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
    const bool read = obj_read(file->path, loader->diagnostics, &obj, error);
    if (!read && error->code == ERROR_MEMORY)
        return error_set(error, ERROR_MEMORY, "%s: no memory for the mesh", file->path);
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
    if (!import_read(file->path, &import, error)) {
        if (error->code == ERROR_MEMORY)
            return error_set(error, ERROR_MEMORY, "%s: no memory for the mesh", file->path);
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
    if (!file->readable)
        return true;
    const u32 errors = diagnostics_error_count(loader->diagnostics);
    Mesh *mesh = next_mesh(loader->scene);
    const bool read = is_obj(file->path) ? read_obj(loader, file, mesh, error)
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
        const char *path = shape->as.mesh.file;
        const i32 known = names_find(&loader->paths, path, strlen(path));
        shape->as.mesh.mesh = loader->files[loader->path_files[known]].meshes[wanted_by(shape)];
    }
}

static bool load(Loader *loader, Error *error)
{
    if (!loader->scratch || !list_files(loader))
        return no_memory(error);
    Scene *scene = loader->scene;
    scene->mesh_count = 0;
    scene->meshes = arena_alloc(loader->arena, 2 * (size_t)loader->file_count, sizeof *scene->meshes);
    if (!scene->meshes)
        return no_memory(error);
    for (u32 i = 0; i < loader->file_count; ++i) {
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
    const bool ok = load(&loader, error);
    arena_destroy(loader.scratch);
    return ok;
}

void assets_release(Scene *scene)
{
    if (!scene)
        return;
    for (u32 i = 0; i < scene->mesh_count; ++i)
        mesh_destroy(&scene->meshes[i]);
    scene->meshes = NULL;
    scene->mesh_count = 0;
    for (u32 i = 0; i < scene->shape_count; ++i) {
        if (is_mesh(&scene->shapes[i]))
            scene->shapes[i].as.mesh.mesh = NULL;
    }
}
