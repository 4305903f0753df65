// TORUS. The ray is moved to the point closest to the centre, where all numbers are of the size of 1; there
// the quartic's derivative, a depressed cubic, gives places between which there is at most one root. They
// need not be exact: the roots are bracketed and refined on the distance to the ring itself, so that no
// coefficient of a quartic ever decides.
#ifndef CLRT_KERNELS_SHAPES_TORUS_H
#define CLRT_KERNELS_SHAPES_TORUS_H

#include "shapes/roots.h"
#include "shapes/surface.h"

#define TORUS_INTERVALS 4
#define TORUS_MAX_STEPS REAL(28, 58)

// A ray in units of length along it: the point at s is o + s d, t = shift + s * t_per_s.
typedef struct {
    v3 o, d;
    vf shift, t_per_s;
    vf tube;
    vf place[TORUS_INTERVALS + 1]; // ascending; the first and the last lie outside
    vm below[TORUS_INTERVALS + 1]; // within the tube there
} TorusRay;

// (rho - 1)^2 + z^2 - tube^2 at s.
static inline vf torus_value(const TorusRay *r, vf s)
{
    const v3 q = v3_fma(r->d, s, r->o);
    const vf w = sqrt(fma(q.x, q.x, q.y * q.y)) - 1.0f;
    return fma(w, w, difference_of_products(q.z, q.z, r->tube, r->tube));
}

// The value over its rate: a step of Newton's method.
static inline vf torus_step(const TorusRay *r, vf s, vf *value)
{
    const v3 q = v3_fma(r->d, s, r->o);
    const vf rho = sqrt(fma(q.x, q.x, q.y * q.y));
    const vf w = rho - 1.0f;
    *value = fma(w, w, difference_of_products(q.z, q.z, r->tube, r->tube));
    const vf rho_rate = fma(q.x, r->d.x, q.y * r->d.y) / rho;
    return *value / (2.0f * fma(w, rho_rate, q.z * r->d.z));
}

// A number between x^(1/3) and 1.2 times that, for x >= 0.
static inline vf above_cube_root(vf x)
{
#if MATH_DOUBLE
    return 1.1f * cbrt(x);
#else
    return 1.1f * VI_AS_VF(VF_AS_VI(x) / 3 + (vi)(709921077));
#endif
}

// The real roots of s^3 + p s - q, q >= 0, in order; where there is one, three times that.
static inline v3 cubic_roots(vf p, vf q)
{
    // The largest root, from above: there the cubic is convex, so that Newton's method cannot pass it.
    const vf by_cube = above_cube_root(p < (vf)(0.0f) ? 2.0f * q : q);
    const vf start_bent = vf_max(by_cube, sqrt(-2.0f * p));
    const vf start_straight = vf_min(q / p, by_cube);
    vf x = p < (vf)(0.0f) ? start_bent : start_straight;
    for (int i = 0; i < 7; i++) {
        const vf rate = fma(3.0f * x, x, p);
        const vf next = x - fma(fma(x, x, p), x, -q) / rate;
        x = rate > (vf)(0.0f) ? vf_max(next, (vf)(0.0f)) : x;
    }
    // The others: s^2 + x s + q / x.
    const vf discriminant = fma(-3.0f * x, x, -4.0f * p);
    const vm three = (discriminant >= (vf)(0.0f)) & (x > (vf)(0.0f));
    const vf low = -0.5f * (x + sqrt(discriminant));
    const vf middle = q / (x * low);
    return v3_make(three ? low : x, three ? middle : x, x);
}

static inline void torus_place(TorusRay *r, int k, vf s, vf end)
{
    r->place[k] = vf_min(vf_max(s, -end), end);
    r->below[k] = torus_value(r, r->place[k]) < (vf)(0.0f);
}

