// Join: the chunks of an OBJ, read one by one, become one mesh.
#ifndef CLRT_ASSETS_OBJ_JOIN_H
#define CLRT_ASSETS_OBJ_JOIN_H

#include "assets/obj.h"
#include "assets/obj_chunk.h"

// A range of the file that begins and ends where statements do.
typedef struct ObjPiece {
    u64 offset;
    size_t length;
    u64 lines;        // ends of lines in it
    u64 lines_before; // in the file
    ObjCounts before; // elements in the file before it
    ObjChunk chunk;
    ObjWords unknown;
    bool faulty; // errors were reported
    int failure; // an errno value
} ObjPiece;

// Sets lines_before and before of each piece; returns the counts of the file.
ObjCounts obj_sum(ObjPiece *pieces, size_t count);

// Makes obj->mesh of the pieces, which give up their chunks, and the names of obj. A piece with an index to
// nothing becomes faulty. total, from obj_sum, is at most OBJ_COUNT_MAX of anything. `path` is where the
// libraries are looked for. Fails with ERROR_MEMORY.
bool obj_join(ObjPiece *pieces, size_t count, const ObjCounts *total, const char *path, ObjFile *obj,
              Error *error);

// Parts, materials and libraries from the marks of the pieces, as obj_join needs them.
bool obj_join_names(const ObjPiece *pieces, size_t count, u32 face_count, const char *path, ObjFile *obj,
                    Error *error);

#endif
