#include "assets/gltf_json.h"

#include <float.h>
#include <string.h>

#include <jansson.h>

#include "base/arena.h"
#include "base/file.h"

enum { GLB_HEAD = 12, CHUNK_HEAD = 8 }; // bytes

static u32 u32_at(const char *bytes)
{
    const u8 *b = (const u8 *)bytes;
    return (u32)b[0] | (u32)b[1] << 8 | (u32)b[2] << 16 | (u32)b[3] << 24;
}

// Moves the content to its JSON, which in a GLB is the first chunk.
static void find_json(FileContent *content)
{
    if (content->length < GLB_HEAD + CHUNK_HEAD || memcmp(content->text, "glTF", 4) != 0)
        return;
    const size_t chunk = u32_at(content->text + GLB_HEAD), most = content->length - GLB_HEAD - CHUNK_HEAD;
    content->text += GLB_HEAD + CHUNK_HEAD;
    content->length = chunk < most ? chunk : most;
}

// Whether the name is there at all: most files need not be parsed a second time.
static bool mentions(const FileContent *content, const char *name)
{
    const size_t length = strlen(name);
    const char *at = content->text, *end = at + content->length;
    while (at && (size_t)(end - at) >= length && memcmp(at, name, length) != 0)
        at = memchr(at + 1, name[0], (size_t)(end - at) - 1);
    return at && (size_t)(end - at) >= length;
}

static void read_strengths(const json_t *root, f64 *strengths, u32 count)
{
    const json_t *materials = json_object_get(root, "materials");
    for (u32 i = 0; i < count; ++i) {
        const json_t *extensions = json_object_get(json_array_get(materials, i), "extensions");
        const json_t *emission = json_object_get(extensions, "KHR_materials_emissive_strength");
        const json_t *strength = json_object_get(emission, "emissiveStrength");
        const f64 value = json_is_number(strength) ? json_number_value(strength) : 1;
        strengths[i] = value < 0 ? 0 : value > (f64)FLT_MAX ? (f64)FLT_MAX : value;
    }
}

bool gltf_emissive_strengths(const char *path, f64 *strengths, u32 count, Error *error)
{
    Arena *arena = arena_create();
    FileContent content;
    Error reason = {0};
    for (u32 i = 0; i < count; ++i)
        strengths[i] = 1;
    bool ok = arena != NULL;
    if (ok && file_read(path, true, arena, &content, &reason)) {
        find_json(&content);
        json_t *root = mentions(&content, "emissiveStrength")
                           ? json_loadb(content.text, content.length, JSON_DISABLE_EOF_CHECK, NULL)
                           : NULL;
        read_strengths(root, strengths, count);
        json_decref(root);
    }
    ok = ok && reason.code != ERROR_MEMORY;
    arena_destroy(arena);
    return ok || error_set(error, ERROR_MEMORY, "out of memory");
}
