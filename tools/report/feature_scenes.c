#include "feature_scenes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "folder.h"

// Parts of a scene; NULL: those of the base.
typedef struct Parts {
    const char *name, *what;
    const char *before; // textures
    const char *kind;   // of the material, phong
    const char
        *material; // its properties beside the diffuse color, which come from here alone if they name one
    const char *shapes; // what is added, in place of the third sphere so that the pictures stay alike
    const char *camera;
    const char *lights;
    const char *settings;    // statements of the whole scene
    const char *image;       // properties of image
    const char *unused;      // statements that declare the feature without use; NULL: made from the above
    const char *unused_from; // statements of the base that `unused` is compared with; NULL: none
    bool needs_use;          // there is no way to declare it without use
} Parts;

static const char BASE_CAMERA[] = "camera { position 0 1.3 5  look_at 0 0.2 0  fov 42 }";
static const char BASE_LIGHT[] = "light point { position -3 5 4  intensity 30  attenuation 0 0 1 }";
static const char BASE_SETTINGS[] = "render { shadows off }\nambient 0";
static const char THIRD_SPHERE[] = "sphere { center 1.4 0 0.3  radius 0.7  material plain }";

static const Parts FEATURES[] = {
    {.name = "nothing", .what = "the base once more: what is left is noise", .needs_use = true},
    {.name = "shadows",
     .what = "shadow rays to the light",
     .settings = "render { shadows on }\nambient 0",
     .unused = "render { shadows on }\nambient 0",
     .unused_from = "render { shadows off }\nambient 0"},
    {.name = "checker",
     .what = "a checker of texture coordinates on all surfaces",
     .before = "texture squares checker { colors 0.9 0.3  scale 4 4 }",
     .material = "diffuse squares"},
    {.name = "checker3d",
     .what = "a checker of space on all surfaces",
     .before = "texture cubes checker3d { colors 0.9 0.3  scale 3 }",
     .material = "diffuse cubes"},
    {.name = "specular", .what = "phong highlights", .material = "diffuse 0.7  specular 0.5  shininess 40"},
    {.name = "blinn",
     .what = "blinn_phong highlights",
     .kind = "blinn_phong",
     .material = "diffuse 0.7  specular 0.5  shininess 40"},
    {.name = "emission", .what = "surfaces that shine", .material = "diffuse 0.7  emission 0.1"},
    {.name = "reflect", .what = "mirrored rays", .material = "diffuse 0.7  reflect 0.3"},
    {.name = "transmit", .what = "transmitted rays", .material = "diffuse 0.4  transmit 0.6  ior 1.3"},
    {.name = "fresnel",
     .what = "mirrored and transmitted rays by fresnel weights",
     .material = "diffuse 0.4  reflect 1  transmit 0.6  fresnel on"},
    {.name = "ambient",
     .what = "ambient light",
     .settings = "render { shadows off }\nambient 0.2",
     .needs_use = true},
    {.name = "background",
     .what = "a background that is not black",
     .settings = "render { shadows off }\nambient 0\nbackground 0.2 0.3 0.5",
     .unused = "background 0",
     .unused_from = ""},
    {.name = "directional",
     .what = "a directional light in place of the point light",
     .lights = "light directional { direction 3 -5 -4  intensity 1 }",
     .needs_use = true},
    {.name = "spot",
     .what = "a spot light in place of the point light",
     .lights =
         "light spot { position -3 5 4  look_at 0 0 0  intensity 30  attenuation 0 0 1  inner 20  outer 50 }",
     .needs_use = true},
    {.name = "second light",
     .what = "one more point light",
     .lights = "light point { position -3 5 4  intensity 30  attenuation 0 0 1 }\n"
               "light point { position 3 5 4  intensity 30  attenuation 0 0 1 }",
     .needs_use = true},
    {.name = "ellipsoid",
     .what = "a sphere scaled by three factors",
     .shapes = "sphere { center 0 0 0  radius 0.7  scale 1 1.2 0.8  translate 1.4 0 0.3  material plain }"},
    {.name = "disk",
     .what = "a disk",
     .shapes = "disk { center 1.4 0 0.3  normal 0 0.3 1  radius 0.7  material plain }"},
    {.name = "box", .what = "a box", .shapes = "box { center 1.4 0 0.3  size 1.2  material plain }"},
    {.name = "tetrahedron",
     .what = "a tetrahedron",
     .shapes = "tetrahedron { center 1.4 0 0.3  size 1.6  material plain }"},
    {.name = "cylinder",
     .what = "a cylinder",
     .shapes = "cylinder { base 1.4 -0.7 0.3  top 1.4 0.7 0.3  radius 0.6  material plain }"},
    {.name = "cone",
     .what = "a cone",
     .shapes = "cone { base 1.4 -0.7 0.3  top 1.4 0.9 0.3  radius 0.7  material plain }"},
    {.name = "torus",
     .what = "a torus",
     .shapes = "torus { center 1.4 0 0.3  axis 0 1 1  major 0.55  minor 0.2  material plain }"},
    {.name = "triangle",
     .what = "a triangle",
     .shapes = "triangle { vertices 0.6 -0.7 0.3  2.2 -0.7 0.3  1.4 0.8 0.3  material plain }"},
    {.name = "mesh",
     .what = "a mesh of 480 triangles",
     .shapes = "mesh { file \"" FEATURE_MESH_NAME "\"  scale 0.7  translate 1.4 0 0.3  material plain }"},
    {.name = "instances",
     .what = "two spheres as instances of an object",
     .shapes = "object pair { sphere { center 0 0 0  radius 0.5 } sphere { center 0 0.6 0  radius 0.3 } }\n"
               "instance pair { translate 1.1 -0.2 0.3  material plain }\n"
               "instance pair { translate 1.9 -0.2 0.3  rotate y 20  material plain }",
     .unused = "object pair { sphere { center 0 0 0  radius 0.5 } }",
     .unused_from = ""},
    {.name = "orthographic",
     .what = "the orthographic camera",
     .camera = "camera { position 0 1.3 5  look_at 0 0.2 0  orthographic 4 }",
     .needs_use = true},
    {.name = "samples", .what = "four samples a pixel", .image = "samples 4", .needs_use = true},
};

