// Picture: the story of one run, from a scene file to a picture or to its diagnostics. Beside main.c because
// it heeds interrupts; it does not end the program.
#ifndef CLRT_PICTURE_H
#define CLRT_PICTURE_H

#include "base/error.h"
#include "cli/options.h"
#include "interrupt.h"

// Does ACTION_RENDER or ACTION_CHECK as options say. Diagnostics and other talk go to standard error; the
// picture stands in its place only where this succeeds. interrupt may be NULL.
bool picture_make(const Options *options, Interrupt *interrupt, Error *error);

#endif
