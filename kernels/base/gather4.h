// Four consecutive numbers for each lane at once: paths' lanes seldom want the same record, and four loads and a
// transposition cost about what one gather does.
#ifndef CLRT_KERNELS_BASE_GATHER4_H
#define CLRT_KERNELS_BASE_GATHER4_H

#include "base/lanes.h"

typedef struct { vf x, y, z, w; } Gather4;

#if LANES == 8 || LANES == 16
// The numbers of eight lanes, those of lane k at p + index[k].
static inline void gather4_eight(global const f32 *p, const int *index, float8 to[4])
{
    const float8 r04 = (float8)(vload4(0, p + index[0]), vload4(0, p + index[4]));
    const float8 r15 = (float8)(vload4(0, p + index[1]), vload4(0, p + index[5]));
    const float8 r26 = (float8)(vload4(0, p + index[2]), vload4(0, p + index[6]));
    const float8 r37 = (float8)(vload4(0, p + index[3]), vload4(0, p + index[7]));
    const float8 low01 = (float8)(r04.s0, r15.s0, r04.s1, r15.s1, r04.s4, r15.s4, r04.s5, r15.s5);
    const float8 high01 = (float8)(r04.s2, r15.s2, r04.s3, r15.s3, r04.s6, r15.s6, r04.s7, r15.s7);
    const float8 low23 = (float8)(r26.s0, r37.s0, r26.s1, r37.s1, r26.s4, r37.s4, r26.s5, r37.s5);
    const float8 high23 = (float8)(r26.s2, r37.s2, r26.s3, r37.s3, r26.s6, r37.s6, r26.s7, r37.s7);
    to[0] = (float8)(low01.s01, low23.s01, low01.s45, low23.s45);
    to[1] = (float8)(low01.s23, low23.s23, low01.s67, low23.s67);
    to[2] = (float8)(high01.s01, high23.s01, high01.s45, high23.s45);
    to[3] = (float8)(high01.s23, high23.s23, high01.s67, high23.s67);
}
#endif

// p[index] .. p[index + 3] for each lane; all must be there, also those of lanes that do not matter.
OUTLINE Gather4 gather4(global const f32 *p, vi index)
{
    Gather4 r;
    LanesI i;
    i.v = index;
#if LANES == 8
    float8 to[4];
    gather4_eight(p, i.s, to);
    r.x = to[0];
    r.y = to[1];
    r.z = to[2];
    r.w = to[3];
#elif LANES == 16
    float8 low[4], high[4];
    gather4_eight(p, i.s, low);
    gather4_eight(p, i.s + 8, high);
    r.x = (float16)(low[0], high[0]);
    r.y = (float16)(low[1], high[1]);
    r.z = (float16)(low[2], high[2]);
    r.w = (float16)(low[3], high[3]);
#else
    LanesF x, y, z, w;
    for (int k = 0; k < LANES; k++) {
        x.s[k] = p[i.s[k]];
        y.s[k] = p[i.s[k] + 1];
        z.s[k] = p[i.s[k] + 2];
        w.s[k] = p[i.s[k] + 3];
    }
    r.x = x.v;
    r.y = y.v;
    r.z = z.v;
    r.w = w.v;
#endif
    return r;
}

#endif
