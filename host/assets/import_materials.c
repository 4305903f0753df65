#include "assets/import_materials.h"

#ifdef CLRT_ASSIMP

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "assets/gltf_json.h"

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

static const ImportUvs PLAIN_UVS = {0, {{1, 0, 0}, {0, 1, 0}}};

// The uvs of a texture. glTF's transform scales, turns counter-clockwise and moves, with v downwards. The
// library moves to another origin, about which it turns; that is undone here.
static ImportUvs uvs_of(const Assimp *assimp, const struct aiMaterial *from, enum aiTextureType type,
                        unsigned set)
{
    ImportUvs uvs = PLAIN_UVS;
    ai_real t[5]; // translation, scale, rotation
    unsigned count = 5;
    uvs.set = set;
    if (assimp->material_numbers(from, AI_MATKEY_UVTRANSFORM(type, 0), t, &count) != aiReturn_SUCCESS ||
        count != 5)
        return uvs;
    for (u32 i = 0; i < 5; ++i)
        if (!isfinite(t[i]))
            return uvs;
    const f64 su = (f64)t[2], sv = (f64)t[3], c = cos(-(f64)t[4]), s = sin(-(f64)t[4]);
    const f64 u0 = (f64)t[0] - su / 2 * (s - c + 1), v0 = 1 - sv + sv / 2 * (s + c - 1) - (f64)t[1];
    const f64 row[2][3] = {{c * su, -s * sv, u0 + s * sv}, {s * su, c * sv, 1 - v0 - c * sv}};
    memcpy(uvs.row, row, sizeof row);
    return uvs;
}

static bool same_uvs(const ImportUvs *a, const ImportUvs *b)
{
    bool same = a->set == b->set;
    for (u32 i = 0; i < 6; ++i)
        same = same && fabs(a->row[i / 3][i % 3] - b->row[i / 3][i % 3]) <= 1e-6;
    return same;
}

// What the language has no word for.
static u32 left_out_of(const Assimp *assimp, const struct aiMaterial *from)
{
    struct aiString alpha, path;
    int shading = 0;
    unsigned count = 1;
    const Vec3 sheen = color_of(assimp, from, AI_MATKEY_SHEEN_COLOR_FACTOR, 0);
    const bool layers =
        sheen.x > 0 || sheen.y > 0 || sheen.z > 0 ||
        number_of(assimp, from, AI_MATKEY_CLEARCOAT_FACTOR, 0) > 0 ||
        number_of(assimp, from, AI_MATKEY_GLOSSINESS_FACTOR, -1) >= 0 ||
        assimp->texture(from, AI_MATKEY_TRANSMISSION_TEXTURE, &path, NULL, NULL, NULL, NULL, NULL, NULL) ==
            aiReturn_SUCCESS ||
        (assimp->material_whole(from, AI_MATKEY_SHADING_MODEL, &shading, &count) == aiReturn_SUCCESS &&
         shading == aiShadingMode_NoShading);
    const bool blended =
        assimp->material_string(from, AI_MATKEY_GLTF_ALPHAMODE, &alpha) == aiReturn_SUCCESS &&
        strcmp(alpha.data, "OPAQUE") != 0;
    return (layers ? 1u << IMPORT_LAYERS : 0) | (blended ? 1u << IMPORT_ALPHA : 0);
}

static int hex_digit(char c)
{
    static const char digits[] = "0123456789abcdef0123456789ABCDEF";
    const char *found = c ? strchr(digits, c) : NULL;
    return found ? (int)(found - digits) % 16 : -1;
}

// The name of a file that a URI is; NULL where memory is exhausted.
static char *file_of(const char *uri)
{
    char *name = malloc(strlen(uri) + 1), *to = name;
    while (name && *uri) {
        const int high = *uri == '%' ? hex_digit(uri[1]) : -1, low = high < 0 ? -1 : hex_digit(uri[2]);
        const bool coded = low >= 0 && high + low > 0;
        *to++ = coded ? (char)(high * 16 + low) : *uri;
        uri += coded ? 3 : 1;
    }
    if (name)
        *to = 0;
    return name;
}

