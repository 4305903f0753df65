#include "hierarchy_support.h"

#include <math.h>

enum { BUNDLE = 32 }; // rays, as many as the largest batches

f32 snapped(u64 *seed, f64 range)
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

// A random point on an edge, a corner or a face of the box of a random leaf of the top-level hierarchy, where
// the least error of a box shows.
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
            point[k] = share < 0.4   ? box[0][k]
                       : share < 0.8 ? box[1][k]
                                     : box[0][k] + (box[1][k] - box[0][k]) * random_unit(seed);
        }
        return;
    }
}

// A random point of a face that rays can meet, often on an edge or a vertex of it. False where the random
// thing that can be met is no face.
static bool random_face_point(const Space *s, u64 *seed, f64 point[3])
{
    const i32 *pair = s->list[(u32)(s->pair_count * random_unit(seed))];
    if (!(pair[0] & FACE))
        return false;
    const TriangleBlock *block = &s->layout->blocks[(pair[0] & (FACE - 1)) / BLOCK_WIDTH];
    u32 count = 0;
    while (count < BLOCK_WIDTH && block->face[count] != NO_INDEX)
        count++;
    const u32 lane = (u32)(count * random_unit(seed));
    const f64 way = random_unit(seed), share = random_unit(seed);
    const f64 b = way < 0.3 ? 0 : way < 0.7 ? share : 0.9 * share, c = way < 0.7 ? 0 : 0.9 - b;
    f64 q[3];
    for (int k = 0; k < 3; k++)
        q[k] = (1 - b - c) * (f64)block->vertex[0][k][lane] + b * (f64)block->vertex[1][k][lane] +
               c * (f64)block->vertex[2][k][lane];
    Vec3 p = {q[0], q[1], q[2]};
    if (pair[1] >= 0) {
        const Primitive *map = &s->layout->primitives[pair[1]];
        const f32x4 x = map->row0, y = map->row1, z = map->row2;
        const Affine to_object = {.row = {{(f64)x.x, (f64)x.y, (f64)x.z},
                                          {(f64)y.x, (f64)y.y, (f64)y.z},
                                          {(f64)z.x, (f64)z.y, (f64)z.z}}};
        p = affine_point(affine_inverse(to_object), p);
        p = vec_add(p, (Vec3){(f64)x.w, (f64)y.w, (f64)z.w});
    }
    point[0] = p.x;
    point[1] = p.y;
    point[2] = p.z;
    return true;
}

static void normalize(f64 d[3])
{
    const f64 length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++)
        d[k] /= length;
}

// What the rays of a bundle have in common.
typedef struct Bundle {
    f64 org[3], dir[3];
} Bundle;

static Bundle make_bundle(const Place *place, u64 *seed)
{
    Bundle bundle;
    random_direction(seed, bundle.dir);
    for (u32 k = 0; k < 3; k++)
        bundle.org[k] = (f64)place->at[k] - 10 * bundle.dir[k] + random_in(seed, -3, 3);
    if (random_unit(seed) < 0.3) // along an axis, to edges and faces at halves
        for (u32 k = 0; k < 3; k++)
            bundle.dir[k] = fabs(bundle.dir[k]) > 0.58 ? bundle.dir[k] : copysign(0, bundle.dir[k]);
    return bundle;
}

// Rays that a packet can take together: about the same way, some of them with an end.
static void make_bundled(f32 *rays, u32 i, const Place *place, const Bundle *bundle, u64 *seed)
{
    f64 dir[3];
    for (u32 k = 0; k < 3; k++) {
        const f64 at = bundle->org[k] - (f64)place->at[k] + random_in(seed, -0.5, 0.5);
        rays[k * RAYS + i] = place->at[k] + (f32)(random_unit(seed) < 0.5 ? floor(2 * at) / 2 : at);
        dir[k] = bundle->dir[k] * random_in(seed, 0.95, 1.05);
    }
    normalize(dir);
    for (u32 k = 0; k < 3; k++)
        rays[(3 + k) * RAYS + i] = (f32)dir[k];
    rays[6 * RAYS + i] = i % 3 ? INFINITY : (f32)random_in(seed, 0, 24);
}

