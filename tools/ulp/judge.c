#include "judge.h"

#include <math.h>

#include "reference/accept.h"
#include "reference/inputs.h"

enum { MOST_TIMES = 1 << 20 }; // how far off is "wrong, no matter how far"

static f64 ulp_near(real x)
{
    const f32 f = (f32)fabsl(x);
    return (f64)nextafterf(f, INFINITY) - (f64)f;
}

// Whether t is right for the surface moved inward or outward by `move`, or by half of that and the ray by the
// other half: at rims and where shapes touch themselves the two are not the same.
static bool explained(const ShapeRay *ray, real t, real move, real slack)
{
    if (reference_accepts(ray, t, move, slack))
        return true;
    for (int k = 0; k < 6; k++) {
        const real by = k % 2 ? move / 2 : -move / 2;
        ShapeRay beside = *ray;
        *(k / 2 == 0 ? &beside.o.x : k / 2 == 1 ? &beside.o.y : &beside.o.z) += by;
        if (reference_accepts(&beside, t, move / 2, slack))
            return true;
    }
    return false;
}

// How many times what one ulp of the inputs does to the surface, seen where the ray is at `near`, explains t.
static f64 times_beyond(const Placed *placed, const ShapeRay *ray, const f32 origin[3],
                        const f32 direction[3], real near, f32 t)
{
    if (ray->shape->kind == SHAPE_PLANE && isfinite(t)) {
        // Along a plane t has no bound: what counts is how far off the plane the point at t is.
        const InputMove there = reference_input_move(placed, origin, direction, t);
        real off, uv[2];
        Real3 normal;
        reference_piece(ray->shape, 0, real3_add(ray->o, real3_scale(ray->d, t)), &off, &normal, uv);
        return (f64)(fabsl(off) / there.along);
    }
    const InputMove move = reference_input_move(placed, origin, direction, near);
    f64 times = 0.25;
    while (times < MOST_TIMES && !explained(ray, t, (real)times * move.across, ulp_near(near)))
        times *= 2;
    return times;
}

Judgement judge_distance(const Placed *placed, const f32 origin[3], const f32 direction[3], f32 t)
{
    const ShapeRay ray = {
        .shape = &placed->shape,
        .o = real_map_point(&placed->inverse, real3(origin[0], origin[1], origin[2])),
        .d = real_map_direction(&placed->inverse, real3(direction[0], direction[1], direction[2])),
    };
    const real exact = reference_hit(ray.shape, ray.o, ray.d, 0, 0, 0);
    const bool hit = !isinf(t), should = !isinf(exact);
    Judgement j = {.hit = hit && should};
    if (!hit && !should)
        return j;
    if (isnan(t))
        return (Judgement){.wrong = true, .over = MOST_TIMES};
    const real near = should ? exact : (real)t;
    const f64 ulp = ulp_near(near);
    if (j.hit) {
        const InputMove move = reference_input_move(placed, origin, direction, exact);
        const real off = fabsl((real)t - exact);
        j.ulps = (f64)off / ulp;
        j.change = (f64)(move.along / move.rate) / ulp;
        j.relative = (f64)(off / exact);
        j.over = j.ulps / fmax(ALLOWED_ULPS, j.change);
        j.edge = j.over > 1;
        if (j.edge)
            j.over = fmin(j.over, times_beyond(placed, &ray, origin, direction, exact, t));
        return j;
    }
    j.over = times_beyond(placed, &ray, origin, direction, near, t);
    j.wrong = j.over > 1;
    return j;
}
