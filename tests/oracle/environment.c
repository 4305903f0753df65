#include "environment.h"

#include "transform.h"

void environment_turn(Environment *environment, real degrees)
{
    environment->from_map = transform_rotate(vec(0, 1, 0), degrees);
    environment->to_map = transform_rotate(vec(0, 1, 0), -degrees);
}

void environment_uv(const Environment *environment, Vec d, real *u, real *v)
{
    d = transform_vector(&environment->to_map, d);
    *u = 0.5L + atan2l(d.x, -d.z) / (2 * PI);
    *v = acosl(fminl(1, fmaxl(-1, d.y))) / PI;
}

Vec environment_direction(const Environment *environment, real u, real v)
{
    real around_y = 2 * PI * (u - 0.5L);
    real sine = sinl(PI * v);
    return transform_vector(&environment->from_map, vec(sine * sinl(around_y), cosl(PI * v), -sine * cosl(around_y)));
}

static Vec map_value(const Environment *environment, real u, real v)
{
    const Image *image = environment->image;
    return image_bilinear(image, image->values, u * image->width, v * image->height, false);
}

Vec environment_radiance(const Environment *environment, Vec d)
{
    real u, v;
    environment_uv(environment, d, &u, &v);
    return times(environment->intensity, map_value(environment, u, v));
}

/* Weight of a texel: its own value and those its bilinear neighbourhood mixes in, so that no lit place is
 * left out, by the solid angle. */
static real texel_weight(const Environment *environment, int column, int row)
{
    const Image *image = environment->image;
    real sum = 0;
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            Vec value = map_value(environment, (column + (i + 0.5L) / 3) / image->width,
                                  (row + (j + 0.5L) / 3) / image->height);
            sum += value.x + value.y + value.z;
        }
    }
    return sum * (cosl(PI * row / image->height) - cosl(PI * (row + 1) / image->height));
}

void environment_prepare(Store *store, Environment *environment)
{
    int width = environment->image->width;
    int height = environment->image->height;
    environment->rows = store_alloc(store, (size_t)height * sizeof(real));
    environment->texels = store_alloc(store, (size_t)height * (size_t)width * sizeof(real));
    real total = 0;
    for (int row = 0; row < height; row++) {
        real *texels = &environment->texels[(size_t)row * (size_t)width];
        real sum = 0;
        for (int column = 0; column < width; column++)
            texels[column] = sum += texel_weight(environment, column, row);
        environment->rows[row] = total += sum;
        for (int column = 0; column < width; column++)
            texels[column] /= sum > 0 ? sum : 1;
    }
    for (int row = 0; row < height; row++)
        environment->rows[row] /= total > 0 ? total : 1;
}

/* The cell of a running sum that holds s, and how far into it s is. */
static int find_cell(const real *sums, int count, real s, real *inside)
{
    int cell = 0;
    while (cell + 1 < count && s >= sums[cell])
        cell++;
    real before = cell > 0 ? sums[cell - 1] : 0;
    real share = sums[cell] - before;
    *inside = share > 0 ? fminl(1, (s - before) / share) : 0.5L;
    return cell;
}

Vec environment_choose(const Environment *environment, Square s)
{
    const Image *image = environment->image;
    real x, y;
    int row = find_cell(environment->rows, image->height, s.x, &y);
    int column = find_cell(&environment->texels[(size_t)row * (size_t)image->width], image->width, s.y, &x);
    /* Uniform in solid angle within the texel. */
    real top = cosl(PI * row / image->height);
    real bottom = cosl(PI * (row + 1) / image->height);
    real v = acosl(top + (bottom - top) * y) / PI;
    return environment_direction(environment, (column + x) / image->width, v);
}

real environment_density(const Environment *environment, Vec d)
{
    const Image *image = environment->image;
    real u, v;
    environment_uv(environment, d, &u, &v);
    int column = (int)fminl(image->width - 1, u * image->width);
    int row = (int)fminl(image->height - 1, v * image->height);
    const real *rows = environment->rows;
    const real *texels = &environment->texels[(size_t)row * (size_t)image->width];
    real share = (rows[row] - (row > 0 ? rows[row - 1] : 0)) *
                 (texels[column] - (column > 0 ? texels[column - 1] : 0));
    real angle = 2 * PI / image->width *
                 (cosl(PI * row / image->height) - cosl(PI * (row + 1) / image->height));
    return share / angle;
}