// A quarter of the rays goes along an axis, another one within a coordinate plane, half of the rest anywhere
// and the others to the borders of boxes and, where there are meshes, of faces. Half of the coordinates are
// halves, as are those of half of the shapes, so that rays run along faces and edges.
static void make_mixed(f32 *rays, u32 i, const Space *space, const Place *place, u64 *seed)
{
    f64 dir[3], target[3];
    random_direction(seed, dir);
    const int axis = (int)(3 * random_unit(seed));
    if (i % 8 < 4)
        dir[axis] = copysign(0, dir[axis]);
    if (i % 8 < 2)
        dir[(axis + 1) % 3] = copysign(0, dir[(axis + 1) % 3]);
    for (u32 k = 0; k < 3; k++)
        rays[k * RAYS + i] = place->at[k] + snapped(seed, 9);
    if (i % 8 >= 6) {
        if (i % 8 == 6 || !random_face_point(space, seed, target))
            random_box_point(space->layout, seed, target);
        for (u32 k = 0; k < 3; k++)
            dir[k] = target[k] - (f64)rays[k * RAYS + i];
    }
    normalize(dir);
    for (u32 k = 0; k < 3; k++)
        rays[(3 + k) * RAYS + i] = (f32)dir[k];
    // Most rays have no end; that of the others is where something may just be.
    rays[6 * RAYS + i] = i % 3 ? INFINITY : (f32)random_in(seed, 0, 12);
}

// Every third batch is a bundle, so that the ways of packets are taken as well as those of single rays.
static void make_rays(f32 *rays, i32 *selves, const Space *space, const Place *place, u64 seed)
{
    for (u32 begin = 0; begin < RAYS; begin += BUNDLE) {
        const bool bundled = begin / BUNDLE % 3 == 2;
        const Bundle bundle = make_bundle(place, &seed);
        for (u32 i = begin; i < begin + BUNDLE; i++) {
            if (bundled)
                make_bundled(rays, i, place, &bundle, &seed);
            else
                make_mixed(rays, i, space, place, &seed);
            selves[i] = selves[RAYS + i] = -1;
        }
    }
}

void space_aim(const Space *space, const Place *place, u64 seed)
{
    Error error = {0};
    f32 *rays = malloc(COLUMNS * RAYS * sizeof *rays);
    i32 *selves = malloc(2 * RAYS * sizeof *selves);
    assert_true(rays && selves);
    make_rays(rays, selves, space, place, seed);
    must(buffer_upload(space->rays, 0, rays, COLUMNS * RAYS * sizeof *rays, &error), &error);
    must(buffer_upload(space->selves, 0, selves, 2 * RAYS * sizeof *selves, &error), &error);
    free(rays);
    free(selves);
}

void space_leave_out_faces(const Space *s)
{
    Error error = {0};
    i32 *found = malloc(2 * RAYS * sizeof *found), *selves = malloc(2 * RAYS * sizeof *selves);
    assert_true(found && selves);
    must(buffer_download(s->found, 0, found, 2 * RAYS * sizeof *found, &error), &error);
    for (u32 i = 0; i < RAYS; i++) {
        selves[i] = found[2 * i] >= 0 && found[2 * i] & FACE ? 2 * found[2 * i] : -1;
        selves[RAYS + i] = found[2 * i + 1];
    }
    must(buffer_upload(s->selves, 0, selves, 2 * RAYS * sizeof *selves, &error), &error);
    free(found);
    free(selves);
}

void search_bounce(const Search *search, const Space *s, u64 seed)
{
    Error error = {0};
    f32 *dirs = malloc(3 * RAYS * sizeof *dirs);
    assert_non_null(dirs);
    for (u32 i = 0; i < RAYS; i++) {
        f64 d[3];
        random_direction(&seed, d);
        for (u32 k = 0; k < 3; k++)
            dirs[k * RAYS + i] = (f32)d[k];
    }
    Kernel *k = search->bounce;
    Buffer *buffer = buffer_create(search->device, "dirs", 3 * RAYS * sizeof *dirs, &error);
    must(buffer && buffer_upload(buffer, 0, dirs, 3 * RAYS * sizeof *dirs, &error), &error);
    space_bind(s, k);
    must(kernel_set_buffer(k, "mesh_indices", s->mesh_indices, &error), &error);
    must(kernel_set_buffer(k, "mesh_normals", s->mesh_normals, &error), &error);
    must(kernel_set_buffer(k, "materials", s->materials, &error), &error);
    must(kernel_set_buffer(k, "extras", s->extras, &error), &error);
    must(kernel_set_u32(k, "n", RAYS, &error), &error);
    must(kernel_set_buffer(k, "t", s->t, &error), &error);
    must(kernel_set_buffer(k, "found", s->found, &error), &error);
    must(kernel_set_buffer(k, "dirs", buffer, &error), &error);
    must(kernel_set_buffer(k, "rays", s->rays, &error), &error);
    must(kernel_set_buffer(k, "selves", s->selves, &error), &error);
    must(kernel_launch(k, RAYS / search->lanes, 1, &error), &error);
    must(device_finish(search->device, &error), &error);
    buffer_destroy(buffer);
    free(dirs);
}
