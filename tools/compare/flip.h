// LDR-FLIP: how strongly a person who flips between two pictures sees a difference, per pixel, 0 to 1.
// After Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020, with the erratum on its page. The
// observer sees 67 pixels per degree, the default of the authors' programs. It knows nothing of files.
#ifndef CLRT_COMPARE_FLIP_H
#define CLRT_COMPARE_FLIP_H

#include "image/image.h"
#include "value.h"

// Writes width x height differences, top row first. Both images have one size and no NaN; grey is repeated,
// alpha is not seen, values are clamped to 0 and scale.peak. False with ERROR_MEMORY.
bool flip_compare(const Image *reference, const Image *test, ValueScale scale, f32 *differences,
                  Error *error);

#endif
