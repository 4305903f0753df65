// OpenEXR as bitmaps: what the library wrote, in every compression, is what is read; others are refused.
#ifdef CLRT_EXR

#include "image_bitmap_exr_fixture.h"

#include <math.h>

#define HALVES {EXR_PIXEL_HALF, EXR_PIXEL_HALF, EXR_PIXEL_HALF, EXR_PIXEL_HALF, EXR_PIXEL_HALF, \
                EXR_PIXEL_HALF}
#define FLOATS {EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT, EXR_PIXEL_FLOAT}

// tolerance: of compressions that lose, relative to the largest value.
static void check(const ExrCase *c, const char *names, BitmapType type, f64 tolerance)
{
    Bytes bytes = make_exr(c);
    const u32 channels = (u32)strlen(names);
    Bitmap bitmap = expect_bitmap(&bytes, EXR_WIDTH, EXR_HEIGHT, channels, type);
    for (u32 y = 0; y < EXR_HEIGHT; y++) {
        for (u32 x = 0; x < EXR_WIDTH; x++) {
            for (u32 k = 0; k < channels; k++) {
                const char name[] = {names[k], 0};
                const f64 right = (f64)exr_sample(x, y, name), value = bitmap_value(&bitmap, x, y, k);
                if (!(fabs(value - right) <= tolerance * 1024))
                    fail_msg("compression %d: %u %u %s is %g, not %g", c->compression, x, y, name, value,
                             right);
            }
        }
    }
    bitmap_destroy(&bitmap);
    bytes_end(&bytes);
}

static void test_compressions(void **state)
{
    (void)state;
    static const exr_compression_t EXACT[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE, EXR_COMPRESSION_ZIPS,
                                              EXR_COMPRESSION_ZIP, EXR_COMPRESSION_PIZ};
    for (size_t i = 0; i < sizeof EXACT / sizeof *EXACT; i++) {
        for (u32 tile = 0; tile <= 32; tile += 16) {
            ExrCase c = {.names = {"A", "B", "G", "R"}, .types = HALVES, .compression = EXACT[i],
                         .tile = tile};
            check(&c, "RGB", BITMAP_HALF, 0);
            c = (ExrCase){.names = {"B", "G", "R"}, .types = FLOATS, .compression = EXACT[i], .tile = tile};
            check(&c, "RGB", BITMAP_FLOAT, 0);
        }
    }
    // Values below 1024 need 10 bits, which PXR24 keeps.
    const ExrCase pxr24 = {.names = {"B", "G", "R"}, .types = FLOATS, .compression = EXR_COMPRESSION_PXR24};
    check(&pxr24, "RGB", BITMAP_FLOAT, 0);
    const ExrCase b44 = {.names = {"B", "G", "R"}, .types = HALVES, .compression = EXR_COMPRESSION_B44};
    check(&b44, "RGB", BITMAP_HALF, 0.25);
}

static void test_channels(void **state)
{
    (void)state;
    const ExrCase grey = {.names = {"A", "Y"}, .types = HALVES};
    check(&grey, "Y", BITMAP_HALF, 0);
    const ExrCase alone = {.names = {"Z"}, .types = FLOATS};
    check(&alone, "Z", BITMAP_FLOAT, 0);
    const ExrCase layer = {.names = {"A", "a.V", "b.B", "b.G", "b.R"}, .types = HALVES};
    check(&layer, "RGB", BITMAP_HALF, 0);
    const ExrCase both = {.names = {"B", "G", "R", "b.B", "b.G", "b.R"}, .types = HALVES};
    check(&both, "RGB", BITMAP_HALF, 0);
    const ExrCase mixed = {.names = {"B", "G", "R"},
                           .types = {EXR_PIXEL_HALF, EXR_PIXEL_UINT, EXR_PIXEL_FLOAT},
                           .compression = EXR_COMPRESSION_ZIP};
    check(&mixed, "RGB", BITMAP_FLOAT, 0);
    const ExrCase whole = {.names = {"Y"}, .types = {EXR_PIXEL_UINT}};
    check(&whole, "Y", BITMAP_FLOAT, 0);
}

