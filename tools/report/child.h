// Child: a program run to its end. It knows nothing of which program and why.
#ifndef CLRT_REPORT_CHILD_H
#define CLRT_REPORT_CHILD_H

#include "base/error.h"
#include "base/types.h"

enum { CHILD_TALK_BYTES = 3000 };

typedef struct Child {
    const char *const *argv;        // ends in NULL; argv[0] is searched for in PATH where it has no slash
    const char *const *environment; // "NAME=VALUE" on top of ours, ends in NULL; NULL: none
    const char *folder;             // to run in; NULL: ours
    const char *talk_path;          // a file for its standard error, which is overwritten
} Child;

typedef struct ChildEnd {
    int status;                  // its exit status, or 128 and the number of the signal that ended it
    f64 seconds;                 // from before its start to its end
    char talk[CHILD_TALK_BYTES]; // the beginning of its standard error, without a last newline
} ChildEnd;

// From now on interrupts and requests to terminate wait until child_run, which hands them to the child and
// fails.
void child_hold_signals(void);

// Standard output of the child is dropped. A program that ends with a status other than 0 is no failure of
// this function. False with ERROR_IO where it cannot be started, ERROR_INTERRUPTED.
bool child_run(const Child *child, ChildEnd *end, Error *error);

#endif
