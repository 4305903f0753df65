#include "tally.h"

#include <math.h>

static u32 fine_bin(f64 ulps)
{
    const f64 place = (log2(ulps) - TALLY_FIRST) * TALLY_STEPS;
    return !(place > 0) ? 0 : place >= TALLY_BINS - 2 ? TALLY_BINS - 1 : (u32)place + 1;
}

f64 tally_reported_ulps(u32 bin)
{
    return bin == 0 ? 0 : ldexp(0.5, (int)bin - 1);
}

static u32 reported_bin(f64 ulps)
{
    u32 bin = 0;
    while (bin < TALLY_REPORTED - 1 && ulps > tally_reported_ulps(bin))
        bin++;
    return bin;
}

static void spread_add(Spread *spread, f64 ulps)
{
    spread->hits++;
    spread->above_one += ulps > 1;
    spread->above_allowed += ulps > ALLOWED_ULPS;
    spread->max_ulps = fmax(spread->max_ulps, ulps);
    spread->fine[fine_bin(ulps)]++;
}

static void spread_merge(Spread *spread, const Spread *other)
{
    spread->hits += other->hits;
    spread->above_one += other->above_one;
    spread->above_allowed += other->above_allowed;
    spread->max_ulps = fmax(spread->max_ulps, other->max_ulps);
    for (u32 i = 0; i < TALLY_BINS; i++)
        spread->fine[i] += other->fine[i];
}

f64 spread_percentile(const Spread *spread, f64 share)
{
    const f64 wanted = share * (f64)spread->hits;
    u64 so_far = 0;
    for (u32 i = 0; i < TALLY_BINS; i++) {
        so_far += spread->fine[i];
        if (so_far > 0 && (f64)so_far >= wanted)
            return fmin(exp2(TALLY_FIRST + (f64)i / TALLY_STEPS), spread->max_ulps);
    }
    return 0;
}

void tally_add(Tally *tally, const Judgement *judgement)
{
    tally->rays++;
    tally->wrong += judgement->wrong;
    tally->beyond += judgement->over > 1;
    tally->max_over = fmax(tally->max_over, judgement->over);
    if (!judgement->hit)
        return;
    tally->max_relative = fmax(tally->max_relative, judgement->relative);
    tally->reported[reported_bin(judgement->ulps)]++;
    spread_add(&tally->all, judgement->ulps);
    if (judgement->change <= ALLOWED_ULPS && !judgement->edge)
        spread_add(&tally->steady, judgement->ulps);
}

void tally_merge(Tally *tally, const Tally *other)
{
    tally->rays += other->rays;
    tally->wrong += other->wrong;
    tally->beyond += other->beyond;
    tally->max_over = fmax(tally->max_over, other->max_over);
    tally->max_relative = fmax(tally->max_relative, other->max_relative);
    spread_merge(&tally->all, &other->all);
    spread_merge(&tally->steady, &other->steady);
    for (u32 i = 0; i < TALLY_REPORTED; i++)
        tally->reported[i] += other->reported[i];
}
