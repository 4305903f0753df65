// The elementary functions: error, bits that all devices share, special values.
#include <float.h>
#include <math.h>
#include <string.h>

#include "selftest/agreed.h"
#include "selftest/random.h"
#include "selftest/run.h"

static u32 bits_of(f32 x)
{
    u32 bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static f64 reference(u32 function, f64 x, f64 y)
{
    switch (function) {
    case FUNCTION_SIN: return sin(x);
    case FUNCTION_COS: return cos(x);
    case FUNCTION_ACOS: return acos(x);
    case FUNCTION_ATAN2: return atan2(y, x);
    case FUNCTION_EXP: return exp(x);
    case FUNCTION_EXP2: return exp2(x);
    case FUNCTION_LOG: return log(x);
    case FUNCTION_LOG2: return log2(x);
    case FUNCTION_POW: return pow(x, y);
    default: return NAN;
    }
}

// Functions that share a bound stand together. Ranges are of magnitudes; y is taken of ATAN2 and POW.
typedef struct Range {
    const char *what; // NULL: as the one before
    u32 function;
    f64 bound; // that the comment of the function states, in ulp
    f64 x_low, x_high, y_low, y_high;
    bool signs;
} Range;

static const Range RANGES[] = {
    {"sin and cos up to 2^17 radians", FUNCTION_SIN, 1.55, 0x1p-20, 0x1p17, 0, 0, true},
    {NULL, FUNCTION_SIN, 1.55, 0x1p-2, 8, 0, 0, true},
    {NULL, FUNCTION_COS, 1.55, 0x1p-20, 0x1p17, 0, 0, true},
    {NULL, FUNCTION_COS, 1.55, 0x1p-2, 8, 0, 0, true},
    {"acos", FUNCTION_ACOS, 1.25, 0x1p-20, 1, 0, 0, true},
    {NULL, FUNCTION_ACOS, 1.25, 0x1p-2, 1, 0, 0, true},
    {"atan2", FUNCTION_ATAN2, 1.6, 0x1p-30, 0x1p30, 0x1p-30, 0x1p30, true},
    {NULL, FUNCTION_ATAN2, 1.6, 0x1p-3, 8, 0x1p-3, 8, true},
    {"exp, exp2, log, log2", FUNCTION_EXP, 1, 0x1p-20, 87, 0, 0, true},
    {NULL, FUNCTION_EXP2, 1, 0x1p-20, 125, 0, 0, true},
    {NULL, FUNCTION_LOG, 1, 0x1p-126, 0x1p127, 0, 0, false},
    {NULL, FUNCTION_LOG, 1, 0.5, 2, 0, 0, false},
    {NULL, FUNCTION_LOG2, 1, 0x1p-126, 0x1p127, 0, 0, false},
    {NULL, FUNCTION_LOG2, 1, 0.5, 2, 0, 0, false},
    {"pow, exponents up to 1e6", FUNCTION_POW, 1.5, 0.5, 1, 0x1p-6, 100, false},
    {NULL, FUNCTION_POW, 1.5, 0x1.fffep-1, 0x1.0001p+0, 1e5, 1e6, false},
    {NULL, FUNCTION_POW, 1.5, 0.75, 1.5, 10, 200, false},
};
enum { RANGE_COUNT = sizeof RANGES / sizeof RANGES[0] };

static void fill_range(NumberTable *table, const Range *range, u64 *random)
{
    const f64 low = log2(range->x_low), high = log2(range->x_high);
    for (u32 i = 0; i < table->count; i++) {
        const f64 x = exp2(random_in(random, low, high));
        const f64 y = range->y_high > 0
                          ? exp2(random_in(random, log2(range->y_low), log2(range->y_high)))
                          : 0;
        number_set(table, i, 0, range->signs && i & 1 ? -x : x);
        number_set(table, i, 1, range->signs && i & 2 ? -y : y);
    }
}

static bool errors(Run *run)
{
    NumberTable *table = run_numbers(run, run->inputs, 4);
    if (!table)
        return false;
    u64 random = 48;
    Score score = {0};
    const Range *first = RANGES;
    for (const Range *range = RANGES; range < RANGES + RANGE_COUNT; range++) {
        fill_range(table, range, &random);
        if (!probe_numbers(run->probe, range->function, table, run->error))
            return false;
        for (u32 i = 0; i < table->count; i++) {
            const f64 exact = reference(range->function, table->in[i], table->in[table->stride + i]);
            if (fabs(exact) >= (f64)FLT_MIN && fabs(exact) <= (f64)FLT_MAX)
                score_ulps(&score, exact, table->out[i]);
        }
        if (range + 1 == RANGES + RANGE_COUNT || range[1].what) {
            run_add(run, "C48", first->what, "double", UNIT_ULP, first->bound, &score);
            score = (Score){0};
            first = range + 1;
        }
    }
    return true;
}

static bool agreed_bits(Run *run)
{
    NumberTable *table = run_numbers(run, AGREED_INPUTS, 4);
    if (!table)
        return false;
    Score score = {0};
    agreed_fill(table->in, table->in + table->stride);
    for (u32 function = 0; function < AGREED_FUNCTIONS; function++) {
        if (!probe_numbers(run->probe, function, table, run->error))
            return false;
        score_wrong(&score, agreed_hash(table->out) != AGREED_HASHES[function]);
    }
    run_add(run, "C48", "these nine functions, bits of 2^20 results each", "agreed hashes", UNIT_WRONG, 0,
            &score);
    return true;
}

typedef struct Special {
    u32 function;
    f32 x, y, result;
} Special;

static const Special ENDS[] = {
    {FUNCTION_POW, 0, 0, 1},         {FUNCTION_POW, -0.1F, 0, 1},
    {FUNCTION_POW, INFINITY, 0, 1},  {FUNCTION_POW, 0, 5, 0},
    {FUNCTION_POW, -0.1F, 5, 0},     {FUNCTION_POW, 1, 1e6F, 1},
    {FUNCTION_POW, 0.5F, 1e6F, 0},   {FUNCTION_POW, 2, 128, INFINITY},
    {FUNCTION_ACOS, 1, 0, 0},        {FUNCTION_ACOS, 0x1.000002p+0F, 0, 0},
    {FUNCTION_ACOS, -1, 0, 0x1.921fb6p+1F}, {FUNCTION_ACOS, -0x1.000002p+0F, 0, 0x1.921fb6p+1F},
    {FUNCTION_ATAN2, 0, 0, 0},       {FUNCTION_ATAN2, -1, 0, 0x1.921fb6p+1F},
    {FUNCTION_SIN, 0, 0, 0},         {FUNCTION_COS, 0, 0, 1},
    {FUNCTION_EXP, 0, 0, 1},         {FUNCTION_LOG, 1, 0, 0},
    {FUNCTION_LOG, 0, 0, -INFINITY}, {FUNCTION_EXP2, 127, 0, 0x1p+127F},
};

// What devices flush to zero or keep.
static const Special DENORMALS[] = {
    {FUNCTION_EXP, 1e-40F, 0, 1},         {FUNCTION_EXP, -87.5F, 0, 0},
    {FUNCTION_EXP2, -126.5F, 0, 0},       {FUNCTION_LOG, 1e-40F, 0, -INFINITY},
    {FUNCTION_LOG2, 1e-40F, 0, -INFINITY}, {FUNCTION_POW, 1e-40F, 1, 0},
    {FUNCTION_POW, 0.5F, 126.5F, 0},      {FUNCTION_ATAN2, 1, 1e-40F, 0},
    {FUNCTION_ATAN2, 1e-40F, 1, 0x1.921fb6p+0F}, {FUNCTION_ATAN2, 1e15F, 1e-30F, 0},
};

static bool specials(Run *run, const Special *list, u32 count, const char *id, const char *what)
{
    NumberTable *table = run_numbers(run, count, 4);
    if (!table)
        return false;
    Score score = {0};
    for (u32 i = 0; i < count; i++) {
        number_set(table, i, 0, list[i].x);
        number_set(table, i, 1, list[i].y);
    }
    for (u32 function = 0; function < AGREED_FUNCTIONS; function++) {
        if (!probe_numbers(run->probe, function, table, run->error))
            return false;
        for (u32 i = 0; i < count; i++)
            if (list[i].function == function)
                score_wrong(&score, bits_of(table->out[i]) != bits_of(list[i].result));
    }
    run_add(run, id, what, "definition", UNIT_WRONG, 0, &score);
    return true;
}

bool agreed_cases(Run *run)
{
    return agreed_bits(run);
}

bool function_cases(Run *run)
{
    return errors(run) &&
           specials(run, ENDS, sizeof ENDS / sizeof ENDS[0], "C45",
                    "pow(0, 0), acos(1 + ulp) and other ends") &&
           specials(run, DENORMALS, sizeof DENORMALS / sizeof DENORMALS[0], "C68",
                    "denormal arguments and results count as 0");
}