const size_t FEATURE_SCENE_COUNT = sizeof FEATURES / sizeof FEATURES[0];

const char *feature_scene_name(size_t feature)
{
    return FEATURES[feature].name;
}

const char *feature_scene_what(size_t feature)
{
    return FEATURES[feature].what;
}

static const char *or_base(const char *part, const char *base)
{
    return part ? part : base;
}

// tail: statements after all others.
static const char *scene_of(const Parts *p, const char *tail, Arena *arena)
{
    return text_format(arena,
                       "image { %s }\n%s\n%s\n%s\n%s\n"
                       "material plain %s { %s }\n"
                       "plane { point 0 -0.7 0  normal 0 1 0  material plain }\n"
                       "sphere { center -1.4 0 0.3  radius 0.7  material plain }\n"
                       "sphere { center 0 0.3 -0.8  radius 1  material plain }\n"
                       "%s\n%s\n",
                       or_base(p->image, ""), or_base(p->camera, BASE_CAMERA),
                       or_base(p->settings, BASE_SETTINGS), or_base(p->lights, BASE_LIGHT),
                       or_base(p->before, ""), or_base(p->kind, "phong"), or_base(p->material, "diffuse 0.7"),
                       or_base(p->shapes, THIRD_SPHERE), tail);
}

static const char *unused_text(const Parts *p, Arena *arena)
{
    if (p->material)
        return scene_of(
            &(Parts){.before = p->before},
            text_format(arena, "material unused %s { %s }", or_base(p->kind, "phong"), p->material), arena);
    if (p->unused && p->settings && strstr(p->unused, "render"))
        return scene_of(&(Parts){.lights = "", .settings = p->unused}, "", arena);
    if (p->unused)
        return scene_of(&(Parts){.name = ""}, p->unused, arena);
    if (p->shapes)
        return scene_of(&(Parts){.name = ""}, text_format(arena, "object unused { %s }", p->shapes), arena);
    return NULL;
}

const char *feature_scene_text(size_t feature, FeatureText text, Arena *arena)
{
    const Parts *p = &FEATURES[feature];
    switch (text) {
    case FEATURE_BASE: return scene_of(&(Parts){.name = ""}, "", arena);
    case FEATURE_USED: return scene_of(p, "", arena);
    case FEATURE_UNUSED: return p->needs_use ? NULL : unused_text(p, arena);
    case FEATURE_UNUSED_BASE:
        return p->unused_from && *p->unused_from
                   ? scene_of(&(Parts){.lights = "", .settings = p->unused_from}, "", arena)
                   : NULL;
    }
    return NULL;
}

// ---- the mesh -------------------------------------------------------------------------------

enum { RINGS = 11, SPOKES = 24, LINE_BYTES = 128 };

typedef struct Obj {
    char *text;
    size_t length;
} Obj;

static void add_vertex(Obj *obj, f64 x, f64 y, f64 z)
{
    obj->length += (size_t)snprintf(obj->text + obj->length, LINE_BYTES, "v %.6f %.6f %.6f\n", x, y, z);
}

// Numbers from 1, as in the file.
static void add_face(Obj *obj, int a, int b, int c)
{
    obj->length += (size_t)snprintf(obj->text + obj->length, LINE_BYTES, "f %d %d %d\n", a, b, c);
}

// RINGS - 1 rings of vertices between the poles, which are the first and the last vertex.
const char *feature_scene_mesh(Arena *arena)
{
    enum { LINES = 2 + (RINGS - 1) * SPOKES + 2 * (RINGS - 1) * SPOKES };
    const f64 half_turn = acos(-1);
    Obj obj = {.text = arena_alloc(arena, LINES + 1, LINE_BYTES)};
    if (!obj.text)
        return NULL;
    add_vertex(&obj, 0, 1, 0);
    for (int ring = 1; ring < RINGS; ring++) {
        const f64 polar = half_turn * ring / RINGS;
        for (int spoke = 0; spoke < SPOKES; spoke++) {
            const f64 around = 2 * half_turn * spoke / SPOKES;
            add_vertex(&obj, sin(polar) * sin(around), cos(polar), sin(polar) * cos(around));
        }
    }
    add_vertex(&obj, 0, -1, 0);
    const int last = 2 + (RINGS - 1) * SPOKES, below = last - SPOKES;
    for (int spoke = 0; spoke < SPOKES; spoke++) {
        const int next = (spoke + 1) % SPOKES;
        add_face(&obj, 1, 2 + spoke, 2 + next);
        add_face(&obj, last, below + next, below + spoke);
        for (int top = 2; top < below; top += SPOKES) {
            add_face(&obj, top + spoke, top + SPOKES + spoke, top + SPOKES + next);
            add_face(&obj, top + spoke, top + SPOKES + next, top + next);
        }
    }
    return obj.text;
}
