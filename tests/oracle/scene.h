/* What a scene file says (sections 1 and 2 of the contract), as plain structs with every default filled in,
 * and the list of placed primitives that rays are tested against. Knows nothing of rays. */
#ifndef ORACLE_SCENE_H
#define ORACLE_SCENE_H

#include "store.h"
#include "transform.h"

typedef enum ShapeKind {
    SHAPE_SPHERE,
    SHAPE_PLANE,
    SHAPE_BOX,
    SHAPE_TETRAHEDRON,
    SHAPE_TRIANGLE,
    SHAPE_DISK,
    SHAPE_CONE, /* and cylinder: both radii equal */
    SHAPE_TORUS,
    SHAPE_MESH /* only until it is placed: then its faces are triangles */
} ShapeKind;

typedef struct Shape {
    ShapeKind kind;
    Vec center;      /* sphere, disk, torus; the point of a plane; the base of a cone; the middle of a box */
    Vec normal;      /* unit: plane, disk; the axis of a cone (base to top) and of a torus */
    Vec t1, t2;      /* unit tangents of `normal`, by the contract's rule */
    Vec half;        /* box: half its size */
    Vec vertices[4]; /* triangle 3, tetrahedron 4 */
    Vec normals[3];  /* triangle, unit */
    real uvs[3][2];  /* triangle */
    bool has_normals, has_uvs;
    bool caps;   /* cone */
    real radius; /* sphere, disk, the base of a cone, torus: major */
    real top_radius; /* cone; torus: minor */
    real height; /* cone */
    const struct Mesh *mesh;
} Shape;

/* Triangles of a file, and their materials: an index of the scene's, or MATERIAL_NONE. */
typedef struct Mesh {
    Shape *faces;
    int *materials;
    size_t count;
} Mesh;

typedef enum TextureKind { TEXTURE_CHECKER, TEXTURE_CHECKER3D } TextureKind;

typedef struct Texture {
    const char *name;
    TextureKind kind;
    Vec colors[2];
    real scale[2]; /* checker3d: the first only */
} Texture;

/* A color, or a texture where `texture` >= 0. */
typedef struct Paint {
    Vec color;
    int texture;
} Paint;

typedef struct Material {
    const char *name;
    bool blinn;
    bool fresnel;
    Paint ambient, diffuse;
    Vec specular, reflect, transmit, emission;
    real shininess, ior;
} Material;

typedef enum LightKind { LIGHT_POINT, LIGHT_DIRECTIONAL, LIGHT_SPOT } LightKind;

typedef struct Light {
    LightKind kind;
    Vec position;
    Vec direction; /* unit, of travel: directional, spot */
    Vec intensity;
    real attenuation[3];
    real cos_inner, cos_outer; /* of half the angles */
} Light;

enum { MATERIAL_NONE = -1, MATERIAL_DEFAULT = -2 };

/* A shape or an instance inside an object, or at the top level. */
typedef struct Item {
    bool is_instance;
    size_t object;   /* index of the instance's object */
    int material;    /* index, MATERIAL_NONE or MATERIAL_DEFAULT */
    Shape shape;
    Transform placed; /* to the space of the enclosing object */
} Item;

typedef struct Object {
    const char *name;
    Item *items;
    size_t count;
} Object;

/* A shape in the world. Index in the list is the order of definition, which decides ties. */
typedef struct Primitive {
    const Shape *shape;
    const Material *material;
    Transform to_world, to_local;
    bool bounded;
    Vec bound_center; /* world */
    real bound_radius;
    /* A distance from its surface below unit * (magnitude + largest coordinate of the ray) is rounding. */
    real magnitude;
    real unit;
} Primitive;

/* Primitives that follow one another, and a sphere around them: what rays that miss it need not be tested
 * against. */
typedef struct Run {
    size_t first, end;
    bool bounded;
    Vec center; /* world */
    real radius;
    real magnitude; /* the largest of theirs */
} Run;

typedef enum ToneMap { TONE_NONE, TONE_REINHARD, TONE_REINHARD_EXTENDED, TONE_ACES, TONE_HABLE } ToneMap;

typedef struct Scene {
    Store store;
    int width, height;
    int samples;
    Vec camera_position, camera_look_at, camera_up;
    real fov;          /* degrees */
    real orthographic; /* height in units, 0: perspective */
    int max_depth;
    real min_weight;
    bool shadows;
    real exposure;
    ToneMap tone_map;
    real white; /* of reinhard_extended */
    bool srgb;
    Vec background, ambient;
    Light *lights;
    size_t light_count;
    Texture *textures;
    size_t texture_count;
    Material *materials;
    size_t material_count;
    Object *objects; /* the first is the top level */
    size_t object_count;
    Primitive *primitives;
    size_t primitive_count;
    Run *runs; /* of all primitives, in their order */
    size_t run_count;
} Scene;

void scene_init(Scene *scene);
void scene_free(Scene *scene);
/* Reads a file into an initialised scene (parse.c) and places its primitives. */
void scene_read(Scene *scene, const char *path);
/* The same from text, for tests; includes are relative to the working folder. */
void scene_read_text(Scene *scene, const char *text);
/* Fills `primitives` and `runs` from the objects. */
void scene_place(Scene *scene);

/* Index or -1. */
int scene_find_texture(const Scene *scene, const char *name);
int scene_find_material(const Scene *scene, const char *name);
int scene_find_object(const Scene *scene, const char *name);

/* A phong material with the contract's defaults. */
Material material_default(const char *name);
/* Linear value of an sRGB-encoded one in [0, 1]. */
real srgb_decode(real encoded);

#endif
