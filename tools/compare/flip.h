// LDR-FLIP: how strongly a person who flips between two pictures sees a difference, per pixel, 0 to 1.
// After Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020, with the erratum on its page. The
// observer sees 67 pixels per degree, the default of the authors' programs. It knows nothing of files.
#ifndef CLRT_COMPARE_FLIP_H
#define CLRT_COMPARE_FLIP_H

#include "image/image.h"

typedef struct FlipScale {
    f32 peak;  // the value of white, at most 65535; values are clamped to 0 and this
    bool srgb; // values are sRGB-encoded whole numbers, else proportional to light
} FlipScale;

// Writes width x height differences, top row first. Both images have one size and no NaN; grey is repeated,
// alpha is not seen. False with ERROR_MEMORY.
bool flip_compare(const Image *reference, const Image *test, FlipScale scale, f32 *differences, Error *error);

#endif
