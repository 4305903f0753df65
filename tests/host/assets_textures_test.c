// Scenes with images: what is shared, what is released, what is said of bad files and where.
#include "assets_fixture.h"
#include "scene_parse_fixture.h"

#include <png.h>

#ifdef CLRT_EXR
#include "image_bitmap_exr_fixture.h"
#endif

#include "assets/assets.h"

static void write_png(const char *name, u32 width, u32 height, u8 level)
{
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = PNG_FORMAT_GRAY};
    u8 levels[64];
    memset(levels, level, sizeof levels);
    assert_true(width * height <= sizeof levels);
    assert_true(png_image_write_to_file(&image, name, 0, levels, 0, NULL));
}

// One pixel of 1, 1/2, 1/4.
#define HDR "#?RADIANCE\n\n-Y 1 +X 1\n\x80\x40\x20\x81"

// The parser refuses what is not drawn yet, so that only errors of what is read here are counted.
static Parsed load_text(const char *text)
{
    Parsed parsed = parse_bytes(text, strlen(text));
    assert_non_null(parsed.scene);
    diagnostics_destroy(parsed.diagnostics);
    parsed.diagnostics = diagnostics_create();
    assert_non_null(parsed.diagnostics);
    if (!assets_load(parsed.scene, parsed.arena, parsed.diagnostics, &parsed.error))
        fail_msg("%s", parsed.error.text);
    free(parsed.messages);
    parsed.messages = printed(parsed.diagnostics);
    return parsed;
}

static void release(Parsed *parsed)
{
    assets_release(parsed->scene);
    assert_int_equal(parsed->scene->bitmap_count, 0);
    assert_null(parsed->scene->bitmaps);
    for (u32 i = 0; i < parsed->scene->texture_count; ++i)
        assert_null(parsed->scene->textures[i].bitmap);
    assert_null(parsed->scene->environment.bitmap);
    assets_release(parsed->scene);
    parsed_end(parsed);
}

static void expect_messages(const char *text, const char *expected)
{
    Parsed parsed = load_text(text);
    assert_string_equal(parsed.messages, expected);
    release(&parsed);
}

static void test_sharing(void **state)
{
    (void)state;
    write_png("a.png", 3, 2, 51);
    write_text("sky.hdr", HDR);
    assert_int_equal(symlink("a.png", "link.png"), 0);
    Parsed p = load_text("texture a image { file \"a.png\" }\ntexture c checker { colors 0 1 }\n"
                         "texture b image { file \"./a.png\" color linear }\n"
                         "texture d image { file \"link.png\" }\ntexture e image { file \"sky.hdr\" }\n"
                         "texture f image { file \"a.png\" filter nearest }\n"
                         "environment { file \"sky.hdr\" }\n");
    assert_string_equal(p.messages, "");
    assert_int_equal(p.scene->bitmap_count, 2);
    const Texture *textures = p.scene->textures;
    const Bitmap *bitmap = textures[0].bitmap, *sky = textures[4].bitmap;
    assert_ptr_equal(bitmap, &p.scene->bitmaps[0]);
    assert_ptr_equal(sky, &p.scene->bitmaps[1]);
    assert_null(textures[1].bitmap);
    assert_ptr_equal(textures[2].bitmap, bitmap);
    assert_ptr_equal(textures[3].bitmap, bitmap);
    assert_ptr_equal(textures[5].bitmap, bitmap);
    assert_ptr_equal(p.scene->environment.bitmap, sky);
    assert_int_equal(bitmap->type, BITMAP_U8);
    assert_int_equal(bitmap->width, 3);
    assert_true(bitmap_value(bitmap, 2, 1, 0) == 0.2);
    assert_true(bitmap_value(sky, 0, 0, 2) == 0.25);
    release(&p);
}

static void test_none(void **state)
{
    (void)state;
    Parsed p = load_text("texture c checker { colors 0 1 }\nsphere { center 0 0 0 radius 1 }\n");
    assert_int_equal(p.scene->bitmap_count, 0);
    release(&p);
}

