// Environments against integrals in double: what a map shows where, and what it sends to the eye from a pbr
// surface. Pixels of a picture are independent estimates of one number.
#include "estimate.h"

#include <unistd.h>

static const f64 pi = 3.14159265358979323846;

enum { WIDTH_MAX = 32, HEIGHT_MAX = 16 };

typedef struct Map {
    u32 width, height;
    f64 texel[HEIGHT_MAX][WIDTH_MAX];
} Map;

// The folder that maps are written to: scenes of tests look for files elsewhere.
static const char *folder(void)
{
    static char path[4096];
    return getcwd(path, sizeof path);
}

// Writes the map, whose values must be exact in it, as Radiance HDR of grey texels.
static void write_map(const Map *map, const char *path)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %u +X %u\n", map->height, map->width);
    for (u32 y = 0; y < map->height; y++) {
        for (u32 x = 0; x < map->width; x++) {
            int exponent;
            const f64 mantissa = frexp(map->texel[y][x], &exponent);
            const u8 m = (u8)(256 * mantissa), bytes[4] = {m, m, m, (u8)(m ? exponent + 128 : 0)};
            assert_true(ldexp(m, exponent - 8) == map->texel[y][x]);
            fwrite(bytes, 1, 4, file);
        }
    }
    assert_int_equal(fclose(file), 0);
}

static Map map_constant(u32 width, u32 height, f64 value)
{
    Map map = {.width = width, .height = height};
    for (u32 y = 0; y < height; y++)
        for (u32 x = 0; x < width; x++)
            map.texel[y][x] = value;
    return map;
}

// A sky that changes everywhere, of powers of two, with a sun 10^5 times as bright in one texel.
static Map map_sunny(void)
{
    Map map = map_constant(32, 16, 1);
    for (u32 y = 0; y < map.height; y++)
        for (u32 x = 0; x < map.width; x++)
            map.texel[y][x] = ldexp(1 + (x * 7 + y * 3) % 4, -(int)(y / 4) - (int)(x % 3));
    map.texel[4][20] = 98304;
    return map;
}

// Radiance of the direction, by the scene language's words.
static f64 map_radiance(const Map *map, f64 rotate, Vec3 d)
{
    const f64 turn = 0.5 + atan2(d.x, -d.z) / (2 * pi) + rotate / 360, v = acos(fmax(-1, fmin(1, d.y))) / pi;
    const f64 x = (turn - floor(turn)) * map->width - 0.5, y = v * map->height - 0.5;
    const f64 left = floor(x), above = floor(y), fx = x - left, fy = y - above;
    const u32 a = ((u32)left + map->width) % map->width, b = (a + 1) % map->width;
    const u32 top = above < 0 ? 0 : (u32)above,
              bottom = above + 1 < map->height ? (u32)(above + 1) : map->height - 1;
    return (1 - fy) * ((1 - fx) * map->texel[top][a] + fx * map->texel[top][b]) +
           fy * ((1 - fx) * map->texel[bottom][a] + fx * map->texel[bottom][b]);
}

typedef struct Surface {
    f64 base, metallic, roughness;
} Surface;

// brdf times cosine, of the scene language's section 5 with ior 1.5, for the normal +y.
static f64 reflected(const Surface *s, Vec3 to_eye, Vec3 to_light)
{
    const f64 nl = to_light.y, nv = fmax(to_eye.y, 1e-4);
    if (nl <= 0)
        return 0;
    const Vec3 h = vec_normalize(vec_add(to_eye, to_light));
    const f64 a2 = pow(s->roughness, 4), f0 = 0.04 + (s->base - 0.04) * s->metallic;
    const f64 f = f0 + (1 - f0) * pow(1 - vec_dot(to_eye, h), 5),
              d = a2 / (pi * pow(h.y * h.y * (a2 - 1) + 1, 2));
    const f64 vis = 0.5 / (nl * sqrt(a2 + (1 - a2) * nv * nv) + nv * sqrt(a2 + (1 - a2) * nl * nl));
    return nl * ((1 - f) * (1 - s->metallic) * s->base / pi + (s->roughness >= 0.02 ? f * d * vis : 0));
}

