// What a feature builds on is there with it, so that any set of features compiles.
#ifndef CLRT_KERNELS_BASE_FEATURES_H
#define CLRT_KERNELS_BASE_FEATURES_H

#if HAS_CHECKER && !HAS_UV
#undef HAS_UV
#define HAS_UV 1
#endif

#if HAS_MESH_UVS && !HAS_UV
#undef HAS_UV
#define HAS_UV 1
#endif

#if (HAS_MESH_NORMALS || HAS_MESH_UVS) && !HAS_MESH
#undef HAS_MESH
#define HAS_MESH 1
#endif

#if HAS_MESH && !HAS_BVH
#undef HAS_BVH
#define HAS_BVH 1
#endif

#if HAS_TRIANGLE_EXTRA && !HAS_TRIANGLE
#undef HAS_TRIANGLE
#define HAS_TRIANGLE 1
#endif

#if HAS_BRANCHING && !HAS_TRANSMIT
#undef HAS_TRANSMIT
#define HAS_TRANSMIT 1
#endif

#if (HAS_TRANSMIT || HAS_FRESNEL) && !HAS_REFLECT
#undef HAS_REFLECT
#define HAS_REFLECT 1
#endif

#if (HAS_PHONG || HAS_BLINN) && !HAS_SPECULAR
#undef HAS_SPECULAR
#define HAS_SPECULAR 1
#endif

#if HAS_TRANSMITTANCE && !HAS_SHADOWS
#undef HAS_SHADOWS
#define HAS_SHADOWS 1
#endif

#if (HAS_SHADOWS || HAS_POINT || HAS_DIRECTIONAL || HAS_SPOT) && !HAS_LIGHTS
#undef HAS_LIGHTS
#define HAS_LIGHTS 1
#endif

#if (HAS_BVH || HAS_LIGHTS || HAS_REFLECT) && !HAS_SURFACES
#undef HAS_SURFACES
#define HAS_SURFACES 1
#endif

#endif
