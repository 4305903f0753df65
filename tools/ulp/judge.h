// Judge: one distance against the reference. Knows nothing of devices.
#ifndef CLRT_ULP_JUDGE_H
#define CLRT_ULP_JUDGE_H

#include "base/types.h"
#include "reference/placed.h"

// Up to here an error needs no excuse.
#define ALLOWED_ULPS 8.0

typedef struct Judgement {
    bool hit;     // both say so
    bool wrong;   // one says hit and one miss, and one ulp of the inputs does not make the difference
    bool edge;    // of a hit: only another shape or another ray, an ulp of the inputs away, explains it
    f64 ulps;     // of a hit: |t - exact| in units in the last place of a float near exact
    f64 change;   // of a hit: of t by one ulp of the inputs, in ulp, to first order
    f64 relative; // of a hit: |t - exact| / exact
    // The error over the larger of ALLOWED_ULPS and what one ulp of the inputs changes; of verdicts and of hits at
    // silhouettes the first power of two, from a quarter, that is enough.
    f64 over;
} Judgement;

// t of the device for the ray (origin, direction) at the shape; INFINITY: no hit.
Judgement judge_distance(const Placed *placed, const f32 origin[3], const f32 direction[3], f32 t);

#endif
