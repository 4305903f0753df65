// MTL: the materials of a Wavefront library, as far as the renderer has them. Knows no scene and opens no
// texture.
#ifndef CLRT_ASSETS_MTL_H
#define CLRT_ASSETS_MTL_H

#include "base/arena.h"
#include "base/error.h"
#include "scene/diagnostics.h"

enum { MTL_NS_MAX = 1000000 };

// What a material gives itself; members without their flag are 0.
typedef enum MtlGiven {
    MTL_KD = 1 << 0,
    MTL_KS = 1 << 1,
    MTL_KE = 1 << 2,
    MTL_NS = 1 << 3,
    MTL_NI = 1 << 4,
    MTL_D = 1 << 5, // d, or Tr where there is no d
} MtlGiven;

typedef struct MtlMaterial {
    char *name;
    u32 line;  // of its newmtl
    u32 given; // MtlGiven
    f64 kd[3], ks[3], ke[3]; // linear, 0 or more
    f64 ns;                  // 0 .. MTL_NS_MAX
    f64 ni;                  // above 0
    f64 d;                   // opacity, 0 .. 1
    char *map_kd;   // NULL: none; as written: relative to the library's folder
    u32 map_kd_line;
    char *map_bump; // norm, else map_Bump or bump: a normal map; NULL: none
    u32 map_bump_line;
} MtlMaterial;

typedef struct MtlFile {
    MtlMaterial *materials; // in the order of the file; where a name stands twice, the first one counts
    u32 count;
    Arena *arena; // of all of it
} MtlFile;

// Reads the regular file at path. Returns false with an Error where that was not possible; the text is the
// reason alone. What the file says wrongly is added to diagnostics, located in `path`, and returns true;
// after an error *mtl is still complete but for that statement. Numbers out of their range are moved into it
// with a warning; statements of the format that the renderer has no use for are skipped silently, unknown
// words with a warning for each.
bool mtl_read(const char *path, Diagnostics *diagnostics, MtlFile *mtl, Error *error);

// Frees what mtl holds and zeroes it; a zeroed MtlFile is fine.
void mtl_destroy(MtlFile *mtl);

#endif
