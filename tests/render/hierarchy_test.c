// The hierarchy changes no hit: random scenes of every kind of shape, of triangles in meshes, and of all of
// them with instances, are searched by the traversal and by a test of every primitive and face. Both must
// name the same primitive or face and instance with the same bits of t, for closest hits, for the hits behind
// them and for any hit; for batches of vectors and for single rays; for rays from anywhere, along the axes,
// and from the surfaces.
#include "hierarchy_support.h"

#include <math.h>

#include "meshes.h"

enum { SHAPES = 36, SOUPS = 4 };

static const u32 soup_sizes[SOUPS] = {2, 30, 150, 800};

typedef struct Devices {
    Device *device;
    Search vectors, single;
    char *soups[SOUPS]; // files of so many triangles
    char *ball;
} Devices;

static const Place near_place = {"", {0, 0, 0}};
// So far away that a place is known to 2^-12 only.
static const Place far_place = {"camera { position -3000 512 1024 look_at 0 0 0 }\n", {3000, -512, -1024}};

// Returns the number of hits.
static u32 compare(const Space *s, const f32 *rays, const Answer *a, const Answer *b, bool any_hit,
                   const char *what)
{
    u32 hits = 0, differ = 0, first = 0;
    for (u32 i = 0; i < STEPS * RAYS; i++) {
        const bool hit = a->found[2 * i] >= 0, other = b->found[2 * i] >= 0;
        const bool same = any_hit ? hit == other
                                  : memcmp(&a->t[i], &b->t[i], sizeof(f32)) == 0 &&
                                        memcmp(&a->found[2 * i], &b->found[2 * i], 2 * sizeof(i32)) == 0;
        hits += hit;
        first = same || differ ? first : i;
        differ += !same;
    }
    if (differ) {
        const u32 ray = first % RAYS;
        const i32 met = b->found[2 * first];
        const i32 kind = met < 0 || met & FACE ? -1 : (i32)s->layout->primitives[met].kind;
        fail_msg("%s: %u of %u differ, the first in step %u: t %.9g and %.9g, primitives %d and %d, "
                 "instances %d and %d, kind of the second %d; ray from %.9g %.9g %.9g towards %.9g %.9g %.9g "
                 "to %.9g",
                 what, differ, STEPS * RAYS, first / RAYS, (f64)a->t[first], (f64)b->t[first],
                 a->found[2 * first], b->found[2 * first], a->found[2 * first + 1], b->found[2 * first + 1],
                 kind, (f64)rays[ray], (f64)rays[RAYS + ray], (f64)rays[2 * RAYS + ray],
                 (f64)rays[3 * RAYS + ray], (f64)rays[4 * RAYS + ray], (f64)rays[5 * RAYS + ray],
                 (f64)rays[6 * RAYS + ray]);
    }
    return hits;
}

// Both ways to search, in both programs, for the rays on the device.
static u32 compare_searches(const Devices *d, const Space *s, const char *name)
{
    Error error = {0};
    f32 *rays = malloc(COLUMNS * RAYS * sizeof *rays);
    assert_non_null(rays);
    Answer all = answer_create(), other = answer_create();
    must(buffer_download(s->rays, 0, rays, COLUMNS * RAYS * sizeof *rays, &error), &error);
    search_run(&d->vectors, s, true, false, false, STEPS, &all);
    search_run(&d->vectors, s, false, false, false, STEPS, &other);
    char *what = text_of("%s, closest, hierarchy against all", name);
    const u32 hits = compare(s, rays, &other, &all, false, what);
    search_run(&d->single, s, false, false, false, STEPS, &other);
    compare(s, rays, &other, &all, false, "the same, single rays");
    for (u32 opaque_only = 0; opaque_only < 2; opaque_only++) {
        search_run(&d->vectors, s, true, true, opaque_only, 1, &all);
        search_run(&d->vectors, s, false, true, opaque_only, 1, &other);
        compare(s, rays, &other, &all, true, "any hit");
        search_run(&d->single, s, false, true, opaque_only, 1, &other);
        compare(s, rays, &other, &all, true, "any hit, single rays");
    }
    search_run(&d->single, s, true, false, false, 1, &all); // and without the hierarchy, one step
    search_run(&d->vectors, s, false, false, false, 1, &other);
    compare(s, rays, &other, &all, false, "closest, vectors against all by single rays");
    free(what);
    free(rays);
    answer_destroy(&all);
    answer_destroy(&other);
    return hits;
}

