// Scene: what a scene file says, as plain structs in double, in the order it was written.
// Ranges and defaults are those of the scene language; whoever holds a Scene may rely on them.
// Nothing here knows of devices, of acceleration or of how anything is drawn.
#ifndef CLRT_SCENE_SCENE_H
#define CLRT_SCENE_SCENE_H

#include "base/arena.h"
#include "base/types.h"
#include "base/vec.h"
#include "image/bitmap.h"
#include "scene/mesh.h"

// Where a thing stands in the text: index into Scene.files, line and column from 1.
typedef struct SourcePos {
    u32 file;
    u32 line;
    u32 column;
} SourcePos;

// ---- image, camera, render, output ----------------------------------------------------------

typedef enum Filter { FILTER_BOX, FILTER_TENT, FILTER_GAUSSIAN, FILTER_MITCHELL } Filter;

typedef struct ImageSettings {
    u32 width, height; // 1..65536
    u32 samples;       // 1..1048576
    Filter filter;
    u32 seed;
    SourcePos filter_at;
} ImageSettings;

typedef struct Camera {
    Vec3 position, look_at, up;
    bool orthographic;
    f64 fov;    // degrees, vertical; perspective only
    f64 height; // of the view in units; orthographic only
    f64 aperture, focus_distance; // radius of the lens, 0 for the pinhole
    SourcePos aperture_at;
} Camera;

typedef enum Integrator { INTEGRATOR_WHITTED, INTEGRATOR_PATH } Integrator;
typedef enum EnvironmentLighting { ENVIRONMENT_SAMPLED, ENVIRONMENT_PREFILTERED } EnvironmentLighting;

// How the path integrator looks for the light of area lights and of the environment.
typedef enum LightSampling { LIGHT_SAMPLING_BOTH, LIGHT_SAMPLING_LIGHTS, LIGHT_SAMPLING_SURFACES } LightSampling;

typedef struct RenderSettings {
    u32 max_depth; // 0..64
    f64 min_weight;
    Integrator integrator;
    u32 ambient_occlusion_samples; // 0: off
    f64 ambient_occlusion_distance;
    u32 environment_samples;
    EnvironmentLighting environment_lighting;
    LightSampling light_sampling; // not of the language; BOTH unless somebody says otherwise
    bool shadows;
    SourcePos integrator_at, ambient_occlusion_at, environment_lighting_at; // line 0: not written
} RenderSettings;

typedef enum ToneMap {
    TONE_MAP_NONE,
    TONE_MAP_REINHARD,
    TONE_MAP_REINHARD_EXTENDED,
    TONE_MAP_ACES,
    TONE_MAP_HABLE
} ToneMap;
typedef enum Encoding { ENCODING_SRGB, ENCODING_LINEAR } Encoding;

typedef struct OutputSettings {
    f64 exposure; // stops
    ToneMap tone_map;
    f64 white; // reinhard_extended only, > 0
    Encoding encoding;
    bool exposure_given, tone_map_given; // written in the file, whatever the value
} OutputSettings;

typedef struct Environment {
    bool present;
    const char *file; // resolved path
    Vec3 intensity;
    f64 rotate; // degrees
    const Bitmap *bitmap; // one of Scene.bitmaps, HALF or FLOAT; NULL until assets_load
    SourcePos at, file_at;
} Environment;

// ---- light ----------------------------------------------------------------------------------

typedef enum LightKind {
    LIGHT_POINT,
    LIGHT_DIRECTIONAL,
    LIGHT_SPOT,
    LIGHT_SPHERE,
    LIGHT_RECTANGLE
} LightKind;

typedef struct Light {
    LightKind kind;
    SourcePos at;
    Vec3 position;       // point, spot; center of a sphere; corner of a rectangle
    Vec3 direction;      // directional: direction of travel, as written
    Vec3 look_at;        // spot
    Vec3 intensity;      // punctual; radiance of an area light
    f64 attenuation[3];  // point, spot: KC KL KQ
    f64 inner, outer;    // spot: full angles in degrees
    f64 radius;          // sphere
    Vec3 edge1, edge2;   // rectangle
    u32 samples;         // area lights
} Light;

// ---- texture and material -------------------------------------------------------------------

typedef enum TextureKind { TEXTURE_CHECKER, TEXTURE_CHECKER3D, TEXTURE_IMAGE } TextureKind;
typedef enum TextureFilter { TEXTURE_BILINEAR, TEXTURE_NEAREST } TextureFilter;

typedef struct Texture {
    TextureKind kind;
    SourcePos at;
    const char *name;
    Vec3 colors[2];  // checkers
    f64 scale[2];    // checker, image: SU SV; checker3d: S in scale[0]. May be any number but 0
    const char *file; // image: resolved path
    const Bitmap *bitmap; // image: one of Scene.bitmaps; NULL until assets_load
    SourcePos file_at;    // image
    TextureFilter filter;
    Encoding encoding; // image: of levels; floats are linear
    u32 channel;       // image: the one that a number reads, 0 .. 2
    const void *content; // image within another file: the bytes of the picture file, where `file` is the other's
    size_t content_size;
    const char *named_by; // image: the file that names it, which can do without it; NULL: the scene itself
    // image: each of the first two channels c becomes c + fade (fade_to - c); 0: they stay
    f64 fade, fade_to;
} Texture;

