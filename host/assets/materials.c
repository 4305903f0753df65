#include "assets/materials.h"

#include <stdlib.h>
#include <string.h>

#include "assets/mtl.h"
#include "base/file.h"
#include "scene/material.h"
#include "scene/names.h"
#include "scene/report.h"

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "no memory for materials");
}

// Adds a material with the name; *index becomes its index.
static bool add(const MaterialContext *context, Material material, const char *name, i32 *index)
{
    Scene *scene = context->scene;
    material.at = context->at;
    material.name = arena_copy_text(context->arena, name, strlen(name));
    Material *materials =
        arena_grow(context->arena, scene->materials, scene->material_count, sizeof *materials);
    if (!materials || !material.name)
        return false;
    scene->materials = materials;
    *index = (i32)scene->material_count;
    materials[scene->material_count++] = material;
    return true;
}

// Adds an image texture; *index becomes its index.
static bool add_texture(const MaterialContext *context, Texture texture, i32 *index)
{
    Scene *scene = context->scene;
    Texture *textures = arena_grow(context->arena, scene->textures, scene->texture_count, sizeof *textures);
    if (!textures || !texture.file)
        return false;
    texture.kind = TEXTURE_IMAGE;
    texture.at = texture.file_at = context->at;
    texture.name = texture.file;
    texture.scale[0] = texture.scale[1] = 1;
    scene->textures = textures;
    *index = (i32)scene->texture_count;
    textures[scene->texture_count++] = texture;
    return true;
}

// ---- OBJ and MTL ----------------------------------------------------------------------------

// The libraries of an OBJ.
typedef struct Libraries {
    Arena *arena;
    MtlFile *files; // one a library of the OBJ; empty where it cannot be read
    const char **paths;
    Names names;                      // of all materials, the first of each name
    const MtlMaterial **materials;    // one a name
    u32 *owners;                      // one a name: index of the library
    bool complete;                    // every library was read
} Libraries;

static bool index_library(Libraries *libraries, u32 library)
{
    const MtlFile *file = &libraries->files[library];
    for (u32 i = 0; i < file->count; ++i) {
        const MtlMaterial *material = &file->materials[i];
        const size_t length = strlen(material->name);
        if (names_find(&libraries->names, material->name, length) >= 0)
            continue;
        const u32 count = libraries->names.count;
        libraries->materials = arena_grow(libraries->arena, libraries->materials, count, sizeof material);
        libraries->owners = arena_grow(libraries->arena, libraries->owners, count, sizeof library);
        if (!libraries->materials || !libraries->owners)
            return false;
        libraries->materials[count] = material;
        libraries->owners[count] = library;
        if (!names_add(&libraries->names, libraries->arena, material->name, length))
            return false;
    }
    return true;
}

static bool read_library(const MaterialContext *context, const ObjFile *obj, u32 library,
                         Libraries *libraries, Error *error)
{
    const char *name = obj->libraries[library];
    const char *path = path_beside(libraries->arena, context->path, name);
    if (!path)
        return no_memory(error);
    libraries->paths[library] = path;
    Error reason;
    if (!mtl_read(path, context->diagnostics, &libraries->files[library], &reason)) {
        if (reason.code == ERROR_MEMORY)
            return error_set(error, ERROR_MEMORY, "%s: %s", path, reason.text);
        libraries->complete = false;
        diagnostics_add(context->diagnostics, SEVERITY_WARNING, context->path, obj->library_lines[library],
                        1, 1, NULL, "cannot read '%s': %s", path, reason.text);
        return true;
    }
    return index_library(libraries, library) || no_memory(error);
}

