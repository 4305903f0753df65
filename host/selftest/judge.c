#include "selftest/judge.h"

#include <math.h>

const char *unit_name(Unit unit)
{
    static const char *const NAMES[UNIT_COUNT] = {
        [UNIT_ULP] = "ulp",     [UNIT_RELATIVE] = "relative", [UNIT_ABSOLUTE] = "off",
        [UNIT_LEAKS] = "leaks", [UNIT_WRONG] = "wrong",
    };
    return NAMES[unit];
}

f64 ulp_of(f64 x)
{
    const f32 magnitude = (f32)fabs(x);
    return (f64)nextafterf(magnitude, INFINITY) - (f64)magnitude;
}

void score_value(Score *score, f64 value)
{
    score->answers++;
    if (isnan(value))
        score->nans++;
    else
        score->worst = fmax(score->worst, value);
}

// The difference in units of `unit`.
static void score_difference(Score *score, f64 exact, f64 measured, f64 unit)
{
    if (isnan(measured))
        score_value(score, NAN);
    else if (isinf(exact) || isinf(measured))
        score_value(score, exact == measured ? 0 : INFINITY);
    else
        score_value(score, fabs(measured - exact) / unit);
}

void score_ulps(Score *score, f64 exact, f64 measured)
{
    score_difference(score, exact, measured, isinf(exact) ? 1 : ulp_of(exact));
}

void score_relative(Score *score, f64 exact, f64 measured)
{
    score_difference(score, exact, measured, fabs(exact));
}

void score_absolute(Score *score, f64 exact, f64 measured)
{
    score_difference(score, exact, measured, 1);
}

void score_wrong(Score *score, bool wrong)
{
    score->answers++;
    score->worst += wrong ? 1 : 0;
}

SelfTestCase case_judge(const char *id, const char *what, const char *against, Unit unit, f64 bar,
                        const Score *score)
{
    return (SelfTestCase){
        .id = id,
        .what = what,
        .against = against,
        .unit = unit,
        .worst = score->worst,
        .bar = bar,
        .answers = score->answers,
        .nans = score->nans,
        .passed = score->answers > 0 && score->nans == 0 && score->worst <= bar,
    };
}
