// Image textures: texels in the precision of their file, decoded first and filtered after.
#ifndef CLRT_KERNELS_TEXTURE_IMAGE_H
#define CLRT_KERNELS_TEXTURE_IMAGE_H

#include "base/exact.h"
#include "base/table.h"
#include "shared/texture.h"

// What a lane reads of its image's record.
typedef struct {
    LanesI first, width, height, format;
} ImageLanes;

static inline ImageLanes image_lanes(const Row *row)
{
    ImageLanes image;
    image.first.v = row_int(row, 12);
    image.width.v = row_int(row, 13);
    image.height.v = row_int(row, 14);
    image.format.v = row_int(row, 15);
    return image;
}

// Value `index` of an image that begins at `image`.
static inline real texel_value(global const uchar *texels, global const uchar *image, size_t index, uint format,
                               bool linear)
{
    const bool encoded = !linear && (format & TEXEL_SRGB) != 0;
    switch (format & TEXEL_TYPE) {
    case TEXEL_U8: {
        const uint level = image[index];
        return encoded ? (real)((global const f32 *)(texels + TEXELS_SRGB8))[level] : (real)level / (real)255;
    }
    case TEXEL_U16: {
        const uint level = ((global const ushort *)image)[index];
        return encoded ? (real)((global const f32 *)(texels + TEXELS_SRGB16))[level] : (real)level / (real)65535;
    }
    case TEXEL_HALF:
        return vload_half(index, (global const half *)image);
    default:
        return ((global const f32 *)image)[index];
    }
}

// The color of the texels in column x of row y, which the images have; linear: levels are not encoded.
OUTLINE v3 image_texel(global const uchar *texels, const ImageLanes *image, vi x, vi y, bool linear)
{
    LanesI column, line;
    LanesF r, g, b;
    column.v = x;
    line.v = y;
    for (int k = 0; k < LANES; k++) {
        const uint format = (uint)image->format.s[k];
        global const uchar *first = texels + (size_t)(uint)image->first.s[k] * TEXEL_UNIT;
        const size_t at = (size_t)line.s[k] * (size_t)image->width.s[k] + (size_t)column.s[k];
        if (format & TEXEL_RGB) {
            r.s[k] = texel_value(texels, first, 3 * at, format, linear);
            g.s[k] = texel_value(texels, first, 3 * at + 1, format, linear);
            b.s[k] = texel_value(texels, first, 3 * at + 2, format, linear);
        } else {
            r.s[k] = g.s[k] = b.s[k] = texel_value(texels, first, at, format, linear);
        }
    }
    return v3_make(r.v, g.v, b.v);
}

// (whole + rest) (scale + scale_low) without its whole part, in [0, 1]: products of the large parts are exact in
// two floats, so that far tiles are as sharp as near ones.
static inline vf tile_place(vf whole, vf rest, vf scale, vf scale_low)
{
    const vf2 far = two_product(whole, scale), near = two_product(rest, scale);
    const vf low = (far.lo + whole * scale_low) + fma(rest, scale_low, near.lo);
    const vf place = ((far.hi - floor(far.hi)) + (near.hi - floor(near.hi))) + low;
    return place - floor(place);
}

// The texel on whose side of its borders x is, of `size`, and the next one; both in range, whatever x is.
typedef struct {
    vi first, second;
    vf beyond; // x past the first, in texels
} TexelPair;

static inline TexelPair texel_pair(vf x, vi size, vm nearest)
{
    TexelPair pair;
    const vf from = nearest ? x : x - 0.5f;
    const vf place = floor(from);
    const vi index = VI_FROM_VF(vf_min(vf_max(place, (vf)(-1.0f)), VF_FROM_VI(size)));
    const vi wrapped = index >= size ? index - size : index;
    pair.first = wrapped < (vi)(0) ? wrapped + size : wrapped;
    pair.second = pair.first + 1 == size ? (vi)(0) : pair.first + 1;
    pair.beyond = nearest ? (vf)(0.0f) : from - place;
    return pair;
}

// a where share is 0, and where both are equal.
static inline v3 between(v3 a, v3 b, vf share)
{
    return v3_fma(v3_sub(b, a), share, a);
}

// u, v in [0, 1].
static inline v3 image_color(global const uchar *texels, const Row *row, vf u, vf v, bool linear)
{
    const ImageLanes image = image_lanes(row);
    const vm nearest = (image.format.v & (int)TEXEL_NEAREST) != (vi)(0);
    const TexelPair x = texel_pair(u * VF_FROM_VI(image.width.v), image.width.v, nearest);
    const TexelPair y = texel_pair((1.0f - v) * VF_FROM_VI(image.height.v), image.height.v, nearest);
    v3 color = image_texel(texels, &image, x.first, y.first, linear);
    if (!vm_all(nearest)) {
        const v3 right = image_texel(texels, &image, x.second, y.first, linear);
        const v3 below = image_texel(texels, &image, x.first, y.second, linear);
        const v3 across = image_texel(texels, &image, x.second, y.second, linear);
        color = between(between(color, right, x.beyond), between(below, across, x.beyond), y.beyond);
    }
    return color;
}

#endif