static Material phong_of(const MtlMaterial *mtl)
{
    Material material = material_default();
    if (mtl->given & MTL_KD)
        material.diffuse.color = (Vec3){mtl->kd[0], mtl->kd[1], mtl->kd[2]};
    material.ambient = material.diffuse;
    if (mtl->given & MTL_KS)
        material.specular = (Vec3){mtl->ks[0], mtl->ks[1], mtl->ks[2]};
    if (mtl->given & MTL_KE)
        material.emission.color = (Vec3){mtl->ke[0], mtl->ke[1], mtl->ke[2]};
    if (mtl->given & MTL_NS)
        material.shininess = mtl->ns;
    if (mtl->given & MTL_NI)
        material.ior = mtl->ni;
    if (mtl->given & MTL_D)
        material.transmit = (Vec3){1 - mtl->d, 1 - mtl->d, 1 - mtl->d};
    return material;
}

// The texture of a file that a library names, where it names one; a backslash is a slash from elsewhere.
static bool add_map(const MaterialContext *context, const char *library, const char *name, i32 *index)
{
    if (!name)
        return true;
    char *file = arena_copy_text(context->arena, name, strlen(name));
    for (char *at = file; at && (at = strchr(at, '\\'));)
        *at = '/';
    const Texture texture = {.file = file ? path_beside(context->arena, library, file) : NULL,
                             .named_by = arena_copy_text(context->arena, library, strlen(library))};
    return texture.named_by && add_texture(context, texture, index);
}

static bool add_named(const MaterialContext *context, const ObjFile *obj, u32 i, Libraries *libraries,
                      i32 *index)
{
    const char *name = obj->material_names[i];
    const i32 found = names_find(&libraries->names, name, strlen(name));
    *index = -1;
    if (found < 0) {
        if (libraries->complete) // else it may be in what could not be read
            diagnostics_add(context->diagnostics, SEVERITY_WARNING, context->path, obj->material_lines[i], 1,
                            1, NULL, "no mtllib of the file has a material '%s'", name);
        return true;
    }
    const MtlMaterial *mtl = libraries->materials[found];
    const char *path = libraries->paths[libraries->owners[found]];
    Material material = phong_of(mtl);
    if (!add_map(context, path, mtl->map_kd, &material.diffuse.texture) ||
        !add_map(context, path, mtl->map_bump, &material.normal_map))
        return false;
    material.ambient = material.diffuse;
    return add(context, material, mtl->name, index);
}

static bool add_all(const MaterialContext *context, const ObjFile *obj, Libraries *libraries, i32 *indices,
                    Error *error)
{
    for (u32 i = 0; i < obj->library_count; ++i) {
        if (!read_library(context, obj, i, libraries, error))
            return false;
    }
    for (u32 i = 0; i < obj->material_count; ++i) {
        if (!add_named(context, obj, i, libraries, &indices[i]))
            return no_memory(error);
    }
    return true;
}

bool materials_add_obj(const MaterialContext *context, const ObjFile *obj, i32 *indices, Error *error)
{
    Libraries libraries = {.arena = arena_create(), .complete = true};
    if (!libraries.arena)
        return no_memory(error);
    libraries.files = arena_alloc(libraries.arena, obj->library_count, sizeof *libraries.files);
    libraries.paths = arena_alloc(libraries.arena, obj->library_count, sizeof *libraries.paths);
    const bool room = libraries.files && libraries.paths;
    const bool ok = room ? add_all(context, obj, &libraries, indices, error) : no_memory(error);
    for (u32 i = 0; libraries.files && i < obj->library_count; ++i)
        mtl_destroy(&libraries.files[i]);
    arena_destroy(libraries.arena);
    return ok;
}

// ---- imported files -------------------------------------------------------------------------

// The pictures within a file: copies that live as long as the scene.
static bool copy_images(const MaterialContext *context, const ImportFile *file, const void **copies)
{
    for (u32 i = 0; i < file->image_count; ++i) {
        const ImportImage *image = &file->images[i];
        void *copy = image->bytes ? arena_alloc(context->arena, image->size, 1) : NULL;
        if (image->bytes && !copy)
            return false;
        if (copy)
            memcpy(copy, image->bytes, image->size);
        copies[i] = copy;
    }
    return true;
}

