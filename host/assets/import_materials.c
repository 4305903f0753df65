#include "assets/import_materials.h"

#ifdef CLRT_ASSIMP

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Of OpenGL, as glTF has it.
enum { FILTER_NEAREST_GL = 9728 };

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "out of memory");
}

// ---- numbers --------------------------------------------------------------------------------

static f64 number_of(const Assimp *assimp, const struct aiMaterial *from, const char *key, unsigned type,
                     unsigned index, f64 otherwise)
{
    ai_real value;
    unsigned count = 1;
    const bool found = assimp->material_numbers(from, key, type, index, &value, &count) == aiReturn_SUCCESS;
    return found && count == 1 && isfinite(value) ? (f64)value : otherwise;
}

static f64 share_of(const Assimp *assimp, const struct aiMaterial *from, const char *key, unsigned type,
                    unsigned index, f64 otherwise)
{
    return fmin(fmax(number_of(assimp, from, key, type, index, otherwise), 0), 1);
}

static Vec3 color_of(const Assimp *assimp, const struct aiMaterial *from, const char *key, unsigned type,
                     unsigned index, f64 otherwise)
{
    struct aiColor4D c;
    if (assimp->material_color(from, key, type, index, &c) != aiReturn_SUCCESS)
        return (Vec3){otherwise, otherwise, otherwise};
    const f64 rgb[3] = {(f64)c.r, (f64)c.g, (f64)c.b};
    f64 sound[3];
    for (u32 k = 0; k < 3; ++k)
        sound[k] = isnan(rgb[k]) || rgb[k] < 0 ? 0 : fmin(rgb[k], (f64)FLT_MAX);
    return (Vec3){sound[0], sound[1], sound[2]};
}

// ---- textures -------------------------------------------------------------------------------

// What the library says of a texture beside its file that is not as in a scene file.
static bool is_inexact(const Assimp *assimp, const struct aiMaterial *from, enum aiTextureType type, unsigned uvs,
                       const enum aiTextureMapMode modes[2])
{
    static const ai_real neutral[5] = {0, 0, 1, 1, 0}; // translation, scale, rotation
    ai_real transform[5];
    unsigned count = 5;
    bool inexact = uvs != 0 || modes[0] != aiTextureMapMode_Wrap || modes[1] != aiTextureMapMode_Wrap;
    if (assimp->material_numbers(from, AI_MATKEY_UVTRANSFORM(type, 0), transform, &count) == aiReturn_SUCCESS)
        for (u32 i = 0; i < 5 && count == 5; ++i)
            inexact |= transform[i] < neutral[i] || transform[i] > neutral[i];
    return inexact || number_of(assimp, from, AI_MATKEY_GLTF_TEXTURE_SCALE(type, 0), 1) < 1 ||
           number_of(assimp, from, AI_MATKEY_GLTF_TEXTURE_SCALE(type, 0), 1) > 1 ||
           number_of(assimp, from, AI_MATKEY_GLTF_TEXTURE_STRENGTH(type, 0), 1) < 1;
}

// Of the first of two types that the library has a texture of. Returns false where memory is exhausted.
static bool read_texture(const Assimp *assimp, const struct aiMaterial *from, const enum aiTextureType types[2],
                         const ImportFile *file, ImportMaterial *material, ImportTexture *texture)
{
    texture->image = -1;
    for (u32 i = 0; i < 2; ++i) {
        struct aiString path;
        unsigned uvs = 0, count = 1;
        int filter = 0;
        enum aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
        if (assimp->texture(from, types[i], 0, &path, NULL, &uvs, NULL, NULL, modes, NULL) != aiReturn_SUCCESS)
            continue;
        if (assimp->material_whole(from, AI_MATKEY_GLTF_MAPPINGFILTER_MAG(types[i], 0), &filter, &count) ==
            aiReturn_SUCCESS)
            texture->nearest = filter == FILTER_NEAREST_GL;
        material->inexact |= is_inexact(assimp, from, types[i], uvs, modes);
        if (path.data[0] != '*') {
            texture->file = strdup(path.data);
            return texture->file != NULL;
        }
        const unsigned long image = strtoul(path.data + 1, NULL, 10);
        texture->image = image < file->image_count ? (i32)image : -1;
        return true;
    }
    return true;
}

