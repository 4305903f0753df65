// clrt-compare as it is used: the pictures that it draws.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

#include "program.h"

static void read_map(const char *name, u8 **pixels, u32 *width, u32 *height)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, name));
    image.format = PNG_FORMAT_RGB;
    *pixels = malloc(PNG_IMAGE_SIZE(image));
    assert_non_null(*pixels);
    assert_true(png_image_finish_read(&image, NULL, *pixels, 0, NULL));
    *width = image.width;
    *height = image.height;
}

static u32 brightness(const u8 *rgb)
{
    return (u32)rgb[0] + rgb[1] + rgb[2];
}

static void test_map(void **state)
{
    Fixture *f = *state;
    write_pfm("a.pfm", f->floats);
    f->floats[0] += 0.001f;
    f->floats[3] += 1;
    f->floats[6] = NAN;
    write_pfm("b.pfm", f->floats);
    u8 mask[WIDTH * HEIGHT] = {0};
    mask[3] = 255;
    write_levels("mask.png", mask, PNG_FORMAT_GRAY, WIDTH, HEIGHT);
    expect_different(f, "a.pfm b.pfm --map map.png --mask mask.png");
    u8 *pixels;
    u32 width, height;
    read_map("map.png", &pixels, &width, &height);
    assert_true(width > WIDTH && height > HEIGHT); // room for the legend
    const u8 cyan[3] = {0, 255, 255};
    assert_true(brightness(pixels) > 0 && brightness(pixels) < brightness(pixels + 3));
    assert_memory_equal(pixels + 6, cyan, 3);
    assert_true(brightness(pixels + 9) > 0 && pixels[9] == pixels[10] && pixels[10] == pixels[11]);
    assert_int_equal(brightness(pixels + 12), 0);
    // The legend: its bar gets brighter from end to end.
    u32 steps = 0, before = 0;
    const u8 *bar = pixels + ((size_t)(HEIGHT + 10) * width) * 3;
    for (u32 x = 40; x < 250; x++) {
        steps += brightness(bar + (size_t)x * 3) >= before;
        before = brightness(bar + (size_t)x * 3);
    }
    assert_true(steps > 200);
    free(pixels);
    // A map is drawn for the same pictures, too; a failed one leaves the old.
    expect_same(f, "a.pfm a.pfm --map map.png");
    read_map("map.png", &pixels, &width, &height);
    for (u32 x = 0; x < WIDTH; x++)
        assert_int_equal(brightness(pixels + (size_t)x * 3), 0);
    free(pixels);
}

enum { SIDE = 40 };

// SIDE x SIDE, grey; one pixel as given.
static void write_flat(const char *name, u32 x, u32 y, u8 level)
{
    u8 levels[SIDE * SIDE];
    memset(levels, 90, sizeof levels);
    levels[y * SIDE + x] = level;
    write_levels(name, levels, PNG_FORMAT_GRAY, SIDE, SIDE);
}

static bool is_grey(const u8 *rgb)
{
    return rgb[0] > 0 && rgb[0] == rgb[1] && rgb[1] == rgb[2];
}

// A spot is in the maps where filters carry it, and not elsewhere; SSIM has none where no window fits.
static void test_maps_of_perception(void **state)
{
    Fixture *f = *state;
    write_flat("a.png", 20, 15, 90);
    write_flat("b.png", 20, 15, 160);
    expect_different(f, "a.png b.png --flip-map flip.png --ssim-map ssim.png --map map.png");
    u8 *maps[2];
    u32 width, height;
    read_map("flip.png", &maps[0], &width, &height);
    read_map("ssim.png", &maps[1], &width, &height);
    for (u32 y = 0; y < SIDE; y++) {
        for (u32 x = 0; x < SIDE; x++) {
            const size_t at = ((size_t)y * width + x) * 3;
            const u32 dx = x > 20 ? x - 20 : 20 - x, dy = y > 15 ? y - 15 : 15 - y;
            assert_true(brightness(maps[0] + at) == 0 || (dx <= 10 && dy <= 10));
            const bool window = x >= 5 && y >= 5 && x < SIDE - 5 && y < SIDE - 5;
            assert_true(is_grey(maps[1] + at) == !window);
            assert_true(!window || (brightness(maps[1] + at) > 0) == (dx <= 5 && dy <= 5));
        }
    }
    const size_t spot = ((size_t)15 * width + 20) * 3;
    assert_true(brightness(maps[0] + spot) > 100 && brightness(maps[1] + spot) > 100);
    free(maps[0]);
    free(maps[1]);
    // The same pictures' maps are black, apart from where SSIM has nothing to say.
    expect_same(f, "a.png a.png --flip-map flip.png --ssim-map ssim.png");
    read_map("flip.png", &maps[0], &width, &height);
    read_map("ssim.png", &maps[1], &width, &height);
    assert_true(brightness(maps[0]) == 0 && is_grey(maps[1]));
    assert_true(brightness(maps[0] + spot) == 0 && brightness(maps[1] + spot) == 0);
    free(maps[0]);
    free(maps[1]);
    expect_trouble(f, "a.png b.png --flip-map flip.pfm", "the map is a PNG");
    expect_trouble(f, "a.png b.png --ssim-map ssim.jpg", ".png");
}

static void test_map_of_scores(void **state)
{
    Fixture *f = *state;
    f32 ones[VALUES];
    for (int i = 0; i < VALUES; i++)
        ones[i] = 1;
    ones[9] = 0;
    write_pfm("v.pfm", ones);
    write_pfm("a.pfm", f->floats);
    f->floats[0] += 1;
    f->floats[4] += 4;
    f->floats[8] -= 80;
    f->floats[9] += 0.001f; // without variance
    f->floats[12] = NAN;
    write_pfm("b.pfm", f->floats);
    expect_different(f, "a.pfm b.pfm --variance-a v.pfm --z-map z.png --flip-map flip.png "
                        "--ssim-map ssim.png");
    u8 *map;
    u32 width, height;
    read_map("z.png", &map, &width, &height);
    const u8 cyan[3] = {0, 255, 255};
    assert_true(brightness(map) > 0 && brightness(map) < brightness(map + 3));
    assert_true(brightness(map + 3) < brightness(map + 6));
    assert_memory_equal(map + 6, map + 9, 3);
    assert_memory_equal(map + 12, cyan, 3);
    assert_int_equal(brightness(map + 15), 0);
    free(map);
    // With a NaN there is neither FLIP nor SSIM anywhere.
    static const char *const NAMES[2] = {"flip.png", "ssim.png"};
    for (int i = 0; i < 2; i++) {
        read_map(NAMES[i], &map, &width, &height);
        assert_memory_equal(map, cyan, 3);
        assert_memory_equal(map + ((HEIGHT - 1) * (size_t)width + WIDTH - 1) * 3, cyan, 3);
        free(map);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_map, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_maps_of_perception, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_map_of_scores, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
