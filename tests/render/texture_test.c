// Image textures and normal maps beside what the scene language says of them, computed in double.
#include "support.h"

#include <math.h>

#include "scene/diagnostics.h"

// The layout of a scene whose image textures all have this picture; their files are not read.
static Layout *layout_with(const char *text, const Bitmap *bitmap)
{
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    Error error = {0};
    Scene *scene = scene_parse_text("scene", text, strlen(text), arena, diagnostics, &error);
    if (!scene || diagnostics_error_count(diagnostics)) {
        diagnostics_print(diagnostics, stdout);
        fail_msg("the scene of the test has errors: %s", error.text);
    }
    for (u32 i = 0; i < scene->texture_count; i++)
        scene->textures[i].bitmap = bitmap;
    Layout *layout = layout_create(scene, &error);
    if (!layout)
        fail_msg("%s", error.text);
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return layout;
}

static Picture render_with(Device *device, const char *text, const Bitmap *bitmap)
{
    Layout *layout = layout_with(text, bitmap);
    Picture picture = render_layout(device, layout, NULL);
    layout_destroy(layout);
    return picture;
}

// ---- image textures -------------------------------------------------------------------------

static Bitmap random_bitmap(u32 width, u32 height, u32 channels, BitmapType type)
{
    Bitmap bitmap;
    Error error = {0};
    u64 state = 7 * width + height + channels + (u32)type;
    assert_true(bitmap_create(&bitmap, width, height, channels, type, &error));
    for (u32 i = 0; i < width * height * channels; i++) {
        const f64 x = random_unit(&state);
        switch (type) {
        case BITMAP_U8: ((u8 *)bitmap.texels)[i] = (u8)(256 * x); break;
        case BITMAP_U16: ((u16 *)bitmap.texels)[i] = (u16)(65536 * x); break;
        case BITMAP_HALF: ((u16 *)bitmap.texels)[i] = (u16)(0x3c00 * x); break; // below 1, with subnormals
        case BITMAP_FLOAT: ((f32 *)bitmap.texels)[i] = (f32)(4 * x); break;
        }
    }
    return bitmap;
}

typedef struct Lookup {
    const Bitmap *bitmap;
    f64 scale[2];
    bool nearest, srgb;
} Lookup;