static bool read_textures(const Assimp *assimp, const struct aiMaterial *from, const ImportFile *file,
                          ImportMaterial *material)
{
    static const enum aiTextureType types[IMPORT_MAPS][2] = {
        [IMPORT_BASE_COLOR] = {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE},
        [IMPORT_METALLIC_ROUGHNESS] = {aiTextureType_METALNESS, aiTextureType_UNKNOWN},
        [IMPORT_NORMAL] = {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA},
        [IMPORT_OCCLUSION] = {aiTextureType_LIGHTMAP, aiTextureType_AMBIENT_OCCLUSION},
        [IMPORT_EMISSION] = {aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR},
    };
    bool ok = true;
    for (u32 i = 0; i < IMPORT_MAPS; ++i)
        ok = read_texture(assimp, from, types[i], file, material, &material->maps[i]) && ok;
    return ok;
}

// Pictures that the library has decoded itself, to which it leaves no file, are left out: *bytes NULL.
static bool read_images(const struct aiScene *scene, ImportFile *file, Error *error)
{
    file->images = calloc(scene->mNumTextures ? scene->mNumTextures : 1, sizeof *file->images);
    if (!file->images)
        return no_memory(error);
    for (; file->image_count < scene->mNumTextures; ++file->image_count) {
        const struct aiTexture *from = scene->mTextures[file->image_count];
        ImportImage *image = &file->images[file->image_count];
        if (from->mHeight != 0 || from->mWidth == 0)
            continue;
        image->size = from->mWidth; // of bytes, where there is no height
        image->bytes = malloc(image->size);
        if (!image->bytes)
            return no_memory(error);
        memcpy(image->bytes, from->pcData, image->size);
    }
    return true;
}

// ---- materials ------------------------------------------------------------------------------

static bool read_material(const Assimp *assimp, const struct aiMaterial *from, const ImportFile *file,
                          ImportMaterial *material)
{
    struct aiString name;
    const bool named = assimp->material_string(from, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS;
    material->name = strdup(named ? name.data : "");
    material->base_color = color_of(assimp, from, AI_MATKEY_BASE_COLOR, 1);
    material->emission = color_of(assimp, from, AI_MATKEY_COLOR_EMISSIVE, 0);
    const f64 strength = fmax(number_of(assimp, from, AI_MATKEY_EMISSIVE_INTENSITY, 1), 0);
    material->emission.x = fmin(material->emission.x * strength, (f64)FLT_MAX);
    material->emission.y = fmin(material->emission.y * strength, (f64)FLT_MAX);
    material->emission.z = fmin(material->emission.z * strength, (f64)FLT_MAX);
    material->metallic = share_of(assimp, from, AI_MATKEY_METALLIC_FACTOR, 1);
    material->roughness = share_of(assimp, from, AI_MATKEY_ROUGHNESS_FACTOR, 1);
    material->transmit = share_of(assimp, from, AI_MATKEY_TRANSMISSION_FACTOR, 0);
    material->ior = number_of(assimp, from, AI_MATKEY_REFRACTI, 1.5);
    if (!(material->ior > 0))
        material->ior = 1.5;
    return read_textures(assimp, from, file, material) && material->name;
}

// The last material of the library's glTF reader is its own, for meshes that name none.
bool import_materials(const Assimp *assimp, const struct aiScene *scene, ImportFile *file, Error *error)
{
    const u32 count = scene->mNumMaterials > 0 ? scene->mNumMaterials - 1 : 0;
    file->materials = calloc(count ? count : 1, sizeof *file->materials);
    if (!file->materials)
        return no_memory(error);
    if (!read_images(scene, file, error))
        return false;
    while (file->material_count < count) {
        const u32 i = file->material_count++;
        if (!read_material(assimp, scene->mMaterials[i], file, &file->materials[i]))
            return no_memory(error);
    }
    return true;
}

void import_materials_destroy(ImportFile *file)
{
    for (u32 i = 0; i < file->material_count; ++i) {
        free(file->materials[i].name);
        for (u32 k = 0; k < IMPORT_MAPS; ++k)
            free(file->materials[i].maps[k].file);
    }
    for (u32 i = 0; i < file->image_count; ++i)
        free(file->images[i].bytes);
    free(file->materials);
    free(file->images);
}

#endif
