// Box tests: the rays of a batch against the eight boxes of a node, one ray at a time or as a packet. Both
// ways are the same arithmetic, so that it is only a matter of speed which one runs.
//
// A plane is met at fma(plane, 1 / dir, addend) with addend = -org / dir, moved apart for near and far planes
// by what else may be wrong: the test of a triangle is off sideways by at most 5 units 2^-24 of
// |vertex| + |origin| (largest coordinates); reciprocal, product and sum add 3 units of |plane| and |origin|.
// The |plane| parts are padding of the boxes (host/layout), the |origin| parts are SHIFT here, and the last
// rounding is BOX_SLACK. So no box hides a hit, whichever boxes stand above it (after Woop, Benthin, Wald,
// "Watertight ray/triangle intersection", 2013, appendix, whose shift depends on the size of the scene; and
// Ize, "Robust BVH ray traversal", 2013). NaN, where numbers leave float's range, leaves a slab open.
#ifndef CLRT_KERNELS_ACCEL_SLABS_H
#define CLRT_KERNELS_ACCEL_SLABS_H

#include "base/ray.h"
#include "shared/bvh.h"

// Relative slack of a box's far side: 64 rounding units, several times the error bound of any t.
#define BOX_SLACK 1.000004f
// 12 rounding units.
#define SHIFT 7.2e-7f
// Components of a direction below this share of the largest are taken for it: moves no point of a ray by a
// rounding unit of the way, and keeps 1 / dir finite.
#define SMALLEST_SLOPE 0x1p-60f

typedef union { int8 v; int s[8]; } Int8;
typedef union { float8 v; float s[8]; } Float8;

// Eight reals. Where a box is entered is kept as a float: it only tells which comes first, and BOX_SLACK has
// room for its rounding.
#if MATH_DOUBLE
typedef double8 real8;
#define REAL8_FROM_FLOAT8(v) convert_double8(v)
#define FLOAT8_FROM_REAL8(v) convert_float8(v)
#define INT8_FROM_MASK(m) convert_int8(m)
#else
typedef float8 real8;
#define REAL8_FROM_FLOAT8(v) (v)
#define FLOAT8_FROM_REAL8(v) (v)
#define INT8_FROM_MASK(m) (m)
#endif

// The rays of a batch in one space.
typedef struct {
    real org_x[BATCH], org_y[BATCH], org_z[BATCH];
    real dir_x[BATCH], dir_y[BATCH], dir_z[BATCH];
} BatchRays;

// What box tests need of the rays. first_x: offset in bytes into a node of the planes that the ray meets
// first.
typedef struct {
    real inv_x[BATCH], inv_y[BATCH], inv_z[BATCH];
    real near_x[BATCH], near_y[BATCH], near_z[BATCH]; // addends
    real far_x[BATCH], far_y[BATCH], far_z[BATCH];
    uint first_x[BATCH], first_y[BATCH], first_z[BATCH];
} BatchSlabs;

static inline uint sign_bits8(int8 m)
{
#if defined(__AVX__) && defined(__has_builtin)
    return (uint)__builtin_ia32_movmskps256(as_float8(m));
#else
    // Bytes 0 or 255, gathered by a multiplication that moves bit 7k to bit 56 + k.
    const ulong bytes = as_ulong(convert_char8(m)) & 0x0101010101010101UL;
    return (uint)(bytes * 0x0102040810204080UL >> 56);
#endif
}

static inline void prepare_axis(const real *org, vf shift, vf dir, vf smallest, real *inv, real *near,
                                real *far, uint *first, uint lower)
{
    const vf inverse = (vf)(1.0f) / (fabs(dir) < smallest ? copysign(smallest, dir) : dir);
    const vf middle = -VF_LOAD(org) * inverse, apart = shift * fabs(inverse);
    VF_STORE(inverse, inv);
    VF_STORE(middle - apart, near);
    VF_STORE(middle + apart, far);
    VU_STORE(inverse < (vf)(0.0f) ? (vu)(lower + 96u) : (vu)(lower), first);
}

