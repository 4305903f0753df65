// Shading of smooth meshes next to the terminator. A ball of few faces, seen by parallel rays, so that the
// test knows the place and the interpolated normal of every pixel: with `terminator on` each has all the light
// that the normal turns to, with `off` whole faces are dark. What does not bulge is the same in both ways.
#include "support.h"

#include <math.h>
#include <unistd.h>

#include "base/vec.h"

enum { AROUND = 8, ROWS = 4, RINGS = (ROWS - 1) * AROUND, VERTICES = RINGS + 2, FACES = 2 * RINGS };
enum { SIDE = 160 }; // of the pictures, in pixels

#define BALL_FILE "terminator_test_ball.obj"
#define SHEET_FILE "terminator_test_sheet.obj"
#define VIEW 2.2 // height of the picture in units
#define ALBEDO 0.8

typedef struct Ball {
    Vec3 vertices[VERTICES]; // unit vectors, and so the normals
    u32 faces[FACES][3];
} Ball;

typedef struct Fixture {
    Device *device;
    Ball ball;
} Fixture;

static Ball ball_make(void)
{
    Ball ball;
    const f64 half = acos(-1);
    u32 count = 0, faces = 0;
    for (u32 y = 1; y < ROWS; y++)
        for (u32 x = 0; x < AROUND; x++) {
            const f64 a = half * y / ROWS, b = 2 * half * x / AROUND;
            ball.vertices[count++] = (Vec3){sin(a) * cos(b), cos(a), -sin(a) * sin(b)};
        }
    const u32 top = count, bottom = count + 1;
    ball.vertices[top] = (Vec3){0, 1, 0};
    ball.vertices[bottom] = (Vec3){0, -1, 0};
    for (u32 y = 0; y < ROWS; y++)
        for (u32 x = 0; x < AROUND; x++) {
            const u32 next = (x + 1) % AROUND, upper = (y - 1) * AROUND, lower = y * AROUND;
            const u32 a = y > 0 ? upper + x : top, b = y + 1 < ROWS ? lower + x : bottom;
            const u32 c = y + 1 < ROWS ? lower + next : bottom, d = y > 0 ? upper + next : top;
            if (y + 1 < ROWS)
                memcpy(ball.faces[faces++], (u32[3]){a, b, c}, sizeof *ball.faces);
            if (y > 0)
                memcpy(ball.faces[faces++], (u32[3]){a, c, d}, sizeof *ball.faces);
        }
    assert_int_equal(faces, FACES);
    return ball;
}