// What a texture that the library has of the type is looked up with.
static void read_lookup(const Assimp *assimp, const struct aiMaterial *from, enum aiTextureType type,
                        ImportTexture *texture, u32 *left_out, ImportUvs *uvs)
{
    struct aiString path;
    unsigned set = 0, count = 1;
    int filter = 0;
    enum aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    assimp->texture(from, type, 0, &path, NULL, &set, NULL, NULL, modes, NULL);
    if (assimp->material_whole(from, AI_MATKEY_GLTF_MAPPINGFILTER_MAG(type, 0), &filter, &count) ==
        aiReturn_SUCCESS)
        texture->nearest = filter == FILTER_NEAREST_GL;
    if (modes[0] != aiTextureMapMode_Wrap || modes[1] != aiTextureMapMode_Wrap)
        *left_out |= 1u << IMPORT_WRAP;
    *uvs = uvs_of(assimp, from, type, set);
    // The one is only given for normal maps, the other for occlusion.
    texture->fade = 1 - number_of(assimp, from, AI_MATKEY_GLTF_TEXTURE_SCALE(type, 0), 1) *
                            share_of(assimp, from, AI_MATKEY_GLTF_TEXTURE_STRENGTH(type, 0), 1);
}

// Of the first of two types that the library has a texture of. *mapped: the material has one already. Returns
// false where memory is exhausted.
static bool read_texture(const Assimp *assimp, const struct aiMaterial *from,
                         const enum aiTextureType types[2], const ImportFile *file, ImportMaterial *material,
                         ImportTexture *texture, bool *mapped)
{
    struct aiString path;
    ImportUvs uvs;
    u32 i = 0;
    texture->image = -1;
    while (i < 2 && assimp->texture(from, types[i], 0, &path, NULL, NULL, NULL, NULL, NULL, NULL) !=
                        aiReturn_SUCCESS)
        ++i;
    if (i == 2)
        return true;
    read_lookup(assimp, from, types[i], texture, &material->left_out, &uvs);
    if (*mapped && !same_uvs(&uvs, &material->uvs))
        material->left_out |= 1u << IMPORT_OTHER_UVS;
    if (!*mapped)
        material->uvs = uvs;
    *mapped = true;
    if (path.data[0] != '*') {
        texture->file = file_of(path.data);
        return texture->file != NULL;
    }
    const unsigned long image = strtoul(path.data + 1, NULL, 10);
    texture->image = image < file->image_count ? (i32)image : -1;
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
    bool ok = true, mapped = false;
    for (u32 i = 0; i < IMPORT_MAPS; ++i)
        ok = read_texture(assimp, from, types[i], file, material, &material->maps[i], &mapped) && ok;
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
    material->metallic = share_of(assimp, from, AI_MATKEY_METALLIC_FACTOR, 1);
    material->roughness = share_of(assimp, from, AI_MATKEY_ROUGHNESS_FACTOR, 1);
    material->transmit = share_of(assimp, from, AI_MATKEY_TRANSMISSION_FACTOR, 0);
    material->ior = number_of(assimp, from, AI_MATKEY_REFRACTI, 1.5);
    if (!(material->ior > 0))
        material->ior = 1.5;
    material->uvs = PLAIN_UVS;
    material->left_out = left_out_of(assimp, from);
    return read_textures(assimp, from, file, material) && material->name;
}

// Older versions of the library do not tell the strengths.
static bool strengthen(const char *path, ImportFile *file, Error *error)
{
    f64 *strengths = calloc((size_t)file->material_count + 1, sizeof *strengths);
    const bool ok =
        strengths ? gltf_emissive_strengths(path, strengths, file->material_count, error) : no_memory(error);
    for (u32 i = 0; ok && i < file->material_count; ++i) {
        Vec3 *emission = &file->materials[i].emission;
        emission->x = fmin(emission->x * strengths[i], (f64)FLT_MAX);
        emission->y = fmin(emission->y * strengths[i], (f64)FLT_MAX);
        emission->z = fmin(emission->z * strengths[i], (f64)FLT_MAX);
    }
    free(strengths);
    return ok;
}

// The last material of the library's glTF reader is its own, for meshes that name none.
bool import_materials(const Assimp *assimp, const struct aiScene *scene, const char *path, ImportFile *file,
                      Error *error)
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
    return strengthen(path, file, error);
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
