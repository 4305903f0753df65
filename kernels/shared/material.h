// Material records, and what shading needs to know of a primitive.
#ifndef CLRT_SHARED_MATERIAL_H
#define CLRT_SHARED_MATERIAL_H

#include "shared/types.h"

#define MATERIAL_BLINN 1u
#define MATERIAL_FRESNEL 2u
#define MATERIAL_IS_PBR 4u
#define MATERIAL_TRANSMIT_TEXTURE 16u // how much goes through is a matter of textures
#define MATERIAL_ONE_SIDED 8u // emission of the outer side alone: area lights

// Colors and numbers are multiplied by the textures that stand beside them.
typedef struct MaterialRecord {
    f32 diffuse[3]; // pbr: base_color
    f32 shininess;
    f32 specular[3];
    f32 ior;
    f32 ambient[3]; // k_a times I_a
    f32 eta_in_rest; // 1 - 1 / ior^2, rounded once
    f32 reflect[3];
    f32 eta_out_rest; // 1 - ior^2, rounded once
    f32 transmit[3];
    f32 inverse_ior;
    f32 emission[3];
    u32 flags; // MATERIAL_X
    i32 diffuse_texture; // index of a TextureRecord; -1: none
    i32 ambient_texture;
    i32 emission_texture;
    i32 normal_texture;
    f32 metallic; // pbr, as are those that follow
    f32 roughness;
    f32 occlusion;
    f32 base_reflectance; // ((ior - 1) / (ior + 1))^2
    i32 metallic_texture;
    i32 roughness_texture;
    i32 occlusion_texture;
    f32 pbr_transmit;
} MaterialRecord;
LAYOUT_SIZE(MaterialRecord, 144);
LAYOUT_OFFSET(MaterialRecord, ambient, 32);
LAYOUT_OFFSET(MaterialRecord, flags, 92);

#define NO_INDEX 0xffffffffu
// In the material of a primitive or of a run of faces: an instance that names a material goes before it.
#define MATERIAL_INHERITED 0x80000000u

// Beside each primitive, at the same index. The place of a hit in the order of definition, which decides
// ties, is the order of its primitive, plus that of its instance if it has one.
typedef struct PrimitiveInfo {
    u32 material; // index | MATERIAL_INHERITED; of an instance: index, or NO_INDEX where it names none
    u32 extra;    // triangle with normals or uvs: index of a TriangleExtra; else NO_INDEX
    u32 order_low;
    u32 order_high;
} PrimitiveInfo;
LAYOUT_SIZE(PrimitiveInfo, 16);

// Normals and texture coordinates at the vertices, in the space of the primitive.
typedef struct TriangleExtra {
    f32 normals[9]; // unit or zero-free as written, any length
    f32 uvs[6];
    u32 has_normals;
} TriangleExtra;
LAYOUT_SIZE(TriangleExtra, 64);

#endif
