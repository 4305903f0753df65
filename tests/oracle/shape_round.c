/* Sphere, and the cone with its special case the cylinder. */
#include "shape.h"

/* An angle of atan2 over 2 pi, in [0, 1). */
static real turn(real y, real x)
{
    real t = atan2l(y, x) / (2 * PI);
    t -= floorl(t);
    return t < 1 ? t : 0;
}

/* Roots of a t^2 + 2 b t + c = 0 without cancellation; those of them that are not finite are left out. */
static int quadratic_roots(real a, real b, real c, real discriminant, real roots[2])
{
    if (!(discriminant >= 0))
        return 0;
    real q = -(b + copysignl(sqrtl(discriminant), b));
    int count = 0;
    if (a != 0 && isfinite(q / a))
        roots[count++] = q / a;
    if (q != 0 && isfinite(c / q))
        roots[count++] = c / q;
    else if (q == 0 && a != 0)
        roots[count++] = 0;
    return count;
}

int sphere_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    Vec f = sub(line->o, shape->center);
    real a = dot(line->d, line->d);
    real b = dot(f, line->d);
    real distance = length(f);
    real c = (distance - shape->radius) * (distance + shape->radius);
    /* r^2 less the squared distance of the line from the centre. */
    real closest = length(sub(f, scaled(line->d, b / a)));
    real roots[2];
    int count = quadratic_roots(a, b, c, a * (shape->radius - closest) * (shape->radius + closest), roots);
    for (int i = 0; i < count; i++)
        out[i] = (Crossing){roots[i], 0, false};
    return count;
}

Surface sphere_surface(const Shape *shape, Vec p)
{
    Vec n = normalized(sub(p, shape->center));
    real u = n.x == 0 && n.z == 0 ? 0.5L : 0.5L + atan2l(n.x, n.z) / (2 * PI);
    real around = hypotl(n.x, n.z);
    Vec du = scaled(vec(n.z, 0, -n.x), 2 * PI * shape->radius);
    Vec dv = grey(0);
    if (around > 0)
        dv = scaled(vec(-n.y * n.x / around, around, -n.y * n.z / around), PI * shape->radius);
    return (Surface){n, n, u < 1 ? u : 0, 1 - acosl(fminl(1, fmaxl(-1, n.y))) / PI, du, dv};
}

static int cap_crossing(const Shape *shape, const Line *line, int patch, Crossing *out)
{
    real radius = patch == 1 ? shape->radius : shape->top_radius;
    real level = patch == 1 ? 0 : shape->height;
    real toward = dot(line->d, shape->normal);
    if (radius == 0 || toward == 0)
        return 0;
    Vec middle = add(shape->center, scaled(shape->normal, level));
    real t = dot(sub(middle, line->o), shape->normal) / toward;
    Vec q = sub(add(line->o, scaled(line->d, t)), middle);
    q = sub(q, scaled(shape->normal, dot(q, shape->normal)));
    if (!(dot(q, q) <= radius * radius))
        return 0;
    *out = (Crossing){t, patch, false};
    return 1;
}

int cone_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    /* From the point of the line closest to the middle, so that a far origin costs no digits. */
    Vec middle = add(shape->center, scaled(shape->normal, shape->height / 2));
    real shift = dot(sub(middle, line->o), line->d) / dot(line->d, line->d);
    Vec f = sub(add(line->o, scaled(line->d, shift)), shape->center);
    real slope = (shape->top_radius - shape->radius) / shape->height;
    real z = dot(f, shape->normal);
    real dz = dot(line->d, shape->normal);
    Vec across = sub(f, scaled(shape->normal, z));
    Vec d_across = sub(line->d, scaled(shape->normal, dz));
    /* |across + t d_across| = radius + slope (z + t dz), both sides squared. */
    real width = shape->radius + slope * z;
    real a = dot(d_across, d_across) - slope * slope * dz * dz;
    real b = dot(across, d_across) - slope * dz * width;
    real c = (length(across) - width) * (length(across) + width);
    real roots[2];
    int found = quadratic_roots(a, b, c, b * b - a * c, roots);
    int count = 0;
    for (int i = 0; i < found; i++) {
        real height = z + roots[i] * dz;
        if (height >= 0 && height <= shape->height)
            out[count++] = (Crossing){roots[i] + shift, 0, false};
    }
    if (shape->caps) {
        count += cap_crossing(shape, line, 1, &out[count]);
        count += cap_crossing(shape, line, 2, &out[count]);
    }
    return count;
}

Surface cone_surface(const Shape *shape, Vec p, int patch)
{
    Vec q = sub(p, shape->center);
    real height = dot(q, shape->normal);
    Vec across = sub(q, scaled(shape->normal, height));
    if (patch != 0) {
        Vec n = scaled(shape->normal, patch == 1 ? -1 : 1);
        real radius = patch == 1 ? shape->radius : shape->top_radius;
        Vec t1, t2;
        tangents_of(n, &t1, &t2);
        return (Surface){n, n, 0.5L + dot(across, t1) / (2 * radius), 0.5L + dot(across, t2) / (2 * radius),
                         scaled(t1, 2 * radius), scaled(t2, 2 * radius)};
    }
    real slope = (shape->top_radius - shape->radius) / shape->height;
    Vec n = shape->normal;
    if (length(across) > 0)
        n = normalized(sub(normalized(across), scaled(shape->normal, slope)));
    Vec du = scaled(cross(shape->normal, across), 2 * PI);
    Vec dv = scaled(shape->normal, shape->height);
    if (length(across) > 0)
        dv = add(dv, scaled(normalized(across), shape->top_radius - shape->radius));
    real u = turn(dot(across, shape->t2), dot(across, shape->t1));
    return (Surface){n, n, u, height / shape->height, du, dv};
}
