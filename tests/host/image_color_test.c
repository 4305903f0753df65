// Tone maps and sRGB: against the formulas in long double, at the ends of their ranges, and in order.
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "image/color.h"

static f64 extended_tiny(f64 c)
{
    return tone_map_reinhard_extended(c, 1e-200);
}

static f64 extended_4(f64 c)
{
    return tone_map_reinhard_extended(c, 4);
}

static f64 extended_huge(f64 c)
{
    return tone_map_reinhard_extended(c, 1e200);
}

typedef f64 (*Curve)(f64);
static const Curve CURVES[] = {tone_map_none, tone_map_reinhard, extended_tiny, extended_4,
                               extended_huge, tone_map_aces,     tone_map_hable};
enum { CURVE_COUNT = sizeof CURVES / sizeof CURVES[0] };

static void test_ends_of_the_range(void **state)
{
    (void)state;
    for (int i = 0; i < CURVE_COUNT; i++) {
        const Curve curve = CURVES[i];
        assert_true(curve(0) == 0 && curve(-0.0) == 0);
        assert_true(curve(NAN) == 0 && curve(-NAN) == 0);
        assert_true(curve(-1) == 0 && curve(-0.1) == 0 && curve(-FLT_MAX) == 0 && curve(-INFINITY) == 0);
        assert_true(fabs(curve(FLT_MAX) - 1) < 1e-15);
        assert_true(fabs(curve(DBL_MAX) - 1) < 1e-15);
        assert_true(curve(INFINITY) == 1);
        assert_true(curve(1e-320) >= 0 && curve(1e-320) <= 1);
    }
}

static void test_in_order_and_in_range(void **state)
{
    (void)state;
    for (int i = 0; i < CURVE_COUNT; i++) {
        f64 before = 0;
        for (f64 c = 1e-45; c < 1e39; c *= 1.0001) {
            const f64 value = CURVES[i](c);
            // Hable's and flat ends may wander by the rounding of the double, never by more.
            if (!(value >= before - 4e-16 && value <= 1))
                fail_msg("curve %d at %.17g: %.17g after %.17g", i, c, value, before);
            before = value;
        }
    }
}

static long double clamp01(long double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

static long double hable(long double x)
{
    return (x * (0.15L * x + 0.05L) + 0.004L) / (x * (0.15L * x + 0.5L) + 0.06L) - 0.02L / 0.3L;
}

static void test_formulas(void **state)
{
    (void)state;
    for (f64 d = 1e-6; d < 1e6; d *= 1.01) {
        const long double c = d;
        assert_true(fabsl(tone_map_none(d) - clamp01(c)) < 1e-15L);
        assert_true(fabsl(tone_map_reinhard(d) - c / (1 + c)) < 1e-15L);
        assert_true(fabsl(extended_4(d) - clamp01(c * (1 + c / 16) / (1 + c))) < 1e-15L);
        const long double aces = c * (2.51L * c + 0.03L) / (c * (2.43L * c + 0.59L) + 0.14L);
        assert_true(fabsl(tone_map_aces(d) - clamp01(aces)) < 1e-15L);
        assert_true(fabsl(tone_map_hable(d) - clamp01(hable(2 * c) / hable(11.2L))) < 1e-15L);
    }
    assert_true(tone_map_reinhard(1) == 0.5);
    assert_true(extended_4(4) == 1);
    assert_true(fabs(tone_map_hable(5.6) - 1) < 1e-15);
}

static void test_srgb(void **state)
{
    (void)state;
    assert_true(srgb_encode(0) == 0 && srgb_decode(0) == 0);
    assert_true(fabs(srgb_encode(1) - 1) < 1e-15 && fabs(srgb_decode(1) - 1) < 1e-15);
    assert_int_equal((int)round(255 * srgb_encode(0.5)), 188);
    assert_int_equal((int)round(255 * srgb_encode(0.0031308)), 10);
    for (int level = 0; level < 65536; level++)
        assert_int_equal((int)round(65535 * srgb_encode(srgb_decode(level / 65535.0))), level);
    for (int level = 0; level < 256; level++)
        assert_int_equal((int)round(255 * srgb_encode(srgb_decode(level / 255.0))), level);
    // In order across the joint, float by float, but for the standard's own step of 2.9e-8 down there, which
    // no level of 8 or 16 bits sees.
    f32 x = 0.00313f;
    f64 before = srgb_encode(x);
    while (x < 0.003132f) {
        x = nextafterf(x, 1);
        const f64 value = srgb_encode(x);
        assert_true(value > before || (before - value < 2.9e-8 && before < 0.04045));
        assert_true(round(65535 * value) >= round(65535 * before));
        assert_true(round(255 * value) >= round(255 * before));
        before = value;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ends_of_the_range),
        cmocka_unit_test(test_in_order_and_in_range),
        cmocka_unit_test(test_formulas),
        cmocka_unit_test(test_srgb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