// *valid: the ray comes near the torus.
static inline TorusRay torus_ray(const PrimitiveLanes *p, const RayLanes *ray, vm *valid)
{
    TorusRay r;
    const CanonicalRay q = canonical_ray(p, ray);
    const v3 d = q.d;
    const vf dd = v3_dot(d, d);
    r.o = q.o;
    r.shift = q.shift + closest_shift(&r.o, d, dd, (vf)(0.0f));
    r.t_per_s = (vf)(1.0f) / sqrt(dd);
    r.d = v3_scale(d, r.t_per_s);
    r.tube = p->p0;
    // Half the chord of a ball a little larger than the torus.
    const vf oo = v3_dot(r.o, r.o), reach = 1.00001f * (1.0f + r.tube);
    const vf chord = fma(reach, reach, -oo);
    *valid = (chord > (vf)(0.0f)) & (r.t_per_s < (vf)(INFINITY));
    const vf end = sqrt(chord);
    // A quarter of the derivative of (s^2 + k)^2 - 4 rho^2, where k = |o|^2 + 1 - tube^2.
    const vf k = oo + (1.0f - r.tube) * (1.0f + r.tube);
    const vf aa = fma(r.d.x, r.d.x, r.d.y * r.d.y), ab = fma(r.o.x, r.d.x, r.o.y * r.d.y);
    const v3 s = cubic_roots(fma(aa, (vf)(-2.0f), k), fabs(2.0f * ab));
    const vm turned = ab < (vf)(0.0f);
    r.place[0] = -end;
    r.place[4] = end;
    r.below[0] = r.below[4] = (vm)(0);
    torus_place(&r, 1, turned ? -s.z : s.x, end);
    torus_place(&r, 2, turned ? -s.y : s.y, end);
    torus_place(&r, 3, turned ? -s.x : s.z, end);
    return r;
}

// The root between places k and k + 1 in the lanes of `wanted`: Newton's method, kept within the bracket by
// bisection. Each lane stops by itself, so that its root does not depend on the others.
static inline vf torus_root(const TorusRay *r, int k, vm wanted)
{
    vf low = r->place[k], high = r->place[k + 1];
    const vm falling = r->below[k + 1];
    vf s = 0.5f * (low + high);
    vm busy = wanted;
    for (int i = 0; i < TORUS_MAX_STEPS && vm_any(busy); i++) {
        vf value;
        const vf step = torus_step(r, s, &value);
        const vm before = falling ? value > (vf)(0.0f) : value < (vf)(0.0f);
        low = (busy & before) ? s : low;
        high = (busy & !before) ? s : high;
        const vf newton = s - step;
        const vm inside = (newton >= low) & (newton <= high);
        const vf next = inside ? newton : 0.5f * (low + high);
        const vf moved = fabs(next - s);
        s = busy ? next : s;
        busy = busy & (moved > (vf)(2.0f * ROUNDING));
    }
    return s;
}

// The torus is not convex: a ray that starts on it may meet it again either way. Outward it next enters,
// inward it next leaves, so that its own root, which is of the other kind, cannot be taken for the next; an
// interval that ends where the ray starts belongs to the past.
static inline vf intersect_torus(const PrimitiveLanes *p, const RayLanes *ray)
{
    vm open;
    const TorusRay r = torus_ray(p, ray, &open);
    const vf limit = ray_limit(ray);
    const vf start = -r.shift / r.t_per_s + fma(r.tube, (vf)(1e-5f), (vf)(8.0f * ROUNDING));
    vf hit = (vf)(INFINITY);
    for (int k = 0; k < TORUS_INTERVALS; k++) {
        const vm enters = (!r.below[k]) & r.below[k + 1], leaves = r.below[k] & (!r.below[k + 1]);
        const vm ahead = r.place[k + 1] > start;
        const vm other = ahead & ((ray->inward & leaves) | ((!ray->inward) & enters));
        const vm kind = (ray->self & other) | ((!ray->self) & (enters | leaves));
        const vm wanted = open & kind & (fma(r.place[k + 1], r.t_per_s, r.shift) > limit);
        if (!vm_any(wanted))
            continue;
        const vf t = fma(torus_root(&r, k, wanted), r.t_per_s, r.shift);
        const vm found = wanted & (t > limit);
        hit = found ? t : hit;
        open = open & !found;
    }
    return hit;
}

static inline void surface_torus(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    s->p = v3_fma(ray->dir, t, ray->org);
    const v3 q = canonical_point(p, s->p);
    const vf rho = sqrt(fma(q.x, q.x, q.y * q.y));
    const vf w = rho - 1.0f;
    const vf distance = sqrt(fma(w, w, q.z * q.z));
    // On the axis, which only a torus without a hole reaches, any direction from the ring will do.
    const vm round = rho > (vf)(0.0f);
    const vf x = round ? q.x / rho : (vf)(1.0f), y = round ? q.y / rho : (vf)(0.0f);
    const vf inverse = (vf)(1.0f) / distance;
    surface_curved(p, v3_make(w * x * inverse, w * y * inverse, q.z * inverse), distance - p->p0, 4.0f, s);
#if HAS_UV
    surface_uv(s, uv_turn(q.y, q.x), uv_turn(q.z, w));
#endif
#if HAS_NORMAL_MAP
    surface_tangents(p, v3_make(-y, x, (vf)(0.0f)), v3_make(-q.z * x, -q.z * y, w), s);
#endif
}

#endif
