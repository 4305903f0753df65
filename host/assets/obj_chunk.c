#include "assets/obj_chunk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void obj_builder_clear(ObjBuilder *builder)
{
    ObjChunk *chunk = &builder->chunk;
    chunk->position_count = chunk->normal_count = chunk->uv_count = 0;
    chunk->face_count = chunk->mark_count = chunk->name_bytes = 0;
    chunk->zero_normals = false;
    free(chunk->face_normals);
    free(chunk->face_uvs);
    chunk->face_normals = NULL;
    chunk->face_uvs = NULL;
    builder->no_memory = false;
}

void obj_builder_destroy(ObjBuilder *builder)
{
    obj_builder_clear(builder);
    free(builder->chunk.positions);
    free(builder->chunk.normals);
    free(builder->chunk.uvs);
    free(builder->chunk.faces);
    free(builder->chunk.marks);
    free(builder->chunk.names);
    *builder = (ObjBuilder){ 0 };
}

// The array with room for more elements of size; NULL, and the array is as before, where there is no memory.
static void *grow(ObjBuilder *builder, void *array, size_t *room, size_t more, size_t size)
{
    const size_t wanted = 2 * (*room + more) + 64;
    void *grown = wanted <= OBJ_COUNT_MAX ? realloc(array, wanted * size) : NULL;
    if (grown)
        *room = wanted;
    else
        builder->no_memory = true;
    return grown;
}

bool obj_grow_positions(ObjBuilder *builder)
{
    ObjChunk *chunk = &builder->chunk;
    Vec3 *grown = grow(builder, chunk->positions, &builder->position_room, 1, sizeof *grown);
    if (grown)
        chunk->positions = grown;
    return grown;
}

void obj_add_normal(ObjBuilder *builder, Vec3 normal)
{
    ObjChunk *chunk = &builder->chunk;
    if (chunk->normal_count == builder->normal_room) {
        f32(*grown)[3] = grow(builder, chunk->normals, &builder->normal_room, 1, sizeof *grown);
        if (!grown)
            return;
        chunk->normals = grown;
    }
    const f64 square = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
    if (square > 1e-200) {
        const f64 length = sqrt(square); // cannot overflow: the components were within float's range
        normal = (Vec3){ normal.x / length, normal.y / length, normal.z / length };
    } else if (normal.x != 0 || normal.y != 0 || normal.z != 0) {
        normal = vec_normalize(normal);
    } else {
        chunk->zero_normals = true;
    }
    f32 *stored = chunk->normals[chunk->normal_count++];
    stored[0] = (f32)normal.x;
    stored[1] = (f32)normal.y;
    stored[2] = (f32)normal.z;
}

void obj_add_uv(ObjBuilder *builder, f64 u, f64 v)
{
    ObjChunk *chunk = &builder->chunk;
    if (chunk->uv_count == builder->uv_room) {
        f32(*grown)[2] = grow(builder, chunk->uvs, &builder->uv_room, 1, sizeof *grown);
        if (!grown)
            return;
        chunk->uvs = grown;
    }
    f32 *stored = chunk->uvs[chunk->uv_count++];
    stored[0] = (f32)u;
    stored[1] = (f32)v;
}

// In all arrays of faces that there are.
bool obj_grow_faces(ObjBuilder *builder)
{
    ObjChunk *chunk = &builder->chunk;
    size_t room = builder->face_room;
    i32(**arrays[3])[3] = { &chunk->faces, &chunk->face_normals, &chunk->face_uvs };
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && !*arrays[i])
            continue;
        room = builder->face_room;
        i32(*grown)[3] = grow(builder, *arrays[i], &room, 1, sizeof *grown);
        if (!grown)
            return false;
        *arrays[i] = grown;
    }
    builder->face_room = room;
    return true;
}

// Starts an array of indices that no face had until now.
static bool begin_indices(ObjBuilder *builder, i32 (**indices)[3])
{
    *indices = calloc(builder->face_room, sizeof **indices);
    builder->no_memory |= !*indices;
    return *indices;
}

static void store_indices(i32 indices[3], i32 a, i32 b, i32 c)
{
    indices[0] = a;
    indices[1] = b;
    indices[2] = c;
}

