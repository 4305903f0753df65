// Without libFuzzer: a main that gives the files named by its arguments to LLVMFuzzerTestOneInput, which stands
// above the line that includes this.
#ifndef CLRT_TESTS_FUZZ_MAIN_H
#define CLRT_TESTS_FUZZ_MAIN_H

#ifndef CLRT_FUZZ
#include <stdio.h>

#include "base/arena.h"
#include "base/file.h"

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i) {
        Arena *arena = arena_create();
        FileContent content;
        Error error;
        if (!arena || !file_read(argv[i], false, arena, &content, &error)) {
            fprintf(stderr, "%s: cannot be read\n", argv[i]);
            return 2;
        }
        LLVMFuzzerTestOneInput((const u8 *)content.text, content.length);
        printf("%s: %zu bytes\n", argv[i], content.length);
        arena_destroy(arena);
    }
    return 0;
}
#endif

#endif
