// The hierarchy changes no hit: random scenes of every kind of shape, and of all of them with instances, are
// searched by the traversal and by a test of every primitive. Both must name the same primitive and instance
// with the same bits of t, for closest hits, for the hits behind them and for any hit; for batches of vectors and
// for single rays; for rays from anywhere, along the axes, and from the surfaces.
#include "support.h"

#include <math.h>

#include "device/program.h"

enum { RAYS = 51200, STEPS = 3, SHAPES = 36, COLUMNS = 7 };

typedef struct Search {
    Device *device;
    Program *program;
    Kernel *search, *bounce;
    u32 batch, lanes;
} Search;

// The scene and the rays of a test, on the device.
typedef struct Space {
    Layout *layout;
    Buffer *primitives, *infos, *nodes, *materials, *extras, *pairs;
    u32 pair_count;
    Buffer *rays, *selves, *t, *found;
} Space;

typedef struct Answer {
    f32 *t;     // STEPS * RAYS
    i32 *found; // primitive and instance of each
} Answer;

typedef struct Devices {
    Device *device;
    Search vectors, single;
} Devices;

#define CHECK(call)                                                                                          \
    do {                                                                                                     \
        Error error = {0};                                                                                   \
        if (!(call))                                                                                         \
            fail_msg("%s: %s", #call, error.text);                                                           \
    } while (0)

static Search search_create(Device *device, u32 lanes, u32 batch)
{
    Search search = {.device = device, .batch = batch, .lanes = lanes};
    Error error = {0};
    static char *source; // outlives the programs
    if (!source)
        source = text_of_file(CLRT_SOURCE "/tests/render/hierarchy.cl");
    char *options = text_of("-w -I " CLRT_SOURCE "/kernels -DLANES=%u -DBATCH=%u -DGROUP=1%s", lanes, batch,
                            device_info(device)->exact_divide ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
    for (Feature f = 0; f < FEATURE_COUNT; f++) {
        const bool textures = f == FEATURE_UV || f == FEATURE_CHECKER || f == FEATURE_CHECKER3D;
        text_append(&options, " -DHAS_%s=%d", feature_name(f), !textures);
    }
    search.program = program_create(device, source, strlen(source), options, &error);
    if (!search.program)
        fail_msg("%s", error.text);
    search.search = kernel_create(search.program, "search", &error);
    search.bounce = kernel_create(search.program, "bounce", &error);
    assert_true(search.search && search.bounce);
    free(options);
    return search;
}

static void search_destroy(Search *search)
{
    kernel_destroy(search->search);
    kernel_destroy(search->bounce);
    program_destroy(search->program);
}

// Adds the primitives of the leaves below node, met through instance.
static void list_leaves(const Layout *layout, u32 node, i32 instance, i32 *pairs, u32 *count)
{
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const BvhNode *n = &layout->nodes[node];
        if (!(n->lower_x[slot] <= n->upper_x[slot]))
            continue;
        if (n->child[slot] >= 0) {
            list_leaves(layout, (u32)n->child[slot], instance, pairs, count);
            continue;
        }
        const u32 leaf = ~(u32)n->child[slot];
        for (u32 i = leaf >> 4; i < (leaf >> 4) + (leaf & 15u); i++) {
            const Primitive *primitive = &layout->primitives[i];
            if ((primitive->kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE) {
                u32 root;
                memcpy(&root, &primitive->p0, sizeof root);
                list_leaves(layout, root, (i32)i, pairs, count);
                continue;
            }
            assert_true(*count < 4096);
            pairs[2 * *count] = (i32)i;
            pairs[2 * (*count)++ + 1] = instance;
        }
    }
}

static Buffer *filled(Device *device, const char *name, const void *data, u64 bytes)
{
    Buffer *buffer;
    CHECK((buffer = buffer_create(device, name, bytes, &error)) != NULL);
    if (bytes)
        CHECK(buffer_upload(buffer, 0, data, bytes, &error));
    return buffer;
}

static Space space_create(Device *device, const char *scene)
{
    Space s = {.layout = layout_of(scene)};
    const Layout *l = s.layout;
    i32 *pairs = malloc(2 * 4096 * sizeof *pairs);
    assert_non_null(pairs);
    for (u32 i = 0; i < l->plane_count; i++) {
        pairs[2 * s.pair_count] = (i32)i;
        pairs[2 * s.pair_count++ + 1] = -1;
    }
    if (l->root != NO_INDEX)
        list_leaves(l, l->root, -1, pairs, &s.pair_count);
    assert_true(s.pair_count > 0);
    s.pairs = filled(device, "pairs", pairs, 2 * s.pair_count * sizeof *pairs);
    free(pairs);
    s.primitives = filled(device, "primitives", l->primitives, l->primitive_count * sizeof *l->primitives);
    s.infos = filled(device, "infos", l->infos, l->primitive_count * sizeof *l->infos);
    s.nodes = filled(device, "nodes", l->nodes, l->node_count * sizeof *l->nodes);
    s.materials = filled(device, "materials", l->materials, l->material_count * sizeof *l->materials);
    s.extras = filled(device, "extras", l->extras, l->extra_count * sizeof *l->extras);
    CHECK((s.rays = buffer_create(device, "rays_in", COLUMNS * RAYS * sizeof(f32), &error)) != NULL);
    CHECK((s.selves = buffer_create(device, "selves", 2 * RAYS * sizeof(i32), &error)) != NULL);
    CHECK((s.t = buffer_create(device, "t", STEPS * RAYS * sizeof(f32), &error)) != NULL);
    CHECK((s.found = buffer_create(device, "found", 2 * STEPS * RAYS * sizeof(i32), &error)) != NULL);
    return s;
}

static void space_destroy(Space *s)
{
    Buffer *buffers[] = {s->primitives, s->infos, s->nodes, s->materials, s->extras,
                         s->pairs,      s->rays,  s->selves, s->t,        s->found};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        buffer_destroy(buffers[i]);
    layout_destroy(s->layout);
}

static f32 snapped(u64 *seed, f64 range)
{
    const f64 x = random_in(seed, -range, range);
    return (f32)(random_unit(seed) < 0.5 ? floor(2 * x) / 2 : x);
}

static void random_direction(u64 *seed, f64 d[3])
{
    f64 squared;
    do {
        squared = 0;
        for (int k = 0; k < 3; k++) {
            d[k] = random_in(seed, -1, 1);
            squared += d[k] * d[k];
        }
    } while (squared > 1 || squared < 1e-3);
    for (int k = 0; k < 3; k++)
        d[k] /= sqrt(squared);
}

// Where the scene stands in render space.
typedef struct Place {
    const char *camera;
    f32 at[3];
} Place;

static const Place near_place = {"", {0, 0, 0}};
// So far away that a place is known to 2^-12 only.
static const Place far_place = {"camera { position -3000 512 1024 look_at 0 0 0 }\n", {3000, -512, -1024}};

// A random point on an edge, a corner or a face of the box of a random leaf of the top-level hierarchy, where the
// least error of a box shows.
static void random_box_point(const Layout *layout, u64 *seed, f64 point[3])
{
    u32 low = layout->root, high = layout->node_count; // the nodes of the scene come first
    for (u32 i = 0; i < layout->primitive_count; i++) {
        u32 root;
        memcpy(&root, &layout->primitives[i].p0, sizeof root);
        if ((layout->primitives[i].kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE && root < high)
            high = root;
    }
    for (;;) {
        const BvhNode *node = &layout->nodes[low + (u32)((high - low) * random_unit(seed))];
        const int slot = (int)(BVH_WIDTH * random_unit(seed));
        if (!(node->lower_x[slot] <= node->upper_x[slot]) || node->child[slot] >= 0)
            continue;
        const f64 box[2][3] = {{node->lower_x[slot], node->lower_y[slot], node->lower_z[slot]},
                               {node->upper_x[slot], node->upper_y[slot], node->upper_z[slot]}};
        for (int k = 0; k < 3; k++) {
            const f64 share = random_unit(seed);
            point[k] = share < 0.4 ? box[0][k]
                       : share < 0.8 ? box[1][k] : box[0][k] + (box[1][k] - box[0][k]) * random_unit(seed);
        }
        return;
    }
}

static void normalize(f64 d[3])
{
    const f64 length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++)
        d[k] /= length;
}

// A quarter of the rays goes along an axis, another one within a coordinate plane, half of the rest anywhere and the
// others to the borders of boxes. Half of the coordinates are halves, as are those of half of the shapes, so that
// rays run along faces and edges.
static void make_rays(f32 *rays, i32 *selves, const Layout *layout, const Place *place, u64 seed)
{
    for (u32 i = 0; i < RAYS; i++) {
        f64 dir[3], target[3];
        random_direction(&seed, dir);
        const int axis = (int)(3 * random_unit(&seed));
        if (i % 8 < 4)
            dir[axis] = copysign(0, dir[axis]);
        if (i % 8 < 2)
            dir[(axis + 1) % 3] = copysign(0, dir[(axis + 1) % 3]);
        for (u32 k = 0; k < 3; k++)
            rays[k * RAYS + i] = place->at[k] + snapped(&seed, 9);
        if (i % 8 >= 6) {
            random_box_point(layout, &seed, target);
            for (u32 k = 0; k < 3; k++)
                dir[k] = target[k] - (f64)rays[k * RAYS + i];
        }
        normalize(dir);
        for (u32 k = 0; k < 3; k++)
            rays[(3 + k) * RAYS + i] = (f32)dir[k];
        // Most rays have no end; that of the others is where something may just be.
        rays[6 * RAYS + i] = i % 3 ? INFINITY : (f32)random_in(&seed, 0, 12);
        selves[i] = selves[RAYS + i] = -1;
    }
}

static Answer answer_create(void)
{
    Answer answer = {malloc(STEPS * RAYS * sizeof(f32)), malloc(2 * STEPS * RAYS * sizeof(i32))};
    assert_true(answer.t && answer.found);
    return answer;
}

static void answer_destroy(Answer *answer)
{
    free(answer->t);
    free(answer->found);
}

static void launch(const Search *search, const Space *s, bool all, bool any_hit, bool opaque_only, u32 steps,
                   Answer *answer)
{
    Kernel *k = search->search;
    // What the kernel leaves alone (steps after the last hit) is the same everywhere.
    CHECK(buffer_fill_u32(s->t, 0, 0, STEPS * RAYS * sizeof(f32), &error));
    CHECK(buffer_fill_u32(s->found, 0, 0, 2 * STEPS * RAYS * sizeof(i32), &error));
    CHECK(kernel_set_buffer(k, "primitives", s->primitives, &error));
    CHECK(kernel_set_buffer(k, "infos", s->infos, &error));
    CHECK(kernel_set_buffer(k, "nodes", s->nodes, &error));
    CHECK(kernel_set_u32(k, "plane_count", s->layout->plane_count, &error));
    CHECK(kernel_set_u32(k, "root", s->layout->root, &error));
    CHECK(kernel_set_buffer(k, "pairs", s->pairs, &error));
    CHECK(kernel_set_u32(k, "pair_count", all ? s->pair_count : 0, &error));
    CHECK(kernel_set_buffer(k, "rays_in", s->rays, &error));
    CHECK(kernel_set_buffer(k, "selves", s->selves, &error));
    CHECK(kernel_set_u32(k, "n", RAYS, &error));
    CHECK(kernel_set_u32(k, "steps", steps, &error));
    CHECK(kernel_set_u32(k, "any_hit", any_hit, &error));
    CHECK(kernel_set_u32(k, "opaque_only", opaque_only, &error));
    CHECK(kernel_set_buffer(k, "t", s->t, &error));
    CHECK(kernel_set_buffer(k, "found", s->found, &error));
    CHECK(kernel_launch(k, RAYS / search->batch, 1, &error));
    CHECK(buffer_download(s->t, 0, answer->t, STEPS * RAYS * sizeof(f32), &error));
    CHECK(buffer_download(s->found, 0, answer->found, 2 * STEPS * RAYS * sizeof(i32), &error));
}

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
        const i32 kind = b->found[2 * first] < 0 ? -1 : (i32)s->layout->primitives[b->found[2 * first]].kind;
        fail_msg("%s: %u of %u differ, the first in step %u: t %.9g and %.9g, primitives %d and %d, instances "
                 "%d and %d, kind of the second %d; ray from %.9g %.9g %.9g towards %.9g %.9g %.9g to %.9g",
                 what, differ, STEPS * RAYS, first / RAYS, (f64)a->t[first], (f64)b->t[first],
                 a->found[2 * first], b->found[2 * first], a->found[2 * first + 1], b->found[2 * first + 1],
                 kind, (f64)rays[ray], (f64)rays[RAYS + ray], (f64)rays[2 * RAYS + ray],
                 (f64)rays[3 * RAYS + ray], (f64)rays[4 * RAYS + ray], (f64)rays[5 * RAYS + ray],
                 (f64)rays[6 * RAYS + ray]);
    }
    return hits;
}