// Their integral over all directions, at points that lie evenly in each texel: what is linear between the
// centres of texels is summed without error.
static f64 expected_radiance(const Map *map, f64 rotate, const Surface *surface, Vec3 to_eye)
{
    const u32 rows = 320, columns = 640; // multiples of the map's
    f64 sum = 0;
    for (u32 i = 0; i < rows; i++) {
        const f64 angle = (i + 0.5) / rows * pi, solid = sin(angle) * pi / rows * 2 * pi / columns;
        for (u32 k = 0; k < columns && angle < pi / 2; k++) {
            const f64 turn = ((k + 0.5) / columns - rotate / 360) * 2 * pi;
            const Vec3 d = {sin(angle) * sin(turn), cos(angle), -sin(angle) * cos(turn)};
            sum += solid * map_radiance(map, rotate, d) * reflected(surface, to_eye, d);
        }
    }
    return sum;
}

static Picture render_surface(Device *device, const char *settings, f64 rotate, const Surface *surface,
                              Vec3 to_eye, u32 samples, u32 seed)
{
    char *text = text_of("image { size 32 32 samples %u seed %u }\nrender { max_depth 0 %s }\n"
                         "camera { position %.17g %.17g %.17g look_at 0 0 0 orthographic 1e-6 }\n"
                         "environment { file \"%s/environment_test.hdr\" rotate %.17g }\n"
                         "material m pbr { base_color %.17g metallic %.17g roughness %.17g }\n"
                         "plane { point 0 0 0 normal 0 1 0 material m }\n",
                         samples, seed, settings, to_eye.x, to_eye.y, to_eye.z, folder(), rotate,
                         surface->base, surface->metallic, surface->roughness);
    Picture picture = render_text(device, text, NULL);
    free(text);
    return picture;
}

static const Surface surfaces[] = {
    { 0.75, 0, 1 }, { 0.75, 0, 0.5 }, { 0.75, 1, 0.25 }, { 1, 1, 0.75 }, { 0.5, 0, 0.01 }
};
enum { SURFACES = sizeof surfaces / sizeof *surfaces };

static void expect_lit(Device *device, const Map *map, f64 rotate, const char *name)
{
    const Vec3 eyes[2] = {vec_normalize((Vec3){0.2, 1, 0.3}), vec_normalize((Vec3){-1, 0.4, 0.5})};
    write_map(map, "environment_test.hdr");
    for (int i = 0; i < SURFACES; i++) {
        for (int k = 0; k < 2; k++) {
            char *what = text_of("%s, surface %d, eye %d", name, i, k);
            Picture picture =
                render_surface(device, k ? "environment_samples 3" : "", rotate, &surfaces[i], eyes[k], 64,
                                             (u32)(2 * i + k));
            expect_estimate(estimate_of(&picture, 1), expected_radiance(map, rotate, &surfaces[i], eyes[k]),
                            what);
            picture_destroy(&picture);
            free(what);
        }
    }
}

static void test_constant(void **state)
{
    const Map map = map_constant(8, 4, 0.5);
    expect_lit(*state, &map, 0, "constant");
}

static void test_single(void **state)
{
    const Map map = map_constant(1, 1, 1);
    expect_lit(*state, &map, 30, "one texel");
}

static void test_sunny(void **state)
{
    const Map map = map_sunny();
    expect_lit(*state, &map, -70, "sun");
}

