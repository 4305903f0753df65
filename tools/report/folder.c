#define _XOPEN_SOURCE 700

#include "folder.h"

#include <dirent.h>
#include <errno.h>
#include <ftw.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *text_format(Arena *arena, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(NULL, 0, format, list);
    va_end(list);
    char *text = length < 0 ? NULL : arena_alloc(arena, (size_t)length + 1, 1);
    if (!text)
        return NULL;
    va_start(list, format);
    vsnprintf(text, (size_t)length + 1, format, list);
    va_end(list);
    return text;
}

bool folder_make(const char *path, Error *error)
{
    return mkdir(path, 0777) == 0 || error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status;
    (void)kind;
    (void)place;
    remove(path);
    return 0;
}

void folder_remove(const char *path)
{
    nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

bool folder_exists(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0;
}

bool folder_is_empty(const char *path)
{
    DIR *folder = opendir(path);
    if (!folder)
        return false;
    bool empty = true;
    for (const struct dirent *entry = readdir(folder); entry && empty; entry = readdir(folder))
        empty = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
    closedir(folder);
    return empty;
}

bool folder_replace(const char *from, const char *to, Arena *arena, Error *error)
{
    const char *old = text_format(arena, "%s.old-%ld", to, (long)getpid());
    if (!old)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    const bool replaces = folder_exists(to);
    if (replaces && rename(to, old) != 0)
        return error_set(error, ERROR_IO, "%s: %s", to, strerror(errno));
    if (rename(from, to) != 0) {
        error_set(error, ERROR_IO, "%s: %s", to, strerror(errno));
        if (replaces)
            rename(old, to);
        return false;
    }
    if (replaces)
        folder_remove(old);
    return true;
}
