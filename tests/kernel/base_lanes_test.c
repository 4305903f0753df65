// The arithmetic that all kernels rest on: contraction off, correct rounding, exact sums and products, masks.
#include "base_support.h"

#include <math.h>
#include <mpfr.h>

enum { COUNT = 65536, COLUMNS = 8 };

typedef struct {
    float in[COLUMNS][COUNT], out[COLUMNS][COUNT];
} Table;

// A float of random sign and mantissa with an exponent in [-range, range].
static float random_float(uint32_t index, int range)
{
    const uint32_t bits = mix(index);
    const float mantissa = 1.0f + (float)(bits >> 9) * 0x1p-23f;
    const int exponent = (int)(mix(bits + 1u) % (uint32_t)(2 * range + 1)) - range;
    return ldexpf(bits & 1u ? -mantissa : mantissa, exponent);
}

static Table *table_create(int range)
{
    Table *table = test_calloc(1, sizeof *table);
    assert_non_null(table);
    for (uint32_t c = 0; c < COLUMNS; c++)
        for (uint32_t i = 0; i < COUNT; i++)
            table->in[c][i] = random_float(i * COLUMNS + c, range);
    return table;
}

// Runs statements that read vf a to h and write vf r0 to r7, over all rows.
static void run_rows(KernelDevice *device, const char *statements, int lanes, Table *table)
{
    char source[4096];
    const int length = snprintf(source, sizeof source,
        "#include \"base/exact.h\"\n#include \"base/vec.h\"\n"
        "kernel void f(global const float *in, global float *out)\n"
        "{\n"
        "    const uint n = %u;\n"
        "    in += get_global_id(0) * LANES;\n"
        "    out += get_global_id(0) * LANES;\n"
        "    vf a = VF_LOAD(in), b = VF_LOAD(in + n), c = VF_LOAD(in + 2 * n), d = VF_LOAD(in + 3 * n);\n"
        "    vf e = VF_LOAD(in + 4 * n), f = VF_LOAD(in + 5 * n), g = VF_LOAD(in + 6 * n);\n"
        "    vf h = VF_LOAD(in + 7 * n);\n"
        "    vf r0 = a, r1 = b, r2 = c, r3 = d, r4 = e, r5 = f, r6 = g, r7 = h;\n"
        "    %s\n"
        "    VF_STORE(r0, out); VF_STORE(r1, out + n); VF_STORE(r2, out + 2 * n);\n"
        "    VF_STORE(r3, out + 3 * n); VF_STORE(r4, out + 4 * n); VF_STORE(r5, out + 5 * n);\n"
        "    VF_STORE(r6, out + 6 * n); VF_STORE(r7, out + 7 * n);\n"
        "}\n", (unsigned)COUNT, statements);
    assert_in_range(length, 1, sizeof source - 1);
    KernelProgram *program = kernel_program_create(device, source, lanes);
    const KernelArg args[] = {
        kernel_in(table->in, sizeof table->in), kernel_out(table->out, sizeof table->out),
    };
    kernel_run(program, "f", COUNT / (size_t)lanes, args, 2);
    kernel_program_destroy(program);
}

// x y - x y is zero only where each product is rounded by itself: with contraction the rounding error of
// one product stays.
static void contraction_is_off(void **state)
{
    Table *table = table_create(20);
    for (size_t w = 0; w < WIDTHS; w++) {
        memcpy(table->in[2], table->in[1], sizeof table->in[1]);
        memcpy(table->in[3], table->in[0], sizeof table->in[0]);
        run_rows(*state, "r0 = a * b - c * d;", widths[w], table);
        for (size_t i = 0; i < COUNT; i++)
            assert_true(table->out[0][i] == 0.0f);
    }
    test_free(table);
}

