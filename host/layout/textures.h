// Textures of a scene as device records, with the texels of the images that can be seen in one array.
#ifndef CLRT_LAYOUT_TEXTURES_H
#define CLRT_LAYOUT_TEXTURES_H

#include "base/error.h"
#include "layout/layout.h"

#define MATERIAL_TEXTURES_MAX 6

// Indices of the textures that shading with the material looks up; returns how many. lit: by light that shines on it
// from somewhere; ambient: by ambient light.
u32 material_textures(const Material *material, bool lit, bool ambient, i32 textures[MATERIAL_TEXTURES_MAX]);

// Of whoever looks the texture up.
FeatureSet texture_features(const Texture *texture);

// Makes layout->textures, at the scene's indices, and layout->texels, of the images in use (used: at the scene's
// indices, too). Such images must have their bitmap. Fails with ERROR_MEMORY.
bool textures_add(Layout *layout, const Scene *scene, const bool *used, Error *error);

#endif
