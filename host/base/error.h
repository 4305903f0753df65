// Error: the one thing that the program could not do, with the exit status that it means.
// What the user wrote wrongly in a scene is a diagnostic (scene/diagnostics.h), never an Error.
#ifndef CLRT_BASE_ERROR_H
#define CLRT_BASE_ERROR_H

#include <stdbool.h>

// Values are the exit statuses of the command line.
typedef enum ErrorCode {
    ERROR_NONE = 0,
    ERROR_SCENE = 1,
    ERROR_USAGE = 2,
    ERROR_DEVICE = 3,
    ERROR_IO = 4,
    ERROR_SELF_TEST = 5,
    ERROR_MEMORY = 6,
    ERROR_TIME = 7,
    ERROR_INTERRUPTED = 130,
} ErrorCode;

typedef struct Error {
    ErrorCode code;
    char text[4096]; // one or more lines without a final newline; cut at the end if longer
} Error;

// Stores code and the printf-style message in *error; returns false, so that callers can write
// `return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));`.
bool error_set(Error *error, ErrorCode code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
