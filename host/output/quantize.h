// Quantizer: radiance to the levels of an integer format. The definition is quantize_exact, in double;
// the tables give the same level for every float, at a few cycles a value.
#ifndef CLRT_OUTPUT_QUANTIZE_H
#define CLRT_OUTPUT_QUANTIZE_H

#include "base/error.h"
#include "base/types.h"
#include "scene/scene.h"

// Radiance times 2^exposure, tone map, clamp, encoding, nearest of 2^bits levels with halves away from
// zero. bits is 8 or 16. NaN and anything below 0 give 0, infinity the last level.
u32 quantize_exact(const OutputSettings *settings, u32 bits, f32 radiance);

typedef struct Quantizer Quantizer;

// NULL with ERROR_MEMORY.
Quantizer *quantizer_create(const OutputSettings *settings, u32 bits, Error *error);
void quantizer_destroy(Quantizer *quantizer);

// count values to count bytes, or at 16 bits to twice as many, the high byte first as in a PNG.
void quantizer_apply(const Quantizer *quantizer, const f32 *values, size_t count, u8 *bytes);

#endif
