// Import: meshes of every format but OBJ, through the C API of assimp where there is one. Knows no scene.
#ifndef CLRT_ASSETS_IMPORT_H
#define CLRT_ASSETS_IMPORT_H

#include "base/error.h"
#include "scene/mesh.h"

// A picture within the file, as the bytes of a picture file.
typedef struct ImportImage {
    void *bytes;
    size_t size;
} ImportImage;

typedef enum ImportMap {
    IMPORT_BASE_COLOR,
    IMPORT_METALLIC_ROUGHNESS, // roughness in green, metallic in blue
    IMPORT_NORMAL,
    IMPORT_OCCLUSION,
    IMPORT_EMISSION,
    IMPORT_MAPS
} ImportMap;

typedef struct ImportTexture {
    char *file;   // relative to the file's folder; NULL: none, or one of the images
    i32 image;    // index of one of the images, -1: none
    bool nearest; // no filter
    f64 fade;     // as in Texture: normal scale, occlusion strength
} ImportTexture;

// From the uvs of a mesh to those that the maps of its material are looked up by; v runs upwards in both.
typedef struct ImportUvs {
    u32 set;       // of the mesh's sets
    f64 row[2][3]; // of u and v: factors of u, v and 1
} ImportUvs;

// What a file can say and a material of the language cannot.
typedef enum ImportLeftOut {
    IMPORT_WRAP,          // textures that are clamped or mirrored, in place of repeating
    IMPORT_OTHER_UVS,     // a map with other uvs than the first
    IMPORT_ALPHA,         // alpha is not opaque
    IMPORT_LAYERS,        // clear coat, sheen, specular and glossiness, unlit, a map of transmission
    IMPORT_VERTEX_COLORS, // not all of them white
    IMPORT_LEFT_OUTS
} ImportLeftOut;

// Of glTF: the part of its model that the renderer has. Colors are linear.
typedef struct ImportMaterial {
    char *name;
    Vec3 base_color, emission; // times their textures
    f64 metallic, roughness;   // 0 .. 1, times their texture
    f64 transmit;              // 0 .. 1
    f64 ior;                   // above 0
    ImportTexture maps[IMPORT_MAPS];
    ImportUvs uvs;
    u32 left_out; // bits 1 << ImportLeftOut
} ImportMaterial;

typedef struct ImportFile {
    Mesh mesh; // as in mesh.h, but faces without area are kept and face_count may be 0;
               // parts[].material is an index into materials, -1: none
    ImportMaterial *materials; // of glTF 2 alone
    u32 material_count;
    ImportImage *images;
    u32 image_count;
} ImportFile;

// Whether this build has assimp.
bool import_available(void);

// Reads the file at path, whose format is told by its suffix and its first bytes. Its nodes are placed by
// their transforms; mirrored ones have their corners turned round, so that outward stays outward. Polygons
// are fans from the first corner; uvs are those that the material's maps want; points, lines, cameras,
// lights, bones, colours of vertices and other uvs are ignored. Where a file gives every corner a vertex of
// its own (STL), positions that are equal are joined, so that normals can be made; the normals of STL's
// facets are ignored, which say nothing new. Fails with ERROR_SCENE, or ERROR_MEMORY; the text is the reason
// alone, *file is empty then.
bool import_read(const char *path, ImportFile *file, Error *error);

// Frees what file holds and zeroes it; a zeroed ImportFile is fine. A caller that keeps file->mesh zeroes it
// before.
void import_destroy(ImportFile *file);

#endif