// What rays see: the map itself, by the formula.
// What a surface of base color 1 sends to the eye of light 1 from everywhere: its lobe summed over normals that lie
// evenly in the distribution, its body over directions that lie evenly under the cosine.
static f64 furnace_radiance(const Surface *s, Vec3 to_eye)
{
    enum { RINGS = 512, SPOKES = 512 };
    const f64 a2 = pow(s->roughness, 4), f0 = 0.04 + (1 - 0.04) * s->metallic;
    f64 sum = 0;
    for (u32 i = 0; i < RINGS; i++) {
        const f64 u = (i + 0.5) / RINGS, tangent2 = a2 * u / (1 - u), hy = 1 / sqrt(1 + tangent2);
        for (u32 k = 0; k < SPOKES; k++) {
            const f64 turn = (k + 0.5) / SPOKES * 2 * pi, hr = sqrt(1 - hy * hy);
            const Vec3 h = {hr * cos(turn), hy, hr * sin(turn)};
            const f64 vh = vec_dot(to_eye, h);
            const Vec3 l = vec_sub(vec_scale(h, 2 * vh), to_eye);
            const Vec3 flat = {sqrt(u) * cos(turn), sqrt(1 - u), sqrt(u) * sin(turn)};
            const f64 half = vec_dot(to_eye, vec_normalize(vec_add(to_eye, flat)));
            sum += (1 - s->metallic) * (1 - f0 - (1 - f0) * pow(1 - half, 5));
            if (l.y <= 0 || vh <= 0)
                continue;
            const f64 nv = to_eye.y, f = f0 + (1 - f0) * pow(1 - vh, 5);
            const f64 vis = 0.5 / (l.y * sqrt(a2 + (1 - a2) * nv * nv) + nv * sqrt(a2 + (1 - a2) * l.y * l.y));
            sum += f * vis * l.y * 4 * vh / hy;
        }
    }
    return sum / RINGS / SPOKES;
}

// Under light 1 from everywhere a surface sends back just what its lobe and body sum to: of a metal at most what it
// gets; of others a little more at most, since the language's body takes Fresnel's share at half-way normals.
static void test_furnace(void **state)
{
    const f64 roughnesses[] = {0.02, 0.05, 0.1, 0.25, 0.5, 0.75, 1}, metallics[] = {0, 0.5, 1};
    const Vec3 to_eye = vec_normalize((Vec3){0.6, 0.5, 0.3});
    const Map map = map_constant(1, 1, 1);
    write_map(&map, "environment_test.hdr");
    for (size_t i = 0; i < sizeof roughnesses / sizeof *roughnesses; i++) {
        for (size_t k = 0; k < sizeof metallics / sizeof *metallics; k++) {
            const Surface surface = {1, metallics[k], roughnesses[i]};
            const f64 expected = furnace_radiance(&surface, to_eye);
            char *what = text_of("furnace, roughness %g, metallic %g", surface.roughness, surface.metallic);
            Picture picture = render_surface(*state, "", 0, &surface, to_eye, 16, (u32)(3 * i + k));
            assert_true(expected <= (surface.metallic < 1 ? 1.05 : 1 + 1e-9));
            expect_estimate(estimate_of(&picture, 0), expected, what);
            picture_destroy(&picture);
            free(what);
        }
    }
}

static void test_seen(void **state)
{
    const Map map = map_sunny();
    static const f64 turns[] = {0, 90, -123.5};
    write_map(&map, "environment_test.hdr");
    for (int i = 0; i < 3; i++) {
        char *text = text_of("image { size 40 30 }\ncamera { look_at 0.3 0.9 -0.2 fov 120 }\n"
                             "environment { file \"%s/environment_test.hdr\" rotate %.17g intensity 0.5 }\n",
                             folder(), turns[i]);
        Picture picture = render_text(*state, text, NULL);
        const Vec3 w = vec_normalize((Vec3){ -0.3, -0.9, 0.2 }),
                   u = vec_normalize(vec_cross((Vec3){ 0, 1, 0 }, w));
        const Vec3 v = vec_cross(w, u);
        const f64 k = tan(60 * pi / 180);
        for (u32 y = 0; y < picture.height; y++) {
            for (u32 x = 0; x < picture.width; x++) {
                const f64 px = (2 * (x + 0.5) / 40 - 1) * 40 / 30 * k, py = (1 - 2 * (y + 0.5) / 30) * k;
                const Vec3 d = vec_normalize(vec_sub(vec_add(vec_scale(u, px), vec_scale(v, py)), w));
                const f64 expected = 0.5 * map_radiance(&map, turns[i], d),
                          found = (f64)pixel_at(&picture, x, y)[0];
                // A texel's place is off by what rounding makes of a turn.
                if (!(fabs(found - expected) <= 3e-5 * expected + (expected > 8 ? 1.0 : 3e-5)))
                    fail_msg("rotate %g, pixel %u %u: %.9g is not %.9g", turns[i], x, y, found, expected);
            }
        }
        picture_destroy(&picture);
        free(text);
    }
}