// A color, times the texture with this index where texture >= 0.
typedef struct ColorInput {
    Vec3 color;
    i32 texture;
} ColorInput;

// A number, times the texture with this index where texture >= 0.
typedef struct NumberInput {
    f64 value;
    i32 texture;
} NumberInput;

typedef enum MaterialKind { MATERIAL_PHONG, MATERIAL_BLINN_PHONG, MATERIAL_PBR } MaterialKind;

typedef struct Material {
    MaterialKind kind;
    SourcePos at;
    const char *name;
    // phong, blinn_phong; ambient is already the diffuse input where the file gives none
    ColorInput ambient, diffuse;
    Vec3 specular;
    f64 shininess;
    Vec3 reflect, transmit;
    bool fresnel;
    // pbr
    ColorInput base_color;
    NumberInput metallic, roughness, occlusion;
    f64 pbr_transmit;
    // all
    f64 ior;
    ColorInput emission;
    i32 normal_map; // texture index, -1: none
    SourcePos normal_map_at;
} Material;

// ---- shapes ---------------------------------------------------------------------------------

typedef enum ShapeKind {
    SHAPE_SPHERE,
    SHAPE_PLANE,
    SHAPE_BOX,
    SHAPE_TETRAHEDRON,
    SHAPE_TRIANGLE,
    SHAPE_DISK,
    SHAPE_CYLINDER,
    SHAPE_CONE,
    SHAPE_TORUS,
    SHAPE_MESH
} ShapeKind;

typedef struct Shape {
    ShapeKind kind;
    SourcePos at;
    i32 material;     // index into Scene.materials, -1: not named by the shape
    Affine transform; // shape's own space -> space of its object (or the world)
    union {
        struct { Vec3 center; f64 radius; } sphere;
        struct { Vec3 point, normal; } plane;   // normal as written
        struct { Vec3 min, max; } box;          // also from center and size
        struct { Vec3 vertices[4]; } tetrahedron; // a b c d as written or as the manual gives them
        struct {
            Vec3 vertices[3];
            Vec3 normals[3]; // where has_normals, as written
            f64 uvs[3][2];   // where has_uvs
            bool has_normals, has_uvs;
        } triangle;
        struct { Vec3 center, normal; f64 radius; } disk;
        struct { Vec3 base, top; f64 radius; bool caps; } cylinder;
        struct { Vec3 base, top; f64 radius, top_radius; bool caps; } cone;
        struct { Vec3 center, axis; f64 major, minor; } torus;
        struct {
            const char *file; // resolved path
            i32 smooth;       // -1: as the file says
            bool terminator;  // shadow rays start above its faces, where its normals make them bulge
            const Mesh *mesh; // one of Scene.meshes; NULL until assets_load
            SourcePos file_at;
        } mesh;
    } as;
} Shape;

typedef struct Instance {
    SourcePos at;
    u32 object;       // index into Scene.objects
    i32 material;     // -1: not named
    Affine transform; // object's space -> parent's space
} Instance;

// One placed thing. Order in a group is the order of definition, which breaks ties between hits.
typedef enum ItemKind { ITEM_SHAPE, ITEM_INSTANCE, ITEM_LIGHT } ItemKind;
typedef struct Item {
    ItemKind kind;
    u32 index; // into Scene.shapes, .instances or .lights
} Item;

typedef struct Group {
    Item *items;
    u32 count;
} Group;

typedef struct Object {
    const char *name;
    SourcePos at;
    Group group; // shapes and instances
    u64 placed;  // instances placed inside it, nested ones counted for every placement
} Object;

typedef struct Scene {
    ImageSettings image;
    Camera camera;
    RenderSettings render;
    OutputSettings output;
    Vec3 background;
    Vec3 ambient;
    Environment environment;
    Light *lights;
    u32 light_count;
    Texture *textures;
    u32 texture_count;
    Material *materials; // [0] is `default`
    u32 material_count;
    Mesh *meshes; // of the files that shapes name; filled by assets_load
    u32 mesh_count;
    Bitmap *bitmaps; // of the files that textures and the environment name; filled by assets_load
    u32 bitmap_count;
    Shape *shapes;
    u32 shape_count;
    Instance *instances;
    u32 instance_count;
    Object *objects;
    u32 object_count;
    Group world;         // top-level shapes, instances and area lights
    const char **files;  // names of the files read, as given or as included; [0] is the scene's
    const char **file_texts; // of each file, ending in 0, for messages about its places
    u32 file_count;
} Scene;

#endif