static f64 texel(const Lookup *l, i64 x, i64 y, u32 channel)
{
    const Bitmap *b = l->bitmap;
    const u32 column = (u32)((x % b->width + b->width) % b->width);
    const u32 row = (u32)((y % b->height + b->height) % b->height);
    const f64 c = bitmap_value(b, column, row, b->channels == 3 ? channel : 0);
    if (!l->srgb || b->type == BITMAP_HALF || b->type == BITMAP_FLOAT)
        return c;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

// False where rounding may choose another texel.
static bool look_up(const Lookup *l, f64 u, f64 v, u32 channel, f64 *value)
{
    const f64 x = u * l->scale[0] * l->bitmap->width, y = (1 - v * l->scale[1]) * l->bitmap->height;
    if (l->nearest) {
        *value = texel(l, (i64)floor(x), (i64)floor(y), channel);
        return fabs(x - round(x)) > 1e-3 && fabs(y - round(y)) > 1e-3;
    }
    const i64 left = (i64)floor(x - 0.5), top = (i64)floor(y - 0.5);
    const f64 fx = x - 0.5 - (f64)left, fy = y - 0.5 - (f64)top;
    *value = (1 - fy) * ((1 - fx) * texel(l, left, top, channel) + fx * texel(l, left + 1, top, channel)) +
             fy * ((1 - fx) * texel(l, left, top + 1, channel) + fx * texel(l, left + 1, top + 1, channel));
    return true;
}

enum { SIDE = 23 };
static const f64 view = 3.1; // units across

// A plane on which u = x, v = y, seen from the front by ambient light alone, about (cx, cy).
static void check_plane(Device *device, const Lookup *l, f64 cx, f64 cy, f64 tolerance)
{
    char *text = text_of("image { size %d %d }\nambient 1\n"
                         "camera { position %.17g %.17g 5 look_at %.17g %.17g 0 orthographic %.17g }\n"
                         "texture t image { file \"t\" scale %.17g %.17g filter %s color %s }\n"
                         "material m phong { diffuse 0 ambient t }\n"
                         "plane { point 0 0 0 normal 0 0 1 material m }\n",
                         SIDE, SIDE, cx, cy, cx, cy, view, l->scale[0], l->scale[1],
                         l->nearest ? "nearest" : "bilinear", l->srgb ? "srgb" : "linear");
    Picture picture = render_with(device, text, l->bitmap);
    u32 compared = 0;
    for (u32 y = 0; y < SIDE; y++) {
        for (u32 x = 0; x < SIDE; x++) {
            const f64 u = cx + (2 * (x + 0.5) / SIDE - 1) * view / 2;
            const f64 v = cy + (1 - 2 * (y + 0.5) / SIDE) * view / 2;
            for (u32 k = 0; k < 3; k++) {
                f64 expected;
                if (!look_up(l, u, v, k, &expected))
                    continue;
                const f64 found = (f64)pixel_at(&picture, x, y)[k];
                compared++;
                if (!(fabs(found - expected) <= tolerance))
                    fail_msg("%ux%ux%u of type %d, scale %g %g, %s, %s, at (%.9g, %.9g): %.9g, not %.9g",
                             l->bitmap->width, l->bitmap->height, l->bitmap->channels, (int)l->bitmap->type,
                             l->scale[0], l->scale[1], l->nearest ? "nearest" : "bilinear",
                             l->srgb ? "srgb" : "linear", u, v, found, expected);
            }
        }
    }
    assert_true(compared > SIDE * SIDE * 2);
    picture_destroy(&picture);
    free(text);
}

static void test_lookups(void **state)
{
    static const struct {
        u32 width, height, channels;
        BitmapType type;
        f64 scale[2];
        bool nearest, srgb;
        f64 cx, cy;
    } cases[] = {
        {4, 3, 3, BITMAP_U8, {1, 1}, false, true, 0, 0},
        {4, 3, 3, BITMAP_U8, {1, 1}, true, true, 0.25, 0.5},
        {5, 2, 1, BITMAP_U8, {-1.5, 0.75}, false, false, 0, 0},
        {3, 7, 3, BITMAP_U16, {0.5, -2}, false, true, 0, 0},
        {3, 7, 1, BITMAP_U16, {0.5, -2}, true, false, 0, 0},
        {6, 5, 3, BITMAP_HALF, {1.25, 1}, false, true, 0, 0},
        {2, 9, 3, BITMAP_FLOAT, {1, 0.3}, false, true, 0, 0},
        {1, 1, 3, BITMAP_U8, {3, 3}, false, true, 0, 0},
        {1, 6, 3, BITMAP_FLOAT, {1, 1}, false, false, 0.5, 0.5},
        {8, 8, 3, BITMAP_U8, {0.1, 0.7}, false, false, 1000, -2000},
        {8, 8, 3, BITMAP_FLOAT, {0.1, 0.7}, true, false, 1e6, 3e6},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Bitmap bitmap =
            random_bitmap(cases[i].width, cases[i].height, cases[i].channels, cases[i].type);
        const Lookup l = {&bitmap, {cases[i].scale[0], cases[i].scale[1]}, cases[i].nearest, cases[i].srgb};
        check_plane(*state, &l, cases[i].cx, cases[i].cy, 1e-5);
        bitmap_destroy(&bitmap);
    }
}

// A number reads one channel and no curve, whatever `color` says; the factor of a file's material multiplies.
static void test_constant(void **state)
{
    u8 texel_bytes[3] = {51, 102, 204};
    const Bitmap bitmap = {.width = 1, .height = 1, .channels = 3, .type = BITMAP_U8, .texels = texel_bytes};
    Picture picture = render_with(*state,
                                  "image { size 2 2 }\nambient 0.5\n"
                                  "texture t image { file \"t\" }\n"
                                  "material m pbr { base_color 1 occlusion t }\n"
                                  "plane { point 0 0 -1 normal 0 0 1 material m }\n",
                                  &bitmap);
    for (u32 k = 0; k < 12; k++)
        assert_true(fabs((f64)picture.rgb[k] - 0.5 * 51 / 255) < 1e-7);
    picture_destroy(&picture);
}

// ---- normal maps ----------------------------------------------------------------------------

// A float map that is one normal, given in tangent space.
static Bitmap normal_bitmap(f32 texel[3], Vec3 n)
{
    texel[0] = (f32)(0.5 + n.x / 2);
    texel[1] = (f32)(0.5 + n.y / 2);
    texel[2] = (f32)(0.5 + n.z / 2);
    return (Bitmap){.width = 1, .height = 1, .channels = 3, .type = BITMAP_FLOAT, .texels = texel};
}

#define ALL_SHAPES(material)                                                                                 \
    "plane { point 0 -1 0 normal 0 1 0 " material " }\n"                                                     \
    "sphere { center -2 0 -6 radius 0.9 " material " }\n"                                                    \
    "sphere { center 0 0 0 radius 0.9 scale 1 0.5 1 translate -2 1.5 -6 " material " }\n"                    \
    "box { center 0 0 -6 size 1.2 rotate y 30 rotate x 20 " material " }\n"                                  \
    "cylinder { base 2 -0.8 -6 top 2.2 0.8 -6 radius 0.6 " material " }\n"                                   \
    "cone { base 0 0.8 -6 top 0.2 2 -6 radius 0.3 top_radius 0.6 " material " }\n"                           \
    "torus { center 2 1.6 -6 axis 0.3 1 0.5 major 0.5 minor 0.2 " material " }\n"                            \
    "tetrahedron { center -1 -0.4 -4 size 0.8 " material " }\n"                                              \
    "disk { center 1 -0.4 -4 normal 0.2 0.3 1 radius 0.4 " material " }\n"                                   \
    "triangle { vertices 0 -0.9 -3 0.5 -0.9 -3 0.2 -0.3 -3 normals 0 0 1 0.3 0 1 0 0.3 1\n"                  \
    "    uvs 0 0 2 1 -1 3 " material " }\n"                                                                  \
    "object pair { box { center 0 0 0 size 0.5 " material " } sphere { center 0.5 0 0 radius 0.2 " material  \
    " } }\ninstance pair { scale -1 2 1 rotate z 40 translate 3 0 -4 }\n"

// A map that tilts nothing leaves every shape as it is.
static void test_flat_map(void **state)
{
    static const char look[] = "image { size 90 60 }\nlight point { position 3 5 0 }\nrender { shadows off }\n"
                               "texture t image { file \"t\" }\n";
    f32 texel_values[3];
    const Bitmap flat = normal_bitmap(texel_values, (Vec3){0, 0, 1});
    char *plain = text_of("%smaterial m phong { specular 0.3 }\n%s", look, ALL_SHAPES("material m"));
    char *mapped = text_of("%smaterial m phong { specular 0.3 normal_map t }\n%s", look, ALL_SHAPES("material m"));
    Picture a = render_with(*state, plain, &flat), b = render_with(*state, mapped, &flat);
    for (u32 i = 0; i < 3 * a.width * a.height; i++)
        if (!(fabs((f64)a.rgb[i] - (f64)b.rgb[i]) <= 2e-6))
            fail_msg("value %u of pixel %u: %.9g, with a flat map %.9g", i % 3, i / 3, (f64)a.rgb[i], (f64)b.rgb[i]);
    picture_destroy(&a);
    picture_destroy(&b);
    free(plain);
    free(mapped);
}

// What a light from `towards` shows of a shape that fills the view, under a map of one normal.
static f64 lit_by(Device *device, const char *shape, Vec3 map, Vec3 towards)
{
    f32 texel_values[3];
    const Bitmap bitmap = normal_bitmap(texel_values, map);
    char *text = text_of("image { size 1 1 }\nambient 0\ncamera { position 0 0 5 look_at 0 0 0 fov 1 }\n"
                         "light directional { direction %.17g %.17g %.17g }\n"
                         "texture t image { file \"t\" }\nmaterial m phong { diffuse 1 normal_map t }\n%s",
                         -towards.x, -towards.y, -towards.z, shape);
    Picture picture = render_with(device, text, &bitmap);
    const f64 value = (f64)picture.rgb[0];
    picture_destroy(&picture);
    free(text);
    return value;
}

// The normal (0.48, 0.64, 0.6) of tangent space in shapes whose tangents are known where the camera looks.
static void test_tilted(void **state)
{
    static const struct {
        const char *shape;
        Vec3 t, b, n; // where it is hit
    } cases[] = {
        {"plane { point 0 0 0 normal 0 0 1 material m }", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        // From behind: t is to the left here, and the tilted normal as a whole is turned round.
        {"plane { point 0 0 0 normal 0 0 -1 material m }", {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {"box { center 0 0 0 size 2 material m }", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"box { center 0 0 0 size 2 scale -1 1 1 material m }", {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"box { center 0 0 0 size 2 rotate z 90 material m }", {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
        {"sphere { center 0 0 0 radius 1 material m }", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"sphere { center 0 0 0 radius 1 scale 1 2 0.5 material m }", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"disk { center 0 0 0 normal 0 0 1 radius 1 scale 1 -2 1 material m }", {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {"cylinder { base 0 -1 0 top 0 1 0 radius 1 material m }", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"torus { center 0 0 0 axis 0 1 0 major 2 minor 1 material m }", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"triangle { vertices -3 -3 0 3 -3 0 0 3 0 uvs 0 0 0 1 -1 0.5 material m }",
         {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
        {"triangle { vertices -3 -3 0 3 -3 0 0 3 0 uvs 0 0 -1 0 -0.5 1 material m }",
         {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {"object o { box { center 0 0 0 size 1 material m } sphere { center 3 3 0 radius 0.5 } }\n"
         "instance o { scale 2 -2 1 rotate z 90 }", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    };
    static const Vec3 map = {0.48, 0.64, 0.6};
    static const Vec3 lights[] = {{0, 0, 1}, {0.6, 0, 0.8}, {0, 0.6, 0.8}, {0.36, -0.48, 0.8}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Vec3 n = vec_add(vec_add(vec_scale(cases[i].t, map.x), vec_scale(cases[i].b, map.y)),
                               vec_scale(cases[i].n, map.z));
        for (size_t k = 0; k < sizeof lights / sizeof *lights; k++) {
            const f64 expected = fmax(0, vec_dot(n, lights[k]));
            const f64 found = lit_by(*state, cases[i].shape, map, lights[k]);
            if (!(fabs(found - expected) <= 2e-3)) // the ray of the pixel's centre is not quite the axis
                fail_msg("%s, light %zu: %.9g, not %.9g", cases[i].shape, k, found, expected);
        }
    }
}

// Normals tilted by 80 degrees, any way, on a mirror under a bright sky: never brighter than the sky, and where the
// normal faces away from the eye the surface mirrors as if it were flat. Light from below gives nothing.
static void test_grazing(void **state)
{
    const f64 tilt = 80 * acos(-1) / 180;
    for (u32 i = 0; i < 8; i++) {
        const f64 angle = i * acos(-1) / 4;
        const Vec3 n = {sin(tilt) * cos(angle), sin(tilt) * sin(angle), cos(tilt)};
        f32 texel_values[3];
        const Bitmap bitmap = normal_bitmap(texel_values, n);
        Picture picture = render_with(*state,
                                      "image { size 40 30 }\nambient 0\nbackground 1\n"
                                      "camera { position 0 0.3 0 look_at 0 0 -3 fov 30 }\n"
                                      "light point { position 0 -0.5 -3 }\nrender { shadows off }\n"
                                      "texture t image { file \"t\" }\n"
                                      "material m phong { diffuse 1 specular 1 reflect 1 normal_map t }\n"
                                      "plane { point 0 0 0 normal 0 1 0 material m }\n",
                                      &bitmap);
        for (u32 y = 0; y < picture.height; y++) {
            for (u32 x = 0; x < picture.width; x++) {
                const f64 k = tan(acos(-1) / 12), px = (2 * (x + 0.5) / 40 - 1) * k * 40 / 30;
                const Vec3 w = vec_normalize((Vec3){0, 0.3, 3}), up = {0, w.z, -w.y};
                const f64 py = (1 - 2 * (y + 0.5) / 30) * k;
                const Vec3 d = vec_sub(vec_add((Vec3){px, 0, 0}, vec_scale(up, py)), w);
                // u runs along x, v along -z.
                const f64 facing = -vec_dot((Vec3){n.x, n.z, -n.y}, vec_normalize(d));
                const f64 value = (f64)pixel_at(&picture, x, y)[0];
                const bool below = value == 0 && facing > 0; // mirrored to below the surface
                if (d.y >= 0 || fabs(facing) < 1e-4)
                    continue;
                if (!(below || fabs(value - 1) < 1e-6))
                    fail_msg("tilted to %u/8, pixel (%u, %u), facing %.3g: %.9g", i, x, y, facing, value);
            }
        }
        picture_destroy(&picture);
    }
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_lookups, device),  cmocka_unit_test_prestate(test_constant, device),
        cmocka_unit_test_prestate(test_flat_map, device), cmocka_unit_test_prestate(test_tilted, device),
        cmocka_unit_test_prestate(test_grazing, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
