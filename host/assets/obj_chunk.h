// ObjChunk: some lines of an OBJ as arrays, read without knowing the lines before. Knows no file.
#ifndef CLRT_ASSETS_OBJ_CHUNK_H
#define CLRT_ASSETS_OBJ_CHUNK_H

#include "assets/obj_text.h"
#include "base/vec.h"

enum {
    OBJ_COUNT_MAX = 1 << 30, // of positions, normals, uvs, and faces each
    OBJ_PADDING = 32         // readable bytes that the text of a chunk has behind it, all 0
};

typedef enum ObjMarkKind { OBJ_USE_MATERIAL, OBJ_USE_LIBRARY } ObjMarkKind;

typedef struct ObjMark {
    ObjMarkKind kind;
    u32 face;    // those from here on have the material
    u64 line;    // in the chunk, from 1
    size_t name; // where it begins in names, and ends with a 0
} ObjMark;

// A corner's index into positions, normals or uvs is coded as
//   above 0: the index from 1 in the file;
//   0:       there is none;
//   below 0: OBJ_COUNT_MAX less than the index, which counts from 0 at the chunk's first element, so that
//            elements of the chunks before have indices below 0.
typedef struct ObjChunk {
    Vec3 *positions;
    f32 (*normals)[3]; // unit, or 0
    f32 (*uvs)[2];
    i32 (*faces)[3]; // triangles
    i32 (*face_normals)[3], (*face_uvs)[3]; // NULL: no corner has one
    ObjMark *marks;
    char *names;
    size_t position_count, normal_count, uv_count, face_count, mark_count, name_bytes;
    bool zero_normals; // some normals are 0
} ObjChunk;

// A chunk that grows, and with it the room of its arrays.
typedef struct ObjBuilder {
    ObjChunk chunk;
    size_t position_room, normal_room, uv_room, face_room, mark_room, name_room;
    bool no_memory; // or too much of something for a chunk
} ObjBuilder;

// What a chunk need not know to be read, but to be judged.
typedef struct ObjCounts {
    u64 positions, normals, uvs, faces;
} ObjCounts;

// Forgets what was read, keeps the room.
void obj_builder_clear(ObjBuilder *builder);
void obj_builder_destroy(ObjBuilder *builder);

// Make room for one more; false, with no_memory, where there is none.
bool obj_grow_positions(ObjBuilder *builder);
bool obj_grow_faces(ObjBuilder *builder);

// Append; the builder is as before, but for no_memory, where there is no memory.
static inline void obj_add_position(ObjBuilder *builder, Vec3 position)
{
    ObjChunk *chunk = &builder->chunk;
    if (chunk->position_count < builder->position_room || obj_grow_positions(builder))
        chunk->positions[chunk->position_count++] = position;
}

void obj_add_normal(ObjBuilder *builder, Vec3 normal);
void obj_add_uv(ObjBuilder *builder, f64 u, f64 v);

typedef struct ObjCorner {
    i32 position, normal, uv;
} ObjCorner;

// obj_add_face for any face.
void obj_add_full_face(ObjBuilder *builder, const ObjCorner *a, const ObjCorner *b, const ObjCorner *c);

static inline void obj_add_face(ObjBuilder *builder, const ObjCorner *a, const ObjCorner *b,
                                const ObjCorner *c)
{
    ObjChunk *chunk = &builder->chunk;
    const bool plain = (a->normal | b->normal | c->normal | a->uv | b->uv | c->uv) == 0 &&
                       !chunk->face_normals && !chunk->face_uvs;
    if (!plain) {
        obj_add_full_face(builder, a, b, c);
    } else if (chunk->face_count < builder->face_room || obj_grow_faces(builder)) {
        i32 *face = chunk->faces[chunk->face_count++];
        face[0] = a->position;
        face[1] = b->position;
        face[2] = c->position;
    }
}

// Appends a mark whose name is the rest of the statement; text->line is that of the mark.
void obj_add_mark(ObjBuilder *builder, ObjMarkKind kind, ObjText *text);

// The code of index (which may be anything) as it stands in the file, count elements into the chunk.
// Returns false where it has none.
bool obj_encode(i64 index, size_t count, i32 *code);

// Moves what was read to one block of memory that is just large enough, and into *chunk, whose positions
// are to be freed and nothing else; clears the builder. Returns false where there is no memory.
bool obj_pack(ObjBuilder *builder, ObjChunk *chunk);

// Reads the statement at the cursor and goes to the next one. What is wrong is reported, and left out. With
// counts, `before` and `total` of the file, indices are checked, too. unknown collects keywords that are
// none.
void obj_statement(ObjText *text, ObjBuilder *builder, ObjWords *unknown, const ObjCounts *before,
                   const ObjCounts *total);

// Reads all of the text, with OBJ_PADDING behind it, into the builder: the common statements fast, the others
// by obj_statement without counts.
void obj_parse_chunk(ObjText *text, ObjBuilder *builder, ObjWords *unknown);

#endif