static void bounce(const Search *search, const Space *s, u64 seed)
{
    f32 *dirs = malloc(3 * RAYS * sizeof *dirs);
    assert_non_null(dirs);
    for (u32 i = 0; i < RAYS; i++) {
        f64 d[3];
        random_direction(&seed, d);
        for (u32 k = 0; k < 3; k++)
            dirs[k * RAYS + i] = (f32)d[k];
    }
    Kernel *k = search->bounce;
    Buffer *buffer = filled(search->device, "dirs", dirs, 3 * RAYS * sizeof *dirs);
    CHECK(kernel_set_buffer(k, "primitives", s->primitives, &error));
    CHECK(kernel_set_buffer(k, "infos", s->infos, &error));
    CHECK(kernel_set_buffer(k, "materials", s->materials, &error));
    CHECK(kernel_set_buffer(k, "extras", s->extras, &error));
    CHECK(kernel_set_u32(k, "n", RAYS, &error));
    CHECK(kernel_set_buffer(k, "t", s->t, &error));
    CHECK(kernel_set_buffer(k, "found", s->found, &error));
    CHECK(kernel_set_buffer(k, "dirs", buffer, &error));
    CHECK(kernel_set_buffer(k, "rays", s->rays, &error));
    CHECK(kernel_set_buffer(k, "selves", s->selves, &error));
    CHECK(kernel_launch(k, RAYS / search->lanes, 1, &error));
    CHECK(device_finish(search->device, &error));
    buffer_destroy(buffer);
    free(dirs);
}

