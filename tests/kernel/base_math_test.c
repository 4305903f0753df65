// The elementary functions of kernels/base against MPFR: error in ulp over dense inputs.
//
// CLRT_TEST_LOG2=N takes 2^N inputs a case instead of 2^20; 28 covers most cases completely.
#include "base_support.h"

#include <float.h>
#include <math.h>
#include <mpfr.h>
#include <stdlib.h>

// The bounds that the comments of the functions state, in ulp.
static const double bounds[FUNCTIONS] = { 1.55, 1.55, 1.25, 1.6, 1, 1, 1, 1, 1.5 };

static double libm(Function function, double x, double y)
{
    switch (function) {
    case SIN: return sin(x);
    case COS: return cos(x);
    case ACOS: return acos(x);
    case ATAN2: return atan2(y, x);
    case EXP: return exp(x);
    case EXP2: return exp2(x);
    case LOG: return log(x);
    case LOG2: return log2(x);
    case POW: return pow(x, y);
    default: return NAN;
    }
}

// The value rounded to double.
static double exact(Function function, double x, double y)
{
    mpfr_t a, b;
    mpfr_inits2(64, a, b, (mpfr_ptr)0);
    mpfr_set_d(a, x, MPFR_RNDN);
    mpfr_set_d(b, y, MPFR_RNDN);
    switch (function) {
    case SIN: mpfr_sin(a, a, MPFR_RNDN); break;
    case COS: mpfr_cos(a, a, MPFR_RNDN); break;
    case ACOS: mpfr_acos(a, a, MPFR_RNDN); break;
    case ATAN2: mpfr_atan2(a, b, a, MPFR_RNDN); break;
    case EXP: mpfr_exp(a, a, MPFR_RNDN); break;
    case EXP2: mpfr_exp2(a, a, MPFR_RNDN); break;
    case LOG: mpfr_log(a, a, MPFR_RNDN); break;
    case LOG2: mpfr_log2(a, a, MPFR_RNDN); break;
    case POW: mpfr_pow(a, a, b, MPFR_RNDN); break;
    default: mpfr_set_nan(a); break;
    }
    const double value = mpfr_get_d(a, MPFR_RNDN);
    mpfr_clears(a, b, (mpfr_ptr)0);
    return value;
}

// Distance in units of the last place of a float near the reference. Where the reference leaves the range of
// normal floats, or is within 2^-17 of doing so, 0 and infinity are right.
static double ulp_error(float result, double reference)
{
    const double magnitude = fabs(reference);
    if (magnitude < 0x1p-126 * (1 + 0x1p-17) && result == 0.0f)
        return 0;
    if (magnitude > 0x1p128 * (1 - 0x1p-17) && isinf(result))
        return 0;
    if (!isfinite(result))
        return INFINITY;
    int exponent;
    frexp(fmax(magnitude, 0x1p-126), &exponent);
    return ldexp(fabs((double)result - reference), 24 - exponent);
}

typedef struct {
    double ulp;
    float x, y, result;
} Worst;

// libm's double result is the reference where the error is small; MPFR has the last word on each new worst
// case and checks libm at every 256th input.
static void measure(Function function, const Batch *batch, Worst *worst)
{
    for (size_t i = 0; i < BATCH; i++) {
        const double x = (double)batch->x[i];
        const double y = (double)batch->y[i];
        double reference = libm(function, x, y);
        double error = ulp_error(batch->result[i], reference);
        if (i % 256 == 0 || !(error <= worst->ulp)) {
            const double value = exact(function, x, y);
            if (fabs(value) >= 0x1p-126 && !(fabs(reference - value) <= 1e-14 * fabs(value)))
                fail_msg("libm and MPFR differ: %s(%a, %a) = %a and %a", function_names[function], x, y,
                         reference, value);
            error = ulp_error(batch->result[i], value);
        }
        if (!(error <= worst->ulp))
            *worst = (Worst){ error, batch->x[i], batch->y[i], batch->result[i] };
    }
}

typedef struct {
    Function function;
    float x_low, x_high; // magnitudes, taken at even steps over the floats between them
    float y_low, y_high; // magnitudes, taken at random
    bool x_signs, y_signs; // both signs occur
} Case;

