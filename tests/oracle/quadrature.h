/* Point sets over the unit square for the integrals that clrt estimates by random points, and their maps to
 * disks and hemispheres. Knows nothing of scenes. */
#ifndef ORACLE_QUADRATURE_H
#define ORACLE_QUADRATURE_H

#include "vec.h"

/* A lattice of `count` points (i, i times the golden ratio), moved by a shift of its own for each place, so
 * that its error at neighbouring places differs and the mean over a pixel's positions is better than each. */
typedef struct Lattice {
    int count;
    real shift[2];
} Lattice;

typedef struct Square {
    real x, y; /* in [0, 1) */
} Square;

/* The shift is made from p and a number that tells integrals at the same place apart. */
Lattice lattice_at(int count, Vec p, int which);
Square lattice_point(const Lattice *lattice, int index);

/* Orthonormal a, b with a unit n. */
void frame_of(Vec n, Vec *a, Vec *b);
/* The direction at an angle from n. */
Vec around(Vec n, real cosine, real turn);
/* Uniform over the unit disk; z is 0. */
Vec disk_point(Square s);
/* About n with density cosine / pi. */
Vec cosine_direction(Vec n, Square s);

#endif