// Both ways to search, in both programs, for the rays on the device.
static u32 compare_searches(const Devices *d, const Space *s, f32 *rays, const char *name)
{
    Answer all = answer_create(), other = answer_create();
    CHECK(buffer_download(s->rays, 0, rays, COLUMNS * RAYS * sizeof *rays, &error));
    launch(&d->vectors, s, true, false, false, STEPS, &all);
    launch(&d->vectors, s, false, false, false, STEPS, &other);
    char *what = text_of("%s, closest, hierarchy against all", name);
    const u32 hits = compare(s, rays, &other, &all, false, what);
    launch(&d->single, s, false, false, false, STEPS, &other);
    compare(s, rays, &other, &all, false, "the same, single rays");
    for (u32 opaque_only = 0; opaque_only < 2; opaque_only++) {
        launch(&d->vectors, s, true, true, opaque_only, 1, &all);
        launch(&d->vectors, s, false, true, opaque_only, 1, &other);
        compare(s, rays, &other, &all, true, "any hit");
        launch(&d->single, s, false, true, opaque_only, 1, &other);
        compare(s, rays, &other, &all, true, "any hit, single rays");
    }
    launch(&d->single, s, true, false, false, 1, &all); // and without the hierarchy, one step
    launch(&d->vectors, s, false, false, false, 1, &other);
    compare(s, rays, &other, &all, false, "closest, vectors against all by single rays");
    free(what);
    answer_destroy(&all);
    answer_destroy(&other);
    return hits;
}

