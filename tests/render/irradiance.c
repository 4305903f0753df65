#include "irradiance.h"

#include <math.h>

static const f64 PI = 3.14159265358979323846;

Polygon polygon_clipped(const Polygon *in, Vec3 normal, f64 limit)
{
    Polygon out = {.count = 0};
    for (int i = 0; i < in->count; i++) {
        const Vec3 a = in->corner[i], b = in->corner[(i + 1) % in->count];
        const f64 da = vec_dot(a, normal) - limit, db = vec_dot(b, normal) - limit;
        if (da >= 0)
            out.corner[out.count++] = a;
        if ((da >= 0) != (db >= 0))
            out.corner[out.count++] = vec_add(a, vec_scale(vec_sub(b, a), da / (da - db)));
    }
    return out;
}

f64 polygon_irradiance(Polygon polygon, Vec3 p)
{
    const Polygon above = polygon_clipped(&polygon, (Vec3){0, 0, 1}, p.z);
    f64 sum = 0;
    for (int i = 0; i < above.count; i++) {
        const Vec3 a = vec_normalize(vec_sub(above.corner[i], p));
        const Vec3 b = vec_normalize(vec_sub(above.corner[(i + 1) % above.count], p));
        const Vec3 across = vec_cross(a, b);
        const f64 sine = vec_length(across);
        if (sine > 0)
            sum += atan2(sine, vec_dot(a, b)) * across.z / sine;
    }
    return fabs(sum) / 2;
}

// Ring after ring of directions, each cut off at the horizon.
f64 sphere_irradiance(f64 half, f64 tilt)
{
    enum { RINGS = 20000 };
    f64 sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const f64 angle = (i + 0.5) / RINGS * half;
        const f64 a = cos(tilt) * cos(angle), b = sin(tilt) * sin(angle);
        const f64 end = a >= b ? PI : a <= -b ? 0 : acos(-a / b);
        sum += 2 * (a * end + b * sin(end)) * sin(angle);
    }
    return sum * half / RINGS;
}