// Under light that is the same from everywhere, prefiltering loses nothing but the steps of its table.
static void test_prefiltered_constant(void **state)
{
    const Map map = map_constant(8, 4, 0.5);
    const Vec3 eye = vec_normalize((Vec3){0.2, 1, 0.3});
    write_map(&map, "environment_test.hdr");
    for (int i = 0; i < SURFACES; i++) {
        Picture picture =
            render_surface(*state, "environment_lighting prefiltered", 0, &surfaces[i], eye, 4, 0);
        const f64 found = (f64)picture.rgb[0], expected = expected_radiance(&map, 0, &surfaces[i], eye);
        print_message("prefiltered, surface %d: %.6f, exact %.6f\n", i, found, expected);
        assert_true(fabs(found - expected) <= 0.004 * expected);
        picture_destroy(&picture);
    }
}

// A mild sky on a diffuse surface: the irradiance map has it, within the width of its texels.
static void test_prefiltered_diffuse(void **state)
{
    Map map = map_constant(16, 8, 0.25);
    for (u32 y = 0; y < 4; y++)
        for (u32 x = 4; x < 9; x++)
            map.texel[y][x] = 2;
    const Surface chalk = {0.75, 0, 1};
    const Vec3 eye = vec_normalize((Vec3){0.2, 1, 0.3});
    write_map(&map, "environment_test.hdr");
    Picture picture = render_surface(*state, "environment_lighting prefiltered", 20, &chalk, eye, 4, 0);
    const f64 found = (f64)picture.rgb[0], expected = expected_radiance(&map, 20, &chalk, eye);
    print_message("prefiltered, chalk: %.6f, exact %.6f\n", found, expected);
    assert_true(fabs(found - expected) <= 0.03 * expected);
    picture_destroy(&picture);
}

// The error falls faster than with independent samples, whose slope is -1/2.
static void test_slope(void **state)
{
    const Vec3 eye = vec_normalize((Vec3){0.2, 1, 0.3});
    const Map map = map_sunny();
    write_map(&map, "environment_test.hdr");
    for (int i = 0; i < SURFACES; i++) {
        f64 deviation[2];
        for (int k = 0; k < 2; k++) {
            Picture picture = render_surface(*state, "", 0, &surfaces[i], eye, k ? 256 : 4, 0);
            deviation[k] = estimate_of(&picture, 1).error * 32;
            picture_destroy(&picture);
        }
        const f64 slope = log2(deviation[1] / deviation[0]) / 6;
        print_message("surface %d: deviation of a pixel %.4g with 4 samples, %.4g with 256: slope %.2f\n", i,
                      deviation[0], deviation[1], slope);
        assert_true(slope < -0.6);
    }
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_seen, device),
        cmocka_unit_test_prestate(test_constant, device), cmocka_unit_test_prestate(test_furnace, device),
        cmocka_unit_test_prestate(test_single, device),
        cmocka_unit_test_prestate(test_sunny, device),
        cmocka_unit_test_prestate(test_slope, device),
        cmocka_unit_test_prestate(test_prefiltered_constant, device),
        cmocka_unit_test_prestate(test_prefiltered_diffuse, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    remove("environment_test.hdr");
    device_close(device);
    return failed;
}
