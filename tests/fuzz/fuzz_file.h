// What the fuzzers of files share: bytes under a name that a reader can open, and the program that runs a
// fuzzer on files where it is not built as one (no CLRT_FUZZ).
#ifndef CLRT_TESTS_FUZZ_FILE_H
#define CLRT_TESTS_FUZZ_FILE_H

#define _GNU_SOURCE // memfd_create
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/types.h"
#include "scene/diagnostics.h"

int LLVMFuzzerTestOneInput(const u8 *data, size_t size);

// In memory, because a file of a disk takes longer to make than to read.
typedef struct FuzzFile {
    int descriptor;
    char path[64];
} FuzzFile;

static inline FuzzFile fuzz_file_begin(const u8 *data, size_t size)
{
    FuzzFile fuzz = { .descriptor = memfd_create("fuzz", MFD_CLOEXEC) };
    if (fuzz.descriptor < 0 || write(fuzz.descriptor, data, size) != (ssize_t)size)
        abort();
    snprintf(fuzz.path, sizeof fuzz.path, "/proc/self/fd/%d", fuzz.descriptor);
    return fuzz;
}

static inline void fuzz_file_end(FuzzFile *fuzz)
{
    close(fuzz->descriptor);
}

// The messages as they are printed, to be freed; some where there are errors.
static inline char *fuzz_print(const Diagnostics *diagnostics)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        abort();
    diagnostics_print(diagnostics, stream);
    fclose(stream);
    if (diagnostics_error_count(diagnostics) > 0 && size == 0)
        abort();
    return text;
}

#endif