static const Case cases[] = {
    { SIN, 0x1p-126f, 0x1p+17f, 0, 0, true, false },
    { SIN, 0x1p-2f, 0x1p+3f, 0, 0, true, false },
    { SIN, 0x1p+10f, 0x1p+17f, 0, 0, true, false },
    { COS, 0x1p-126f, 0x1p+17f, 0, 0, true, false },
    { COS, 0x1p-2f, 0x1p+3f, 0, 0, true, false },
    { COS, 0x1p+10f, 0x1p+17f, 0, 0, true, false },
    { ACOS, 0x1p-126f, 1.0f, 0, 0, true, false },
    { ACOS, 0x1p-3f, 1.0f, 0, 0, true, false },
    { ATAN2, 0x1p-126f, FLT_MAX, 0x1p-126f, FLT_MAX, true, true },
    { ATAN2, 0x1p-3f, 0x1p+3f, 0x1p-3f, 0x1p+3f, true, true },
    { EXP, 0x1p-126f, 88.7228317f, 0, 0, true, false },
    { EXP, 0x1p-2f, 88.7228317f, 0, 0, true, false },
    { EXP2, 0x1p-126f, 0x1.fffffep+6f, 0, 0, true, false },
    { EXP2, 0x1p-2f, 0x1.fffffep+6f, 0, 0, true, false },
    { LOG, 0x1p-126f, FLT_MAX, 0, 0, false, false },
    { LOG, 0.5f, 2.0f, 0, 0, false, false },
    { LOG2, 0x1p-126f, FLT_MAX, 0, 0, false, false },
    { LOG2, 0.5f, 2.0f, 0, 0, false, false },
    { POW, 0.5f, 1.0f, 0x1p-6f, 1e6f, false, false },
    { POW, 0x1.ffcp-1f, 0x1.002p+0f, 1e3f, 1e6f, false, false },
    { POW, 0x1.fffep-1f, 0x1.0001p+0f, 1e6f, 1e6f, false, false },
    { POW, 0x1p-126f, FLT_MAX, 0x1p-10f, 1.0f, false, false },
    { POW, 0.7f, 1.4f, 100.0f, 400.0f, false, false },
    { POW, 0x1.ep-1f, 0x1.1p+0f, 500.0f, 2000.0f, false, false },
};

static void fill(const Case *c, uint64_t first, uint64_t total, Batch *batch)
{
    const uint32_t x_low = bits_of(c->x_low), x_span = bits_of(c->x_high) - x_low;
    const uint32_t y_low = bits_of(c->y_low), y_span = bits_of(c->y_high) - y_low;
    for (uint32_t i = 0; i < BATCH; i++) {
        const uint32_t random = mix((uint32_t)first + i);
        const uint32_t step = (uint32_t)((double)(first + i) / (double)(total - 1) * x_span);
        const float x = from_bits(x_low + step);
        const uint64_t scaled = mix(random + 1u) * ((uint64_t)y_span + 1);
        const float y = from_bits(y_low + (uint32_t)(scaled >> 32));
        batch->x[i] = c->x_signs && random & 1u ? -x : x;
        batch->y[i] = c->y_signs && random & 2u ? -y : y;
    }
}

static uint64_t case_inputs(void)
{
    const char *text = getenv("CLRT_TEST_LOG2");
    const int log2 = text ? atoi(text) : 20;
    return (uint64_t)1 << (log2 < 20 ? 20 : log2 > 32 ? 32 : log2);
}

static void errors_are_within_bounds(void **state)
{
    KernelProgram *program = functions_create(*state, 8, NULL);
    Batch *batch = batch_create();
    const uint64_t total = case_inputs();
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const Case *test = &cases[c];
        Worst worst = { 0, 0, 0, 0 };
        double seconds = INFINITY;
        for (uint64_t first = 0; first < total; first += BATCH) {
            fill(test, first, total, batch);
            seconds = fmin(seconds, functions_apply(program, test->function, 8, batch));
            measure(test->function, batch, &worst);
        }
        printf("%-5s x %-12.6g to %-12.6g y %-12.6g to %-12.6g worst %.4f ulp of %.2f at (%a, %a), %.2f ns\n",
               function_names[test->function], (double)test->x_low, (double)test->x_high, (double)test->y_low,
               (double)test->y_high, worst.ulp, bounds[test->function], (double)worst.x, (double)worst.y,
               1e9 * seconds / BATCH);
        if (!(worst.ulp <= bounds[test->function]))
            fail_msg("%s(%a, %a) = %a is wrong by %g ulp", function_names[test->function], (double)worst.x,
                     (double)worst.y, (double)worst.result, worst.ulp);
    }
    free(batch);
    kernel_program_destroy(program);
}

// The floats next to multiples of pi/2, where most of the argument cancels.
static void multiples_of_half_pi_are_reduced(void **state)
{
    KernelProgram *program = functions_create(*state, 8, NULL);
    Batch *batch = batch_create();
    for (uint32_t i = 0; i < BATCH; i++) {
        const float near = (float)((double)(i / 8) * 1.57079632679489661923);
        const float x = from_bits(bits_of(near) + (i >> 1 & 3u) - (near > 0.0f ? 1u : 0u));
        batch->x[i] = x > 0x1p+17f ? 0.0f : i & 1u ? -x : x;
    }
    for (Function function = SIN; function <= COS; function++) {
        Worst worst = { 0, 0, 0, 0 };
        functions_apply(program, function, 8, batch);
        measure(function, batch, &worst);
        printf("%s near multiples of pi/2: worst %.4f ulp at %a\n", function_names[function], worst.ulp,
               (double)worst.x);
        assert_true(worst.ulp <= bounds[function]);
    }
    free(batch);
    kernel_program_destroy(program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_within_bounds),
        cmocka_unit_test(multiples_of_half_pi_are_reduced),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