// For the rays k .. k + LANES - 1.
static inline void prepare_slabs(const BatchRays *rays, int k, BatchSlabs *s)
{
    const v3 org = v3_make(VF_LOAD(&rays->org_x[k]), VF_LOAD(&rays->org_y[k]), VF_LOAD(&rays->org_z[k]));
    const v3 dir = v3_make(VF_LOAD(&rays->dir_x[k]), VF_LOAD(&rays->dir_y[k]), VF_LOAD(&rays->dir_z[k]));
    const v3 o = v3_abs(org), d = v3_abs(dir);
    const vf shift = vf_max(o.x, vf_max(o.y, o.z)) * SHIFT;
    const vf smallest = vf_max(d.x, vf_max(d.y, d.z)) * SMALLEST_SLOPE;
    prepare_axis(&rays->org_x[k], shift, dir.x, smallest, &s->inv_x[k], &s->near_x[k], &s->far_x[k],
                 &s->first_x[k], 0);
    prepare_axis(&rays->org_y[k], shift, dir.y, smallest, &s->inv_y[k], &s->near_y[k], &s->far_y[k],
                 &s->first_y[k], 32);
    prepare_axis(&rays->org_z[k], shift, dir.z, smallest, &s->inv_z[k], &s->near_z[k], &s->far_z[k],
                 &s->first_z[k], 64);
}

// Eight planes of a node, those that start `offset` bytes into it.
static inline real8 planes_at(global const BvhNode *node, uint offset)
{
    return REAL8_FROM_FLOAT8(vload8(0, (global const f32 *)((global const char *)node + offset)));
}

// Which boxes ray k reaches before tfar, and where it enters them.
static inline int8 test_boxes(global const BvhNode *node, const BatchSlabs *s, int k, real tfar, float8 *enters)
{
    const uint x = s->first_x[k], y = s->first_y[k], z = s->first_z[k];
    const real8 inv_x = (real8)(s->inv_x[k]), inv_y = (real8)(s->inv_y[k]), inv_z = (real8)(s->inv_z[k]);
    const real8 near_x = fma(planes_at(node, x), inv_x, (real8)(s->near_x[k]));
    const real8 near_y = fma(planes_at(node, y), inv_y, (real8)(s->near_y[k]));
    const real8 near_z = fma(planes_at(node, z), inv_z, (real8)(s->near_z[k]));
    const real8 far_x = fma(planes_at(node, 96 - x), inv_x, (real8)(s->far_x[k]));
    const real8 far_y = fma(planes_at(node, 160 - y), inv_y, (real8)(s->far_y[k]));
    const real8 far_z = fma(planes_at(node, 224 - z), inv_z, (real8)(s->far_z[k]));
    real8 tnear = (real8)(0.0f), tend = (real8)(tfar * BOX_SLACK);
    tnear = near_x > tnear ? near_x : tnear;
    tnear = near_y > tnear ? near_y : tnear;
    tnear = near_z > tnear ? near_z : tnear;
    tend = far_x < tend ? far_x : tend;
    tend = far_y < tend ? far_y : tend;
    tend = far_z < tend ? far_z : tend;
    *enters = FLOAT8_FROM_REAL8(tnear);
    return INT8_FROM_MASK(tnear <= tend);
}

#if LANES > 1
// Bounds of the numbers of the rays of a packet that run into the same octant.
typedef struct {
    real inv_least[3], inv_most[3];
    real near_least[3], far_most[3];
    uint first[3];
    bool usable;
} PacketBounds;

static inline real vf_least(vf x)
{
    LanesF lanes;
    lanes.v = x;
    real least = lanes.s[0];
    for (int k = 1; k < LANES; k++)
        least = lanes.s[k] < least ? lanes.s[k] : least;
    return least;
}

static inline void bound_axis(const real *inv, const real *near, const real *far, uint lower, uint mask,
                              int axis, PacketBounds *b)
{
    vf inv_least = (vf)(INFINITY), inv_most = (vf)(-INFINITY);
    vf near_least = (vf)(INFINITY), far_most = (vf)(-INFINITY);
    for (int k = 0; k < BATCH; k += LANES) {
        const vm mine = vm_from_bits(mask >> k);
        const vf i = VF_LOAD(&inv[k]), n = VF_LOAD(&near[k]), f = VF_LOAD(&far[k]);
        const vm finite = (fabs(n) < (vf)(1e30f)) & (fabs(f) < (vf)(1e30f));
        b->usable = b->usable && !vm_any(mine & !finite);
        inv_least = (mine & (i < inv_least)) ? i : inv_least;
        inv_most = (mine & (i > inv_most)) ? i : inv_most;
        near_least = (mine & (n < near_least)) ? n : near_least;
        far_most = (mine & (f > far_most)) ? f : far_most;
    }
    b->inv_least[axis] = vf_least(inv_least);
    b->inv_most[axis] = -vf_least(-inv_most);
    b->near_least[axis] = vf_least(near_least);
    b->far_most[axis] = -vf_least(-far_most);
    b->first[axis] = b->inv_least[axis] < 0.0f ? lower + 96u : lower;
    b->usable = b->usable && (b->inv_least[axis] < 0.0f) == (b->inv_most[axis] < 0.0f);
}

