// For each feature a small scene that has it, and the same scene as nearly as can be without it. Shared by
// the tests of the layout and of the programs made for these scenes.
#ifndef CLRT_TESTS_LAYOUT_FEATURE_SCENES_H
#define CLRT_TESTS_LAYOUT_FEATURE_SCENES_H

#include "layout/features.h"

typedef struct FeatureScenes {
    Feature feature;
    const char *with, *without;
} FeatureScenes;

#define SHAPE_BALL "sphere { center 0 0 -4 radius 1 }\n"
#define SHAPE_BALL_OF(material) "sphere { center 0 0 -4 radius 1 material " material " }\n"
#ifndef CLRT_TESTS
#define CLRT_TESTS CLRT_SOURCE "/tests"
#endif
// Files for whoever reads them; layout_meshes.h knows the meshes by their names.
#define SHAPE_SHEET(name, properties) \
    "mesh { file \"" CLRT_TESTS "/host/meshes/" name ".obj\" " properties " translate 0 0 -4 }\n"
#define LIGHT_PANEL(radiance) \
    "light rectangle { corner 3 4 0 edge1 1 0 0 edge2 0 0 1 radiance " radiance " }\n"
#define LIGHT_BULB(radiance) "light sphere { center 3 4 0 radius 1 radiance " radiance " }\n"
#define ENVIRONMENT_SKY(properties) \
    "environment { file \"" CLRT_TESTS "/render/meshes/sky.hdr\" " properties " }\n"
#define MATERIAL_PBR_M "material m pbr { }\n"
#define LIGHT_LAMP "light point { position 3 4 0 }\n"
#define LIGHT_LAMPS LIGHT_LAMP LIGHT_LAMP LIGHT_LAMP LIGHT_LAMP
#define RENDER_PATHS "render { integrator path }\n"
#define TEXTURE_IMAGE_T "texture t image { file \"" CLRT_TESTS "/render/meshes/skin.png\" }\n"
#define MATERIAL_M(properties) "material m phong { " properties " }\n"

