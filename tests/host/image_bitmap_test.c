// Bitmaps by themselves: sizes, values, halves, repair, and files that are no picture.
#include "image_bitmap_fixture.h"

#include <float.h>
#include <math.h>
#include <unistd.h>

static void test_sizes(void **state)
{
    (void)state;
    Bitmap bitmap;
    Error error;
    assert_true(bitmap_create(&bitmap, 5, 3, 3, BITMAP_U16, &error));
    assert_int_equal(bitmap_bytes(&bitmap), 90);
    assert_ptr_equal(bitmap_row(&bitmap, 2), (u8 *)bitmap.texels + 60);
    assert_true(bitmap_value(&bitmap, 4, 2, 2) == 0);
    bitmap_destroy(&bitmap);
    assert_null(bitmap.texels);
    bitmap_destroy(&bitmap);
    assert_false(bitmap_create(&bitmap, 0, 3, 3, BITMAP_U8, &error));
    assert_int_equal(error.code, ERROR_SCENE);
    assert_false(bitmap_create(&bitmap, 1, BITMAP_SIDE_MAX + 1, 1, BITMAP_U8, &error));
    assert_int_equal(error.code, ERROR_SCENE);
    assert_false(bitmap_create(&bitmap, BITMAP_SIDE_MAX, BITMAP_SIDE_MAX, 3, BITMAP_FLOAT, &error));
    assert_int_equal(error.code, ERROR_MEMORY);
    assert_null(bitmap.texels);
}

static void test_values(void **state)
{
    (void)state;
    Bitmap bitmap;
    Error error;
    assert_true(bitmap_create(&bitmap, 2, 1, 1, BITMAP_U8, &error));
    memcpy(bitmap.texels, (u8[]){51, 255}, 2);
    assert_true(bitmap_value(&bitmap, 0, 0, 0) == 51 / 255.0 && bitmap_value(&bitmap, 1, 0, 0) == 1);
    bitmap_destroy(&bitmap);
    assert_true(bitmap_create(&bitmap, 2, 1, 1, BITMAP_U16, &error));
    memcpy(bitmap.texels, (u16[]){257, 65535}, 4);
    assert_true(bitmap_value(&bitmap, 0, 0, 0) == 257 / 65535.0 && bitmap_value(&bitmap, 1, 0, 0) == 1);
    bitmap_destroy(&bitmap);
}

// Every half against its definition.
static void test_halves(void **state)
{
    (void)state;
    for (u32 half = 0; half < 0x10000; half++) {
        const int exponent = (int)(half >> 10 & 31);
        const f64 mantissa = half & 0x3ff, sign = half & 0x8000 ? -1 : 1;
        const f32 value = half_value((u16)half);
        assert_int_equal(signbit(value) != 0, half >> 15);
        if (exponent == 31)
            assert_true(mantissa > 0 ? isnan(value) : isinf(value));
        else if (exponent == 0)
            assert_true((f64)value == sign * mantissa * 0x1p-24);
        else
            assert_true((f64)value == sign * (1 + mantissa / 1024) * pow(2, exponent - 15));
    }
}

static void test_repair(void **state)
{
    (void)state;
    Bitmap bitmap;
    Error error;
    assert_true(bitmap_create(&bitmap, 7, 1, 1, BITMAP_FLOAT, &error));
    const f32 values[] = {1, -1, NAN, INFINITY, -INFINITY, -0.0f, FLT_MAX};
    memcpy(bitmap.texels, values, sizeof values);
    assert_int_equal(bitmap_repair(&bitmap), 4);
    const f32 repaired[] = {1, 0, 0, FLT_MAX, 0, 0, FLT_MAX};
    assert_memory_equal(bitmap.texels, repaired, sizeof repaired);
    assert_int_equal(bitmap_repair(&bitmap), 0);
    bitmap_destroy(&bitmap);
    assert_true(bitmap_create(&bitmap, 7, 1, 1, BITMAP_HALF, &error));
    const u16 halves[] = {0x3c00, 0xbc00, 0x7e00, 0x7c00, 0xfc00, 0x8000, 0x7bff};
    memcpy(bitmap.texels, halves, sizeof halves);
    assert_int_equal(bitmap_repair(&bitmap), 4);
    const u16 right[] = {0x3c00, 0, 0, 0x7bff, 0, 0, 0x7bff};
    assert_memory_equal(bitmap.texels, right, sizeof right);
    assert_int_equal(bitmap_repair(&bitmap), 0);
    bitmap_destroy(&bitmap);
}

static void test_no_pictures(void **state)
{
    (void)state;
    expect_refusal("", 0, "not a PNG, JPEG, Radiance HDR or OpenEXR file");
    expect_refusal("GIF89a", 6, "not a PNG, JPEG, Radiance HDR or OpenEXR file");
    Bitmap bitmap;
    Error error;
    assert_false(bitmap_read("/nonexistent/a.png", &bitmap, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_null(bitmap.texels);
    assert_false(bitmap_read("/", &bitmap, &error));
    assert_int_equal(error.code, ERROR_IO);
}

static void test_read(void **state)
{
    (void)state;
    char path[] = "/tmp/clrt-bitmap-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "wb");
    fwrite("#?RADIANCE\n\n-Y 1 +X 1\n\x80\x40\x00\x81", 1, 26, file);
    assert_int_equal(fclose(file), 0);
    Bitmap bitmap;
    Error error;
    assert_true(bitmap_read(path, &bitmap, &error));
    assert_true(bitmap_value(&bitmap, 0, 0, 0) == 1 && bitmap_value(&bitmap, 0, 0, 1) == 0.5);
    bitmap_destroy(&bitmap);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),  cmocka_unit_test(test_values),      cmocka_unit_test(test_halves),
        cmocka_unit_test(test_repair), cmocka_unit_test(test_no_pictures), cmocka_unit_test(test_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
