// Named files: the files that a scene names, each once however it is named, and what is said where one of
// them cannot be used. Knows nothing of what is in them.
#ifndef CLRT_ASSETS_NAMED_FILES_H
#define CLRT_ASSETS_NAMED_FILES_H

#include "base/arena.h"
#include "scene/diagnostics.h"
#include "scene/names.h"
#include "scene/scene.h"

typedef struct NamedFile {
    const char *path; // as it is named first
    SourcePos at;     // where that is
    const char *named_by; // a file of the scene that names it, NULL: the scene itself
    u64 device, inode;
    bool readable; // it is a regular file
} NamedFile;

// To be made with the first three members, and all others zero.
typedef struct NamedFiles {
    const Scene *scene;
    Arena *arena; // where the lists live
    Diagnostics *diagnostics;
    NamedFile *files;
    u32 count;
    Names paths;
    u32 *path_files; // index of the file, one a path
} NamedFiles;

// Lists the file at path, named at a place of the scene or by a file that is named there, unless it is there
// already, by this name or another. Where it is no regular file, that is reported. False where memory is
// exhausted.
bool named_files_add(NamedFiles *named, const char *path, SourcePos at, const char *named_by);

// The index of the file of a path that was added.
u32 named_files_find(const NamedFiles *named, const char *path);

// Reports, where the file is named, "cannot WHAT 'PATH': REASON": an error; a warning where a file names it.
void named_file_refuse(const NamedFiles *named, const NamedFile *file, const char *what, const char *reason);

#endif