static void division_and_root_are_correctly_rounded(void **state)
{
    Table *table = table_create(30);
    for (size_t w = 0; w < WIDTHS; w++) {
        run_rows(*state, "r0 = a / b; r1 = sqrt(fabs(c)); r2 = fma(a, b, c); r3 = floor(d);"
                         "r4 = (vf)(1.0f) / e; r5 = rint(f); r6 = copysign(g, a);"
                         "r7 = VF_FROM_VI(VI_FROM_VF(h));", widths[w], table);
        for (size_t i = 0; i < COUNT; i++) {
            assert_true(table->out[0][i] == table->in[0][i] / table->in[1][i]);
            assert_true(table->out[1][i] == sqrtf(fabsf(table->in[2][i])));
            assert_true(table->out[2][i] == fmaf(table->in[0][i], table->in[1][i], table->in[2][i]));
            assert_true(table->out[3][i] == floorf(table->in[3][i]));
            assert_true(table->out[4][i] == 1.0f / table->in[4][i]);
            assert_true(table->out[5][i] == rintf(table->in[5][i]));
            assert_true(table->out[6][i] == copysignf(table->in[6][i], table->in[0][i]));
            assert_true(table->out[7][i] == truncf(table->in[7][i]));
        }
    }
    test_free(table);
}

static void sums_and_products_are_exact(void **state)
{
    Table *table = table_create(12); // so that double holds every sum and product
    run_rows(*state, "vf2 s = two_sum(a, b); r0 = s.hi; r1 = s.lo;"
                     "vf2 p = two_product(a, b); r2 = p.hi; r3 = p.lo;"
                     "vm m = fabs(c) > fabs(d);"
                     "vf2 q = fast_two_sum(m ? c : d, m ? d : c); r4 = q.hi; r5 = q.lo;", 8, table);
    for (size_t i = 0; i < COUNT; i++) {
        const double a = (double)table->in[0][i], b = (double)table->in[1][i];
        const double c = (double)table->in[2][i], d = (double)table->in[3][i];
        assert_true(table->out[0][i] == (float)(a + b));
        assert_true((double)table->out[0][i] + (double)table->out[1][i] == a + b);
        assert_true(table->out[2][i] == (float)(a * b));
        assert_true((double)table->out[2][i] + (double)table->out[3][i] == a * b);
        assert_true(table->out[4][i] == (float)(c + d));
        assert_true((double)table->out[4][i] + (double)table->out[5][i] == c + d);
    }
    test_free(table);
}

// |hi + lo - reference| / |reference|, and hi is the sum rounded.
static double relative_error(float hi, float lo, mpfr_t reference)
{
    assert_true(hi + lo == hi);
    mpfr_t difference;
    mpfr_init2(difference, 200);
    mpfr_d_sub(difference, (double)hi + (double)lo, reference, MPFR_RNDN); // 53 bits hold these pairs
    mpfr_div(difference, difference, reference, MPFR_RNDN);
    const double error = mpfr_zero_p(reference) ? 0 : fabs(mpfr_get_d(difference, MPFR_RNDN));
    mpfr_clear(difference);
    return error;
}

static void set_pair(mpfr_t x, float hi, float lo)
{
    mpfr_set_d(x, (double)hi, MPFR_RNDN);
    mpfr_add_d(x, x, (double)lo, MPFR_RNDN);
}