static void check_scene(const Devices *d, const char *name, const char *scene, const Place *place, u64 seed)
{
    char *placed = text_of("%s%s", place->camera, scene);
    Space s = space_create(d->device, placed);
    free(placed);
    space_aim(&s, place, seed);
    const u32 first = compare_searches(d, &s, name);
    if (s.layout->block_count > 0) {
        space_leave_out_faces(&s);
        assert_true(compare_searches(d, &s, name) < first);
    }
    search_bounce(&d->vectors, &s, seed); // t and found are those of closest hits
    const u32 second = compare_searches(d, &s, name);
    print_message("%-28s %u primitives and faces, %u rays, %u + %u hits\n", name, s.target_count, 2 * RAYS,
                  first, second);
    assert_true(first > RAYS / 10 && second > RAYS / 20);
    space_destroy(&s);
}

static void append_transform(char **text, u64 *seed, bool similar)
{
    if (random_unit(seed) < 0.5)
        return;
    if (!similar && random_unit(seed) < 0.5)
        text_append(text, " scale %.4f %.4f %.4f", random_in(seed, 0.3, 2), random_in(seed, -2, -0.3),
                    random_in(seed, 0.3, 2));
    text_append(text, " rotate %.3f %.3f 1 %.2f scale %.3f", random_in(seed, -1, 1), random_in(seed, -1, 1),
                random_in(seed, 0, 360), random_in(seed, 0.6, 1.4));
}

static char *point(u64 *seed, f64 range)
{
    return text_of("%.9g %.9g %.9g", (f64)snapped(seed, range), (f64)snapped(seed, range),
                   (f64)snapped(seed, range));
}

// One shape of the kind named, somewhere within about eight units of the origin.
static void append_shape(const Devices *d, char **text, const char *kind, u64 *seed)
{
    char *a = point(seed, 5), *b = point(seed, 5), *c = point(seed, 5);
    const f64 r = random_unit(seed) < 0.4 ? 1 : random_in(seed, 0.2, 1.8);
    const bool caps = random_unit(seed) < 0.5;
    char *own = NULL;
    if (strcmp(kind, "sphere") == 0)
        text_append(&own, "sphere { center %s radius %g", a, r);
    else if (strcmp(kind, "giant") == 0)
        text_append(&own, "sphere { center 0 %.9g 0 radius 6.4e6", -6.4e6 - random_in(seed, -4, 4));
    else if (strcmp(kind, "ellipsoid") == 0)
        text_append(&own, "sphere { center 0 0 0 radius 1 scale %.3f %.3f %.3f rotate x %.1f translate %s",
                    random_in(seed, 0.01, 2), random_in(seed, 0.3, 3), -random_in(seed, 0.3, 2),
                    random_in(seed, 0, 90), a);
    else if (strcmp(kind, "plane") == 0)
        text_append(&own, "plane { point %s normal %.4f %.4f 1.25", a, (f64)snapped(seed, 1),
                    (f64)snapped(seed, 1));
    else if (strcmp(kind, "box") == 0)
        text_append(&own, "box { center %s size %g %g %g", a, r, caps ? 1.0 : 0.001 * r, 2.0);
    else if (strcmp(kind, "tetrahedron") == 0)
        text_append(&own, "tetrahedron { center %s size %g", a, 2 * r);
    else if (strcmp(kind, "disk") == 0)
        text_append(&own, "disk { center %s normal %s radius %g", a, caps ? "0 1 0" : "1 0.3 -0.4", 1.5 * r);
    else if (strcmp(kind, "cylinder") == 0)
        text_append(&own, "cylinder { base 0 0 0 top 0 %g 0 radius %g caps %s translate %s", 2 * r, r,
                    caps ? "on" : "off", a);
    else if (strcmp(kind, "cone") == 0)
        text_append(&own, "cone { base 0 0 0 top 1 %g 0.5 radius %g top_radius %g caps %s translate %s",
                    2 * r, r, random_unit(seed) < 0.5 ? 0.0 : 0.5, caps ? "on" : "off", a);
    else if (strcmp(kind, "torus") == 0)
        text_append(&own, "torus { center %s axis %s major %g minor %g", a, caps ? "0 1 0" : "1 0.5 0.2", r,
                    caps ? 0.25 * r : r);
    else if (strcmp(kind, "mesh") == 0)
        text_append(&own, "mesh { file \"%s\" %s scale %g translate %s", d->soups[random_unit(seed) < 0.5],
                    caps ? "smooth off" : "", 2 * r, a);
    else if (caps)
        text_append(&own, "triangle { vertices %s %s %s normals 0 1 0 0 1 0.5 1 0 0", a, b, c);
    else
        text_append(&own, "triangle { vertices %s %.9g 0.25 1.5 %s", a, random_in(seed, -5, 5), c);
    if (random_unit(seed) < 0.4)
        text_append(&own, " material %s", random_unit(seed) < 0.5 ? "glass" : "tinted");
    append_transform(&own, seed, strcmp(kind, "sphere") == 0 || strcmp(kind, "giant") == 0);
    text_append(text, "%s }\n", own);
    free(own);
    free(a);
    free(b);
    free(c);
}