// Who takes the texels puts NULL in their place.
static void test_taken(void **state)
{
    (void)state;
    write_png("a.png", 3, 2, 51);
    Parsed p = load_text("texture a image { file \"a.png\" }");
    Bitmap taken = p.scene->bitmaps[0];
    p.scene->bitmaps[0].texels = NULL;
    release(&p);
    assert_true(bitmap_value(&taken, 0, 0, 0) == 0.2);
    bitmap_destroy(&taken);
}

static void test_errors(void **state)
{
    (void)state;
    write_text("text.png", "no picture");
    write_text("cut.hdr", "#?RADIANCE\n\n-Y 2 +X 1\n\x80\x40\x20\x81");
    write_text("huge.hdr", "#?RADIANCE\n\n-Y 16000000 +X 16000000\n");
    write_png("a.png", 3, 2, 51);
    expect_messages("texture a image { file \"none.png\" }\ntexture b image { file \"none.png\" }\n"
                    "texture c image { scale 1 1 file \"text.png\" }\ntexture d image { file \".\" }\n"
                    "texture e image {\n  file \"cut.hdr\"\n}\ntexture f image { file \"huge.hdr\" }",
                    "t:1:19: error: cannot read 'none.png': No such file or directory\n"
                    "    texture a image { file \"none.png\" }\n                      ^~~~\n"
                    "t:3:29: error: cannot read 'text.png': not a PNG, JPEG, Radiance HDR or OpenEXR file\n"
                    "    texture c image { scale 1 1 file \"text.png\" }\n"
                    "                                ^~~~\n"
                    "t:4:19: error: cannot read '.': Is a directory\n"
                    "    texture d image { file \".\" }\n                      ^~~~\n"
                    "t:6:3: error: cannot read 'cut.hdr': the file ends too early\n"
                    "      file \"cut.hdr\"\n      ^~~~\n"
                    "t:8:19: error: cannot read 'huge.hdr': no memory for 16000000 x 16000000 texels of 12 "
                    "bytes\n"
                    "    texture f image { file \"huge.hdr\" }\n                      ^~~~\n");
    expect_messages("environment { file \"a.png\" }",
                    "t:1:15: error: 'a.png' has levels, no radiance; an environment is Radiance HDR or "
                    "OpenEXR\n"
                    "    environment { file \"a.png\" }\n                  ^~~~\n");
    expect_messages("environment { file \"none.hdr\" }",
                    "t:1:15: error: cannot read 'none.hdr': No such file or directory\n"
                    "    environment { file \"none.hdr\" }\n                  ^~~~\n");
}

#ifdef CLRT_EXR
static void test_repair(void **state)
{
    (void)state;
    const ExrCase c = {.names = {"B", "G", "R"}, .types = {EXR_PIXEL_HALF, EXR_PIXEL_HALF, EXR_PIXEL_HALF}};
    Bytes bytes = make_exr(&c);
    memcpy(bytes.data + bytes.size - 4, "\x00\x7c\x00\xfe", 4); // the last two reds: infinite, and no number
    write_bytes("sky.exr", bytes.data, bytes.size);
    bytes_end(&bytes);
    Parsed p = load_text("environment { file \"sky.exr\" }");
    assert_string_equal(p.messages,
                        "t:1:15: warning: 'sky.exr' has 2 values below 0, infinite or not a number; these "
                        "are taken as 0, or as the largest there is\n"
                        "    environment { file \"sky.exr\" }\n                  ^~~~\n");
    const Bitmap *bitmap = p.scene->environment.bitmap;
    assert_non_null(bitmap);
    assert_true(bitmap_value(bitmap, EXR_WIDTH - 2, EXR_HEIGHT - 1, 0) == 65504);
    assert_true(bitmap_value(bitmap, EXR_WIDTH - 1, EXR_HEIGHT - 1, 0) == 0);
    release(&p);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sharing),
        cmocka_unit_test(test_none),
        cmocka_unit_test(test_taken),
        cmocka_unit_test(test_errors),
#ifdef CLRT_EXR
        cmocka_unit_test(test_repair),
#endif
    };
    char folder[FIXTURE_PATH_MAX];
    enter_folder(folder);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    leave_folder(folder);
    return failed;
}
