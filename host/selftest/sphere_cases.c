// Spheres: far, giant, tiny and grazed ones; where rays start and how long they are.
#include <math.h>

#include "selftest/random.h"
#include "selftest/run.h"

static const Vec3 ORIGIN = {0, 0, 0};

// A primitive of kind SPHERE, also where baking would make it a giant one.
static Primitive plain_sphere(Vec3 center, f64 radius)
{
    return (Primitive){.row0 = {1, 0, 0, (f32)center.x},
                       .row1 = {0, 1, 0, (f32)center.y},
                       .row2 = {0, 0, 1, (f32)center.z},
                       .p0 = (f32)radius,
                       .kind = PRIMITIVE_SPHERE};
}

// The first meeting of a ray from o, rounded to float, with |p - c| = r from outside, in long double.
static f64 sphere_distance(Vec3 o, Vec3 direction, Vec3 c, f64 r)
{
    const long double f[3] = {(long double)o.x - c.x, (long double)o.y - c.y, (long double)o.z - c.z};
    const long double d[3] = {(f32)direction.x, (f32)direction.y, (f32)direction.z};
    long double ff = 0, fd = 0, dd = 0;
    for (int k = 0; k < 3; k++) {
        ff += f[k] * f[k];
        fd += f[k] * d[k];
        dd += d[k] * d[k];
    }
    const long double excess = ff - (long double)r * r;
    return (f64)(excess / (-fd + sqrtl(fd * fd - dd * excess)));
}

static void far_spheres(Sheet *sheet)
{
    static const f64 DISTANCES[] = {100, 2000, 4100, 8000, 1e5, 1e6, 1e7};
    sheet_case(sheet, "C1", "unit sphere 100 to 1e7 away, half off the axis", "D - sqrt(3/4)", UNIT_ULP, 2);
    for (u32 i = 0; i < sizeof DISTANCES / sizeof DISTANCES[0]; i++) {
        sheet_primitive(sheet, plain_sphere((Vec3){0, 0, DISTANCES[i]}, 1));
        sheet_ray(sheet, (Vec3){0.5, 0, 0}, (Vec3){0, 0, 1}, DISTANCES[i] - sqrt(0.75));
    }
}

static void giant_floors(Sheet *sheet)
{
    static const f64 RADII[] = {1e5, 1e6, 6.4e6};
    const Vec3 eye = {0, 1, 0}, down = {.70710677, -.70710677, 0}, along = {.99995, -.0099998, 0};
    sheet_case(sheet, "C2", "floors of radius 1e5 to 6.4e6, 1 below the eye", "long double", UNIT_ULP, 4);
    for (u32 i = 0; i < 3; i++) {
        const Vec3 c = {0, -RADII[i], 0};
        sheet_primitive(sheet, plain_sphere(c, RADII[i]));
        sheet_ray(sheet, eye, down, sphere_distance(eye, down, c, RADII[i]));
    }
    sheet_case(sheet, "C3", "floor of radius 6.4e6, grazed 100 away", "long double", UNIT_ULP, 8);
    sheet_ray(sheet, eye, along, sphere_distance(eye, along, (Vec3){0, -6.4e6, 0}, 6.4e6));
}

// The same floors as the layout makes them, in any direction, the eye in the origin. Rounding the centre and
// the ray tilts the ground by about an ulp, which counts by how flat the ray is.
static void baked_floors(Sheet *sheet)
{
    u64 random = 2;
    sheet_case(sheet, "C2", "such floors in any direction, as scenes have them", "long double", UNIT_RELATIVE,
               24 * 0x1p-24);
    for (u32 i = 0; i < 48; i++) {
        const f64 r = i % 3 == 0 ? 1e5 : i % 3 == 1 ? 1e6 : 6.4e6;
        const Vec3 up = random_direction(&random);
        const Vec3 side = vec_normalize(vec_cross(up, random_direction(&random)));
        const Vec3 d = vec_normalize(vec_sub(side, vec_scale(up, random_in(&random, 0.2, 2))));
        const Shape shape = {.kind = SHAPE_SPHERE, .as.sphere = {vec_scale(up, -(r + 1.7)), r}};
        sheet_shape(sheet, &shape, affine_identity());
        sheet_ray(sheet, ORIGIN, d, sphere_distance(ORIGIN, d, shape.as.sphere.center, r));
    }
}

