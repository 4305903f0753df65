#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Reads to the end of the file, of which size bytes are expected (0: unknown).
static bool read_all(int descriptor, size_t size, Arena *arena, FileContent *content, Error *error)
{
    size_t capacity = size + 4096;
    char *text = arena_alloc(arena, capacity, 1);
    size_t length = 0;
    while (text) {
        const ssize_t got = read(descriptor, text + length, capacity - 1 - length);
        if (got < 0)
            return error_set(error, ERROR_IO, "%s", strerror(errno));
        if (got == 0) {
            text[length] = 0;
            content->text = text;
            content->length = length;
            return true;
        }
        length += (size_t)got;
        if (length > FILE_BYTES_MAX)
            return error_set(error, ERROR_IO, "larger than %d MiB", FILE_BYTES_MAX >> 20);
        if (length + 1 == capacity) {
            text = arena_resize(arena, text, capacity, 2 * capacity, 1);
            capacity *= 2;
        }
    }
    return error_set(error, ERROR_MEMORY, "out of memory");
}

static bool read_open(int descriptor, bool regular_only, Arena *arena, FileContent *content, Error *error)
{
    struct stat status;
    if (fstat(descriptor, &status) != 0)
        return error_set(error, ERROR_IO, "%s", strerror(errno));
    if (S_ISDIR(status.st_mode))
        return error_set(error, ERROR_IO, "%s", strerror(EISDIR));
    const bool regular = S_ISREG(status.st_mode);
    if (regular_only && !regular)
        return error_set(error, ERROR_IO, "not a regular file");
    if (regular && status.st_size > FILE_BYTES_MAX)
        return error_set(error, ERROR_IO, "larger than %d MiB", FILE_BYTES_MAX >> 20);
    content->device = (u64)status.st_dev;
    content->inode = (u64)status.st_ino;
    return read_all(descriptor, regular ? (size_t)status.st_size : 0, arena, content, error);
}

bool file_read(const char *path, bool regular_only, Arena *arena, FileContent *content, Error *error)
{
    if (!regular_only && strcmp(path, "-") == 0)
        return read_open(STDIN_FILENO, regular_only, arena, content, error);
    // A pipe without a writer would hold up a blocking open.
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | (regular_only ? O_NONBLOCK : 0));
    if (descriptor < 0)
        return error_set(error, ERROR_IO, "%s", strerror(errno));
    const bool done = read_open(descriptor, regular_only, arena, content, error);
    close(descriptor);
    return done;
}

const char *path_beside(Arena *arena, const char *from, const char *name)
{
    const char *slash = strrchr(from, '/');
    const size_t folder = slash && name[0] != '/' ? (size_t)(slash - from) + 1 : 0;
    const size_t length = strlen(name);
    char *path = arena_alloc(arena, folder + length + 1, 1);
    if (path) {
        memcpy(path, from, folder);
        memcpy(path + folder, name, length);
    }
    return path;
}
