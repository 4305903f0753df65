// White furnace: under light 1 from everywhere each material, over its parameters, sends to the eye what its
// formulas sum to. One picture has a tile of a plane for each material, seen at the same angle.
#include "brdf.h"
#include "statistics.h"

enum { COLUMNS = 8, PIXELS = 12, INNER = PIXELS - 2, SAMPLES = 64, MATTERS_MAX = 64 };

typedef struct Matters {
    Matter matter[MATTERS_MAX];
    u32 count;
} Matters;

static void put(Matters *m, Matter matter)
{
    assert_true(m->count < MATTERS_MAX);
    matter.ior = matter.ior > 0 ? matter.ior : 1.5;
    m->matter[m->count++] = matter;
}

static Matters matters_make(void)
{
    static const f64 exponents[] = {0, 1, 10, 100, 1e4, 1e6},
                     roughnesses[] = {0, 0.01, 0.02, 0.1, 0.25, 0.5, 0.75, 1};
    Matters m = {.count = 0};
    for (u32 i = 0; i < 6; i++) {
        put(&m, (Matter){.kind = "phong", .specular = 1, .shininess = exponents[i]});
        put(&m, (Matter){.kind = "blinn_phong", .specular = 1, .shininess = exponents[i]});
    }
    put(&m, (Matter){.kind = "phong", .diffuse = 1});
    put(&m, (Matter){.kind = "blinn_phong", .diffuse = 1});
    put(&m, (Matter){.kind = "phong", .reflect = 1});
    put(&m, (Matter){.kind = "phong", .reflect = 1, .fresnel = true, .ior = 1.75});
    put(&m, (Matter){.kind = "phong", .reflect = 1, .transmit = 1, .fresnel = true});
    put(&m, (Matter){.kind = "phong", .reflect = 1, .transmit = 1, .fresnel = true, .ior = 0.625});
    put(&m, (Matter){.kind = "phong", .transmit = 0.75, .reflect = 0.125, .ior = 0.625});
    put(&m, (Matter){.kind = "phong",
                     .diffuse = 0.25,
                     .specular = 0.25,
                     .shininess = 30,
                     .reflect = 0.25,
                     .transmit = 0.25});
    put(&m, (Matter){.kind = "blinn_phong",
                     .diffuse = 0.5,
                     .specular = 0.375,
                     .shininess = 300,
                     .reflect = 0.125,
                     .fresnel = true});
    for (u32 i = 0; i < 8; i++)
        for (u32 k = 0; k < 3; k++)
            put(&m, (Matter){.kind = "pbr", .diffuse = 1, .roughness = roughnesses[i], .metallic = k / 2.0});
    put(&m, (Matter){.kind = "pbr", .diffuse = 0.5, .roughness = 0.375, .metallic = 0.25});
    put(&m, (Matter){.kind = "pbr", .diffuse = 1, .roughness = 0.5, .transmit = 1});
    put(&m, (Matter){.kind = "pbr", .diffuse = 0.5, .roughness = 0, .transmit = 0.5});
    put(&m,
        (Matter){
            .kind = "pbr", .diffuse = 0.5, .roughness = 0.5, .transmit = 0.5, .metallic = 0.25, .ior = 2.5});
    put(&m, (Matter){.kind = "pbr", .diffuse = 0.75, .roughness = 0.25, .transmit = 0.75, .ior = 0.625});
    return m;
}

static void describe(const Matter *m, char *text, size_t size)
{
    if (strcmp(m->kind, "pbr") == 0)
        snprintf(text, size, "pbr %g rough %g metal %g thr %g", m->diffuse, m->roughness, m->metallic,
                 m->transmit);
    else
        snprintf(text, size, "%.5s d %g s %g n %g r %g t %g%s", m->kind, m->diffuse, m->specular,
                 m->shininess, m->reflect, m->transmit, m->fresnel ? " F" : "");
}

// Tiles of all matters in the plane z = 0, `away` to the right, so that they look the same in a picture that
// is `cosine` times as high.
static void tiles_append(char **text, const Matters *m, f64 cosine, f64 away)
{
    for (u32 i = 0; i < m->count; i++) {
        const f64 left = i % COLUMNS + away, low = i / COLUMNS / cosine, high = (i / COLUMNS + 1) / cosine;
        char *name = text_of("m%u", i);
        matter_append(text, name, &m->matter[i]);
        free(name);
        text_append(text,
                    "triangle { vertices %.17g %.17g 0 %.17g %.17g 0 %.17g %.17g 0 material m%u }\n"
                    "triangle { vertices %.17g %.17g 0 %.17g %.17g 0 %.17g %.17g 0 material m%u }\n",
                    left, low, left + 1, low, left + 1, high, i, left, low, left + 1, high, left, high, i);
    }
}

// Lobes that a light which shines from everywhere does not find.
static bool is_narrow(const Matter *m)
{
    return strcmp(m->kind, "pbr") == 0 ? m->roughness >= 0.02 && m->roughness < 0.25 : m->shininess > 10;
}

// Of the middle of a tile. An estimate may have no variance because an event, as a normal far from the
// surface's, is so rare that no sample had it: one sample counts as its error at least.
static Estimate tile_estimate(const Picture *picture, u32 tile)
{
    const u32 left = tile % COLUMNS * PIXELS, top = picture->height - (tile / COLUMNS + 1) * PIXELS;
    f32 rgb[3 * INNER * INNER];
    for (u32 k = 0; k < INNER * INNER; k++)
        memcpy(&rgb[3 * k], pixel_at(picture, left + 1 + k % INNER, top + 1 + k / INNER), 3 * sizeof(f32));
    const Picture part = {.width = INNER, .height = INNER, .rgb = rgb};
    const Estimate found = estimate_of(&part, 1);
    return (Estimate){found.mean, hypot(found.error, found.mean / (SAMPLES * INNER * INNER))};
}