// Of the rays of mask; not usable where they run into several octants.
static inline void bound_packet(const BatchSlabs *s, uint mask, PacketBounds *b)
{
    b->usable = true;
    bound_axis(s->inv_x, s->near_x, s->far_x, 0, mask, 0, b);
    bound_axis(s->inv_y, s->near_y, s->far_y, 32, mask, 1, b);
    bound_axis(s->inv_z, s->near_z, s->far_z, 64, mask, 2, b);
}

static inline void bound_planes(global const BvhNode *node, const PacketBounds *b, int axis, float8 *tnear,
                                float8 *tend)
{
    const uint first = b->first[axis], last = (uint)(96 + 64 * axis) - first;
    const float8 near = planes_at(node, first), far = planes_at(node, last);
    const float8 least = (float8)(b->inv_least[axis]), most = (float8)(b->inv_most[axis]);
    const float8 n = (float8)(b->near_least[axis]), f = (float8)(b->far_most[axis]);
    const float8 n0 = fma(near, least, n), n1 = fma(near, most, n);
    const float8 f0 = fma(far, least, f), f1 = fma(far, most, f);
    const float8 enter = n0 < n1 ? n0 : n1, leave = f0 > f1 ? f0 : f1;
    *tnear = enter > *tnear ? enter : *tnear;
    *tend = leave < *tend ? leave : *tend;
}

// Boxes that some ray of the packet may reach: rounding is monotone, so the bounds are rigorous.
static inline uint test_boxes_bounds(global const BvhNode *node, const PacketBounds *b, float8 *enters)
{
    float8 tnear = (float8)(0.0f), tend = (float8)(INFINITY);
    bound_planes(node, b, 0, &tnear, &tend);
    bound_planes(node, b, 1, &tnear, &tend);
    bound_planes(node, b, 2, &tnear, &tend);
    *enters = tnear;
    return sign_bits8(tnear <= tend);
}

static inline real plane_at(global const BvhNode *node, uint offset, int slot)
{
    return *((global const f32 *)((global const char *)node + offset) + slot);
}

// The rays of mask, all of one octant, that reach one box.
static inline uint test_box_packet(global const BvhNode *node, int slot, const BatchSlabs *s,
                                   const PacketBounds *b, const real *tfar, uint mask)
{
    const vf near_x = (vf)(plane_at(node, b->first[0], slot));
    const vf near_y = (vf)(plane_at(node, b->first[1], slot));
    const vf near_z = (vf)(plane_at(node, b->first[2], slot));
    const vf far_x = (vf)(plane_at(node, 96 - b->first[0], slot));
    const vf far_y = (vf)(plane_at(node, 160 - b->first[1], slot));
    const vf far_z = (vf)(plane_at(node, 224 - b->first[2], slot));
    uint reached = 0;
    for (int k = 0; k < BATCH; k += LANES) {
        if (!(mask >> k & ((1u << LANES) - 1u)))
            continue;
        const vf inv_x = VF_LOAD(&s->inv_x[k]), inv_y = VF_LOAD(&s->inv_y[k]), inv_z = VF_LOAD(&s->inv_z[k]);
        vf tnear = vf_max(fma(near_x, inv_x, VF_LOAD(&s->near_x[k])), (vf)(0.0f));
        vf tend = vf_min(fma(far_x, inv_x, VF_LOAD(&s->far_x[k])), VF_LOAD(&tfar[k]) * BOX_SLACK);
        tnear = vf_max(fma(near_y, inv_y, VF_LOAD(&s->near_y[k])), tnear);
        tend = vf_min(fma(far_y, inv_y, VF_LOAD(&s->far_y[k])), tend);
        tnear = vf_max(fma(near_z, inv_z, VF_LOAD(&s->near_z[k])), tnear);
        tend = vf_min(fma(far_z, inv_z, VF_LOAD(&s->far_z[k])), tend);
        reached |= vm_bits(tnear <= tend) << k;
    }
    return reached & mask;
}
#endif

#endif
