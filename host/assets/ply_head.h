// Head of a PLY: the library's reader never comes back from one that does not end.
#ifndef CLRT_ASSETS_PLY_HEAD_H
#define CLRT_ASSETS_PLY_HEAD_H

#include "base/error.h"

// False where the file at path begins like a PLY and a line `end_header` is not in its first MiB, with
// ERROR_SCENE; the text is the reason alone. Any other file, also one that cannot be read, is fine.
bool ply_head_check(const char *path, Error *error);

#endif