static void expect_tiles(Device *device, const Matters *m, f64 cosine, LightSampling sampling, u32 depth,
                         Verdicts *verdicts)
{
    const u32 rows = (m->count + COLUMNS - 1) / COLUMNS;
    const f64 sine = sqrt(1 - cosine * cosine), x = COLUMNS / 2.0, y = rows / 2.0 / cosine;
    char *text =
        text_of("image { size %u %u samples %u }\nrender { integrator path max_depth %u }\nbackground 1\n"
                "camera { position %.17g %.17g %.17g look_at %.17g %.17g 0 orthographic %u }\n"
                "sphere { center 1e5 1e5 0 radius 1 }\n",
                COLUMNS * PIXELS, rows * PIXELS, SAMPLES, depth, x, y + 50 * sine, 50 * cosine, x, y, rows);
    tiles_append(&text, m, cosine, 0);
    Layout *layout = layout_by(text, sampling);
    Picture picture = render_layout(device, layout, NULL);
    for (u32 i = 0; i < m->count; i++) {
        char what[96];
        const f64 expected = matter_albedo(&m->matter[i], cosine);
        describe(&m->matter[i], what, sizeof what);
        // Metals give back at most what they get. Others may give more at grazing angles: the language's body
        // loses Fresnel's share at half-way normals, which is less than the lobe gets there.
        if (sampling == LIGHT_SAMPLING_LIGHTS && is_narrow(&m->matter[i]))
            continue;
        assert_true(m->matter[i].metallic < 1 || expected <= 1 + 1e-9);
        verdict_add(verdicts, what, tile_estimate(&picture, i), expected, 0.05);
    }
    picture_destroy(&picture);
    layout_destroy(layout);
    free(text);
}

static void test_tiles(void **state)
{
    static const struct {
        f64 cosine;
        LightSampling sampling;
        u32 depth;
    } cases[] = {{0.875, LIGHT_SAMPLING_BOTH, 1},
                 {0.25, LIGHT_SAMPLING_BOTH, 3},
                 {0.875, LIGHT_SAMPLING_SURFACES, 1},
                 {0.25, LIGHT_SAMPLING_SURFACES, 1},
                 {0.625, LIGHT_SAMPLING_LIGHTS, 1}};
    const Matters matters = matters_make();
    Verdicts verdicts = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        print_message("N.V %g, way %d, depth %u\n", cases[i].cosine, (int)cases[i].sampling, cases[i].depth);
        expect_tiles(*state, &matters, cases[i].cosine, cases[i].sampling, cases[i].depth, &verdicts);
    }
    verdicts_end(&verdicts);
}

// A ball that scatters nothing: 1 at each pixel, whatever ways the light takes through it.
static void test_glass_balls(void **state)
{
    static const Matter glasses[] = {
        {.kind = "phong", .reflect = 1, .transmit = 1, .fresnel = true, .ior = 1.5},
        {.kind = "phong", .reflect = 1, .transmit = 1, .fresnel = true, .ior = 2.5},
        {.kind = "phong", .reflect = 1, .transmit = 1, .fresnel = true, .ior = 0.75},
        {.kind = "phong", .transmit = 1, .ior = 1.25},
        {.kind = "phong", .reflect = 1, .ior = 1.5},
        {.kind = "pbr", .diffuse = 1, .transmit = 1, .roughness = 0.5, .ior = 1.5},
        {.kind = "pbr", .diffuse = 1, .transmit = 1, .roughness = 0, .ior = 1.75},
        {.kind = "pbr", .diffuse = 1, .metallic = 1, .roughness = 0, .ior = 1.5},
        {.kind = "phong", .diffuse = 1, .ior = 1.5},
    };
    const Matters matters = matters_make();
    for (size_t i = 0; i < sizeof glasses / sizeof *glasses; i++) {
        char *text =
            text_of("image { size 24 24 samples 16 }\nrender { integrator path max_depth 64 }\nbackground 1\n"
                    "camera { position 0 0 9 look_at 0 0 0 orthographic 1.375 }\n");
        matter_append(&text, "ball", &glasses[i]);
        text_append(&text, "sphere { center 0 0 0 radius 1 material ball }\n");
        tiles_append(&text, &matters, 1, 1e6); // one program for all
        Picture picture = render_text(*state, text, NULL);
        const bool noisy = glasses[i].diffuse > 0 && strcmp(glasses[i].kind, "phong") == 0;
        f64 worst = 0, mean = 0;
        for (u32 k = 0; k < 3 * picture.width * picture.height; k++) {
            worst = fmax(worst, fabs((f64)picture.rgb[k] - 1));
            mean += (f64)picture.rgb[k] / (3 * picture.width * picture.height);
        }
        char what[96];
        describe(&glasses[i], what, sizeof what);
        print_message("ball of %s, ior %g: farthest from 1 %.2g, mean %.7f\n", what, glasses[i].ior, worst,
                      mean);
        if (!(worst <= (noisy ? 0.25 : 1e-5) && fabs(mean - 1) <= (noisy ? 2e-3 : 1e-5)))
            fail_msg("a ball of %s: a pixel is %.3g from 1, the mean %.3g", what, worst, mean - 1);
        picture_destroy(&picture);
        free(text);
    }
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_tiles, device),
                                       cmocka_unit_test_prestate(test_glass_balls, device)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
