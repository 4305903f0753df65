// What the tests of the readers of OBJ and MTL share: bytes in, what was read and the messages out, as text.
#ifndef CLRT_TESTS_ASSETS_OBJ_FIXTURE_H
#define CLRT_TESTS_ASSETS_OBJ_FIXTURE_H

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/error.h"
#include "scene/diagnostics.h"

// A new folder becomes the current one, so that messages name files in it alone.
static inline int enter_folder(void **state)
{
    char *path = strdup("/tmp/clrt-obj-XXXXXX");
    *state = path;
    return path && mkdtemp(path) && chdir(path) == 0 ? 0 : -1;
}

static inline int leave_folder(void **state)
{
    char *path = *state;
    const int result = chdir("/") == 0 && rmdir(path) == 0 ? 0 : -1;
    free(path);
    return result;
}

static inline void write_bytes(const char *name, const char *bytes, size_t length)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

// Calls check with the path of each file of tests/crashers whose name ends so; returns how many.
static inline u32 for_each_crasher(const char *suffix, void (*check)(const char *path))
{
    DIR *directory = opendir(CLRT_TESTS "/crashers");
    assert_non_null(directory);
    u32 count = 0;
    for (const struct dirent *entry; (entry = readdir(directory));) {
        const size_t length = strlen(entry->d_name), tail = strlen(suffix);
        if (length < tail || strcmp(entry->d_name + length - tail, suffix) != 0)
            continue;
        char path[1000];
        snprintf(path, sizeof path, CLRT_TESTS "/crashers/%s", entry->d_name);
        check(path);
        ++count;
    }
    closedir(directory);
    return count;
}

// A stream that writes to *text.
static inline FILE *open_text(char **text, size_t *size)
{
    FILE *stream = open_memstream(text, size);
    assert_non_null(stream);
    return stream;
}

static inline char *printed(const Diagnostics *diagnostics)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_text(&text, &size);
    diagnostics_print(diagnostics, stream);
    fclose(stream);
    return text;
}

#endif
