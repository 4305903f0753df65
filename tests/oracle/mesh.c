/* OBJ files. */
#include "mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lines.h"
#include "shape.h"

/* Indices from 0, or -1 where the corner has none. */
typedef struct Corner {
    long position, uv, normal;
} Corner;

typedef struct Face {
    Corner corners[3];
    const char *material; /* name, or NULL */
} Face;

typedef struct Obj {
    Store *store;
    Vec *positions, *normals, *uvs; /* of uvs x and y count */
    size_t position_count, normal_count, uv_count;
    Face *faces;
    size_t face_count;
    const char **libraries;
    size_t library_count;
} Obj;

static void append_vec(Obj *obj, Vec **list, size_t *count, Vec value)
{
    *list = store_grow(obj->store, *list, *count, sizeof value);
    (*list)[(*count)++] = value;
}

/* The index that *text starts with, which it is moved behind. */
static long take_index(const Lines *lines, const char **text, size_t count)
{
    char *end;
    long index = strtol(*text, &end, 10);
    if (end == *text)
        return -1;
    *text = end;
    index = index < 0 ? (long)count + index : index - 1;
    if (index < 0 || index >= (long)count)
        die("%s:%d: an index that nothing has", lines->path, lines->line);
    return index;
}

/* v, v/t, v//n or v/t/n. */
static Corner take_corner(const Obj *obj, const Lines *lines, const char *text)
{
    Corner corner = {-1, -1, -1};
    corner.position = take_index(lines, &text, obj->position_count);
    if (*text == '/') {
        text++;
        corner.uv = take_index(lines, &text, obj->uv_count);
    }
    if (*text == '/') {
        text++;
        corner.normal = take_index(lines, &text, obj->normal_count);
    }
    if (corner.position < 0 || *text != '\0')
        die("%s:%d: a corner expected", lines->path, lines->line);
    return corner;
}

static void read_face(Obj *obj, const Lines *lines, const char *material)
{
    for (size_t i = 2; i + 1 < lines->count; i++) {
        Face face = {.material = material};
        face.corners[0] = take_corner(obj, lines, lines->words[1]);
        face.corners[1] = take_corner(obj, lines, lines->words[i]);
        face.corners[2] = take_corner(obj, lines, lines->words[i + 1]);
        obj->faces = store_grow(obj->store, obj->faces, obj->face_count, sizeof face);
        obj->faces[obj->face_count++] = face;
    }
}

static void read_libraries(Obj *obj, const Lines *lines)
{
    for (size_t i = 1; i < lines->count; i++) {
        obj->libraries = store_grow(obj->store, obj->libraries, obj->library_count, sizeof *obj->libraries);
        obj->libraries[obj->library_count++] = store_beside(obj->store, lines->path, lines->words[i]);
    }
}

static Vec three_numbers(const Lines *lines)
{
    return vec(lines_number(lines, 1), lines_number(lines, 2), lines_number(lines, 3));
}

static void read_obj(Obj *obj, const char *path)
{
    Lines lines;
    const char *material = NULL;
    if (!lines_open(&lines, obj->store, path))
        die("%s: cannot be opened", path);
    while (lines_next(&lines)) {
        const char *key = lines.words[0];
        if (strcmp(key, "v") == 0)
            append_vec(obj, &obj->positions, &obj->position_count, three_numbers(&lines));
        else if (strcmp(key, "vn") == 0)
            append_vec(obj, &obj->normals, &obj->normal_count, three_numbers(&lines));
        else if (strcmp(key, "vt") == 0)
            append_vec(obj, &obj->uvs, &obj->uv_count,
                       vec(lines_number(&lines, 1), lines.count > 2 ? lines_number(&lines, 2) : 0, 0));
        else if (strcmp(key, "f") == 0)
            read_face(obj, &lines, material);
        else if (strcmp(key, "usemtl") == 0)
            material = lines_rest(&lines);
        else if (strcmp(key, "mtllib") == 0)
            read_libraries(obj, &lines);
    }
}

/* Twice the area, along the normal. */
static Vec face_cross(const Obj *obj, const Face *face)
{
    Vec a = obj->positions[face->corners[0].position];
    Vec b = obj->positions[face->corners[1].position];
    Vec c = obj->positions[face->corners[2].position];
    return cross(sub(b, a), sub(c, a));
}

/* Of each position, the sum over its faces of area times normal. */
static Vec *made_normals(const Obj *obj)
{
    Vec *made = store_alloc(obj->store, obj->position_count * sizeof *made);
    for (size_t i = 0; i < obj->face_count; i++) {
        Vec n = face_cross(obj, &obj->faces[i]);
        for (int k = 0; k < 3; k++) {
            Vec *sum = &made[obj->faces[i].corners[k].position];
            *sum = add(*sum, n);
        }
    }
    return made;
}

/* The names of a face: has the corner part for all three. */
static bool has_all(const Face *face, bool normals)
{
    bool all = true;
    for (int k = 0; k < 3; k++)
        all &= (normals ? face->corners[k].normal : face->corners[k].uv) >= 0;
    return all;
}

static Shape face_shape(const Obj *obj, const Face *face, Smooth smooth, const Vec *made)
{
    Shape shape = {.kind = SHAPE_TRIANGLE, .has_uvs = has_all(face, false)};
    bool own = has_all(face, true);
    shape.has_normals = smooth == SMOOTH_ON || (smooth == SMOOTH_FILE && own);
    for (int k = 0; k < 3; k++) {
        const Corner *corner = &face->corners[k];
        shape.vertices[k] = obj->positions[corner->position];
        if (shape.has_normals)
            shape.normals[k] = own ? obj->normals[corner->normal] : made[corner->position];
        if (shape.has_uvs) {
            shape.uvs[k][0] = obj->uvs[corner->uv].x;
            shape.uvs[k][1] = obj->uvs[corner->uv].y;
        }
    }
    return shape;
}

static int find_material(const MtlList *list, const char *path, const char *name)
{
    for (size_t i = 0; name != NULL && i < list->count; i++)
        if (strcmp(list->entries[i].name, name) == 0)
            return list->entries[i].material;
    if (name != NULL)
        fprintf(stderr, "clrt-oracle: warning: %s: no material `%s`\n", path, name);
    return MATERIAL_NONE;
}

const Mesh *mesh_read(Scene *scene, const char *path, Smooth smooth)
{
    Obj obj = {.store = &scene->store};
    MtlList list = {NULL, 0};
    read_obj(&obj, path);
    for (size_t i = 0; i < obj.library_count; i++)
        mtl_read(scene, obj.libraries[i], &list);
    const Vec *made = made_normals(&obj);
    int material = MATERIAL_NONE;
    Mesh *mesh = store_alloc(&scene->store, sizeof *mesh);
    mesh->faces = store_alloc(&scene->store, (obj.face_count + 1) * sizeof *mesh->faces);
    mesh->materials = store_alloc(&scene->store, (obj.face_count + 1) * sizeof *mesh->materials);
    for (size_t i = 0; i < obj.face_count; i++) {
        const Face *face = &obj.faces[i];
        /* Faces in a row share the name; one that no file defines is told once. */
        if (i == 0 || face->material != obj.faces[i - 1].material)
            material = find_material(&list, path, face->material);
        if (length(face_cross(&obj, face)) == 0)
            continue;
        mesh->faces[mesh->count] = face_shape(&obj, face, smooth, made);
        shape_finish(&mesh->faces[mesh->count]);
        mesh->materials[mesh->count++] = material;
    }
    if (mesh->count == 0)
        die("%s: no face", path);
    return mesh;
}
