// Conditions: which lines of OpenCL C stand under `#if`s that hold, by the options of the build alone. A
// `#define` in the source counts for nothing, so a macro that such a line names has its final value in the
// options. Knows nothing of the lines in between. Private to this module.
#ifndef CLRT_DEVICE_CONDITIONS_H
#define CLRT_DEVICE_CONDITIONS_H

#include <stddef.h>

#include "base/types.h"

enum { CONDITIONS_MAX = 16 }; // open at a time

typedef struct Conditions {
    const char *options; // of clBuildProgram: -DNAME is 1, -DNAME=VALUE, a name that is not there 0
    u32 depth;
    bool holds[CONDITIONS_MAX]; // the branch in hand of each `#if` that is open
    bool held[CONDITIONS_MAX];  // that branch, or one before it
    bool broken;                // not balanced, nested too deeply, or an expression that is not understood
} Conditions;

// Takes a line of the preprocessor, from its # on: #if, #ifdef, #ifndef, #elif, #else, #endif; others change
// nothing.
void conditions_take(Conditions *conditions, const char *line, size_t length);

// True where everything that is open holds.
bool conditions_hold(const Conditions *conditions);

// The expression of an `#if`: names, integers, defined, ! && || and parentheses. 1 where it holds, 0 where it
// does not, -1 where it is anything else.
i32 condition_value(const char *text, size_t length, const char *options);

#endif
