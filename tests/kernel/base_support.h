// What the tests of kernels/base share: floats and their bits, and the elementary functions by number.
#ifndef CLRT_TESTS_KERNEL_BASE_SUPPORT_H
#define CLRT_TESTS_KERNEL_BASE_SUPPORT_H

#include "harness.h"

#include <string.h>

static inline uint32_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float from_bits(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

// A hash of x, for test inputs.
static inline uint32_t mix(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

enum { WIDTHS = 4, BATCH = 1 << 20 };

extern const int widths[WIDTHS];

typedef enum { SIN, COS, ACOS, ATAN2, EXP, EXP2, LOG, LOG2, POW, FUNCTIONS } Function;

extern const char *const function_names[FUNCTIONS];

typedef struct {
    float x[BATCH], y[BATCH], result[BATCH]; // atan2(y, x), pow(x, y), otherwise of x alone
} Batch;

// Zeros; freed with free.
Batch *batch_create(void);

// Options of the compiler may be NULL.
KernelProgram *functions_create(KernelDevice *device, int lanes, const char *options);

// Fills the results; gives the seconds it took.
double functions_apply(KernelProgram *program, Function function, int lanes, Batch *batch);

#endif
