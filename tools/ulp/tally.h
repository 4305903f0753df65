// Tally: what judgements of many rays add up to. Sums do not depend on the order.
#ifndef CLRT_ULP_TALLY_H
#define CLRT_ULP_TALLY_H

#include "judge.h"

// Fine bins for percentiles: TALLY_STEPS to a factor of two, from 2^TALLY_FIRST ulp.
#define TALLY_STEPS 16
#define TALLY_FIRST (-8)
#define TALLY_OCTAVES 40
#define TALLY_BINS (TALLY_STEPS * TALLY_OCTAVES + 2) // one for what is below, one for what is above

// Bins of the report: exact, up to 1/2, 1, 2, 4, ... ulp; the last one takes the rest.
#define TALLY_REPORTED 24

// How far hits are off.
typedef struct Spread {
    u64 hits, above_one, above_allowed; // by more than one ulp, by more than ALLOWED_ULPS
    f64 max_ulps;
    u64 fine[TALLY_BINS];
} Spread;

typedef struct Tally {
    u64 rays, wrong;
    u64 beyond;    // judgements with over > 1
    f64 max_over, max_relative;
    Spread all;    // hits
    Spread steady; // hits, none at an edge, that one ulp of the inputs moves by ALLOWED_ULPS at most
    u64 reported[TALLY_REPORTED]; // of all
} Tally;

void tally_add(Tally *tally, const Judgement *judgement);
void tally_merge(Tally *tally, const Tally *other);

// The ulps that the share (0 to 1) of the hits stays within, to 5 percent of itself, at most max_ulps; 0
// without hits.
f64 spread_percentile(const Spread *spread, f64 share);

// The upper end of a bin of the report.
f64 tally_reported_ulps(u32 bin);

#endif
