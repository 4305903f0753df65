/* The shapes of the contract in their own space: set-up, crossings with a line, the surface at a crossing.
 * Knows nothing of the world, of materials or of light. */
#ifndef ORACLE_SHAPE_H
#define ORACLE_SHAPE_H

#include "scene.h"

/* The line o + t d, for any t; d need not be a unit vector. */
typedef struct Line {
    Vec o, d;
} Line;

/* Patches: box 0..5 (-x +x -y +y -z +z), tetrahedron 0..3 (abc abd acd bcd), cone 0 side 1 base 2 top,
 * else 0. */
typedef struct Crossing {
    real t;
    int patch;
    bool on_edge; /* of a triangle, as far as rounding lets one tell */
} Crossing;

enum { CROSSINGS_MAX = 8 };

typedef struct Surface {
    Vec normal;  /* geometric, outward, unit */
    Vec shading; /* interpolated where the shape has such normals, else `normal` */
    real u, v;
    Vec du, dv; /* of the point, by u and v */
} Surface;

/* right and up of somebody who faces the surface: unit vectors for a unit normal n. */
void tangents_of(Vec n, Vec *t1, Vec *t2);

/* Fill what follows from center, normal (any length), vertices, radii: unit normals, tangents, height. */
void shape_finish(Shape *shape);
/* A sphere around the shape; false, and a point of it with radius 0, for what is infinite. */
bool shape_bound(const Shape *shape, Vec *center, real *radius);
/* All crossings of the whole line with the surface, in no order; returns their number. */
int shape_crossings(const Shape *shape, const Line *line, Crossing out[CROSSINGS_MAX]);
/* Whether a line that starts on the patch cannot meet the same patch again. */
bool shape_patch_is_flat(const Shape *shape, int patch);
/* p is on the given patch. */
Surface shape_surface(const Shape *shape, Vec p, int patch);

/* One kind each; the shapes' files. */
int sphere_crossings(const Shape *shape, const Line *line, Crossing *out);
int cone_crossings(const Shape *shape, const Line *line, Crossing *out);
int torus_crossings(const Shape *shape, const Line *line, Crossing *out);
int plane_crossings(const Shape *shape, const Line *line, Crossing *out);
int disk_crossings(const Shape *shape, const Line *line, Crossing *out);
int triangle_crossings(const Shape *shape, const Line *line, Crossing *out);
int parallelogram_crossings(const Shape *shape, const Line *line, Crossing *out);
int box_crossings(const Shape *shape, const Line *line, Crossing *out);
int tetrahedron_crossings(const Shape *shape, const Line *line, Crossing *out);

Surface sphere_surface(const Shape *shape, Vec p);
Surface cone_surface(const Shape *shape, Vec p, int patch);
Surface torus_surface(const Shape *shape, Vec p);
Surface plane_surface(const Shape *shape, Vec p);
Surface disk_surface(const Shape *shape, Vec p);
Surface triangle_surface(const Shape *shape, Vec p);
Surface parallelogram_surface(const Shape *shape, Vec p);
Surface box_surface(const Shape *shape, Vec p, int patch);
Surface tetrahedron_surface(const Shape *shape, Vec p, int patch);

#endif
