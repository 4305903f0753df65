// Checker textures: the parity of cells, exact also where cells are counted in millions.
#ifndef CLRT_KERNELS_TEXTURE_CHECKER_H
#define CLRT_KERNELS_TEXTURE_CHECKER_H

#include "base/vec.h"

// 0 or 1 for a whole number.
static inline vf parity(vf whole)
{
    return whole - 2.0f * floor(whole * 0.5f);
}

// Parity of floor((whole + rest) (scale + scale_low)), whole a whole number or 0. The product of the large
// parts is exact in two floats (fma), so that only the rounding of rest counts.
static inline vf cell_parity(vf whole, vf rest, vf scale, vf scale_low)
{
    const vf product = whole * scale;
    const vf product_low = fma(whole, scale, -product) + whole * scale_low;
    const vf cell = floor(product);
    const vf within = (product - cell) + fma(rest, scale, product_low);
    return parity(parity(cell) + parity(floor(within)));
}

#endif
