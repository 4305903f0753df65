// Progress: one line on a terminal that says how far the render is; silent elsewhere.
#ifndef CLRT_CLI_PROGRESS_H
#define CLRT_CLI_PROGRESS_H

#include <stdio.h>

#include "base/types.h"

typedef struct Progress {
    FILE *stream; // NULL: silent
    f64 start;    // seconds of a monotonic clock
    f64 shown;    // when the line was last written, 0: never
} Progress;

// Starts the clock. Shows nothing where quiet is set or stream is no terminal.
Progress progress_start(FILE *stream, bool quiet);

// Writes the line anew, at most ten times a second and not in the first half second. done: share from 0 to
// 1; rays: traced so far.
void progress_update(Progress *progress, f64 done, u64 rays);

// Takes the line away.
void progress_end(Progress *progress);

// The line without its end, at most width characters, for a render that has run for `seconds`:
//   [=======>            ]  37 %  12.3 Mrays/s  0:42 left
// The bar is left out where there is no room for it, the time where nothing is known of it yet.
void progress_line(char *line, size_t size, u32 width, f64 done, u64 rays, f64 seconds);

#endif