static void two_floats_keep_48_bits(void **state)
{
    Table *table = table_create(3);
    for (size_t i = 0; i < COUNT; i++) {
        // Pairs (a, b) and (c, d); in half of the rows their sum cancels.
        table->in[1][i] *= 0x1p-29f;
        table->in[3][i] *= 0x1p-29f;
        table->in[2][i] = i & 1u ? -table->in[0][i] * (1.0f + (float)(i & 30u) * 0x1p-23f) : table->in[2][i];
    }
    run_rows(*state, "vf2 p = fast_two_sum(a, b), q = fast_two_sum(c, d); vf2 t;"
                     "t = vf2_add(p, q); r0 = t.hi; r1 = t.lo; t = vf2_mul(p, q); r2 = t.hi; r3 = t.lo;"
                     "t = vf2_add_vf(p, c); r4 = t.hi; r5 = t.lo;"
                     "t = vf2_mul_vf(p, c); r6 = t.hi; r7 = t.lo;", 8, table);
    mpfr_t p, q, r;
    mpfr_inits2(200, p, q, r, (mpfr_ptr)0);
    double worst[4] = { 0, 0, 0, 0 };
    for (size_t i = 0; i < COUNT; i++) {
        set_pair(p, table->in[0][i], table->in[1][i]);
        set_pair(q, table->in[2][i], table->in[3][i]);
        mpfr_add(r, p, q, MPFR_RNDN);
        worst[0] = fmax(worst[0], relative_error(table->out[0][i], table->out[1][i], r));
        mpfr_mul(r, p, q, MPFR_RNDN);
        worst[1] = fmax(worst[1], relative_error(table->out[2][i], table->out[3][i], r));
        mpfr_add_d(r, p, (double)table->in[2][i], MPFR_RNDN);
        worst[2] = fmax(worst[2], relative_error(table->out[4][i], table->out[5][i], r));
        mpfr_mul_d(r, p, (double)table->in[2][i], MPFR_RNDN);
        worst[3] = fmax(worst[3], relative_error(table->out[6][i], table->out[7][i], r));
    }
    mpfr_clears(p, q, r, (mpfr_ptr)0);
    printf("errors in 2^-48: add %.3f, mul %.3f, add_vf %.3f, mul_vf %.3f\n", worst[0] * 0x1p48,
           worst[1] * 0x1p48, worst[2] * 0x1p48, worst[3] * 0x1p48);
    assert_true(worst[0] <= 3.01 * 0x1p-48 && worst[1] <= 5 * 0x1p-48);
    assert_true(worst[2] <= 2 * 0x1p-48 && worst[3] <= 2 * 0x1p-48);
    test_free(table);
}

static void difference_of_products_survives_cancellation(void **state)
{
    Table *table = table_create(2);
    for (size_t i = 0; i < COUNT; i += 2) {
        // c d is a b but for a few units in the last place.
        table->in[2][i] = table->in[0][i] * (1.0f + (float)(i & 6u) * 0x1p-23f);
        table->in[3][i] = table->in[1][i] * (1.0f - (float)(i & 24u) * 0x1p-26f);
    }
    table->in[0][0] = 10001.0f; // b^2 - a c of a tangent ray, 1/4
    table->in[1][0] = 10001.0f;
    table->in[2][0] = 10000.5f;
    table->in[3][0] = 10001.5f;
    run_rows(*state, "r0 = difference_of_products(a, b, c, d);", 8, table);
    assert_true(table->out[0][0] == 0.25f);
    for (size_t i = 0; i < COUNT; i++) {
        // Both products are exact in double; where they cancel so is their difference.
        const double exact = (double)table->in[0][i] * (double)table->in[1][i] -
                             (double)table->in[2][i] * (double)table->in[3][i];
        int exponent;
        frexp(exact, &exponent);
        assert_true(fabs((double)table->out[0][i] - exact) <= ldexp(1.5, exponent - 24));
    }
    test_free(table);
}

static void vectors_keep_their_bounds(void **state)
{
    Table *table = table_create(4);
    run_rows(*state, "v3 p = v3_make(a, b, c), q = v3_make(d, e, f); v3 unit = v3_normalize(p);"
                     "r0 = v3_dot(p, q); r1 = unit.x; r2 = unit.y; r3 = unit.z;", 8, table);
    double worst_dot = 0, worst_length = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double dot = 0, sum = 0, length2 = 0;
        for (size_t k = 0; k < 3; k++) {
            const double product = (double)table->in[k][i] * (double)table->in[k + 3][i];
            dot += product;
            sum += fabs(product);
            length2 += (double)table->out[k + 1][i] * (double)table->out[k + 1][i];
        }
        worst_dot = fmax(worst_dot, fabs((double)table->out[0][i] - dot) / sum);
        worst_length = fmax(worst_length, fabs(sqrt(length2) - 1));
    }
    printf("errors in 2^-24: dot %.3f, length of a normalised vector %.3f\n", worst_dot * 0x1p24,
           worst_length * 0x1p24);
    assert_true(worst_dot <= 3 * 0x1p-24);
    assert_true(worst_length <= 3 * 0x1p-24);
    test_free(table);
}