static void tiny_and_grazed(Sheet *sheet)
{
    static const f64 TINY[3][2] = {{1e-6, 1}, {1e-4, 1}, {1e-4, 10}};
    const Vec3 ahead = {0, 0, 1};
    sheet_case(sheet, "C4", "radius 1e-6 and 1e-4 at 1 and 10", "D - r", UNIT_ULP, 1);
    for (u32 i = 0; i < 3; i++) {
        sheet_primitive(sheet, plain_sphere((Vec3){0, 0, TINY[i][1]}, TINY[i][0]));
        sheet_ray(sheet, ORIGIN, ahead, TINY[i][1] - (f64)(f32)TINY[i][0]);
    }
    const f64 inside = nextafterf(1, 0), outside = nextafterf(1, 2);
    sheet_case(sheet, "C5", "unit sphere an ulp inside and outside its rim", "closed form", UNIT_ULP, 2);
    sheet_primitive(sheet, plain_sphere(ORIGIN, 1));
    sheet_ray(sheet, (Vec3){inside, 0, -5}, ahead, 5 - sqrt(1 - inside * inside));
    sheet_ray(sheet, (Vec3){outside, 0, -5}, ahead, INFINITY);
}

// Beyond the range in which squares are floats there is no distance to be had, but no NaN either.
static void extremes(Sheet *sheet)
{
    sheet_case(sheet, "C7", "radius 1e20, beyond what floats can square", "no hit", UNIT_WRONG, 0);
    sheet_primitive(sheet, plain_sphere(ORIGIN, 1e20));
    sheet_ray(sheet, (Vec3){0, 0, -3e20}, (Vec3){0, 0, 1}, INFINITY);
    sheet_case(sheet, "C7", "radius 1e-23: t to within the radius", "closed form", UNIT_RELATIVE, 0.5001);
    sheet_primitive(sheet, plain_sphere(ORIGIN, 1e-23));
    sheet_ray(sheet, (Vec3){0, 0, -3e-23}, (Vec3){0, 0, 1}, 2e-23);
}

static void starts_and_lengths(Sheet *sheet)
{
    const Vec3 up = {0, 1, 0}, ahead = {0, 0, 1};
    sheet_case(sheet, "C10", "from the surface outward, from the centre", "0 or 1 hits", UNIT_ULP, 0);
    sheet_primitive(sheet, plain_sphere(ORIGIN, 1));
    sheet_ray(sheet, up, up, INFINITY);
    sheet_ray(sheet, ORIGIN, up, 1);
    sheet_case(sheet, "C10", "from an ulp inside outward", "2^-23", UNIT_ULP, 4);
    sheet_ray(sheet, (Vec3){0, 1 - 0x1p-23, 0}, up, 0x1p-23);
    static const f64 LENGTHS[] = {1e-6, 1e-3, 1e3, 1e6};
    sheet_case(sheet, "C11", "direction of length 1e-6 to 1e6", "4 / length", UNIT_ULP, 2);
    for (u32 i = 0; i < sizeof LENGTHS / sizeof LENGTHS[0]; i++)
        sheet_ray(sheet, (Vec3){0, 0, -5}, vec_scale(ahead, LENGTHS[i]), 4 / (f64)(f32)LENGTHS[i]);
    sheet_case(sheet, "C11", "of length 1e-25, 1e-40: a clean miss", "no hit", UNIT_WRONG, 0);
    sheet_ray(sheet, (Vec3){0, 0, -5}, (Vec3){0, 0, 1e-25}, INFINITY);
    sheet_ray(sheet, (Vec3){0, 0, -5}, (Vec3){0, 0, 1e-40}, INFINITY);
}

bool sphere_cases(Run *run)
{
    Sheet *sheet = sheet_create(run);
    if (!sheet)
        return false;
    far_spheres(sheet);
    giant_floors(sheet);
    baked_floors(sheet);
    tiny_and_grazed(sheet);
    starts_and_lengths(sheet);
    extremes(sheet);
    return sheet_run(sheet);
}
