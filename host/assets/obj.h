// OBJ: the polygons of a Wavefront file as a Mesh, read by all threads at hundreds of megabytes a second.
// Knows no scene, no materials behind the names, no other format; what has no area is still there (finish.h).
#ifndef CLRT_ASSETS_OBJ_H
#define CLRT_ASSETS_OBJ_H

#include "base/arena.h"
#include "base/error.h"
#include "scene/diagnostics.h"
#include "scene/mesh.h"

typedef struct ObjFile {
    Mesh mesh; // as in mesh.h, but faces without area are kept and face_count may be 0;
               // parts[].material is an index into material_names
    char **material_names; // of usemtl, in the order of their first use by a face, each once; any bytes
    u32 *material_lines;   // of that usemtl, from 1
    u32 material_count;
    char **libraries; // of mtllib, as written: relative to the file's folder; each once
    u32 *library_lines;
    u32 library_count;
    Arena *arena; // of the names and lines
} ObjFile;

// Reads the regular file at path. Returns false with an Error where that was not possible; the text is the
// reason alone. What the file says wrongly is added to diagnostics, located in `path`, and also returns true:
// where an error was added, *obj is empty. The result does not depend on the number of threads.
//
// v (numbers after the third, weight and colour, are ignored), vt (w is ignored), vn, f and fo (fans from the
// first corner), usemtl, mtllib, # and \ at the end of a line, which does not continue a comment; other
// keywords of the format are skipped silently, unknown words with a warning for each. A triangle has normals
// (uvs) where all of its corners have one; a normal of length 0 is none. Indices may refer to what follows.
bool obj_read(const char *path, Diagnostics *diagnostics, ObjFile *obj, Error *error);

// Frees what obj holds and zeroes it; a zeroed ObjFile is fine. A caller that keeps obj->mesh zeroes it
// before.
void obj_destroy(ObjFile *obj);

#endif
