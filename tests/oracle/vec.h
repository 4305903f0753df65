/* Vectors of the oracle: extended precision, so that no formula of the contract needs a careful rewriting.
 * Knows nothing of scenes. */
#ifndef ORACLE_VEC_H
#define ORACLE_VEC_H

#include <math.h>
#include <stdbool.h>

typedef long double real;

#define PI 3.14159265358979323846264338327950288L

typedef struct Vec {
    real x, y, z;
} Vec;

static inline Vec vec(real x, real y, real z)
{
    return (Vec){x, y, z};
}

static inline Vec grey(real value)
{
    return (Vec){value, value, value};
}

static inline Vec add(Vec a, Vec b)
{
    return (Vec){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline Vec sub(Vec a, Vec b)
{
    return (Vec){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline Vec scaled(Vec a, real s)
{
    return (Vec){a.x * s, a.y * s, a.z * s};
}

/* Component by component, for colors. */
static inline Vec times(Vec a, Vec b)
{
    return (Vec){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline real dot(Vec a, Vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline Vec cross(Vec a, Vec b)
{
    return (Vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline real length(Vec a)
{
    return sqrtl(dot(a, a));
}

static inline Vec normalized(Vec a)
{
    return scaled(a, 1 / length(a));
}

static inline real component(Vec a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

static inline real largest(Vec a)
{
    return fmaxl(a.x, fmaxl(a.y, a.z));
}

#endif
