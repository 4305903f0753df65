#include "assets/ply_head.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/types.h"

enum { HEAD_BYTES = 1 << 20 };

// Whether one of the lines of the text, which ends in 0, is the word.
static bool has_line(const char *text, const char *word)
{
    const size_t length = strlen(word);
    for (const char *line = text; line; line = strpbrk(line, "\r\n")) {
        line += strspn(line, "\r\n");
        if (strncmp(line, word, length) == 0 && (line[length] == '\n' || line[length] == '\r'))
            return true;
    }
    return false;
}

bool ply_head_check(const char *path, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return true;
    char *head = malloc(HEAD_BYTES + 1);
    const size_t length = head ? fread(head, 1, HEAD_BYTES, file) : 0;
    fclose(file);
    if (!head)
        return error_set(error, ERROR_MEMORY, "out of memory");
    head[length] = 0;
    const bool ply = strncmp(head, "ply", 3) == 0 || strncmp(head, "PLY", 3) == 0;
    const bool sound = !ply || has_line(head, "end_header");
    free(head);
    return sound || error_set(error, ERROR_SCENE, "the head of the PLY has no end_header");
}
