// realpath is in the XSI part of POSIX.
#define _XOPEN_SOURCE 700

#include "output/sink.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

enum { BUFFER_BYTES = 1 << 18, NAME_TRIES = 100 };

struct Sink {
    const char *path; // as the user wrote it, for messages
    FILE *file;       // what is written to: the temporary file, the spool or the target itself
    char *target;     // what the temporary file becomes, links resolved; NULL: no renaming
    char *temporary;
    int spool_target; // descriptor that the spool is copied to; -1: no spool
};

static bool io_error(const Sink *sink, Error *error)
{
    const char *path = strcmp(sink->path, "-") == 0 ? "standard output" : sink->path;
    return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
}

// Also closes what is open; keeps errno.
static void sink_free(Sink *sink)
{
    const int reason = errno;
    if (sink->file)
        fclose(sink->file);
    if (sink->spool_target >= 0)
        close(sink->spool_target);
    free(sink->target);
    free(sink->temporary);
    free(sink);
    errno = reason;
}

// The folder of a path with its final slash, as a length; 0 for the current folder.
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

// Creates .clrt-PROCESS-N.tmp beside the target; its name is short whatever the target's is. The mode
// is what the umask leaves, or an older file's own.
static bool open_temporary(Sink *sink, const struct stat *older)
{
    const size_t folder = folder_length(sink->target);
    const size_t capacity = folder + 64;
    sink->temporary = malloc(capacity);
    if (!sink->temporary)
        return false;
    memcpy(sink->temporary, sink->target, folder);
    int descriptor = -1;
    for (int i = 0; i < NAME_TRIES && descriptor < 0; i++) {
        snprintf(sink->temporary + folder, capacity - folder, ".clrt-%ld-%d.tmp", (long)getpid(), i);
        descriptor = open(sink->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST)
            break;
    }
    if (descriptor >= 0) {
        // A file system without modes refuses this; the picture is worth more than its mode.
        if (older && fchmod(descriptor, older->st_mode & 0777) != 0)
            errno = 0;
        sink->file = fdopen(descriptor, "wb");
        if (sink->file)
            return true;
        close(descriptor);
        unlink(sink->temporary);
    }
    free(sink->temporary);
    sink->temporary = NULL;
    return false;
}

// descriptor < 0 passes an error of the caller on.
static bool open_direct(Sink *sink, int descriptor, bool seekable)
{
    if (descriptor < 0)
        return false;
    if (seekable) {
        sink->spool_target = descriptor;
        sink->file = tmpfile();
        return sink->file != NULL;
    }
    sink->file = fdopen(descriptor, "wb");
    if (!sink->file)
        close(descriptor);
    return sink->file != NULL;
}

// False with errno set.
static bool open_path(Sink *sink, bool seekable)
{
    // A duplicate, so that closing it reports what a network file system kept for the end.
    if (strcmp(sink->path, "-") == 0)
        return open_direct(sink, dup(STDOUT_FILENO), seekable);
    struct stat older;
    const bool exists = stat(sink->path, &older) == 0;
    if (!exists && errno != ENOENT)
        return false;
    if (exists && !S_ISREG(older.st_mode))
        return open_direct(sink, open(sink->path, O_WRONLY | O_CLOEXEC), seekable);
    // A file that may not be written is not to be replaced either, though renaming could.
    if (exists && access(sink->path, W_OK) != 0)
        return false;
    sink->target = exists ? realpath(sink->path, NULL) : strdup(sink->path);
    return sink->target && open_temporary(sink, exists ? &older : NULL);
}

Sink *sink_open(const char *path, bool seekable, Error *error)
{
    Sink *sink = calloc(1, sizeof *sink);
    if (!sink) {
        error_set(error, ERROR_MEMORY, "%s: no memory to write it", path);
        return NULL;
    }
    sink->path = path;
    sink->spool_target = -1;
    if (!open_path(sink, seekable)) {
        io_error(sink, error);
        sink_free(sink);
        return NULL;
    }
    // Without its large buffer a stream is slower and as right.
    (void)setvbuf(sink->file, NULL, _IOFBF, BUFFER_BYTES);
    return sink;
}

bool sink_write(Sink *sink, const void *bytes, size_t length, Error *error)
{
    return fwrite(bytes, 1, length, sink->file) == length || io_error(sink, error);
}

bool sink_seek(Sink *sink, u64 offset, Error *error)
{
    return fseeko(sink->file, (off_t)offset, SEEK_SET) == 0 || io_error(sink, error);
}

static bool write_all(int descriptor, const char *bytes, size_t length)
{
    while (length > 0) {
        const ssize_t written = write(descriptor, bytes, length);
        if (written < 0 && errno != EINTR)
            return false;
        if (written > 0) {
            bytes += written;
            length -= (size_t)written;
        }
    }
    return true;
}

// False with errno set.
static bool copy_spool(Sink *sink)
{
    char bytes[1 << 14];
    rewind(sink->file);
    for (;;) {
        const size_t length = fread(bytes, 1, sizeof bytes, sink->file);
        if (length == 0)
            break;
        if (!write_all(sink->spool_target, bytes, length))
            return false;
    }
    const int descriptor = sink->spool_target;
    sink->spool_target = -1;
    return !ferror(sink->file) && close(descriptor) == 0;
}

// False with errno set.
static bool finish(Sink *sink)
{
    if (fflush(sink->file) != 0)
        return false;
    if (sink->spool_target >= 0 && !copy_spool(sink))
        return false;
    FILE *file = sink->file;
    sink->file = NULL;
    if (fclose(file) != 0)
        return false;
    return !sink->temporary || rename(sink->temporary, sink->target) == 0;
}

bool sink_commit(Sink *sink, Error *error)
{
    const bool done = finish(sink);
    if (!done) {
        io_error(sink, error);
        if (sink->temporary)
            unlink(sink->temporary);
    }
    sink_free(sink);
    return done;
}

void sink_abort(Sink *sink)
{
    if (!sink)
        return;
    if (sink->temporary)
        unlink(sink->temporary);
    sink_free(sink);
}

const char *sink_temporary_path(const Sink *sink)
{
    return sink->temporary;
}
