#include "hierarchy_support.h"

#include <math.h>

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

// A quarter of the rays goes along an axis, another one within a coordinate plane, half of the rest anywhere
// and the others to the borders of boxes. Half of the coordinates are halves, as are those of half of the
// shapes, so that rays run along faces and edges.
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

void space_aim(const Space *space, const Place *place, u64 seed)
{
    Error error = {0};
    f32 *rays = malloc(COLUMNS * RAYS * sizeof *rays);
    i32 *selves = malloc(2 * RAYS * sizeof *selves);
    assert_true(rays && selves);
    make_rays(rays, selves, space->layout, place, seed);
    must(buffer_upload(space->rays, 0, rays, COLUMNS * RAYS * sizeof *rays, &error), &error);
    must(buffer_upload(space->selves, 0, selves, 2 * RAYS * sizeof *selves, &error), &error);
    free(rays);
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
    must(kernel_set_buffer(k, "primitives", s->primitives, &error), &error);
    must(kernel_set_buffer(k, "infos", s->infos, &error), &error);
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