static void masks_and_lanes_are_as_stated(void **state)
{
    for (size_t w = 0; w < WIDTHS; w++) {
        KernelProgram *program = kernel_program_create(*state,
            "#include \"base/lanes.h\"\n"
            "kernel void f(global const float *x, global const int *index, global uint *masks,\n"
            "              global float *r)\n"
            "{\n"
            "    const vf a = VF_LOAD(x), b = VF_LOAD(x + LANES);\n"
            "    const vm m = a < b;\n"
            "    masks[0] = vm_bits(m);\n"
            "    masks[1] = vm_bits(vm_from_bits(masks[0]));\n"
            "    masks[2] = vm_bits(!m);\n"
            "    masks[3] = (vm_any(m) ? 1u : 0u) | (vm_all(m) ? 2u : 0u) | (vm_any(m & !m) ? 4u : 0u) |\n"
            "               (vm_all(m | !m) ? 8u : 0u);\n"
            "    VF_STORE(vf_min(a, b), r);\n"
            "    VF_STORE(vf_max(a, b), r + LANES);\n"
            "    VF_STORE(vf_gather(x, VI_LOAD(index)), r + 2 * LANES);\n"
            "    vf_scatter(r + 3 * LANES, VI_LOAD(index), a, m);\n"
            "    VF_STORE(VF_FROM_VI(LANE_IOTA), r + 4 * LANES);\n"
            "}\n", widths[w]);
        const uint32_t lanes = (uint32_t)widths[w];
        float x[32], r[5 * 16];
        int32_t index[16];
        uint32_t masks[4], expected = 0;
        for (uint32_t i = 0; i < 2 * lanes; i++)
            x[i] = random_float(i + 1, 4);
        x[0] = NAN;
        for (uint32_t i = 0; i < lanes; i++) {
            index[i] = (int32_t)((i * 5 + 1) % lanes);
            expected |= (uint32_t)(x[i] < x[i + lanes]) << i;
        }
        for (size_t i = 0; i < sizeof r / sizeof *r; i++)
            r[i] = -7.0f;
        kernel_run(program, "f", 1, (KernelArg[]){ kernel_in(x, sizeof x), kernel_in(index, sizeof index),
                   kernel_out(masks, sizeof masks), kernel_out(r, sizeof r) }, 4);
        kernel_program_destroy(program);
        assert_int_equal(masks[0], expected);
        assert_int_equal(masks[1], expected);
        assert_int_equal(masks[2], ~expected & ((1u << lanes) - 1u));
        assert_int_equal(masks[3], (expected ? 1u : 0u) | 8u);
        assert_true(r[0] == x[lanes] && r[lanes] == x[lanes]); // NaN gives the second
        for (uint32_t i = 0; i < lanes; i++) {
            const bool less = expected >> i & 1u;
            assert_true(r[i] == (less ? x[i] : x[i + lanes]));
            assert_true(i == 0 || r[lanes + i] == (less ? x[i + lanes] : x[i]));
            assert_int_equal(bits_of(r[2 * lanes + i]), bits_of(x[index[i]]));
            assert_true(r[3 * lanes + (uint32_t)index[i]] == (less ? x[i] : -7.0f));
            assert_true(r[4 * lanes + i] == (float)i);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contraction_is_off),
        cmocka_unit_test(division_and_root_are_correctly_rounded),
        cmocka_unit_test(sums_and_products_are_exact),
        cmocka_unit_test(two_floats_keep_48_bits),
        cmocka_unit_test(difference_of_products_survives_cancellation),
        cmocka_unit_test(vectors_keep_their_bounds),
        cmocka_unit_test(masks_and_lanes_are_as_stated),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
