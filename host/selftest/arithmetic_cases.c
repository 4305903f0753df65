// The arithmetic that everything else rests on: contraction, differences of products, division and square
// root, lengths, sums of samples, random numbers.
#include <math.h>
#include <string.h>

#include "selftest/random.h"
#include "selftest/run.h"

// Of either sign, 2^low to 2^high.
static f32 random_float(u64 *random, f64 low, f64 high)
{
    const f64 magnitude = exp2(random_in(random, low, high));
    return (f32)(random_unit(random) < 0.5 ? -magnitude : magnitude);
}

// a b - a b is 0 unless the compiler joins a product and the difference to one rounding.
static bool contraction(Run *run)
{
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    u64 random = 47;
    for (u32 i = 0; i < run->inputs; i++) {
        const f32 a = random_float(&random, -30, 30), b = random_float(&random, -30, 30);
        const f32 factors[4] = {a, b, a, b};
        for (u32 k = 0; k < 4; k++)
            number_set(table, i, k, factors[k]);
    }
    if (!probe_numbers(run->probe, FUNCTION_EXPRESSION, table, run->error))
        return false;
    Score score = {0};
    for (u32 i = 0; i < run->inputs; i++)
        score_wrong(&score, table->out[i] != 0);
    run_add(run, "C47", "a b - a b, compiled as kernels are", "0", UNIT_WRONG, 0, &score);
    return true;
}

// Products of floats are exact in long double, and so is the difference of two that are nearly equal.
static bool differences_of_products(Run *run)
{
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    u64 random = 6;
    for (u32 i = 0; i < run->inputs; i++) {
        const f32 a = random_float(&random, -6, 6), b = random_float(&random, -6, 6);
        const f32 c = nextafterf(a, i % 3 ? INFINITY : -INFINITY);
        const f32 factors[4] = {a, b, c, (f32)((f64)a * b / c)};
        for (u32 k = 0; k < 4; k++)
            number_set(table, i, k, factors[k]);
    }
    const f64 kahan[4] = {10001, 10001, 10000.5, 10001.5};
    for (u32 k = 0; k < 4; k++)
        number_set(table, 0, k, kahan[k]);
    if (!probe_numbers(run->probe, FUNCTION_PRODUCTS, table, run->error))
        return false;
    Score known = {0}, near = {0};
    score_ulps(&known, 0.25, table->out[0]);
    for (u32 i = 1; i < run->inputs; i++) {
        f32 f[4];
        for (u32 k = 0; k < 4; k++)
            f[k] = table->in[k * table->stride + i];
        const long double exact = (long double)f[0] * f[1] - (long double)f[2] * f[3];
        score_ulps(&near, (f64)exact, table->out[i]);
    }
    run_add(run, "C6", "10001^2 - 10000.5 x 10001.5", "1/4", UNIT_ULP, 0, &known);
    run_add(run, "C6", "a b - c d of nearly equal products", "long double", UNIT_ULP, 1.5, &near);
    return true;
}

// Double has more than twice the digits of float, so that rounding its result again is correct rounding.
static bool quotients_and_roots(Run *run)
{
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    u64 random = 48;
    for (u32 i = 0; i < run->inputs; i++) {
        number_set(table, i, 0, random_float(&random, -60, 60));
        number_set(table, i, 1, random_float(&random, -60, 60));
    }
    Score quotients = {0}, roots = {0};
    if (!probe_numbers(run->probe, FUNCTION_DIVIDE, table, run->error))
        return false;
    const f32 *a = table->in, *b = table->in + table->stride;
    for (u32 i = 0; i < run->inputs; i++)
        score_wrong(&quotients, table->out[i] != (f32)((f64)a[i] / (f64)b[i]));
    for (u32 i = 0; i < run->inputs; i++)
        number_set(table, i, 0, fabsf(a[i]));
    if (!probe_numbers(run->probe, FUNCTION_SQRT, table, run->error))
        return false;
    for (u32 i = 0; i < run->inputs; i++)
        score_wrong(&roots, table->out[i] != (f32)sqrt((f64)a[i]));
    run_add(run, "C48", "division: correctly rounded", "double", UNIT_WRONG, 0, &quotients);
    run_add(run, "C48", "square root: correctly rounded", "double", UNIT_WRONG, 0, &roots);
    return true;
}

