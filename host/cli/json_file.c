#include "cli/json_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

bool json_file_write(json_t *document, const char *path, const char *what, Error *error)
{
    if (!document)
        return error_set(error, ERROR_MEMORY, "no memory for %s", what);
    FILE *file = fopen(path, "w");
    bool ok = file && json_dumpf(document, file, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) == 0;
    json_decref(document);
    if (file) {
        fputc('\n', file);
        ok = fclose(file) == 0 && ok;
    }
    return ok || error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
}
