// Clock: time that passes, for statistics and for launches of the right length.
#ifndef CLRT_BASE_CLOCK_H
#define CLRT_BASE_CLOCK_H

#include "base/types.h"

// Seconds of a clock that never goes back, from some beginning.
f64 clock_seconds(void);

#endif
