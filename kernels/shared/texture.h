// Texture records, and the array that holds the texels of all images.
#ifndef CLRT_SHARED_TEXTURE_H
#define CLRT_SHARED_TEXTURE_H

#include "shared/types.h"

#define TEXTURE_KIND_CHECKER 0
#define TEXTURE_KIND_CHECKER3D 1
#define TEXTURE_KIND_IMAGE 2

// In TextureRecord.format.
#define TEXEL_TYPE 3u
#define TEXEL_U8 0u    // 0 .. 255 stand for 0 .. 1
#define TEXEL_U16 1u   // 0 .. 65535 stand for 0 .. 1
#define TEXEL_HALF 2u  // binary16
#define TEXEL_FLOAT 3u // f32
#define TEXEL_RGB 4u   // three channels side by side; else one, grey
#define TEXEL_SRGB 8u  // levels are encoded, for those who ask for colors
#define TEXEL_NEAREST 16u
#define TEXEL_CHANNEL 5 // shift: the channel that counts where the texture is a number, two bits

// Images begin at multiples of this many bytes; their rows, from the top, have no padding.
#define TEXEL_UNIT 16
// Before them stand the linear values (f32) of the sRGB levels of 8 bits, and of 16 bits where some image has such.
#define TEXELS_SRGB8 0
#define TEXELS_SRGB16 1024
#define TEXELS_SRGB16_END (1024 + 4 * 65536)

// Scales in two floats, so that the parity of a far cell is that of the number written in the scene.
typedef struct TextureRecord {
    f32 color_a[3]; // checkers
    f32 scale_u; // checker3d: the scale
    f32 color_b[3];
    f32 scale_v;
    f32 scale_u_low;
    f32 scale_v_low;
    f32 inset; // checker3d: 1e-4 / scale
    u32 kind;  // TEXTURE_KIND_X
    u32 first; // image, as are those that follow: where it begins in the texels, in units of TEXEL_UNIT
    u32 width; // 1 .. 2^24, as height
    u32 height;
    u32 format; // TEXEL_X
} TextureRecord;
LAYOUT_SIZE(TextureRecord, 64);
LAYOUT_OFFSET(TextureRecord, kind, 44);

#endif
