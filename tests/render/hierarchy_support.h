// What hierarchy_test.c works with: programs that search rays for their hits with and without the hierarchy,
// a scene and rays on the device, and the answers.
#ifndef CLRT_TESTS_RENDER_HIERARCHY_SUPPORT_H
#define CLRT_TESTS_RENDER_HIERARCHY_SUPPORT_H

#include "support.h"

#include "device/program.h"

enum { RAYS = 51200, STEPS = 3, COLUMNS = 7 };

// What is met, as in BatchHits.primitive: a primitive, or FACE | 8 * block + place in the block.
enum { FACE = 0x20000000 };

// The programs of hierarchy.cl for one shape of kernels.
typedef struct Search {
    Device *device;
    char *source; // of the program
    Program *program;
    Kernel *search, *bounce;
    u32 batch, lanes;
} Search;

// The scene and the rays of a test, on the device.
typedef struct Space {
    Layout *layout;
    Buffer *primitives, *infos, *nodes, *materials, *extras;
    Buffer *blocks, *mesh_runs, *mesh_indices, *mesh_normals;
    // What rays can meet, each with the instance that it is seen through: a primitive, or the first face of a
    // block, which stands for all of them.
    i32 (*list)[2];
    u32 pair_count;
    Buffer *pairs;
    u32 target_count; // primitives and faces of the list
    Buffer *rays, *selves, *t, *found;
} Space;

// Of each step and ray: t, and the primitive or face and the instance that are met.
typedef struct Answer {
    f32 *t;     // STEPS * RAYS
    i32 *found; // 2 * STEPS * RAYS
} Answer;

// Where the scene stands in render space.
typedef struct Place {
    const char *camera; // statement of a scene
    f32 at[3];
} Place;

// Fails the running test with the error unless done.
void must(bool done, const Error *error);

// With every feature but textures; errors fail the running test.
Search search_create(Device *device, u32 lanes, u32 batch);
void search_destroy(Search *search);

Space space_create(Device *device, const char *scene);
void space_destroy(Space *space);
// Sets what both kernels read of the scene.
void space_bind(const Space *space, Kernel *kernel);

// Puts random rays about the place into the space; none starts on a surface.
void space_aim(const Space *space, const Place *place, u64 seed);
// Random, and half of the time a multiple of a half.
f32 snapped(u64 *seed, f64 range);

// The primitive's place in the order of definition, without that of an instance.
u64 order_of(const Layout *layout, i32 met);

Answer answer_create(void);
void answer_destroy(Answer *answer);

// Searches the rays of the space, all: by a test of every primitive and face. Fills the answer.
void search_run(const Search *search, const Space *space, bool all, bool any_hit, bool opaque_only, u32 steps,
                Answer *answer);

// Tells the rays of the space that they start on the faces that they have met in the last search_run, one for
// closest hits: they now meet what is behind, wherever they start.
void space_leave_out_faces(const Space *space);

// Turns the rays of the space that have met something in the last search_run, one for closest hits, into rays
// that start there in random directions.
void search_bounce(const Search *search, const Space *space, u64 seed);

#endif
