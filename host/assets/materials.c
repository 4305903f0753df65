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
    u32 textured;                     // materials with textures that were added
    const MtlMaterial *first_textured;
    const char *first_textured_path;
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
    if ((mtl->map_kd || mtl->map_bump) && libraries->textured++ == 0) {
        libraries->first_textured = mtl;
        libraries->first_textured_path = libraries->paths[libraries->owners[found]];
    }
    return add(context, phong_of(mtl), mtl->name, index);
}

static void warn_of_textures(const MaterialContext *context, const Libraries *libraries)
{
    const MtlMaterial *mtl = libraries->first_textured;
    if (!mtl)
        return;
    const char *what = !mtl->map_kd     ? "the normal map"
                       : !mtl->map_bump ? "map_Kd"
                                        : "map_Kd and the normal map";
    const u32 line = mtl->map_kd ? mtl->map_kd_line : mtl->map_bump_line;
    char others[64] = "";
    if (libraries->textured > 1)
        snprintf(others, sizeof others, ", and those of %u more", libraries->textured - 1);
    diagnostics_add(context->diagnostics, SEVERITY_WARNING, libraries->first_textured_path, line, 1, 1, NULL,
                    "image textures are not supported yet; left out: %s of material '%s'%s", what, mtl->name,
                    others);
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
    warn_of_textures(context, libraries);
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

bool materials_add_import(const MaterialContext *context, const ImportFile *file, i32 *indices, Error *error)
{
    bool textured = false;
    for (u32 i = 0; i < file->material_count; ++i) {
        const ImportMaterial *from = &file->materials[i];
        Material material = material_default();
        material.diffuse.color = from->base_color;
        material.ambient = material.diffuse;
        material.emission.color = from->emission;
        textured |= from->textured;
        if (!add(context, material, from->name, &indices[i]))
            return no_memory(error);
    }
    if (file->material_count > 0)
        scene_report(context->scene, context->diagnostics, SEVERITY_WARNING, context->at,
                     "pbr materials are not supported yet: base colour and emission of those of '%s' serve "
                     "as phong%s",
                     context->path, textured ? ", image textures are left out" : "");
    return true;
}