// What the materials of a file need to add their textures.
typedef struct Import {
    const MaterialContext *context;
    const ImportFile *file;
    const void **images; // copies
} Import;

// The texture of a map, where there is one; channel: what a number reads.
static bool add_import_map(const Import *import, const ImportMaterial *from, ImportMap kind, u32 channel,
                           i32 *index)
{
    const MaterialContext *context = import->context;
    const ImportTexture *map = &from->maps[kind];
    Texture texture = {.named_by = context->path,
                       .channel = channel,
                       .filter = map->nearest ? TEXTURE_NEAREST : TEXTURE_BILINEAR,
                       .fade = map->fade,
                       .fade_to = kind == IMPORT_NORMAL ? 0.5 : 1};
    if (map->file) {
        texture.file = path_beside(context->arena, context->path, map->file);
        return add_texture(context, texture, index);
    }
    if (map->image < 0 || !import->images[map->image])
        return true;
    texture.file = context->path;
    texture.content = import->images[map->image];
    texture.content_size = import->file->images[map->image].size;
    return add_texture(context, texture, index);
}

static bool add_pbr(const Import *import, const ImportMaterial *from, i32 *index)
{
    Material material = material_default();
    material.kind = MATERIAL_PBR;
    material.base_color.color = from->base_color;
    material.emission.color = from->emission;
    material.metallic.value = from->metallic;
    material.roughness.value = from->roughness;
    material.pbr_transmit = from->transmit;
    material.ior = from->ior;
    return add_import_map(import, from, IMPORT_BASE_COLOR, 0, &material.base_color.texture) &&
           add_import_map(import, from, IMPORT_METALLIC_ROUGHNESS, 1, &material.roughness.texture) &&
           add_import_map(import, from, IMPORT_METALLIC_ROUGHNESS, 2, &material.metallic.texture) &&
           add_import_map(import, from, IMPORT_NORMAL, 0, &material.normal_map) &&
           add_import_map(import, from, IMPORT_OCCLUSION, 0, &material.occlusion.texture) &&
           add_import_map(import, from, IMPORT_EMISSION, 0, &material.emission.texture) &&
           add(import->context, material, from->name, index);
}

// One message for each kind of what is left out, by the first material that has it.
static void report_left_out(const MaterialContext *context, const ImportFile *file)
{
    static const char *const kinds[IMPORT_LEFT_OUTS] = {
        [IMPORT_WRAP] = "textures that are clamped or mirrored repeat",
        [IMPORT_OTHER_UVS] = "all maps are looked up by the coordinates of the first",
        [IMPORT_ALPHA] = "alpha is ignored",
        [IMPORT_LAYERS] = "clear coat, sheen, specular and glossiness, unlit and maps of transmission are "
                          "left out",
        [IMPORT_VERTEX_COLORS] = "colors of vertices are ignored",
    };
    for (u32 kind = 0; kind < IMPORT_LEFT_OUTS; ++kind) {
        u32 i = 0;
        while (i < file->material_count && !(file->materials[i].left_out >> kind & 1))
            ++i;
        if (i < file->material_count)
            scene_report(context->scene, context->diagnostics, SEVERITY_WARNING, context->at,
                         "material '%s' of '%s': %s", file->materials[i].name, context->path, kinds[kind]);
    }
}

bool materials_add_import(const MaterialContext *context, const ImportFile *file, i32 *indices, Error *error)
{
    Import import = {context, file, calloc(file->image_count + (size_t)1, sizeof *import.images)};
    bool ok = import.images && copy_images(context, file, import.images);
    for (u32 i = 0; ok && i < file->material_count; ++i)
        ok = add_pbr(&import, &file->materials[i], &indices[i]);
    free(import.images);
    if (ok)
        report_left_out(context, file);
    return ok || no_memory(error);
}
