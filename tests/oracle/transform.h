/* Affine transforms of the contract: translate, rotate, scale, matrix, and their inverses. Knows nothing of
 * shapes. */
#ifndef ORACLE_TRANSFORM_H
#define ORACLE_TRANSFORM_H

#include "vec.h"

/* Three rows of four; the last column is the translation. */
typedef struct Transform {
    real m[3][4];
} Transform;

Transform transform_identity(void);
Transform transform_translate(Vec by);
Transform transform_scale(Vec by);
/* Right-hand rotation about an axis of any length but zero. */
Transform transform_rotate(Vec axis, real degrees);
/* What applies `first`, then `second`. */
Transform transform_then(const Transform *first, const Transform *second);
/* The matrix must not be singular. */
Transform transform_inverse(const Transform *t);
/* Frobenius norm of the linear part: no less than the largest factor by which a length grows. */
real transform_norm(const Transform *t);

Vec transform_point(const Transform *t, Vec p);
Vec transform_vector(const Transform *t, Vec v);
/* A normal of the space that `inverse` leads to, carried back by the transpose of `inverse`; unit length. */
Vec transform_normal(const Transform *inverse, Vec n);

#endif
