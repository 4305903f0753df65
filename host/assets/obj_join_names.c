#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "assets/obj_join.h"
#include "base/file.h"
#include "scene/names.h"

typedef struct Joiner {
    ObjFile *obj;
    const char *path;
    Names materials, libraries;
    u32 part_room;
    const char *material; // of the faces from part_first on; NULL: none
    u32 material_line;
    u32 part_first;
} Joiner;

// Index of the name in names, to which it is added where it is new, with its line; -1: no memory.
static i32 intern(Joiner *joiner, Names *names, const char *text, size_t length, u32 line, u32 **lines)
{
    const i32 known = names_find(names, text, length);
    if (known >= 0)
        return known;
    Arena *arena = joiner->obj->arena;
    const char *copy = arena_copy_text(arena, text, length);
    u32 *grown = arena_grow(arena, *lines, names->count, sizeof *grown);
    if (!copy || !grown)
        return -1;
    *lines = grown;
    grown[names->count] = line;
    return names_add(names, arena, copy, length) ? (i32)names->count - 1 : -1;
}

// ---- materials ------------------------------------------------------------------------------

// Ends the part whose material is known at face end, unless it is empty.
static bool end_part(Joiner *joiner, u32 end)
{
    Mesh *mesh = &joiner->obj->mesh;
    if (end == joiner->part_first && !(end == 0 && mesh->face_count == 0))
        return true;
    i32 material = -1;
    if (joiner->material) {
        material = intern(joiner, &joiner->materials, joiner->material, strlen(joiner->material),
                          joiner->material_line, &joiner->obj->material_lines);
        if (material < 0)
            return false;
    }
    const MeshPart part = { joiner->part_first, material };
    joiner->part_first = end;
    if (mesh->part_count > 0 && mesh->parts[mesh->part_count - 1].material == material)
        return true;
    if (mesh->part_count == joiner->part_room) {
        const u32 room = 2 * joiner->part_room + 8; // at most a part a face
        MeshPart *grown = realloc(mesh->parts, room * sizeof *grown);
        if (!grown)
            return false;
        mesh->parts = grown;
        joiner->part_room = room;
    }
    mesh->parts[mesh->part_count++] = part;
    return true;
}

// ---- libraries ------------------------------------------------------------------------------

static bool add_library(Joiner *joiner, const char *name, size_t length, u32 line)
{
    return length == 0 ||
           intern(joiner, &joiner->libraries, name, length, line, &joiner->obj->library_lines) >= 0;
}

static bool is_file(const Joiner *joiner, const char *name)
{
    Arena *scratch = arena_create();
    const char *path = scratch ? path_beside(scratch, joiner->path, name) : NULL;
    const bool found = path && access(path, F_OK) == 0;
    arena_destroy(scratch);
    return found;
}

static bool ends_a_name(const char *end, size_t length)
{
    return length > 4 && strncasecmp(end - 4, ".mtl", 4) == 0;
}

// A name may hold blanks, and a statement several names: it is one where there is such a file. Else each ends
// with a word that ends in .mtl or, where the last word does not, with any.
static bool add_libraries(Joiner *joiner, const char *names, u32 line)
{
    static const char blanks[] = " \t\v\f";
    const size_t length = strlen(names);
    if (names[strcspn(names, blanks)] == 0 || is_file(joiner, names))
        return add_library(joiner, names, length, line);
    const bool suffixes = ends_a_name(names + length, length);
    const char *name = names;
    for (const char *p = names; *p;) {
        p += strcspn(p, blanks);
        if (!suffixes || ends_a_name(p, (size_t)(p - name))) {
            if (!add_library(joiner, name, (size_t)(p - name), line))
                return false;
            name = p + strspn(p, blanks);
        }
        p += strspn(p, blanks);
    }
    return true;
}

// ---------------------------------------------------------------------------------------------

static bool list_names(Arena *arena, const Names *names, char ***list, u32 *count)
{
    *count = names->count;
    *list = arena_alloc(arena, names->count, sizeof **list);
    if (!*list)
        return false;
    for (u32 i = 0; i < names->count; ++i) {
        // The text is the arena's, and intern's own copy.
        memcpy(&(*list)[i], &names->entries[i].text, sizeof(char *));
    }
    return true;
}

static bool take_marks(Joiner *joiner, const ObjPiece *piece)
{
    const ObjChunk *chunk = &piece->chunk;
    for (size_t i = 0; i < chunk->mark_count; ++i) {
        const ObjMark *mark = &chunk->marks[i];
        const char *name = chunk->names + mark->name;
        const u64 line = piece->lines_before + mark->line;
        const u32 shown_line = line < UINT32_MAX ? (u32)line : UINT32_MAX;
        if (mark->kind == OBJ_USE_LIBRARY) {
            if (!add_libraries(joiner, name, shown_line))
                return false;
        } else {
            const u64 face = piece->before.faces + mark->face;
            if (face > 0 && !end_part(joiner, (u32)face))
                return false;
            joiner->material = *name ? name : NULL;
            joiner->material_line = shown_line;
        }
    }
    return true;
}

bool obj_join_names(const ObjPiece *pieces, size_t count, u32 face_count, const char *path, ObjFile *obj,
                    Error *error)
{
    Joiner joiner = { .obj = obj, .path = path };
    bool done = true;
    for (size_t i = 0; i < count && done; ++i)
        done = take_marks(&joiner, &pieces[i]);
    done = done && end_part(&joiner, face_count) &&
           list_names(obj->arena, &joiner.materials, &obj->material_names, &obj->material_count) &&
           list_names(obj->arena, &joiner.libraries, &obj->libraries, &obj->library_count);
    return done || error_set(error, ERROR_MEMORY, "out of memory");
}
