// Judging noisy numbers: each value within what chance allows, where the chance that any of all values of a
// test is beyond it is one in a hundred (Sidak, "Rectangular Confidence Regions for the Means of Multivariate
// Normal Distributions", J. Am. Stat. Assoc. 62, 1967), and within a bound that no variance, right or wrong,
// widens.
#ifndef CLRT_TESTS_RENDER_STATISTICS_H
#define CLRT_TESTS_RENDER_STATISTICS_H

#include "estimate.h"

// The p-value below which one of n values is beyond chance.
f64 sidak_threshold(f64 n);
// Two-sided: the chance of a number as far from 0, or farther. dof: degrees of freedom, 1 or more.
f64 normal_p(f64 z);
f64 student_p(f64 t, u32 dof);

// ---- estimates of known numbers ---------------------------------------------------------------------------

typedef struct Verdicts {
    u32 count;
    f64 smallest_p, z; // of the worst one
    char worst[96];    // what it is
} Verdicts;

// Compares an estimate with the expected value and prints both. `most`: how far they may be apart whatever
// the variance, absolutely.
void verdict_add(Verdicts *verdicts, const char *what, Estimate found, f64 expected, f64 most);
// Fails the running test unless all estimates are within what chance allows.
void verdicts_end(const Verdicts *verdicts);

// ---- pictures of one scene by two ways --------------------------------------------------------------------

// Pictures that differ in the seed alone, one behind the other.
typedef struct Seeds {
    u32 width, height, count;
    f32 *rgb;
} Seeds;

// The seeds are first, first + 1, ...
Seeds seeds_render(Device *device, const Layout *layout, u32 first, u32 count);
void seeds_destroy(Seeds *seeds);

// Fails the running test unless a and b, as many pictures of the same size, have the same expected values:
// each pixel by Student's t of the differences of pictures, where 99.75 % must pass (the rule of Mitsuba's
// tests of renders), since what is rare is not normal; the means of blocks of pixels; and that of all pixels
// within four standard errors, and relative to itself within `most`.
void expect_same_mean(const Seeds *a, const Seeds *b, f64 most, const char *what);

#endif
