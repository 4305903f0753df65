// Frame: two unit vectors beside a third, for directions that are drawn about it.
#ifndef CLRT_KERNELS_BASE_FRAME_H
#define CLRT_KERNELS_BASE_FRAME_H

#include "base/vec.h"

#define INVERSE_PI REAL(0.31830989f, 0.31830988618379067154)
#define PI REAL(3.1415927f, 3.14159265358979323846)
#define TWO_PI REAL(6.2831855f, 6.28318530717958647693)

typedef struct { v3 t1, t2, n; } Frame;

// Right-handed, orthonormal within a few roundings, for unit n: Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 2017.
static inline Frame frame_make(v3 n)
{
    Frame f;
    const vf sign = n.z < (vf)(0.0f) ? (vf)(-1.0f) : (vf)(1.0f);
    const vf a = (vf)(-1.0f) / (sign + n.z);
    const vf b = n.x * n.y * a;
    f.t1 = v3_make(fma(sign * n.x * n.x, a, (vf)(1.0f)), sign * b, -sign * n.x);
    f.t2 = v3_make(b, fma(n.y * n.y, a, sign), -n.y);
    f.n = n;
    return f;
}

static inline v3 frame_to_local(const Frame *f, v3 v)
{
    return v3_make(v3_dot(f->t1, v), v3_dot(f->t2, v), v3_dot(f->n, v));
}

static inline v3 frame_from_local(const Frame *f, v3 v)
{
    return v3_fma(f->n, v.z, v3_fma(f->t2, v.y, v3_scale(f->t1, v.x)));
}

#endif
