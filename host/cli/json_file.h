// A JSON document as a file of the user's.
#ifndef CLRT_CLI_JSON_FILE_H
#define CLRT_CLI_JSON_FILE_H

#include <jansson.h>

#include "base/error.h"

// Writes document to the file at path, indented, and gives its reference up, also on failure. document NULL, as
// jansson makes it when memory is exhausted, is ERROR_MEMORY about `what`; a file that cannot be written is
// ERROR_IO.
bool json_file_write(json_t *document, const char *path, const char *what, Error *error);

#endif
