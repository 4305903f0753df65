// What tests and fuzzers need of the OBJ reader beyond obj.h.
#ifndef CLRT_ASSETS_OBJ_INTERNAL_H
#define CLRT_ASSETS_OBJ_INTERNAL_H

#include "assets/obj.h"

// obj_read in pieces of about piece_bytes (at least 1), the last of whose lines is complete. The result does
// not depend on it.
bool obj_read_in_pieces(const char *path, size_t piece_bytes, Diagnostics *diagnostics, ObjFile *obj,
                        Error *error);

#endif
