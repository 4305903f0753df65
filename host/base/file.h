// Files: reading one whole, and names relative to other names.
#ifndef CLRT_BASE_FILE_H
#define CLRT_BASE_FILE_H

#include "base/arena.h"
#include "base/error.h"

typedef struct FileContent {
    char *text; // length bytes and a terminating 0, in the arena
    size_t length;
    u64 device, inode; // the same pair means the same file, whatever its name
} FileContent;

enum { FILE_BYTES_MAX = 1 << 30 };

// Reads the file at path. regular_only refuses pipes and devices, without waiting for them; else "-"
// is standard input. Fails with ERROR_IO, also above FILE_BYTES_MAX, or ERROR_MEMORY; the text of the
// error is the reason alone, without the path.
bool file_read(const char *path, bool regular_only, Arena *arena, FileContent *content, Error *error);

// The path of `name` as written in the file called `from`: beside it, unless name is absolute.
// Lives in arena; NULL when memory is exhausted.
const char *path_beside(Arena *arena, const char *from, const char *name);

#endif