static const char head[] =
    "material glass phong { transmit 0.9 }\nmaterial tinted phong { transmit 0 0.5 0 }\n";

static const char *const kinds[] = {"sphere", "giant",    "ellipsoid", "plane", "box",      "tetrahedron",
                                    "disk",   "cylinder", "cone",      "torus", "triangle", "mesh"};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void test_each_kind(void **state)
{
    const Devices *d = *state;
    for (u32 k = 0; k < KINDS; k++) {
        char *scene = text_of("%s", head);
        u64 seed = 100 + k;
        const bool endless = strcmp(kinds[k], "plane") == 0 || strcmp(kinds[k], "giant") == 0;
        for (u32 i = 0; i < (endless ? 6 : SHAPES); i++)
            append_shape(d, &scene, kinds[k], &seed);
        text_append(&scene, "box { center 0 0 0 size 0.5 }\n"); // the programs want a hierarchy
        check_scene(d, kinds[k], scene, &near_place, 1000 + k);
        free(scene);
    }
}

// Shapes of all kinds but for endless ones, which are one each.
static void append_mixture(const Devices *d, char **scene, u64 *seed, u32 count, bool endless)
{
    for (u32 i = 0; i < count; i++) {
        const char *kind = kinds[i % KINDS];
        const bool wide = strcmp(kind, "plane") == 0 || strcmp(kind, "giant") == 0;
        if (!wide || (endless && i < KINDS))
            append_shape(d, scene, kind, seed);
    }
}

// Objects within objects, mirrored, sheared and at the same place.
static char *instanced_scene(const Devices *d)
{
    char *scene = text_of("%s", head);
    u64 seed = 77;
    text_append(&scene, "object inner {\n");
    append_mixture(d, &scene, &seed, 13, false);
    text_append(&scene, "}\nobject flat { disk { center 0 0 0 normal 0 1 0 radius 2 }\n"
                        "box { min -1 0 -1 max 1 0.5 1 } plane { point 0 -6 0 normal 0 1 0.1 } }\n"
                        "object single { sphere { center 0 0 0 radius 1 } }\n"
                        "object outer {\ninstance inner { scale 0.5 translate 2 0 0 }\n"
                        "instance inner { scale 0.4 -0.5 0.6 rotate z 40 translate -3 1 0 material tinted }\n"
                        "sphere { center 0 0 0 radius 1.5 }\nbox { min -4 -2 -4 max 4 -1.5 4 }\n}\n");
    append_mixture(d, &scene, &seed, 9, true);
    for (u32 i = 0; i < 3; i++) {
        char *at = point(&seed, 4);
        text_append(&scene, "instance outer { matrix 1 0.3 0 0  0 1 0.2 0  0.1 0 1 0 rotate y %u "
                            "translate %s }\n", 90 * i, at);
        text_append(&scene, "instance flat { rotate x %u translate %s material glass }\n", 45 * i, at);
        text_append(&scene, "instance single { translate %s }\n", at);
        free(at);
    }
    text_append(&scene, "instance flat { translate 0 1 0 }\n"
                        "instance flat { translate 0 1 0 material glass }\n"
                        "box { min -1 1 -1 max 1 1.5 1 }\ninstance inner { scale 1e-3 translate 0 -1 0 }\n"
                        "instance inner { scale 1e3 }\n");
    return scene;
}

static void test_all_kinds(void **state)
{
    const Devices *d = *state;
    char *scene = text_of("%s", head);
    u64 seed = 5;
    append_mixture(d, &scene, &seed, 120, true);
    check_scene(d, "all kinds", scene, &near_place, 50);
    check_scene(d, "all kinds, far away", scene, &far_place, 51);
    free(scene);
}

static void test_instances(void **state)
{
    const Devices *d = *state;
    char *scene = instanced_scene(d);
    check_scene(d, "instances", scene, &near_place, 60);
    check_scene(d, "instances, far away", scene, &far_place, 61);
    free(scene);
}

// Thousands of triangles of one file, and between them shapes of all kinds and the same file again, by
// instances that bring a material or leave it at that of the file.
static void test_soups(void **state)
{
    const Devices *d = *state;
    u64 seed = 21;
    char *alone = text_of("mesh { file \"%s\" scale 3 }\n", d->soups[3]);
    check_scene(d, "soup", alone, &near_place, 90);
    check_scene(d, "soup, far away", alone, &far_place, 91);
    char *scene = text_of("%s%sobject soup { mesh { file \"%s\" } mesh { file \"%s\" material tinted } "
                          "sphere { center 0 0 0 radius 0.5 } }\n", head, alone, d->soups[2], d->soups[1]);
    append_mixture(d, &scene, &seed, 40, true);
    text_append(&scene, "instance soup { scale 2 -1 1 rotate x 20 }\ninstance soup { material glass }\n"
                        "instance soup { scale 0.5 translate 3 2 1 }\n"
                        "object outer { instance soup { rotate z 10 material tinted }\n"
                        "    box { center 0 0 3 size 1 } }\n"
                        "instance outer { translate -3 1 0 }\n"
                        "instance outer { translate -3 1 0 material glass }\n");
    check_scene(d, "soups, shapes and instances", scene, &near_place, 92);
    free(alone);
    free(scene);
}

