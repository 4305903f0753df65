// What the tests of the shapes share: shapes baked and intersected on the device, many rays at a time.
#ifndef CLRT_TESTS_KERNEL_SHAPES_SUPPORT_H
#define CLRT_TESTS_KERNEL_SHAPES_SUPPORT_H

#include "harness.h"

#include "layout/bake.h"
#include "reference/placed.h"

// Rays and answers, one place each, as columns of `capacity` floats; capacity is a multiple of 16.
typedef struct RayTable {
    size_t capacity, count;
    float *rays; // RAY_X columns
    int *index;  // of the ray's primitive
    float *hits; // HIT_X columns
} RayTable;

enum { RAY_ORG, RAY_DIR = 3, RAY_TMIN = 6, RAY_SELF, RAY_INWARD, RAY_COLUMNS };
enum {
    HIT_T,
    HIT_P,
    HIT_ERROR = 4,
    HIT_NG = 7,
    HIT_U = 10,
    HIT_V,
    HIT_U_WHOLE,
    HIT_V_WHOLE,
    HIT_B1,
    HIT_B2,
    HIT_COLUMNS
};

RayTable ray_table_create(size_t count);
void ray_table_destroy(RayTable *table);
void ray_table_clear(RayTable *table);
// Adds a ray; false where the table is full.
bool ray_table_add(RayTable *table, int primitive, const float org[3], const float dir[3]);
// Adds random_ray of RAY_ANY.
void ray_table_add_random(RayTable *table, int primitive, const Placed *p, uint64_t *state);
void ray_table_add_self(RayTable *table, int primitive, const float org[3], const float dir[3], bool inward);
float ray_number(const RayTable *table, size_t i, int column);
float hit_number(const RayTable *table, size_t i, int column);

// Whether CLRT_TEST_LONG is set, to anything but 0: all rays, all widths, and a program for each kind alone.
// Without it a test has fewer rays and one program for all shapes, which every test finds in the driver's
// cache once one has run: compiling is most of what these tests cost.
bool shapes_long_run(void);
// A program that knows the kind (PRIMITIVE_X): that kind alone in the long run, otherwise every kind; -1:
// every kind in any case.
KernelProgram *shapes_program(KernelDevice *device, int kind, int lanes);
// The same with that kind alone in any case.
KernelProgram *shapes_program_alone(KernelDevice *device, int kind, int lanes);
// A program of other text with one kind, or with -1 all.
KernelProgram *shapes_program_of(KernelDevice *device, const char *text, int kind, int lanes);
// Fills table->hits. All primitives are of one kind where the program has only one.
void shapes_run(KernelProgram *program, int lanes, RayTable *table, const Primitive *primitives,
                size_t count);
// Moves the origin of every ray to where a ray in its direction leaves the surface point in table->hits.
void shapes_leave(KernelProgram *program, int lanes, RayTable *table);
// How many of the primitives each ray of the table meets; met has table->capacity places.
void shapes_crossings(KernelProgram *program, int lanes, const RayTable *table, const Primitive *primitives,
                      size_t count, float *met);

// Uniform in [0, 1), and in a range; *state is any number.
double random_unit(uint64_t *state);
double random_in(uint64_t *state, double low, double high);
void random_direction(uint64_t *state, double d[3]);
// 10 to a power that is uniform in [low, high].
double random_scale(uint64_t *state, double low, double high);

// Distance between two floats in units in the last place of the first.
double ulps_between(double exact, float x);
double ulp_of(double x);

typedef struct Answer {
    const char *name;
    double exact, ulps; // INFINITY: no hit
} Answer;

// The primitive of a shape under a translation; a failure fails the test.
Primitive bake_at(const Shape *shape, Vec3 shift);
// Adds a ray at the primitive of the same index.
void ray_table_add_next(RayTable *table, Vec3 org, Vec3 dir);
// Shoots the rays at 8 lanes, in the long run also at 1, compares with the answers and prints one line each
// name.
void expect_answers(KernelDevice *device, int kind, RayTable *table, const Primitive *primitives,
                    const Answer *answers);

#endif
