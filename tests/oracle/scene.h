/* What a scene file says (sections 1 and 2 of the contract), as plain structs with every default filled in,
 * and the list of placed primitives that rays are tested against. Knows nothing of rays. */
#ifndef ORACLE_SCENE_H
#define ORACLE_SCENE_H

#include "image.h"
#include "store.h"
#include "transform.h"

typedef enum ShapeKind {
    SHAPE_SPHERE,
    SHAPE_PLANE,
    SHAPE_BOX,
    SHAPE_TETRAHEDRON,
    SHAPE_TRIANGLE,
    SHAPE_PARALLELOGRAM, /* vertices: a corner and the two next to it; only area lights have it */
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

typedef enum TextureKind { TEXTURE_CHECKER, TEXTURE_CHECKER3D, TEXTURE_IMAGE } TextureKind;

typedef struct Texture {
    const char *name;
    TextureKind kind;
    Vec colors[2];
    real scale[2]; /* checker3d: the first only */
    const Image *image;
    bool nearest, srgb;
} Texture;

/* A color, times a texture where `texture` >= 0. A number is a color whose first channel counts. */
typedef struct Paint {
    Vec color;
    int texture;
} Paint;

typedef struct Material {
    const char *name;
    bool blinn, pbr;
    bool fresnel;
    Paint ambient, diffuse, emission;
    Vec specular, reflect, transmit;
    real shininess, ior;
    int normal_map; /* texture, or -1 */
    Paint base_color, metallic, roughness, occlusion;
    real share_transmitted; /* pbr's transmit */
} Material;

typedef enum LightKind {
    LIGHT_POINT,
    LIGHT_DIRECTIONAL,
    LIGHT_SPOT,
    LIGHT_SPHERE,
    LIGHT_RECTANGLE
} LightKind;

typedef struct Light {
    LightKind kind;
    Vec position;  /* the center of a sphere, the corner of a rectangle */
    Vec direction; /* unit, of travel: directional, spot */
    Vec intensity; /* the radiance of area lights */
    real radius;
    Vec edges[2];
    real attenuation[3];
    real cos_inner, cos_outer; /* of half the angles */
} Light;

/* An equirectangular map of radiance around the scene. */
typedef struct Environment {
    const Image *image; /* NULL: there is none */
    Vec intensity;
    Transform to_map, from_map; /* directions; by the angle `rotate` */
    real *rows;  /* of importance sampling: share of all rows up to each one, and of its texels in each row */
    real *texels;
} Environment;

typedef enum Filter { FILTER_BOX, FILTER_TENT, FILTER_GAUSSIAN, FILTER_MITCHELL } Filter;

enum { MATERIAL_NONE = -1, MATERIAL_DEFAULT = -2 };

/* A shape or an instance inside an object, or at the top level. */
typedef struct Item {
    bool is_instance;
    size_t object;   /* index of the instance's object */
    int material;    /* index, MATERIAL_NONE or MATERIAL_DEFAULT */
    int light;       /* index of the area light whose surface this is, or -1 */
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
    int light; /* index of the area light whose surface this is, or -1 */
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
    Filter filter;
    Vec camera_position, camera_look_at, camera_up;
    real fov;          /* degrees */
    real orthographic; /* height in units, 0: perspective */
    real aperture;
    real focus_distance; /* 0: the distance to look_at */
    int max_depth;
    real min_weight;
    bool path; /* integrator path */
    bool shadows;
    real occlusion_distance; /* of ambient occlusion; 0: off */
    int points; /* of the quadrature over an area light, a hemisphere, the environment */
    real exposure;
    ToneMap tone_map;
    real white; /* of reinhard_extended */
    bool srgb;
    Vec background, ambient;
    Environment environment;
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

#endif
