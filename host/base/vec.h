// Vectors and affine maps in double, for set-up on the host.
#ifndef CLRT_BASE_VEC_H
#define CLRT_BASE_VEC_H

#include "base/types.h"

typedef struct Vec3 {
    f64 x, y, z;
} Vec3;

// p -> linear p + translation; rows of the linear part in row[0..2].
typedef struct Affine {
    Vec3 row[3];
    Vec3 translation;
} Affine;

Vec3 vec_add(Vec3 a, Vec3 b);
Vec3 vec_sub(Vec3 a, Vec3 b);
Vec3 vec_scale(Vec3 a, f64 s);
f64 vec_dot(Vec3 a, Vec3 b);
Vec3 vec_cross(Vec3 a, Vec3 b);
// Free of overflow and underflow for any finite vector.
f64 vec_length(Vec3 a);
// a must not be zero; free of overflow and underflow.
Vec3 vec_normalize(Vec3 a);

Affine affine_identity(void);
Affine affine_translate(Vec3 t);
Affine affine_scale(Vec3 s);
// Right-hand rotation by degrees about the axis (need not be unit length); exact at multiples of 90.
Affine affine_rotate(Vec3 axis, f64 degrees);
// The map that applies `first`, then `second`.
Affine affine_compose(Affine second, Affine first);
// The inverse; linear part must be regular.
Affine affine_inverse(Affine m);
f64 affine_determinant(Affine m);
Vec3 affine_point(Affine m, Vec3 p);
Vec3 affine_direction(Affine m, Vec3 d);
// Carries a normal by the inverse transpose of m's linear part, up to a positive factor, so that
// outward stays outward under a mirroring map; result is unit length.
Vec3 affine_normal(Affine m, Vec3 n);
// Singular values of the linear part, largest first.
void affine_singular_values(Affine m, f64 values[3]);

#endif
