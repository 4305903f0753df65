// Ray sets: the rays that a render of the scene would trace, one kind a set, and what is found for them.
// Directions are unit; columns lie side by side (structure of arrays).
#ifndef CLRT_BENCH_RAYS_H
#define CLRT_BENCH_RAYS_H

#include "base/error.h"
#include "scenes.h"

typedef enum RayKind {
    RAYS_CAMERA,   // tiles of 8x8 pixels, Morton order inside
    RAYS_MIRROR,   // reflected where camera rays hit
    RAYS_AO,       // any hit within a tenth of the scene's diagonal, cosine about the normal
    RAYS_DIFFUSE,  // closest hit, cosine about the normal
    RAYS_BOUNCE2,  // the same from the hits of RAYS_DIFFUSE
    RAYS_SHUFFLED, // RAYS_DIFFUSE in random order
    RAYS_SUN,      // any hit towards a directional light, from lit camera hits
    RAY_KINDS
} RayKind;

// Numbers of a ray: columns of RaySet.columns.
enum { RAY_ORG = 0, RAY_DIR = 3, RAY_FAR = 6, RAY_COLUMNS = 7 };

enum {
    RAYS_PADDING = 64,        // columns are a multiple of it long; the rest repeats the last ray
    RAYS_FEW = 50000          // smaller sets measure latency rather than tracing
};

typedef struct RaySet {
    RayKind kind;
    bool any_hit;
    u32 count, stride;
    f32 *columns; // column c of ray i at [c * stride + i]
} RaySet;

#define NO_PRIMITIVE 0xffffffffu

// In the scene's own numbers, whoever traced. Of any-hit rays only whether primitive is NO_PRIMITIVE counts.
typedef struct RayHits {
    u32 count, stride;
    f32 *t, *u, *v;  // weights of the second and third corner
    u32 *primitive;  // face or sphere, or NO_PRIMITIVE
    u32 *instance;   // 0 or NO_PRIMITIVE where there are none
} RayHits;

// "camera", "mirror", ...
const char *ray_kind_name(RayKind kind);
// The set whose hits a set starts from; the set itself for RAYS_CAMERA.
RayKind ray_kind_source(RayKind kind);

// size: of the image, for RAYS_CAMERA only; source and hits: of ray_kind_source(kind), for the others. A set
// may be empty. Fails with ERROR_MEMORY.
RaySet *rays_create(RayKind kind, const BenchScene *scene, u32 size, const RaySet *source,
                    const RayHits *hits, Error *error);
void rays_destroy(RaySet *rays);

RayHits *ray_hits_create(u32 count, Error *error);
void ray_hits_destroy(RayHits *hits);

Vec3 ray_origin(const RaySet *rays, u32 i);
Vec3 ray_direction(const RaySet *rays, u32 i);

#endif
