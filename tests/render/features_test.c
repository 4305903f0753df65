// What a scene does not use costs nothing: for each feature, the program of a small scene without it is
// preprocessed as a device's compiler would and compared with that of the same scene with it. What belongs to
// the feature, functions, types, arguments of the kernel and fields of a slot, must be gone. No device is needed.
#include "support.h"

#include <ctype.h>
#include <unistd.h>

#include "../host/layout_feature_scenes.h"
#include "bundle/bundle.h"
#include "render/plan.h"

// Words that only the feature's code has, and the kernel's argument that only it needs.
typedef struct FeatureWords {
    Feature feature;
    const char *words[5];
    const char *argument;
} FeatureWords;

static const FeatureWords feature_words[] = {
    {FEATURE_SURFACES, {"intersect_closest", "hit_make", "test_primitive"}, "primitives"},
    {FEATURE_BVH, {"BvhNode", "traverse_object", "push_children"}, "nodes"},
    {FEATURE_INSTANCES, {"enter_instance", "SELF_INSTANCE", "self_instance"}, NULL},
    {FEATURE_SPHERE, {"intersect_sphere", "surface_sphere"}, NULL},
    {FEATURE_GIANT_SPHERE, {"intersect_giant_sphere", "surface_giant_sphere"}, NULL},
    {FEATURE_ELLIPSOID, {"intersect_ellipsoid", "surface_ellipsoid"}, NULL},
    {FEATURE_PLANE, {"intersect_plane", "surface_plane"}, NULL},
    {FEATURE_BOX, {"intersect_box", "surface_box"}, NULL},
    {FEATURE_TETRAHEDRON, {"intersect_tetrahedron", "surface_tetrahedron"}, NULL},
    {FEATURE_DISK, {"intersect_disk", "surface_disk"}, NULL},
    {FEATURE_CYLINDER, {"intersect_cylinder", "surface_cylinder"}, NULL},
    {FEATURE_CONE, {"intersect_cone", "surface_cone"}, NULL},
    {FEATURE_TORUS, {"intersect_torus", "surface_torus", "TorusRay"}, NULL},
    {FEATURE_TRIANGLE, {"intersect_triangle", "surface_triangle", "b1"}, NULL},
    {FEATURE_TRIANGLE_EXTRA, {"hit_interpolate", "extras"}, "extras"},
    {FEATURE_UV, {"u_whole", "surface_uv", "vf_atan2"}, NULL},
    {FEATURE_CHECKER, {"cell_parity", "texture"}, "textures"},
    {FEATURE_CHECKER3D, {"object_point", "ObjectPoint", "cell_parity"}, "frames"},
    {FEATURE_LIGHTS, {"light_sample", "shade_lights", "shade_light"}, "lights"},
    {FEATURE_POINT, {"attenuation_of_point"}, NULL},
    {FEATURE_DIRECTIONAL, {"travel"}, NULL},
    {FEATURE_SPOT, {"soft", "axis"}, NULL},
    {FEATURE_SHADOWS, {"intersect_shadow", "SHADOW_ORG", "shadow_batch"}, NULL},
    {FEATURE_TRANSMITTANCE, {"transmit_shadows", "last_primitive"}, NULL},
    {FEATURE_SPECULAR, {"specular", "vf_log2"}, NULL},
    {FEATURE_PHONG, {"lobe_phong"}, NULL},
    {FEATURE_BLINN, {"lobe_blinn"}, NULL},
    {FEATURE_EMISSION, {"MATERIAL_EMISSION"}, NULL},
    {FEATURE_AMBIENT, {"MATERIAL_AMBIENT"}, NULL},
    {FEATURE_BACKGROUND, {"background"}, NULL},
    {FEATURE_REFLECT, {"spawn_rays", "scatter_make", "reflect_about"}, NULL},
    {FEATURE_TRANSMIT, {"refract_cosines"}, NULL},
    {FEATURE_FRESNEL, {"fresnel_dielectric"}, NULL},
    {FEATURE_BRANCHING, {"park_ray", "unpark_ray", "PENDING_COUNT"}, NULL},
    {FEATURE_ORTHOGRAPHIC, {"ahead"}, NULL},
    {FEATURE_SAMPLES, {"film_low", "sample_2d"}, "film_low"},
};