static void test_places(void **state)
{
    (void)state;
    ExrCase c = {.names = {"B", "G", "R"}, .types = HALVES, .left = -40, .top = 1000,
                 .compression = EXR_COMPRESSION_ZIP};
    check(&c, "RGB", BITMAP_HALF, 0);
    c.tile = 20;
    check(&c, "RGB", BITMAP_HALF, 0);
    c.mip_maps = true;
    check(&c, "RGB", BITMAP_HALF, 0);
    c = (ExrCase){.names = {"B", "G", "R"}, .types = HALVES, .second_part = true};
    check(&c, "RGB", BITMAP_HALF, 0);
}

static void test_refusals(void **state)
{
    (void)state;
    const ExrCase chroma = {.names = {"BY", "RY", "Y"}, .types = HALVES};
    const ExrCase none = {.names = {"U", "V"}, .types = HALVES};
    Bytes bytes = make_exr(&chroma);
    expect_refusal(bytes.data, bytes.size, "luminance and chroma");
    bytes_end(&bytes);
    bytes = make_exr(&none);
    expect_refusal(bytes.data, bytes.size, "without channels R, G and B");
    // The flag of deep data in the version field.
    bytes.data[5] |= 8;
    expect_refusal(bytes.data, bytes.size, "");
    bytes_end(&bytes);
}

static u8 *find(const Bytes *bytes, const char *name)
{
    const size_t length = strlen(name) + 1;
    for (size_t i = 0; i + length < bytes->size; i++) {
        if (memcmp(bytes->data + i, name, length) == 0)
            return bytes->data + i + length;
    }
    fail_msg("no %s", name);
    return NULL;
}

// Data windows in the header of a file that is otherwise whole.
static void test_sizes(void **state)
{
    (void)state;
    static const i32 WINDOWS[][4] = {
        {0, 0, -1, -1},
        {5, 5, 2, 2},
        {0, 0, 29999, 29999},
        {0, 0, 15999999, 15999999},
        {0, 0, 0x7ffffffe, 0x7ffffffe},
        {-0x7fffffff, -0x7fffffff, 0x7fffffff, 0x7fffffff},
    };
    for (size_t i = 0; i < sizeof WINDOWS / sizeof *WINDOWS; i++) {
        for (u32 tile = 0; tile <= 16; tile += 16) {
            const ExrCase c = {.names = {"B", "G", "R"}, .types = FLOATS, .tile = tile,
                               .compression = EXR_COMPRESSION_ZIP};
            Bytes bytes = make_exr(&c);
            memcpy(find(&bytes, "dataWindow") + strlen("box2i") + 1 + 4, WINDOWS[i], 16);
            expect_refusal(bytes.data, bytes.size, "");
            bytes_end(&bytes);
        }
    }
}

static void test_broken(void **state)
{
    (void)state;
    for (u32 tile = 0; tile <= 32; tile += 32) {
        const ExrCase c = {.names = {"B", "G", "R"}, .types = HALVES, .tile = tile,
                           .compression = tile ? EXR_COMPRESSION_PIZ : EXR_COMPRESSION_ZIP};
        Bytes bytes = make_exr(&c);
        expect_sturdy(&bytes, 29);
        bytes_end(&bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_compressions), cmocka_unit_test(test_channels), cmocka_unit_test(test_places),
        cmocka_unit_test(test_refusals),     cmocka_unit_test(test_sizes),    cmocka_unit_test(test_broken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

#include "image_bitmap_fixture.h"

static void test_refused(void **state)
{
    (void)state;
    expect_refusal("\x76\x2f\x31\x01\x02\0\0\0", 8, "this build reads no OpenEXR");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#endif
