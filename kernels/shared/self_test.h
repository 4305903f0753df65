// What the self-test and its kernels agree on: numbers of functions, columns of tables. A table has its
// columns side by side, `stride` numbers each; a ray or a set of arguments is one place in all of them.
#ifndef CLRT_SHARED_SELF_TEST_H
#define CLRT_SHARED_SELF_TEST_H

#include "shared/types.h"

// self_test_numbers: what is done with the numbers a, b, c ... of each place; results in columns 0, 1, 2.
enum {
    FUNCTION_SIN,
    FUNCTION_COS,
    FUNCTION_ACOS,
    FUNCTION_ATAN2, // of the point (a, b)
    FUNCTION_EXP,
    FUNCTION_EXP2,
    FUNCTION_LOG,
    FUNCTION_LOG2,
    FUNCTION_POW,
    FUNCTION_DIVIDE,
    FUNCTION_SQRT,
    FUNCTION_EXPRESSION, // a b - c d as it is written in C
    FUNCTION_PRODUCTS,   // difference_of_products(a, b, c, d)
    FUNCTION_NORMALIZE,  // a b c
    FUNCTION_UNIT,       // random_unit of the bits of a
    FUNCTION_LEAVE,      // where a ray in direction d starts: point, error, normal, d of three numbers each
    FUNCTION_MEAN,       // of b samples of value a; not among the known answers
    FUNCTION_COUNT
};

#define NUMBERS_IN 12
#define NUMBERS_OUT 3

// self_test_rays: what the rays meet.
#define PROBE_OWN 0       // each the primitive of PROBE_PRIMITIVE, in the space of PROBE_INSTANCE
#define PROBE_HIERARCHY 1 // the scene, by its hierarchy
#define PROBE_EACH 2      // the scene without boxes: every block and every primitive

enum { PROBE_ORG, PROBE_DIR = 3, PROBE_TMIN = 6, PROBE_TFAR, PROBE_RAY_REALS };
// SELF as in BatchHits.self; INSTANCE, SELF_INSTANCE: index of an instance, or -1.
enum { PROBE_PRIMITIVE, PROBE_INSTANCE, PROBE_SELF, PROBE_SELF_INSTANCE, PROBE_RAY_INTS };

enum {
    PROBE_T, // of the first hit; INFINITY: none
    PROBE_P,
    PROBE_ERROR = 4,
    PROBE_NG = 7, // outward
    PROBE_U = 10,
    PROBE_V,
    PROBE_U_WHOLE,
    PROBE_V_WHOLE,
    PROBE_COLOR,   // red of the diffuse color
    PROBE_LIT,     // red of what light 0 sends to the eye by way of the hit
    PROBE_REFLECT, // direction and red of the weight
    PROBE_REFLECT_WEIGHT = PROBE_REFLECT + 3,
    PROBE_TRANSMIT,
    PROBE_TRANSMIT_WEIGHT = PROBE_TRANSMIT + 3,
    PROBE_HIT_REALS
};
enum {
    PROBE_FOUND,     // number of the face, or index of the primitive; -1: none
    PROBE_CROSSINGS, // hits along the ray, up to as many as asked for
    PROBE_HIT_INTS
};

#endif