// The place of a hit in the order of definition.
static u64 place_of(const Layout *layout, i32 met, i32 instance)
{
    return order_of(layout, met) + (instance < 0 ? 0 : order_of(layout, instance));
}

static u64 end_of_order(const Space *s)
{
    u64 end = 0;
    for (u32 i = 0; i < s->pair_count; i++) {
        const bool faces = s->list[i][0] & FACE;
        for (i32 k = 0; k < (faces ? BLOCK_WIDTH : 1); k++) {
            const i32 met = s->list[i][0] + k;
            if (faces && s->layout->blocks[(met & (FACE - 1)) / BLOCK_WIDTH].face[k] == NO_INDEX)
                continue;
            const u64 order = place_of(s->layout, met, s->list[i][1]);
            end = order + 1 > end ? order + 1 : end;
        }
    }
    return end;
}

// The first hit of a ray is of the first half of the order; right behind it, at the same t, is its twin. But
// where a closed mesh is touched at an edge, both its faces are met at once. Returns the number of hits.
static u32 check_twins(const Layout *layout, const Answer *answer, u32 ray, u64 end)
{
    const i32 *first = answer->found + 2 * ray, *second = answer->found + 2 * (RAYS + ray);
    if (first[0] < 0)
        return 0;
    const u64 order = place_of(layout, first[0], first[1]);
    assert_true(order < end / 2);
    if (second[0] < 0)
        return 1;
    const u64 next = place_of(layout, second[0], second[1]);
    assert_memory_equal(&answer->t[ray], &answer->t[RAYS + ray], sizeof(f32));
    assert_true(next >= end / 2 || (next > order && first[0] & FACE && second[0] & FACE));
    return 2;
}

// Everything twice, at the same place: only what comes first is ever seen.
static void test_first_defined_wins(void **state)
{
    // Of faces that do not lie at the same place by themselves.
    Devices balls = *(const Devices *)*state;
    const Devices *d = &balls;
    balls.soups[0] = balls.soups[1] = balls.ball;
    char *once = NULL, *scene = text_of("%sobject pair { sphere { center 0 0 0 radius 0.8 } "
                                        "torus { center 0 0 0 axis 0 1 0 major 1.2 minor 0.3 } }\n", head);
    u64 seed = 8;
    append_mixture(d, &once, &seed, 60, true);
    text_append(&once, "instance pair { translate 1 2 -3 }\ninstance pair { scale 2 rotate x 30 }\n");
    text_append(&scene, "%s%s", once, once);
    Space s = space_create(d->device, scene);
    const u64 end = end_of_order(&s);
    assert_true(end % 2 == 0);
    space_aim(&s, &near_place, 80);
    compare_searches(d, &s, "everything twice");
    Answer answer = answer_create();
    const Search *searches[] = {&d->vectors, &d->single};
    for (u32 k = 0; k < 2; k++) {
        search_run(searches[k], &s, false, false, false, 2, &answer);
        u32 hits = 0;
        for (u32 i = 0; i < RAYS; i++)
            hits += check_twins(s.layout, &answer, i, end);
        assert_true(hits > RAYS / 2);
    }
    answer_destroy(&answer);
    free(once);
    free(scene);
    space_destroy(&s);
}

int main(void)
{
    Devices d = {.device = test_device_open(0)};
    if (!d.device)
        return TEST_SKIP;
    for (u32 k = 0; k < SOUPS; k++) {
        char *name = text_of("hierarchy_test_%u.obj", k);
        d.soups[k] = mesh_write_soup(name, soup_sizes[k], 40 + k);
        free(name);
    }
    d.ball = mesh_write_bumpy("hierarchy_test_ball.obj", 12);
    d.vectors = search_create(d.device, 8, 32);
    d.single = search_create(d.device, 1, 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_each_kind, &d),
        cmocka_unit_test_prestate(test_all_kinds, &d),
        cmocka_unit_test_prestate(test_instances, &d),
        cmocka_unit_test_prestate(test_soups, &d),
        cmocka_unit_test_prestate(test_first_defined_wins, &d),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (u32 k = 0; k < SOUPS; k++)
        mesh_remove(d.soups[k]);
    mesh_remove(d.ball);
    search_destroy(&d.vectors);
    search_destroy(&d.single);
    device_close(d.device);
    return failed;
}
