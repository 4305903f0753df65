// Textures of all kinds behind one function.
#ifndef CLRT_KERNELS_TEXTURE_TEXTURE_H
#define CLRT_KERNELS_TEXTURE_TEXTURE_H

#include "base/table.h"
#include "shared/texture.h"
#if HAS_CHECKER3D
#include "shapes/object_frame.h"
#endif
#if HAS_CHECKER || HAS_CHECKER3D
#include "texture/checker.h"
#endif
#if HAS_IMAGE
#include "texture/image.h"
#endif

#define TEXTURE_NUMBERS 16

// Where on a surface a texture is looked up.
typedef struct {
#if HAS_UV
    vf u, v; // texture coordinates: u_whole + u, v_whole + v
    vf u_whole, v_whole;
#endif
#if HAS_CHECKER3D
    ObjectPoint object; // in the shape's own space, before its transforms
#endif
} TexturePoint;

#if HAS_TEXTURES
typedef struct {
    global const TextureRecord *records;
#if HAS_IMAGE
    global const uchar *texels;
#endif
} Textures;

#if HAS_CHECKER || HAS_CHECKER3D
static inline v3 checker_color(const Row *row, const TexturePoint *at)
{
    vf odd = (vf)(0.0f);
#if HAS_CHECKER
    odd = parity(cell_parity(at->u_whole, at->u, row_real(row, 3), row_real(row, 8)) +
                 cell_parity(at->v_whole, at->v, row_real(row, 7), row_real(row, 9)));
#endif
#if HAS_CHECKER3D
    const vf scale = row_real(row, 3), low = row_real(row, 8), inset = row_real(row, 10);
    const v3 p = v3_fma(at->object.normal, -inset, at->object.fine);
    const vf odd3 = parity(cell_parity(at->object.whole.x, p.x, scale, low) +
                           cell_parity(at->object.whole.y, p.y, scale, low) +
                           cell_parity(at->object.whole.z, p.z, scale, low));
    odd = row_int(row, 11) == (vi)(TEXTURE_KIND_CHECKER3D) ? odd3 : odd;
#endif
    return v3_select(odd != (vf)(0.0f), row_real3(row, 4), row_real3(row, 0));
}
#endif

// The texture of index `texture` in the lanes of m, of which there is one; linear: levels of images are taken as
// they are, for numbers and normals. *channel: the one that counts of a texture that stands for a number.
OUTLINE v3 texture_color(const Textures *textures, const TexturePoint *at, vi texture, vm m, bool linear,
                         vi *channel)
{
    const Row row = row_make(textures->records, m ? texture : (vi)(0), TEXTURE_NUMBERS);
    *channel = (vi)(0);
#if HAS_IMAGE
    const vm image = m & (row_int(&row, 11) == (vi)(TEXTURE_KIND_IMAGE));
    v3 color = v3_splat(0.0f);
    if (vm_any(image)) {
        const vf u = tile_place(at->u_whole, at->u, row_real(&row, 3), row_real(&row, 8));
        const vf v = tile_place(at->v_whole, at->v, row_real(&row, 7), row_real(&row, 9));
        // Lanes with other textures stand in for one with this.
        color = image_color(textures->texels, &row, u, v, linear);
        *channel = (row_int(&row, 15) >> TEXEL_CHANNEL) & 3;
    }
#if HAS_CHECKER || HAS_CHECKER3D
    if (vm_any(m & !image))
        color = v3_select(image, color, checker_color(&row, at));
#endif
    return color;
#else
    (void)linear;
    return checker_color(&row, at);
#endif
}
#endif

#endif
