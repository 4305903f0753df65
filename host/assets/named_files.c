#include "assets/named_files.h"

#include <assert.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/report.h"

void named_file_refuse(const NamedFiles *named, const NamedFile *file, const char *what, const char *reason)
{
    if (file->named_by)
        scene_report(named->scene, named->diagnostics, SEVERITY_WARNING, file->at,
                     "cannot %s '%s', which '%s' names: %s; it is left out", what, file->path,
                     file->named_by, reason);
    else
        scene_report(named->scene, named->diagnostics, SEVERITY_ERROR, file->at, "cannot %s '%s': %s", what,
                     file->path, reason);
}

// Looks whether the file can be read and which it is.
static NamedFile look_up(const NamedFiles *named, const char *path, SourcePos at, const char *named_by)
{
    NamedFile file = {.path = path, .at = at, .named_by = named_by};
    struct stat status;
    if (stat(path, &status) != 0) {
        named_file_refuse(named, &file, "read", strerror(errno));
    } else if (S_ISDIR(status.st_mode)) {
        named_file_refuse(named, &file, "read", strerror(EISDIR));
    } else if (!S_ISREG(status.st_mode)) {
        named_file_refuse(named, &file, "read", "not a regular file");
    } else {
        file.readable = true;
        file.device = (u64)status.st_dev;
        file.inode = (u64)status.st_ino;
    }
    return file;
}

// The index of the file at a new path: a new one, or one known by another path.
static bool add_file(NamedFiles *named, const char *path, SourcePos at, const char *named_by, u32 *index)
{
    const NamedFile file = look_up(named, path, at, named_by);
    for (u32 i = 0; file.readable && i < named->count; ++i) {
        const NamedFile *other = &named->files[i];
        if (other->readable && other->device == file.device && other->inode == file.inode) {
            *index = i;
            return true;
        }
    }
    NamedFile *files = arena_grow(named->arena, named->files, named->count, sizeof *files);
    if (!files)
        return false;
    named->files = files;
    *index = named->count;
    files[named->count++] = file;
    return true;
}

bool named_files_add(NamedFiles *named, const char *path, SourcePos at, const char *named_by)
{
    const size_t length = strlen(path);
    if (names_find(&named->paths, path, length) >= 0)
        return true;
    u32 *path_files = arena_grow(named->arena, named->path_files, named->paths.count, sizeof *path_files);
    if (!path_files || !add_file(named, path, at, named_by, &path_files[named->paths.count]))
        return false;
    named->path_files = path_files;
    return names_add(&named->paths, named->arena, path, length);
}

u32 named_files_find(const NamedFiles *named, const char *path)
{
    const i32 known = names_find(&named->paths, path, strlen(path));
    assert(known >= 0);
    return named->path_files[known];
}