static void check_scene(const Devices *d, const char *name, const char *scene, const Place *place, u64 seed)
{
    char *placed = text_of("%s%s", place->camera, scene);
    Space s = space_create(d->device, placed);
    free(placed);
    f32 *rays = malloc(COLUMNS * RAYS * sizeof *rays);
    i32 *selves = malloc(2 * RAYS * sizeof *selves);
    assert_true(rays && selves);
    make_rays(rays, selves, s.layout, place, seed);
    CHECK(buffer_upload(s.rays, 0, rays, COLUMNS * RAYS * sizeof *rays, &error));
    CHECK(buffer_upload(s.selves, 0, selves, 2 * RAYS * sizeof *selves, &error));
    const u32 first = compare_searches(d, &s, rays, name);
    bounce(&d->vectors, &s, seed); // t and found are those of closest hits
    const u32 second = compare_searches(d, &s, rays, name);
    print_message("%-28s %u primitives, %u rays, %u + %u hits\n", name, s.pair_count, 2 * RAYS, first, second);
    assert_true(first > RAYS / 10 && second > RAYS / 20);
    free(rays);
    free(selves);
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
static void append_shape(char **text, const char *kind, u64 *seed)
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
        text_append(&own, "plane { point %s normal %.4f %.4f %.4f", a, snapped(seed, 1), snapped(seed, 1), 1.25);
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
        text_append(&own, "cone { base 0 0 0 top 1 %g 0.5 radius %g top_radius %g caps %s translate %s", 2 * r,
                    r, random_unit(seed) < 0.5 ? 0.0 : 0.5, caps ? "on" : "off", a);
    else if (strcmp(kind, "torus") == 0)
        text_append(&own, "torus { center %s axis %s major %g minor %g", a, caps ? "0 1 0" : "1 0.5 0.2", r,
                    caps ? 0.25 * r : r);
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

static const char head[] = "material glass phong { transmit 0.9 }\nmaterial tinted phong { transmit 0 0.5 0 }\n";

static const char *const kinds[] = {"sphere", "giant",    "ellipsoid", "plane", "box",     "tetrahedron",
                                    "disk",   "cylinder", "cone",      "torus", "triangle"};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void test_each_kind(void **state)
{
    const Devices *d = *state;
    for (u32 k = 0; k < KINDS; k++) {
        char *scene = text_of("%s", head);
        u64 seed = 100 + k;
        const bool endless = strcmp(kinds[k], "plane") == 0 || strcmp(kinds[k], "giant") == 0;
        for (u32 i = 0; i < (endless ? 6 : SHAPES); i++)
            append_shape(&scene, kinds[k], &seed);
        text_append(&scene, "box { center 0 0 0 size 0.5 }\n"); // the programs want a hierarchy
        check_scene(d, kinds[k], scene, &near_place, 1000 + k);
        free(scene);
    }
}

// Shapes of all kinds but for endless ones, which are one each.
static void append_mixture(char **scene, u64 *seed, u32 count, bool endless)
{
    for (u32 i = 0; i < count; i++) {
        const char *kind = kinds[i % KINDS];
        const bool wide = strcmp(kind, "plane") == 0 || strcmp(kind, "giant") == 0;
        if (!wide || (endless && i < KINDS))
            append_shape(scene, kind, seed);
    }
}

// Objects within objects, mirrored, sheared and at the same place.
static char *instanced_scene(void)
{
    char *scene = text_of("%s", head);
    u64 seed = 77;
    text_append(&scene, "object inner {\n");
    append_mixture(&scene, &seed, 13, false);
    text_append(&scene, "}\nobject flat { disk { center 0 0 0 normal 0 1 0 radius 2 }\n"
                        "box { min -1 0 -1 max 1 0.5 1 } plane { point 0 -6 0 normal 0 1 0.1 } }\n"
                        "object single { sphere { center 0 0 0 radius 1 } }\n"
                        "object outer {\ninstance inner { scale 0.5 translate 2 0 0 }\n"
                        "instance inner { scale 0.4 -0.5 0.6 rotate z 40 translate -3 1 0 material tinted }\n"
                        "sphere { center 0 0 0 radius 1.5 }\nbox { min -4 -2 -4 max 4 -1.5 4 }\n}\n");
    append_mixture(&scene, &seed, 9, true);
    for (u32 i = 0; i < 3; i++) {
        char *at = point(&seed, 4);
        text_append(&scene, "instance outer { matrix 1 0.3 0 0  0 1 0.2 0  0.1 0 1 0 rotate y %u translate %s }\n",
                    90 * i, at);
        text_append(&scene, "instance flat { rotate x %u translate %s material glass }\n", 45 * i, at);
        text_append(&scene, "instance single { translate %s }\n", at);
        free(at);
    }
    text_append(&scene, "instance flat { translate 0 1 0 }\ninstance flat { translate 0 1 0 material glass }\n"
                        "box { min -1 1 -1 max 1 1.5 1 }\ninstance inner { scale 1e-3 translate 0 -1 0 }\n"
                        "instance inner { scale 1e3 }\n");
    return scene;
}

static void test_all_kinds(void **state)
{
    char *scene = text_of("%s", head);
    u64 seed = 5;
    append_mixture(&scene, &seed, 120, true);
    check_scene(*state, "all kinds", scene, &near_place, 50);
    check_scene(*state, "all kinds, far away", scene, &far_place, 51);
    free(scene);
}

static void test_instances(void **state)
{
    char *scene = instanced_scene();
    check_scene(*state, "instances", scene, &near_place, 60);
    check_scene(*state, "instances, far away", scene, &far_place, 61);
    free(scene);
}

// Everything twice, at the same place: only what comes first is ever seen.
static void test_first_defined_wins(void **state)
{
    const Devices *d = *state;
    char *once = NULL, *scene = text_of("%sobject pair { sphere { center 0 0 0 radius 0.8 } "
                                        "torus { center 0 0 0 axis 0 1 0 major 1.2 minor 0.3 } }\n", head);
    u64 seed = 8;
    append_mixture(&once, &seed, 60, true);
    text_append(&once, "instance pair { translate 1 2 -3 }\ninstance pair { scale 2 rotate x 30 }\n");
    text_append(&scene, "%s%s", once, once);
    Space s = space_create(d->device, scene);
    u64 end = 0; // of the order of definition
    for (u32 i = 0; i < s.layout->primitive_count; i++) {
        const u64 order = (u64)s.layout->infos[i].order_high << 32 | s.layout->infos[i].order_low;
        const bool instance = (s.layout->primitives[i].kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE;
        end = order + (instance ? 2 : 1) > end ? order + (instance ? 2 : 1) : end;
    }
    f32 *rays = malloc(COLUMNS * RAYS * sizeof *rays);
    i32 *selves = malloc(2 * RAYS * sizeof *selves);
    assert_true(rays && selves && end % 2 == 0);
    make_rays(rays, selves, s.layout, &near_place, 80);
    CHECK(buffer_upload(s.rays, 0, rays, COLUMNS * RAYS * sizeof *rays, &error));
    CHECK(buffer_upload(s.selves, 0, selves, 2 * RAYS * sizeof *selves, &error));
    compare_searches(d, &s, rays, "everything twice");
    Answer answer = answer_create();
    const Search *searches[] = {&d->vectors, &d->single};
    for (u32 k = 0; k < 2; k++) {
        launch(searches[k], &s, false, false, false, 2, &answer);
        u32 hits = 0;
        for (u32 i = 0; i < 2 * RAYS; i++) {
            if (answer.found[2 * i] < 0 || (i >= RAYS && answer.found[2 * (i - RAYS)] < 0))
                continue;
            u64 order = 0;
            for (u32 part = 0; part < 2; part++) {
                const i32 at = answer.found[2 * i + part];
                if (at >= 0)
                    order += (u64)s.layout->infos[at].order_high << 32 | s.layout->infos[at].order_low;
            }
            hits++;
            // The first hit belongs to the first half; right behind it, at the same t, is its twin.
            assert_true((order < end / 2) == (i < RAYS));
            if (i >= RAYS)
                assert_memory_equal(&answer.t[i], &answer.t[i - RAYS], sizeof(f32));
        }
        assert_true(hits > RAYS / 2);
    }
    answer_destroy(&answer);
    free(rays);
    free(selves);
    free(once);
    free(scene);
    space_destroy(&s);
}

int main(void)
{
    Devices d = {.device = test_device_open(0)};
    if (!d.device)
        return TEST_SKIP;
    d.vectors = search_create(d.device, 8, 32);
    d.single = search_create(d.device, 1, 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_each_kind, &d),
        cmocka_unit_test_prestate(test_all_kinds, &d),
        cmocka_unit_test_prestate(test_instances, &d),
        cmocka_unit_test_prestate(test_first_defined_wins, &d),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    search_destroy(&d.vectors);
    search_destroy(&d.single);
    device_close(d.device);
    return failed;
}
