// The elementary functions of kernels/base over a million inputs: what every device must give, bit by bit.
#ifndef CLRT_SELFTEST_AGREED_H
#define CLRT_SELFTEST_AGREED_H

#include "base/types.h"

enum { AGREED_INPUTS = 1 << 20, AGREED_FUNCTIONS = 9 };

// Arguments x and y: bit patterns from all over the floats, half of them of moderate size. Denormal ones,
// which devices may flush, are zeros; y is not negative.
void agreed_fill(f32 *x, f32 *y);

// A hash of the results, all NaN alike.
u64 agreed_hash(const f32 *results);

// What agreed_hash must be for sin cos acos atan2(y, x) exp exp2 log log2 pow(x, y), as FUNCTION_X numbers
// them. Only a deliberate change of a function changes its number.
extern const u64 AGREED_HASHES[AGREED_FUNCTIONS];

#endif
