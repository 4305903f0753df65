/* Point sets over the unit square for the integrals that clrt estimates by random points, and their maps to
 * disks and hemispheres. Knows nothing of scenes. */
#ifndef ORACLE_QUADRATURE_H
#define ORACLE_QUADRATURE_H

#include <stdint.h>

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

/* What one of `count` random paths draws: its points of the square, each uniform and independent of the
 * others. Those that paths of the same key draw for the same decision are a lattice together, moved by a
 * random shift and met in another order at every decision. Paths of another key are independent. */
typedef struct Chance {
    uint64_t key;
    int count, index;
    uint64_t drawn;
} Chance;

Chance chance_make(uint64_t key, int count, int index);
Square chance_draw(Chance *chance);
/* A key of both. */
uint64_t key_with(uint64_t key, uint64_t number);

/* Orthonormal a, b with a unit n. */
void frame_of(Vec n, Vec *a, Vec *b);
/* The direction at an angle from n. */
Vec around(Vec n, real cosine, real turn);
/* Uniform over the unit disk; z is 0. */
Vec disk_point(Square s);
/* About n with density cosine / pi. */
Vec cosine_direction(Vec n, Square s);

#endif
