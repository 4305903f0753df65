// relMSE, the means over what is compared, and the hash of the pixels.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "hash.h"
#include "metrics.h"
#include "synthetic.h"

static Metrics compare(const Pictures *pictures)
{
    const Limits limits = {.hard_fail = INFINITY};
    Metrics metrics;
    Error error;
    assert_true(metrics_compute(pictures, &limits, &metrics, &error));
    metrics_destroy(&metrics);
    return metrics;
}

static Pictures make(Synthetic a, Synthetic b)
{
    return (Pictures){.images = {synthetic_image(a), synthetic_image(b)},
                      .format = FORMAT_PNG8,
                      .region = {0, 0, SYNTHETIC_WIDTH, SYNTHETIC_HEIGHT}};
}

static void assert_near(f64 value, f64 expected, f64 relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.15g instead of %.15g", value, expected);
}

// Black and white: 1 / 0.01. Green and blue: a third each of 0, 1 / 1.01 and 1 / 0.01. The rest: NumPy in
// double, levels decoded by the sRGB curve of IEC 61966-2-1.
static void test_relmse(void **state)
{
    (void)state;
    const struct {
        Synthetic a, b;
        f64 relmse;
    } cases[] = {
        {SYNTHETIC_BLACK, SYNTHETIC_WHITE, 100},
        {SYNTHETIC_WHITE, SYNTHETIC_BLACK, 1 / 1.01},
        {SYNTHETIC_GREEN, SYNTHETIC_BLUE, (1 / 1.01 + 100) / 3},
        {SYNTHETIC_RAMP, SYNTHETIC_FIREFLY, 0.00369211010606},
        {SYNTHETIC_RAMP, SYNTHETIC_SHIFTED, 0.000745062786268},
        {SYNTHETIC_NOISE, SYNTHETIC_OTHER_NOISE, 5.97264309584},
        {SYNTHETIC_RAMP, SYNTHETIC_CHECKER, 6.42363191625},
        {SYNTHETIC_NOISE, SYNTHETIC_NOISE, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Pictures pictures = make(cases[i].a, cases[i].b);
        assert_near(compare(&pictures).relmse, cases[i].relmse, 1e-11);
        pictures_destroy(&pictures);
    }
    // Light as floats is taken as it is, below black and beyond white, too.
    Pictures pictures = make(SYNTHETIC_NOISE, SYNTHETIC_RAMP);
    pictures.format = FORMAT_PFM;
    pictures.linear = true;
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < SYNTHETIC_COUNT * 3; i++)
            pictures.images[k]->values[i] = pictures.images[k]->values[i] / 64 - 0.5f;
    }
    assert_near(compare(&pictures).relmse, 14.0147889691579, 1e-13);
    pictures_destroy(&pictures);
}

// Alpha has no light: it counts in what stands in the files and nowhere else.
static void test_alpha(void **state)
{
    (void)state;
    Error error;
    Pictures pictures = {.format = FORMAT_PNG8, .region = {0, 0, 20, 20}};
    for (u32 k = 0; k < 2; k++) {
        pictures.images[k] = image_create(20, 20, 4, &error);
        assert_non_null(pictures.images[k]);
        for (u32 i = 0; i < 400; i++) {
            pictures.images[k]->values[4 * i] = 255 * (f32)k;
            pictures.images[k]->values[4 * i + 3] = 100 * (f32)k;
        }
    }
    const Metrics m = compare(&pictures);
    assert_near(m.relmse, 100.0 / 3, 1e-14);
    assert_near(m.mse, (255.0 * 255 + 100 * 100) / 4, 1e-14);
    assert_near(m.rmse * m.rmse, m.mse, 1e-14);
    const f64 red = 0.2126;
    assert_near(m.ssim_mean, 1e-4 / (red * red + 1e-4), 1e-6);
    pictures_destroy(&pictures);
}

// Windows are counted by their centres; 0.025134308 is NumPy's for the right part.
static void test_means_of_what_is_compared(void **state)
{
    (void)state;
    Pictures pictures = make(SYNTHETIC_RAMP, SYNTHETIC_CHECKER);
    pictures.left_out = calloc(SYNTHETIC_COUNT, 1);
    assert_non_null(pictures.left_out);
    for (u32 i = 0; i < SYNTHETIC_COUNT; i++)
        pictures.left_out[i] = i % SYNTHETIC_WIDTH < 40;
    Metrics m = compare(&pictures);
    assert_near(m.ssim_mean, 0.025134308, 1e-7);
    assert_true(m.pixels == 35 * SYNTHETIC_HEIGHT);
    // Only pixels where no window fits.
    for (u32 i = 0; i < SYNTHETIC_COUNT; i++)
        pictures.left_out[i] = i % SYNTHETIC_WIDTH >= 5;
    m = compare(&pictures);
    assert_true(isnan(m.ssim_mean) && m.flip_mean > 0);
    pictures_destroy(&pictures);
}

static u64 hash_text(const char *text)
{
    return hash_bytes(HASH_START, text, strlen(text));
}

// The first three are published with the algorithm; the pictures' are a few lines of Python over the bytes
// that hash.h describes, made with struct.pack.
static void test_hash(void **state)
{
    (void)state;
    assert_true(hash_text("") == 0xCBF29CE484222325u);
    assert_true(hash_text("a") == 0xAF63DC4C8601EC8Cu);
    assert_true(hash_text("foobar") == 0x85944171F73967E8u);
    assert_true(hash_bytes(hash_text("foo"), "bar", 3) == hash_text("foobar"));
    Error error;
    Image *color = image_create(20, 10, 3, &error), *grey = image_create(20, 10, 1, &error);
    assert_true(color && grey);
    for (u32 i = 0; i < 600; i++)
        color->values[i] = (f32)(i % 200 + 20);
    assert_true(hash_image(color, 1) == 0xBA125B2380E80601u);
    for (u32 i = 0; i < 600; i++)
        color->values[i] = (f32)(i + 1) / 100;
    assert_true(hash_image(color, 4) == 0xE822C9166D7C9382u);
    for (u32 i = 0; i < 200; i++)
        grey->values[i] = (f32)(i * 331 % 65536);
    assert_true(hash_image(grey, 2) == 0x339606BC240FF75Bu);
    image_destroy(color);
    image_destroy(grey);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_relmse),
        cmocka_unit_test(test_alpha),
        cmocka_unit_test(test_means_of_what_is_compared),
        cmocka_unit_test(test_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
