// Judge: measured numbers against right ones. Knows nothing of devices or of what was measured.
#ifndef CLRT_SELFTEST_JUDGE_H
#define CLRT_SELFTEST_JUDGE_H

#include "base/types.h"

// What the worst of a case counts in.
typedef enum Unit {
    UNIT_ULP,      // units in the last place of a float near the right number
    UNIT_RELATIVE, // share of the right number
    UNIT_ABSOLUTE, // difference
    UNIT_LEAKS,    // rays that slip through a closed surface, or count it twice
    UNIT_WRONG,    // answers that are not what they must be
    UNIT_COUNT
} Unit;

// The answers of a case so far; all zeros at first.
typedef struct Score {
    u32 answers, nans;
    f64 worst;
} Score;

// One line of the table. Its texts are constants.
typedef struct SelfTestCase {
    const char *id;      // "C14"
    const char *what;    // the construction
    const char *against; // where the right answer comes from
    Unit unit;
    f64 worst, bar;
    u32 answers, nans;
    bool passed;
} SelfTestCase;

// "ulp", "leaks", ...
const char *unit_name(Unit unit);

// The distance from |x| to the next larger float.
f64 ulp_of(f64 x);

// Take an answer into the score. exact INFINITY: the right answer is "no hit", and nothing else will do. An
// answer that is NaN counts as one, whatever the right one is.
void score_ulps(Score *score, f64 exact, f64 measured);
void score_relative(Score *score, f64 exact, f64 measured);
void score_absolute(Score *score, f64 exact, f64 measured);
// worst is the largest value.
void score_value(Score *score, f64 value);
// worst is the number of wrong answers.
void score_wrong(Score *score, bool wrong);

// Passed: there are answers, none of them NaN, and the worst is at most bar.
SelfTestCase case_judge(const char *id, const char *what, const char *against, Unit unit, f64 bar,
                        const Score *score);

#endif
