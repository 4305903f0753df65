// Folder: names of files and folders, and folders that come and go. It knows nothing of what is in them.
#ifndef CLRT_REPORT_FOLDER_H
#define CLRT_REPORT_FOLDER_H

#include "base/arena.h"
#include "base/error.h"

// A text as of printf, in the arena; NULL when memory is exhausted.
char *text_format(Arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Makes a folder that is not there; false with ERROR_IO.
bool folder_make(const char *path, Error *error);

// Removes the folder with all that is in it, without following links; what is not there is no error, and
// neither is what cannot be removed.
void folder_remove(const char *path);

bool folder_exists(const char *path);
bool folder_is_empty(const char *path);

// Puts the folder `from` in the place of `to`, which it replaces if that is there. False with ERROR_IO; then
// `to` is as it was.
bool folder_replace(const char *from, const char *to, Arena *arena, Error *error);

#endif