void obj_add_full_face(ObjBuilder *builder, const ObjCorner *a, const ObjCorner *b, const ObjCorner *c)
{
    ObjChunk *chunk = &builder->chunk;
    if (chunk->face_count == builder->face_room && !obj_grow_faces(builder))
        return;
    if (!chunk->face_normals && (a->normal | b->normal | c->normal) &&
        !begin_indices(builder, &chunk->face_normals))
        return;
    if (!chunk->face_uvs && (a->uv | b->uv | c->uv) && !begin_indices(builder, &chunk->face_uvs))
        return;
    const size_t face = chunk->face_count++;
    store_indices(chunk->faces[face], a->position, b->position, c->position);
    if (chunk->face_normals)
        store_indices(chunk->face_normals[face], a->normal, b->normal, c->normal);
    if (chunk->face_uvs)
        store_indices(chunk->face_uvs[face], a->uv, b->uv, c->uv);
}

void obj_add_mark(ObjBuilder *builder, ObjMarkKind kind, ObjText *text)
{
    ObjChunk *chunk = &builder->chunk;
    if (chunk->mark_count == builder->mark_room) {
        ObjMark *grown = grow(builder, chunk->marks, &builder->mark_room, 1, sizeof *grown);
        if (!grown)
            return;
        chunk->marks = grown;
    }
    const size_t bound = obj_text_rest_bound(text);
    if (bound > builder->name_room - chunk->name_bytes) {
        char *grown = grow(builder, chunk->names, &builder->name_room, bound, 1);
        if (!grown)
            return;
        chunk->names = grown;
    }
    const ObjMark mark = {
        .kind = kind, .face = (u32)chunk->face_count, .line = text->line, .name = chunk->name_bytes
    };
    ObjWord place;
    chunk->name_bytes += obj_text_rest(text, chunk->names + chunk->name_bytes, &place) + 1;
    chunk->marks[chunk->mark_count++] = mark;
}

bool obj_encode(i64 index, size_t count, i32 *code)
{
    if (index > 0 && index <= OBJ_COUNT_MAX) {
        *code = (i32)index;
        return true;
    }
    const i64 relative = (i64)count + index;
    if (index >= 0 || index < -2 * (i64)OBJ_COUNT_MAX || relative < -(i64)OBJ_COUNT_MAX)
        return false;
    *code = (i32)(relative - OBJ_COUNT_MAX);
    return true;
}

// Copies count elements to *end, which moves behind them; NULL where from is NULL.
static void *append(unsigned char **end, const void *from, size_t count, size_t size)
{
    if (!from)
        return NULL;
    void *to = *end;
    memcpy(to, from, count * size);
    *end += count * size;
    return to;
}

bool obj_pack(ObjBuilder *builder, ObjChunk *chunk)
{
    const ObjChunk *from = &builder->chunk;
    *chunk = *from;
    const size_t face_arrays = 1u + (from->face_normals != NULL) + (from->face_uvs != NULL);
    // Below 2^40 for any room, so nothing overflows. Doubles and pointers come first.
    const size_t bytes = from->position_count * sizeof *from->positions +
                         from->mark_count * sizeof *from->marks + from->normal_count * sizeof *from->normals +
                         from->uv_count * sizeof *from->uvs +
                         from->face_count * sizeof *from->faces * face_arrays + from->name_bytes;
    unsigned char *end = malloc(bytes + 1);
    if (!end) {
        *chunk = (ObjChunk){ 0 };
        return false;
    }
    chunk->positions = (Vec3 *)(void *)end;
    append(&end, from->positions, from->position_count, sizeof *from->positions);
    chunk->marks = append(&end, from->marks, from->mark_count, sizeof *from->marks);
    chunk->normals = append(&end, from->normals, from->normal_count, sizeof *from->normals);
    chunk->uvs = append(&end, from->uvs, from->uv_count, sizeof *from->uvs);
    chunk->faces = append(&end, from->faces, from->face_count, sizeof *from->faces);
    chunk->face_normals = append(&end, from->face_normals, from->face_count, sizeof *from->face_normals);
    chunk->face_uvs = append(&end, from->face_uvs, from->face_count, sizeof *from->face_uvs);
    chunk->names = append(&end, from->names, from->name_bytes, 1);
    obj_builder_clear(builder);
    return true;
}
