#include "film.h"

#include "path.h"

real filter_radius(Filter filter)
{
    static const real RADII[] = {0.5L, 1, 1.5L, 2};
    return RADII[filter];
}

/* Mitchell and Netravali 1988 with B = C = 1/3; x >= 0. */
static real mitchell(real x)
{
    const real b = 1.0L / 3;
    const real c = 1.0L / 3;
    real x2 = x * x;
    real x3 = x * x * x;
    if (x < 1)
        return ((12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + (6 - 2 * b)) / 6;
    return ((-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

real filter_value(Filter filter, real x)
{
    x = fabsl(x);
    if (x > filter_radius(filter))
        return 0;
    switch (filter) {
    case FILTER_BOX:
        return 1;
    case FILTER_TENT:
        return 1 - x;
    case FILTER_GAUSSIAN:
        return expl(-2 * x * x) - expl(-2 * 1.5L * 1.5L);
    case FILTER_MITCHELL:
        return mitchell(x);
    }
    return 0;
}

real filter_integral(Filter filter)
{
    return filter == FILTER_GAUSSIAN ? sqrtl(PI / 2) * erfl(1.5L * sqrtl(2)) - 3 * expl(-4.5L) : 1;
}

/* Through one position of the image, by all of the lens. */
static Vec position_value(const Scene *scene, const Camera *camera, real px, real py)
{
    int count = camera->aperture > 0 ? scene->points : 1;
    Lattice lattice = lattice_at(count, vec(px, py, 0), 0);
    Vec sum = grey(0);
    for (int i = 0; i < count; i++) {
        Ray ray = camera_ray(camera, px, py, disk_point(lattice_point(&lattice, i)));
        sum = add(sum, trace_radiance(scene, &ray));
    }
    return scaled(sum, 1 / (real)count);
}

Vec film_pixel(const Scene *scene, const Camera *camera, int grid, int x, int y, real dx, real dy)
{
    Vec sum = grey(0);
    real weights = 0;
    /* One position a cell, each with a column and a row of its own, so that upright and level edges are met as
     * well as others (the canonical arrangement of Kensler, "Correlated Multi-Jittered Sampling", 2013). */
    real step = 2 * filter_radius(scene->filter) / grid;
    for (int j = 0; j < grid; j++) {
        for (int i = 0; i < grid; i++) {
            real fx = (i + (j + 0.5L) / grid - grid / 2.0L) * step;
            real fy = (j + (i + 0.5L) / grid - grid / 2.0L) * step;
            real weight = filter_value(scene->filter, fx) * filter_value(scene->filter, fy);
            Vec value = position_value(scene, camera, x + 0.5L + fx + dx, y + 0.5L + fy + dy);
            sum = add(sum, scaled(value, weight));
            weights += weight;
        }
    }
    return scaled(sum, 1 / weights);
}

/* One path about the pixel's centre (px, py). */
static Vec path_value(const Scene *scene, const Camera *camera, real px, real py, Chance *chance)
{
    Filter filter = scene->filter;
    Vec lens = disk_point(chance_draw(chance));
    Square place = chance_draw(chance);
    if (chance->count == 1) {
        Ray ray = camera_ray(camera, px, py, lens);
        return path_radiance(scene, &ray, chance);
    }
    real support = 2 * filter_radius(filter);
    real fx = (place.x - 0.5L) * support;
    real fy = (place.y - 0.5L) * support;
    Ray ray = camera_ray(camera, px + fx, py + fy, lens);
    real weight = filter_value(filter, fx) * filter_value(filter, fy) * support * support /
                  (filter_integral(filter) * filter_integral(filter));
    return scaled(path_radiance(scene, &ray, chance), weight);
}

Estimate film_paths(const Scene *scene, const Camera *camera, const Paths *paths, int x, int y, real dx,
                    real dy)
{
    uint64_t key = key_with(key_with(paths->seed, (uint64_t)x), (uint64_t)y);
    int count = paths->grid * paths->grid;
    Vec sum = grey(0);
    Vec squares = grey(0);
    for (int round = 0; round < paths->rounds; round++) {
        Vec value = grey(0);
        for (int i = 0; i < count; i++) {
            Chance chance = chance_make(key_with(key, (uint64_t)round), count, i);
            value = add(value, path_value(scene, camera, x + 0.5L + dx, y + 0.5L + dy, &chance));
        }
        value = scaled(value, 1 / (real)count);
        sum = add(sum, value);
        squares = add(squares, times(value, value));
    }
    real rounds = paths->rounds;
    Vec mean = scaled(sum, 1 / rounds);
    Vec spread = sub(scaled(squares, 1 / rounds), times(mean, mean));
    /* Rounding can make it less than 0 where there is none. */
    spread = vec(fmaxl(0, spread.x), fmaxl(0, spread.y), fmaxl(0, spread.z));
    return (Estimate){mean, scaled(spread, 1 / fmaxl(1, rounds - 1))};
}