static const FeatureScenes feature_scenes[] = {
    {FEATURE_SURFACES, SHAPE_BALL, ""},
    {FEATURE_BVH, SHAPE_BALL, "plane { point 0 -1 0 normal 0 1 0 }\n"},
    {FEATURE_INSTANCES,
     "object pair { sphere { center 0 0 -4 radius 1 } sphere { center 1 0 -4 radius 1 } }\n"
     "instance pair { }\n",
     "sphere { center 0 0 -4 radius 1 } sphere { center 1 0 -4 radius 1 }\n"},
    {FEATURE_SPHERE, SHAPE_BALL "box { min -1 -2 -5 max 1 -1 -4 }\n", "box { min -1 -2 -5 max 1 -1 -4 }\n"},
    {FEATURE_GIANT_SPHERE, SHAPE_BALL "sphere { center 0 -6.4e6 0 radius 6.399999e6 }\n", SHAPE_BALL},
    {FEATURE_ELLIPSOID, "sphere { center 0 0 0 radius 1 scale 1 2 1 translate 0 0 -4 }\n",
     "sphere { center 0 0 0 radius 1 scale 2 translate 0 0 -4 }\n"},
    {FEATURE_PLANE, SHAPE_BALL "plane { point 0 -1 0 normal 0 1 0 }\n", SHAPE_BALL},
    {FEATURE_BOX, SHAPE_BALL "box { min -1 -2 -5 max 1 -1 -4 }\n", SHAPE_BALL},
    {FEATURE_TETRAHEDRON, SHAPE_BALL "tetrahedron { center 2 0 -4 size 1 }\n", SHAPE_BALL},
    {FEATURE_DISK, SHAPE_BALL "disk { center 0 -1 -4 normal 0 1 0 radius 2 }\n", SHAPE_BALL},
    {FEATURE_CYLINDER, SHAPE_BALL "cylinder { base 2 -1 -4 top 2 1 -4 radius 0.5 }\n", SHAPE_BALL},
    {FEATURE_CONE, SHAPE_BALL "cone { base 2 -1 -4 top 2 1 -4 radius 0.5 }\n", SHAPE_BALL},
    {FEATURE_TORUS, SHAPE_BALL "torus { center 0 0 -4 axis 0 1 0 major 2 minor 0.3 }\n", SHAPE_BALL},
    {FEATURE_RECTANGLE, SHAPE_BALL LIGHT_PANEL("0"), SHAPE_BALL},
    {FEATURE_TRIANGLE, SHAPE_BALL "triangle { vertices -1 0 -4 1 0 -4 0 1 -4 }\n", SHAPE_BALL},
    {FEATURE_TRIANGLE_EXTRA, "triangle { vertices -1 0 -4 1 0 -4 0 1 -4 normals 0 0 1 1 0 1 0 1 1 }\n",
     "triangle { vertices -1 0 -4 1 0 -4 0 1 -4 uvs 0 0 1 0 0 1 }\n"},
    {FEATURE_MESH, SHAPE_BALL SHAPE_SHEET("grid1", ""), SHAPE_BALL},
    {FEATURE_MESH_NORMALS, SHAPE_SHEET("grid1_normals", ""),
     SHAPE_SHEET("grid1_normals", "smooth off")},
    {FEATURE_TERMINATOR, SHAPE_SHEET("grid1_normals", "terminator on") LIGHT_LAMP,
     SHAPE_SHEET("grid1_normals", "") LIGHT_LAMP},
    {FEATURE_MESH_UVS,
     "texture t checker { scale 8 8 }\n" MATERIAL_M("diffuse t")
     SHAPE_SHEET("grid1_uvs", "material m"),
     "texture t checker { scale 8 8 }\n" MATERIAL_M("diffuse t")
     SHAPE_SHEET("grid1", "material m")},
    {FEATURE_UV, "texture t checker { scale 8 8 }\n" MATERIAL_M("diffuse t") SHAPE_BALL_OF("m"),
     "texture t checker3d { scale 8 }\n" MATERIAL_M("diffuse t") SHAPE_BALL_OF("m")},
    {FEATURE_CHECKER, "texture t checker { scale 8 8 }\n" MATERIAL_M("diffuse t") SHAPE_BALL_OF("m"),
     "texture t checker { scale 8 8 }\n" MATERIAL_M("diffuse 0.5") SHAPE_BALL_OF("m")},
    {FEATURE_CHECKER3D, "texture t checker3d { scale 8 }\n" MATERIAL_M("diffuse t") SHAPE_BALL_OF("m"),
     "texture t checker3d { scale 8 }\n" MATERIAL_M("diffuse 0.5") SHAPE_BALL_OF("m")},
    {FEATURE_IMAGE, TEXTURE_IMAGE_T MATERIAL_M("diffuse t") SHAPE_BALL_OF("m"),
     TEXTURE_IMAGE_T MATERIAL_M("diffuse 0.5") SHAPE_BALL_OF("m")},
    {FEATURE_NORMAL_MAP, TEXTURE_IMAGE_T MATERIAL_M("diffuse t normal_map t") SHAPE_BALL_OF("m"),
     TEXTURE_IMAGE_T MATERIAL_M("diffuse t") SHAPE_BALL_OF("m")},
    {FEATURE_LIGHTS, SHAPE_BALL LIGHT_LAMP, SHAPE_BALL "light point { position 3 4 0 intensity 0 }\n"},
    {FEATURE_POINT, SHAPE_BALL LIGHT_LAMP "light directional { direction 0 -1 0 }\n",
     SHAPE_BALL "light directional { direction 0 -1 0 }\n"},
    {FEATURE_DIRECTIONAL, SHAPE_BALL LIGHT_LAMP "light directional { direction 0 -1 0 }\n",
     SHAPE_BALL LIGHT_LAMP},
    {FEATURE_SPOT, SHAPE_BALL LIGHT_LAMP "light spot { position 0 4 0 look_at 0 0 -4 }\n",
     SHAPE_BALL LIGHT_LAMP},
    {FEATURE_SPHERE_LIGHT, SHAPE_BALL LIGHT_BULB("1"), SHAPE_BALL LIGHT_BULB("0")},
    {FEATURE_RECTANGLE_LIGHT, SHAPE_BALL LIGHT_PANEL("1"), SHAPE_BALL LIGHT_PANEL("0")},
    {FEATURE_OCCLUSION, SHAPE_BALL "render { ambient_occlusion 4 1 }\n",
     SHAPE_BALL "ambient 0 render { ambient_occlusion 4 1 }\n"},
    {FEATURE_ENVIRONMENT, SHAPE_BALL ENVIRONMENT_SKY(""), SHAPE_BALL ENVIRONMENT_SKY("intensity 0")},
    {FEATURE_ENVIRONMENT_LIGHT, MATERIAL_PBR_M SHAPE_BALL_OF("m") ENVIRONMENT_SKY(""),
     MATERIAL_PBR_M SHAPE_BALL ENVIRONMENT_SKY("")},
    {FEATURE_PREFILTERED,
     "render { environment_lighting prefiltered }\n" MATERIAL_PBR_M SHAPE_BALL_OF("m") ENVIRONMENT_SKY(""),
     "render { environment_lighting prefiltered }\n" MATERIAL_PBR_M SHAPE_BALL ENVIRONMENT_SKY("")},
    {FEATURE_HIT_RANDOM, SHAPE_BALL LIGHT_BULB("1"), SHAPE_BALL LIGHT_LAMP},
    {FEATURE_PATH, SHAPE_BALL RENDER_PATHS, "ambient 0\n" SHAPE_BALL},
    {FEATURE_MANY_LIGHTS, SHAPE_BALL LIGHT_LAMPS LIGHT_LAMPS LIGHT_LAMP RENDER_PATHS,
     SHAPE_BALL LIGHT_LAMPS LIGHT_LAMPS RENDER_PATHS},
    {FEATURE_SHADOWS, SHAPE_BALL LIGHT_LAMP, SHAPE_BALL LIGHT_LAMP "render { shadows off }\n"},
    {FEATURE_TRANSMITTANCE, MATERIAL_M("transmit 0.5") SHAPE_BALL_OF("m") LIGHT_LAMP,
     MATERIAL_M("transmit 0.5") SHAPE_BALL_OF("m") LIGHT_LAMP "render { shadows off }\n"},
    {FEATURE_TRANSMIT_TEXTURE,
     "texture t checker { }\nmaterial m pbr { base_color t transmit 1 }\n" SHAPE_BALL_OF("m") LIGHT_LAMP,
     "texture t checker { }\nmaterial m pbr { base_color t }\n" SHAPE_BALL_OF("m") LIGHT_LAMP},
    {FEATURE_SPECULAR, MATERIAL_M("specular 0.5") SHAPE_BALL_OF("m") LIGHT_LAMP,
     MATERIAL_M("shininess 5") SHAPE_BALL_OF("m") LIGHT_LAMP},
    {FEATURE_PHONG, MATERIAL_M("specular 0.5") SHAPE_BALL_OF("m") LIGHT_LAMP,
     "material m blinn_phong { specular 0.5 }\n" SHAPE_BALL_OF("m") LIGHT_LAMP},
    {FEATURE_BLINN, "material m blinn_phong { specular 0.5 }\n" SHAPE_BALL_OF("m") LIGHT_LAMP,
     MATERIAL_M("specular 0.5") SHAPE_BALL_OF("m") LIGHT_LAMP},
    {FEATURE_EMISSION, MATERIAL_M("emission 1") SHAPE_BALL_OF("m"),
     MATERIAL_M("emission 0") SHAPE_BALL_OF("m")},
    {FEATURE_AMBIENT, SHAPE_BALL, "ambient 0\n" SHAPE_BALL},
    {FEATURE_BACKGROUND, "background 0.5\n" SHAPE_BALL, "background 0\n" SHAPE_BALL},
    {FEATURE_REFLECT, MATERIAL_M("reflect 0.5") SHAPE_BALL_OF("m"), SHAPE_BALL},
    {FEATURE_TRANSMIT, MATERIAL_M("transmit 0.5") SHAPE_BALL_OF("m"),
     MATERIAL_M("reflect 0.5") SHAPE_BALL_OF("m")},
    {FEATURE_FRESNEL, MATERIAL_M("transmit 0.5 fresnel on") SHAPE_BALL_OF("m"),
     MATERIAL_M("transmit 0.5 fresnel off") SHAPE_BALL_OF("m")},
    {FEATURE_BRANCHING, MATERIAL_M("transmit 0.5 reflect 0.5") SHAPE_BALL_OF("m"),
     MATERIAL_M("transmit 0.5") SHAPE_BALL_OF("m")},
    {FEATURE_ORTHOGRAPHIC, "camera { orthographic 3 }\n" SHAPE_BALL, "camera { fov 40 }\n" SHAPE_BALL},
    {FEATURE_PBR, "material m pbr { }\n" SHAPE_BALL_OF("m") LIGHT_LAMP, MATERIAL_M("") SHAPE_BALL_OF("m") LIGHT_LAMP},
    {FEATURE_SAMPLES, "image { samples 4 }\n" SHAPE_BALL, "image { samples 1 }\n" SHAPE_BALL},
    {FEATURE_APERTURE, "camera { aperture 0.1 }\n" SHAPE_BALL, "camera { aperture 0 }\n" SHAPE_BALL},
    {FEATURE_FILTER_TENT, "image { samples 4 filter tent }\n" SHAPE_BALL, "image { samples 1 filter tent }\n" SHAPE_BALL},
    {FEATURE_FILTER_TABLE, "image { samples 4 filter gaussian }\n" SHAPE_BALL,
     "image { samples 4 filter tent }\n" SHAPE_BALL},
    {FEATURE_FILTER_LOBES, "image { samples 4 filter mitchell }\n" SHAPE_BALL,
     "image { samples 4 filter gaussian }\n" SHAPE_BALL},
    {FEATURE_CLAMP, SHAPE_BALL, SHAPE_BALL},
};

// What a render must be asked for to have the feature of these scenes.
static inline FeatureSet feature_scenes_asked(const FeatureScenes *scenes)
{
    return feature_bit(scenes->feature) & FEATURES_OF_RENDERS;
}

enum { FEATURE_SCENE_COUNT = sizeof feature_scenes / sizeof *feature_scenes };

#endif
