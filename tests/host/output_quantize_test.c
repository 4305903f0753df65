// Quantizer: the tables give what the formulas give, for every level's first float and its neighbours and
// for floats from all over, under every tone map, encoding, depth and strange exposures. The definition
// itself is checked against long double.
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "output/quantize.h"

static f32 from_bits(u32 bits)
{
    f32 value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static u32 to_bits(f32 value)
{
    u32 bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static u32 table_level(const Quantizer *quantizer, u32 bits, f32 value)
{
    u8 bytes[2];
    quantizer_apply(quantizer, &value, 1, bytes);
    return bits == 8 ? bytes[0] : bytes[0] * 256u + bytes[1];
}

static void check(const Quantizer *quantizer, const OutputSettings *settings, u32 bits, f32 value)
{
    const u32 expected = quantize_exact(settings, bits, value);
    const u32 level = table_level(quantizer, bits, value);
    if (level != expected)
        fail_msg("%a (tone map %d, encoding %d, exposure %g, %u bits): %u instead of %u", value,
                 (int)settings->tone_map, (int)settings->encoding, settings->exposure, bits, level, expected);
}

static void check_neighbours(const Quantizer *quantizer, const OutputSettings *settings, u32 bits, u32 at)
{
    for (u32 i = at < 3 ? 0 : at - 3; i <= at + 3; i++)
        check(quantizer, settings, bits, from_bits(i));
}

// The bits of the first float of a level, found independently of the tables.
static u32 first_of_level(const OutputSettings *settings, u32 bits, u32 level)
{
    u32 low = 0, high = 0x7F800000;
    while (high - low > 1) {
        const u32 middle = low + (high - low) / 2;
        if (quantize_exact(settings, bits, from_bits(middle)) >= level)
            high = middle;
        else
            low = middle;
    }
    return high;
}

static void check_settings(const OutputSettings *settings, u32 bits)
{
    Error error;
    Quantizer *quantizer = quantizer_create(settings, bits, &error);
    assert_non_null(quantizer);
    const f32 specials[] = {0,       -0.0f,    1,       -1,       0.5f,  0.0031308f,     FLT_MIN,
                            FLT_MAX, -FLT_MAX, -1e-45f, INFINITY, 1e38f, -(f32)INFINITY, FLT_TRUE_MIN};
    for (size_t i = 0; i < sizeof specials / sizeof specials[0]; i++)
        check(quantizer, settings, bits, specials[i]);
    assert_int_equal(table_level(quantizer, bits, NAN), 0);
    assert_int_equal(table_level(quantizer, bits, -NAN), 0);
    assert_int_equal(table_level(quantizer, bits, from_bits(0x7F800001)), 0);
    assert_int_equal(table_level(quantizer, bits, INFINITY), (1u << bits) - 1);
    assert_int_equal(table_level(quantizer, bits, -(f32)INFINITY), 0);
    const u32 step = bits == 8 ? 1 : 499;
    for (u32 level = 1; level < 1u << bits; level += step)
        check_neighbours(quantizer, settings, bits, first_of_level(settings, bits, level));
    // Bits at even steps reach denormals and infinity alike.
    for (u32 i = 0; i < 0x7F800000; i += 165041)
        check(quantizer, settings, bits, from_bits(i));
    u32 random = 1;
    for (int i = 0; i < 20000; i++) {
        random = random * 1664525u + 1013904223u;
        check(quantizer, settings, bits, (f32)(random >> 8) / 4194304);
    }
    quantizer_destroy(quantizer);
}

static void test_tables_agree(void **state)
{
    (void)state;
    for (int map = TONE_MAP_NONE; map <= TONE_MAP_HABLE; map++) {
        for (int encoding = ENCODING_SRGB; encoding <= ENCODING_LINEAR; encoding++) {
            const OutputSettings settings = {
                .tone_map = (ToneMap)map, .white = 4, .encoding = (Encoding)encoding};
            check_settings(&settings, 8);
            check_settings(&settings, 16);
        }
    }
}

static void test_exposures(void **state)
{
    (void)state;
    const f64 exposures[] = {-1e38, -1100, -200, -127.5, -3, 0.3, 2.5, 100, 140, 148, 149.5, 160, 1100, 1e38};
    for (size_t i = 0; i < sizeof exposures / sizeof exposures[0]; i++) {
        for (int map = TONE_MAP_NONE; map <= TONE_MAP_HABLE; map++) {
            const OutputSettings settings = {
                .exposure = exposures[i], .tone_map = (ToneMap)map, .white = i % 2 ? 1e-3 : 1e3};
            check_settings(&settings, 8);
        }
        const OutputSettings settings = {.exposure = exposures[i]};
        check_settings(&settings, 16);
    }
}

// Every float of a binade, so that no threshold between the samples above is missed.
static void test_every_float_of_a_binade(void **state)
{
    (void)state;
    const OutputSettings settings = {.tone_map = TONE_MAP_ACES, .exposure = 0.3};
    Error error;
    Quantizer *quantizer = quantizer_create(&settings, 8, &error);
    assert_non_null(quantizer);
    u32 before = 0;
    for (u32 bits = to_bits(0.25f); bits < to_bits(0.5f); bits++) {
        const f32 value = from_bits(bits);
        const u32 level = table_level(quantizer, 8, value);
        assert_true(level >= before);
        if (level != before || bits % 8 == 0)
            assert_int_equal(level, quantize_exact(&settings, 8, value));
        before = level;
    }
    quantizer_destroy(quantizer);
}

static u32 long_double_level(const OutputSettings *settings, u32 bits, f32 radiance, long double *distance)
{
    long double c = (long double)radiance * exp2l(settings->exposure);
    const long double w = settings->white;
    if (settings->tone_map == TONE_MAP_REINHARD)
        c = c / (1 + c);
    else if (settings->tone_map == TONE_MAP_REINHARD_EXTENDED)
        c = c * (1 + c / (w * w)) / (1 + c);
    else if (settings->tone_map == TONE_MAP_ACES)
        c = c * (2.51L * c + 0.03L) / (c * (2.43L * c + 0.59L) + 0.14L);
    else if (settings->tone_map == TONE_MAP_HABLE) {
        const long double x[2] = {2 * c, 11.2L};
        long double f[2];
        for (int i = 0; i < 2; i++) {
            const long double top = x[i] * (0.15L * x[i] + 0.05L) + 0.004L;
            f[i] = top / (x[i] * (0.15L * x[i] + 0.5L) + 0.06L) - 0.02L / 0.3L;
        }
        c = f[0] / f[1];
    }
    c = c > 1 ? 1 : c;
    if (settings->encoding == ENCODING_SRGB)
        c = c <= 0.0031308L ? 12.92L * c : 1.055L * powl(c, 1 / 2.4L) - 0.055L;
    c *= (long double)((1u << bits) - 1);
    *distance = fabsl(c - floorl(c) - 0.5L);
    return (u32)floorl(c + 0.5L);
}

static void test_the_definition(void **state)
{
    (void)state;
    for (int map = TONE_MAP_NONE; map <= TONE_MAP_HABLE; map++) {
        for (int i = 0; i < 4; i++) {
            const OutputSettings settings = {.tone_map = (ToneMap)map,
                                             .white = 3,
                                             .exposure = i < 2 ? 0 : -1.5,
                                             .encoding = i % 2 ? ENCODING_LINEAR : ENCODING_SRGB};
            for (f32 c = 1e-7f; c < 1e5f; c *= 1.001f) {
                long double distance;
                const u32 expected = long_double_level(&settings, 16, c, &distance);
                // Nearer than this to the middle of two levels a double cannot tell.
                if (distance > 1e-10L)
                    assert_int_equal(quantize_exact(&settings, 16, c), expected);
            }
        }
    }
}

static void test_known_levels(void **state)
{
    (void)state;
    const OutputSettings srgb = {.encoding = ENCODING_SRGB};
    const OutputSettings linear = {.encoding = ENCODING_LINEAR};
    assert_int_equal(quantize_exact(&srgb, 8, 0.5f), 188);
    assert_int_equal(quantize_exact(&srgb, 8, 0.0031308f), 10);
    // 127.5 and 32767.5: halves go up.
    assert_int_equal(quantize_exact(&linear, 8, 0.5f), 128);
    assert_int_equal(quantize_exact(&linear, 16, 0.5f), 32768);
    assert_int_equal(quantize_exact(&linear, 8, nextafterf(0.5f, 0)), 127);
    const OutputSettings brighter = {.encoding = ENCODING_LINEAR, .exposure = 1};
    assert_int_equal(quantize_exact(&brighter, 8, 0.25f), 128);
    const OutputSettings half = {.encoding = ENCODING_LINEAR, .tone_map = TONE_MAP_REINHARD};
    assert_int_equal(quantize_exact(&half, 8, 1), 128);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tables_agree),
        cmocka_unit_test(test_exposures),
        cmocka_unit_test(test_every_float_of_a_binade),
        cmocka_unit_test(test_the_definition),
        cmocka_unit_test(test_known_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