static bool unit_vectors(Run *run)
{
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    u64 random = 44;
    for (u32 i = 0; i < run->inputs; i++) {
        const Vec3 v = vec_scale(random_direction(&random), random_scale(&random, -6, 6));
        number_set(table, i, 0, v.x);
        number_set(table, i, 1, v.y);
        number_set(table, i, 2, v.z);
    }
    if (!probe_numbers(run->probe, FUNCTION_NORMALIZE, table, run->error))
        return false;
    Score score = {0};
    for (u32 i = 0; i < run->inputs; i++) {
        f64 length = 0, parts[3];
        for (u32 k = 0; k < 3; k++) {
            parts[k] = table->in[k * table->stride + i];
            length += parts[k] * parts[k];
        }
        for (u32 k = 0; k < 3; k++)
            score_ulps(&score, parts[k] / sqrt(length), table->out[k * table->stride + i]);
    }
    run_add(run, "C48", "normalize: each coordinate", "double", UNIT_ULP, 3, &score);
    return true;
}

// A cosine of at most 1 to any power is at most 1, so that no highlight is brighter than its light.
static bool powers_of_cosines(Run *run)
{
    static const f64 EXPONENTS[] = {1e-3, 1, 50, 1e3, 1e6};
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    f32 cosine = 1;
    for (u32 i = 0; i < run->inputs; i++) {
        number_set(table, i, 0, cosine);
        number_set(table, i, 1, EXPONENTS[i % 5]);
        cosine = i < run->inputs / 2 ? nextafterf(cosine, 0) : cosine * 0.9995F;
    }
    if (!probe_numbers(run->probe, FUNCTION_POW, table, run->error))
        return false;
    Score score = {0};
    for (u32 i = 0; i < run->inputs; i++)
        score_wrong(&score, !(table->out[i] >= 0 && table->out[i] <= 1));
    run_add(run, "C44", "cosine to the power of up to 1e6: in [0, 1]", "definition", UNIT_WRONG, 0, &score);
    return true;
}

static bool means_of_samples(Run *run)
{
    NumberTable *table = run_numbers(run, 2, 4);
    if (!table)
        return false;
    const f64 values[2] = {1, 0.1F};
    for (u32 i = 0; i < 2; i++) {
        number_set(table, i, 0, values[i]);
        number_set(table, i, 1, 2e7);
    }
    if (!probe_numbers(run->probe, FUNCTION_MEAN, table, run->error))
        return false;
    Score score = {0};
    for (u32 i = 0; i < 2; i++)
        score_ulps(&score, values[i], table->out[i]);
    run_add(run, "C64", "mean of 2e7 samples of 1, of 0.1", "1, 0.1", UNIT_ULP, 1, &score);
    return true;
}

static bool random_numbers(Run *run)
{
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    for (u32 i = 0; i < run->inputs; i++) {
        const u32 bits = 0xffffffffu - i * 65535u;
        memcpy(&table->in[i], &bits, sizeof bits);
    }
    if (!probe_numbers(run->probe, FUNCTION_UNIT, table, run->error))
        return false;
    Score score = {0};
    for (u32 i = 0; i < run->inputs; i++)
        score_wrong(&score, table->out[i] != (f32)((0xffffffffu - i * 65535u) >> 8) * 0x1p-24F ||
                                !(table->out[i] < 1));
    run_add(run, "C66", "random bits to [0, 1), 0xffffffff among them", "integers", UNIT_WRONG, 0, &score);
    return true;
}

bool arithmetic_cases(Run *run)
{
    return contraction(run) && differences_of_products(run) && powers_of_cosines(run) && random_numbers(run);
}

bool division_cases(Run *run)
{
    return quotients_and_roots(run) && unit_vectors(run);
}

bool film_cases(Run *run)
{
    return means_of_samples(run);
}
