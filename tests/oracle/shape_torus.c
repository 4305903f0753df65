/* The torus. Where the quartic of a line turns is found from its derivatives; between two turns the sign of
 * the distance from the tube, evaluated directly, is followed. No coefficient decides where a root is. */
#include "shape.h"

/* The line in the frame of the torus, z along its axis, in units of its outer radius, from its point
 * closest to the centre. */
typedef struct Tube {
    Vec o, d;
    real major, minor;
} Tube;

/* A function of t to find a root of: a polynomial, or where `tube` is not NULL, the tube's distance. */
typedef struct Function {
    const Tube *tube;
    const real *coefficients;
    int degree;
} Function;

/* Squared distance from the ring, less the squared minor radius: the quartic without its positive factor. */
static real tube_value(const Tube *tube, real t, real *slope)
{
    Vec p = add(tube->o, scaled(tube->d, t));
    real rho = sqrtl(p.x * p.x + p.y * p.y);
    real from_ring = rho - tube->major;
    real rho_slope = rho > 0 ? (p.x * tube->d.x + p.y * tube->d.y) / rho : 0;
    *slope = 2 * (from_ring * rho_slope + p.z * tube->d.z);
    real distance = sqrtl(from_ring * from_ring + p.z * p.z);
    return (distance - tube->minor) * (distance + tube->minor);
}

static real value_at(const Function *f, real t, real *slope)
{
    if (f->tube != NULL)
        return tube_value(f->tube, t, slope);
    real value = f->coefficients[f->degree];
    *slope = 0;
    for (int i = f->degree - 1; i >= 0; i--) {
        *slope = *slope * t + value;
        value = value * t + f->coefficients[i];
    }
    return value;
}

/* The root between low and high, where the function has one and changes its sign: Newton's steps, and a
 * halving wherever one leaves the bracket or the bracket shrinks slowly. */
static real root_between(const Function *f, real low, real high)
{
    real slope;
    bool low_positive = value_at(f, low, &slope) > 0;
    real t = (low + high) / 2;
    real last_step = high - low;
    for (int i = 0; i < 300; i++) {
        real value = value_at(f, t, &slope);
        if (value == 0)
            return t;
        if ((value > 0) == low_positive)
            low = t;
        else
            high = t;
        real step = value / slope;
        real next = t - step;
        if (!(next > low && next < high) || fabsl(step) > last_step / 2) {
            next = (low + high) / 2;
            step = (high - low) / 2;
        }
        last_step = fabsl(step);
        if (next == t || last_step < 1e-20L)
            return next;
        t = next;
    }
    return t;
}

static bool sign_changes(const Function *f, real low, real high)
{
    real slope;
    return (value_at(f, low, &slope) > 0) != (value_at(f, high, &slope) > 0);
}

/* Roots in (low, high) of a polynomial, ascending, by those of its derivatives. */
static int roots_between(const real *coefficients, int degree, real low, real high, real *roots)
{
    real stops[8];
    int stop_count = 0;
    stops[stop_count++] = low;
    if (degree > 1) {
        real derivative[5];
        for (int i = 0; i < degree; i++)
            derivative[i] = coefficients[i + 1] * (real)(i + 1);
        stop_count += roots_between(derivative, degree - 1, low, high, &stops[stop_count]);
    }
    stops[stop_count++] = high;
    Function f = {NULL, coefficients, degree};
    int count = 0;
    for (int i = 0; i + 1 < stop_count; i++)
        if (sign_changes(&f, stops[i], stops[i + 1]))
            roots[count++] = root_between(&f, stops[i], stops[i + 1]);
    return count;
}

int torus_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    real size = shape->radius + shape->top_radius;
    real speed = length(line->d);
    Vec d = scaled(line->d, 1 / speed);
    Vec f = sub(line->o, shape->center);
    real shift = -dot(f, d);
    Vec start = scaled(add(f, scaled(d, shift)), 1 / size);
    if (dot(start, start) >= 1)
        return 0;
    Tube tube = {
        .o = vec(dot(start, shape->t1), dot(start, shape->t2), dot(start, shape->normal)),
        .d = vec(dot(d, shape->t1), dot(d, shape->t2), dot(d, shape->normal)),
        .major = shape->radius / size,
        .minor = shape->top_radius / size,
    };
    /* (|p|^2 + R^2 - r^2)^2 = 4 R^2 (x^2 + y^2) along p = o + t d, with o.d = 0 and |d| = 1. */
    real k = dot(tube.o, tube.o) + tube.major * tube.major - tube.minor * tube.minor;
    real four = 4 * tube.major * tube.major;
    real coefficients[5] = {
        k * k - four * (tube.o.x * tube.o.x + tube.o.y * tube.o.y),
        -2 * four * (tube.o.x * tube.d.x + tube.o.y * tube.d.y),
        2 * k - four * (tube.d.x * tube.d.x + tube.d.y * tube.d.y),
        0,
        1,
    };
    real turns[5];
    real derivative[4] = {coefficients[1], 2 * coefficients[2], 0, 4};
    int turn_count = roots_between(derivative, 3, -1.01L, 1.01L, turns);
    turns[turn_count++] = 1.01L;
    Function distance = {&tube, NULL, 0};
    int count = 0;
    real low = -1.01L;
    for (int i = 0; i < turn_count; i++) {
        if (sign_changes(&distance, low, turns[i])) {
            real t = root_between(&distance, low, turns[i]) * size + shift;
            out[count++] = (Crossing){t / speed, 0, false};
        }
        low = turns[i];
    }
    return count;
}

Surface torus_surface(const Shape *shape, Vec p)
{
    Vec q = sub(p, shape->center);
    real height = dot(q, shape->normal);
    Vec across = sub(q, scaled(shape->normal, height));
    real rho = length(across);
    Vec outward = rho > 0 ? scaled(across, 1 / rho) : shape->t1;
    Vec n = normalized(add(scaled(outward, rho - shape->radius), scaled(shape->normal, height)));
    real u = atan2l(dot(across, shape->t2), dot(across, shape->t1)) / (2 * PI);
    real v = atan2l(height, rho - shape->radius) / (2 * PI);
    u -= floorl(u);
    v -= floorl(v);
    Vec du = scaled(cross(shape->normal, across), 2 * PI);
    Vec dv = scaled(sub(scaled(shape->normal, rho - shape->radius), scaled(outward, height)), 2 * PI);
    return (Surface){n, n, u < 1 ? u : 0, v < 1 ? v : 0, du, dv};
}
