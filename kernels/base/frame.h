// Frame: three unit vectors at right angles, for directions that are drawn about one of them.
#ifndef CLRT_KERNELS_BASE_FRAME_H
#define CLRT_KERNELS_BASE_FRAME_H

#include "base/trig.h"
#include "base/vec.h"

#define INVERSE_PI REAL(0.31830989f, 0.31830988618379067154)
#define PI REAL(3.1415927f, 3.14159265358979323846)
#define TWO_PI REAL(6.2831855f, 6.28318530717958647693)

typedef struct { v3 x, y, z; } Frame;

// Right-handed, orthonormal within a few roundings, for unit z: Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 2017.
static inline Frame frame_about(v3 z)
{
    Frame f;
    const vf sign = z.z < (vf)(0.0f) ? (vf)(-1.0f) : (vf)(1.0f);
    const vf a = (vf)(-1.0f) / (sign + z.z);
    const vf b = z.x * z.y * a;
    f.x = v3_make(fma(sign * z.x * z.x, a, (vf)(1.0f)), sign * b, -sign * z.x);
    f.y = v3_make(b, fma(z.y * z.y, a, sign), -z.y);
    f.z = z;
    return f;
}

// At the angle with this sine and cosine to z, so many turns about it; made unit.
static inline v3 frame_direction(const Frame *f, vf sine, vf cosine, vf turn)
{
    const SineCosine angle = vf_sincos(turn * TWO_PI);
    const v3 flat = v3_fma(f->x, angle.cosine * sine, v3_scale(f->y, angle.sine * sine));
    return v3_normalize(v3_fma(f->z, cosine, flat));
}

// About the unit normal n with density cosine / pi, for u and turn uniform in [0, 1) (Malley's method).
static inline v3 cosine_direction(v3 n, vf u, vf turn)
{
    const Frame f = frame_about(n);
    return frame_direction(&f, sqrt(u), sqrt(1.0f - u), turn);
}

#endif