static void write_files(const Ball *ball)
{
    FILE *file = fopen(BALL_FILE, "w");
    assert_non_null(file);
    for (u32 i = 0; i < VERTICES; i++)
        fprintf(file, "v %.9g %.9g %.9g\nvn %.9g %.9g %.9g\n", ball->vertices[i].x, ball->vertices[i].y,
                ball->vertices[i].z, ball->vertices[i].x, ball->vertices[i].y, ball->vertices[i].z);
    for (u32 f = 0; f < FACES; f++) {
        const u32 a = ball->faces[f][0] + 1, b = ball->faces[f][1] + 1, c = ball->faces[f][2] + 1;
        fprintf(file, "f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
    }
    assert_int_equal(fclose(file), 0);
    file = fopen(SHEET_FILE, "w");
    assert_non_null(file);
    fprintf(file, "vn 0 0 1\n");
    for (u32 i = 0; i < 16; i++)
        fprintf(file, "v %.9g %.9g 0\n", 0.7 * (i % 4) - 1, 0.7 * (i / 4) - 1);
    for (u32 i = 1; i <= 11; i++)
        if (i % 4)
            fprintf(file, "f %u//1 %u//1 %u//1 %u//1\n", i, i + 1, i + 5, i + 4);
    assert_int_equal(fclose(file), 0);
}

// A mesh of the test's folder, with the properties behind it.
static char *mesh_of(const char *file, const char *properties)
{
    char folder[4096];
    assert_non_null(getcwd(folder, sizeof folder));
    return text_of("mesh { file \"%s/%s\" %s }\n", folder, file, properties);
}

// The mesh with `terminator on` or `off`, and what else is in the scene, from straight ahead.
static Picture picture_of(Device *device, const char *file, const char *properties, bool on, const char *rest,
                          const RenderHow *how)
{
    char *all = text_of("%s terminator %s", properties, on ? "on" : "off");
    char *mesh = mesh_of(file, all);
    char *text = text_of("image { size %d %d }\ncamera { position 0 0 5 look_at 0 0 0 orthographic %g }\n%s%s",
                         SIDE, SIDE, VIEW, mesh, rest);
    Picture picture = render_text(device, text, how);
    free(all);
    free(mesh);
    free(text);
    return picture;
}

static f64 edge(Vec3 a, Vec3 b, f64 x, f64 y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// What the ray of a pixel meets; false next to an edge too, where rounding may choose the other face.
static bool look(const Ball *ball, u32 column, u32 row, Vec3 *point, Vec3 *normal)
{
    const f64 x = ((column + 0.5) / SIDE - 0.5) * VIEW, y = (0.5 - (row + 0.5) / SIDE) * VIEW;
    for (u32 f = 0; f < FACES; f++) {
        const Vec3 a = ball->vertices[ball->faces[f][0]], b = ball->vertices[ball->faces[f][1]];
        const Vec3 c = ball->vertices[ball->faces[f][2]];
        const f64 area = edge(a, b, c.x, c.y);
        const f64 u = edge(b, c, x, y) / area, v = edge(c, a, x, y) / area, w = 1 - u - v;
        if (!(area > 1e-6 && u > 1e-4 && v > 1e-4 && w > 1e-4))
            continue;
        *point = vec_add(vec_add(vec_scale(a, u), vec_scale(b, v)), vec_scale(c, w));
        *normal = vec_normalize(*point); // normals and places are interpolated from the same numbers
        return true;
    }
    return false;
}

typedef struct Lamp {
    const char *name, *text;
    bool near;  // shines from a place, else along a direction
    Vec3 where; // that place, or the way to the light
} Lamp;

// The last lies on the underside of a slab that its rays may not meet.
static const Lamp LAMPS[] = {
    {"from the side", "light directional { direction -1 0 -0.1 }\n", false, {1, 0, 0.1}},
    {"from behind", "light directional { direction -0.8 -0.4 0.6 }\n", false, {0.8, 0.4, -0.6}},
    {"across", "light directional { direction -1 -0.7 0.3 }\n", false, {1, 0.7, -0.3}},
    {"near", "light point { position 0.9 1.1 0.6 }\n", true, {0.9, 1.1, 0.6}},
    {"below a slab", "light point { position 0.2 1.5 0.5 }\nbox { min -3 1.5 -3 max 3 1.625 3 }\n", true,
     {0.2, 1.5, 0.5}},
};

typedef struct Found {
    u32 lit, dark;     // pixels that should have light, and those of them that have none
    f64 error, sphere; // largest distances: from the light that the normal turns to, and from a sphere's
    f64 step;          // largest between neighbours of a row
} Found;

static Found compare(const Ball *ball, const Picture *picture, const Lamp *lamp)
{
    Found found = {0};
    for (u32 y = 0; y < SIDE; y++) {
        f64 last = -1;
        for (u32 x = 0; x < SIDE; x++) {
            Vec3 p, n;
            if (!look(ball, x, y, &p, &n)) {
                last = -1;
                continue;
            }
            const Vec3 way = vec_normalize(lamp->near ? vec_sub(lamp->where, p) : lamp->where);
            const f64 expected = ALBEDO * fmax(0, vec_dot(n, way)), value = (f64)pixel_at(picture, x, y)[0];
            const Vec3 round = {p.x, p.y, sqrt(fmax(0, 1 - p.x * p.x - p.y * p.y))};
            const Vec3 over = vec_normalize(lamp->near ? vec_sub(lamp->where, round) : lamp->where);
            found.lit += expected > 0.01;
            found.dark += expected > 0.01 && value == 0;
            found.error = fmax(found.error, fabs(value - expected));
            found.sphere = fmax(found.sphere, fabs(value - ALBEDO * fmax(0, vec_dot(round, over))));
            if (last >= 0)
                found.step = fmax(found.step, fabs(value - last));
            last = value;
        }
    }
    return found;
}

static void test_bands(void **state)
{
    const Fixture *f = *state;
    print_message("%-14s %-4s %6s %6s %10s %10s %10s\n", "light", "", "lit", "dark", "normals", "sphere",
                  "step");
    for (size_t i = 0; i < sizeof LAMPS / sizeof *LAMPS; i++) {
        Found found[2];
        char *rest = text_of("ambient 0\n%s", LAMPS[i].text);
        for (int on = 0; on < 2; on++) {
            Picture picture = picture_of(f->device, BALL_FILE, "", on, rest, NULL);
            found[on] = compare(&f->ball, &picture, &LAMPS[i]);
            print_message("%-14s %-4s %6u %6u %10.2g %10.2g %10.2g\n", LAMPS[i].name, on ? "on" : "off",
                          found[on].lit, found[on].dark, found[on].error, found[on].sphere, found[on].step);
            picture_destroy(&picture);
        }
        free(rest);
        assert_true(found[1].lit > 500);
        assert_int_equal(found[1].dark, 0);
        assert_true(found[1].error < 1e-5);
        assert_true(found[0].dark > found[0].lit / 50 && found[0].error > 0.05);
        assert_true(found[1].step < 0.5 * found[0].step);
    }
}

// Where nothing bulges towards the ray there is no difference, to the last bit.
static void test_unchanged(void **state)
{
    const Fixture *f = *state;
    static const char lights[] = "light directional { direction -1 -0.7 0.3 }\n"
                                 "light point { position 0.1 0.2 0.3 }\n"
                                 "light directional { direction -0.2 -0.1 -1 }\n";
    static const struct {
        const char *file, *properties;
    } cases[] = {
        {SHEET_FILE, "rotate 1 2 3 33"},                          // flat, with normals
        {SHEET_FILE, "scale 1 3 1 rotate y 89 translate 0 0.3 -1"}, // grazed by light and by rays
        {SHEET_FILE, "scale 1e5 rotate x -89 translate 0 -0.1 0"},
        {BALL_FILE, "smooth off"},
        {BALL_FILE, "scale 20"}, // from within
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Picture off = picture_of(f->device, cases[i].file, cases[i].properties, false, lights, NULL);
        Picture on = picture_of(f->device, cases[i].file, cases[i].properties, true, lights, NULL);
        assert_same_picture(&off, &on, cases[i].properties);
        picture_destroy(&off);
        picture_destroy(&on);
    }
}

// Baked and as an instance, mirrored or not, the ball is the same but for rounding.
static void test_placed(void **state)
{
    const Fixture *f = *state;
    static const char *const ways[] = {"scale 0.9 0.5 0.7 rotate 1 0.5 0 40",
                                       "scale -0.6 0.9 0.6 rotate z 20"};
    static const char lights[] = "ambient 0\nlight directional { direction -1 -0.7 0.3 }\n";
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        char *ball = mesh_of(BALL_FILE, "terminator on");
        char *text = text_of("image { size %d %d }\ncamera { position 0 0 5 look_at 0 0 0 orthographic %g }\n%s"
                             "object o { %s }\ninstance o { %s }\n", SIDE, SIDE, VIEW, lights, ball, ways[i]);
        Picture instance = render_text(f->device, text, NULL);
        Picture baked = picture_of(f->device, BALL_FILE, ways[i], true, lights, NULL);
        Picture banded = picture_of(f->device, BALL_FILE, ways[i], false, lights, NULL);
        const u32 apart = levels_apart(&instance, &baked, 1), bands = levels_apart(&baked, &banded, 1);
        print_message("%s: %u of %u values more than a level apart; without: %u\n", ways[i], apart,
                      3 * SIDE * SIDE, bands);
        assert_true(apart <= 3 && bands >= 300);
        picture_destroy(&instance);
        picture_destroy(&baked);
        picture_destroy(&banded);
        free(text);
        free(ball);
    }
}

static f64 mean_of(const Picture *picture)
{
    f64 sum = 0;
    for (u32 i = 0; i < picture->width * picture->height; i++)
        sum += (f64)picture->rgb[3 * i];
    return sum / (picture->width * picture->height);
}

// A body without hollows hides nothing from itself: with moved origins all rays of ambient occlusion are
// free. Lamps with a size shine on more places.
static void test_drawn(void **state)
{
    const Fixture *f = *state;
    static const char *const scenes[] = {
        "render { ambient_occlusion 16 10 }\nambient 1\n",
        "ambient 0\nlight sphere { center 4 3 -2 radius 1 radiance 20 samples 4 }\n",
        "ambient 0\nlight rectangle { corner 3 -1 -2 edge1 0 0 2 edge2 0 2 0 radiance 20 samples 4 }\n",
    };
    Picture open = picture_of(f->device, BALL_FILE, "", true, "ambient 1\n", NULL);
    for (int i = 0; i < 3; i++) {
        Picture off = picture_of(f->device, BALL_FILE, "", false, scenes[i], NULL);
        Picture on = picture_of(f->device, BALL_FILE, "", true, scenes[i], NULL);
        print_message("scene %d: mean %g off, %g on, %g with all ambient light\n", i, mean_of(&off),
                      mean_of(&on), mean_of(&open));
        assert_true(mean_of(&on) > 1.01 * mean_of(&off));
        if (i == 0)
            assert_true(mean_of(&on) > 0.999 * mean_of(&open));
        picture_destroy(&off);
        picture_destroy(&on);
    }
    picture_destroy(&open);
}

// The same bytes whatever the shape of the kernels, with rays of all kinds that start from moved places.
static void test_shapes(void **state)
{
    const Fixture *f = *state;
    static const char *const shapes[] = {"8,32,1", "1,1,16"};
    static const char rest[] =
        "render { ambient_occlusion 4 10 }\nlight sphere { center 4 3 -2 radius 1 radiance 20 samples 2 }\n"
        "light directional { direction -1 -0.7 0.3 }\nenvironment { file \"sky.hdr\" }\n"
        "instance o { scale 0.25 -0.5 0.25 translate 0.75 0.75 0 material m }\n";
    char *ball = mesh_of(BALL_FILE, "terminator on");
    char *text = text_of("object o { %s }\nmaterial m pbr { }\n%s", ball, rest);
    free(ball);
    Picture pictures[2];
    for (int i = 0; i < 2; i++)
        pictures[i] = picture_of(f->device, BALL_FILE, "", true, text, &(RenderHow){.shape = shapes[i]});
    assert_same_picture(&pictures[0], &pictures[1], shapes[1]);
    for (int i = 0; i < 2; i++)
        picture_destroy(&pictures[i]);
    free(text);
}

int main(void)
{
    Fixture f = {.device = test_device_open(0)};
    if (!f.device)
        return TEST_SKIP;
    f.ball = ball_make();
    write_files(&f.ball);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_bands, &f),
        cmocka_unit_test_prestate(test_unchanged, &f),
        cmocka_unit_test_prestate(test_placed, &f),
        cmocka_unit_test_prestate(test_drawn, &f),
        cmocka_unit_test_prestate(test_shapes, &f),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    remove(BALL_FILE);
    remove(SHEET_FILE);
    device_close(f.device);
    return failed;
}
