#include "base/vec.h"

#include <float.h>
#include <math.h>

static f64 largest(Vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

// The exponent e that brings a value of this magnitude to 1/2 <= value 2^-e < 1; 0 for 0.
static int exponent_of(f64 magnitude)
{
    int exponent = 0;
    frexp(magnitude, &exponent);
    return exponent;
}

static Vec3 scale_by_power(Vec3 a, int exponent)
{
    return (Vec3){scalbn(a.x, exponent), scalbn(a.y, exponent), scalbn(a.z, exponent)};
}

Vec3 vec_add(Vec3 a, Vec3 b)
{
    return (Vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

Vec3 vec_sub(Vec3 a, Vec3 b)
{
    return (Vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

Vec3 vec_scale(Vec3 a, f64 s)
{
    return (Vec3){a.x * s, a.y * s, a.z * s};
}

f64 vec_dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vec3 vec_cross(Vec3 a, Vec3 b)
{
    return (Vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

f64 vec_length(Vec3 a)
{
    // A power of two changes no bit of the result, so that lengths scale exactly with a scene.
    const int exponent = exponent_of(largest(a));
    const Vec3 b = scale_by_power(a, -exponent);
    return scalbn(sqrt(vec_dot(b, b)), exponent);
}

Vec3 vec_normalize(Vec3 a)
{
    const Vec3 b = scale_by_power(a, -exponent_of(largest(a)));
    const f64 length = sqrt(vec_dot(b, b));
    return (Vec3){b.x / length, b.y / length, b.z / length};
}

Affine affine_identity(void)
{
    return affine_scale((Vec3){1, 1, 1});
}

Affine affine_translate(Vec3 t)
{
    Affine m = affine_identity();
    m.translation = t;
    return m;
}

Affine affine_scale(Vec3 s)
{
    return (Affine){.row = {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}};
}

// Sine and cosine of an angle in degrees; exact at multiples of 90.
static void sincos_degrees(f64 degrees, f64 *sine, f64 *cosine)
{
    const f64 turn = fmod(degrees, 360);
    const f64 rest = remainder(turn, 90);
    const int quarter = ((int)rint((turn - rest) / 90) + 4) % 4;
    const f64 radians = rest * (3.14159265358979323846 / 180);
    const f64 s = sin(radians), c = cos(radians);
    *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
}

Affine affine_rotate(Vec3 axis, f64 degrees)
{
    const Vec3 u = vec_normalize(axis);
    f64 s, c;
    sincos_degrees(degrees, &s, &c);
    const f64 k = 1 - c;
    // u.x u.x + c (1 - u.x u.x) rather than c + k u.x u.x: exactly 1 on the axis itself.
    return (Affine){.row = {
        {u.x * u.x + c * (1 - u.x * u.x), k * u.x * u.y - s * u.z, k * u.x * u.z + s * u.y},
        {k * u.x * u.y + s * u.z, u.y * u.y + c * (1 - u.y * u.y), k * u.y * u.z - s * u.x},
        {k * u.x * u.z - s * u.y, k * u.y * u.z + s * u.x, u.z * u.z + c * (1 - u.z * u.z)},
    }};
}

static Vec3 column(Affine m, int i)
{
    return i == 0   ? (Vec3){m.row[0].x, m.row[1].x, m.row[2].x}
           : i == 1 ? (Vec3){m.row[0].y, m.row[1].y, m.row[2].y}
                    : (Vec3){m.row[0].z, m.row[1].z, m.row[2].z};
}

Affine affine_compose(Affine second, Affine first)
{
    const Vec3 x = column(first, 0), y = column(first, 1), z = column(first, 2);
    Affine m;
    for (int i = 0; i < 3; ++i) {
        const Vec3 r = second.row[i];
        m.row[i] = (Vec3){vec_dot(r, x), vec_dot(r, y), vec_dot(r, z)};
    }
    m.translation = affine_point(second, first.translation);
    return m;
}

// The linear part times the power of two that brings its largest element to [1/2, 1); returns the
// exponent that was taken out. Products of three elements then stay in range.
static int balance(Affine *m)
{
    const int exponent =
        exponent_of(fmax(largest(m->row[0]), fmax(largest(m->row[1]), largest(m->row[2]))));
    for (int i = 0; i < 3; ++i)
        m->row[i] = scale_by_power(m->row[i], -exponent);
    return exponent;
}

static f64 linear_determinant(const Vec3 row[3])
{
    return vec_dot(row[0], vec_cross(row[1], row[2]));
}

Affine affine_inverse(Affine m)
{
    const int exponent = balance(&m);
    const Vec3 c0 = vec_cross(m.row[1], m.row[2]);
    const Vec3 c1 = vec_cross(m.row[2], m.row[0]);
    const Vec3 c2 = vec_cross(m.row[0], m.row[1]);
    const f64 determinant = linear_determinant(m.row);
    Affine inverse = {.row = {{c0.x, c1.x, c2.x}, {c0.y, c1.y, c2.y}, {c0.z, c1.z, c2.z}}};
    for (int i = 0; i < 3; ++i) {
        const Vec3 r = inverse.row[i];
        inverse.row[i] = scale_by_power((Vec3){r.x / determinant, r.y / determinant, r.z / determinant},
                                        -exponent);
    }
    inverse.translation = vec_scale(affine_direction(inverse, m.translation), -1);
    return inverse;
}

f64 affine_determinant(Affine m)
{
    const int exponent = balance(&m);
    return scalbn(linear_determinant(m.row), 3 * exponent);
}

Vec3 affine_point(Affine m, Vec3 p)
{
    return vec_add(affine_direction(m, p), m.translation);
}

Vec3 affine_direction(Affine m, Vec3 d)
{
    return (Vec3){vec_dot(m.row[0], d), vec_dot(m.row[1], d), vec_dot(m.row[2], d)};
}

Vec3 affine_normal(Affine m, Vec3 n)
{
    // The inverse transpose is the cofactor matrix over the determinant, of which the sign matters.
    balance(&m);
    const Vec3 carried = {
        vec_dot(vec_cross(m.row[1], m.row[2]), n),
        vec_dot(vec_cross(m.row[2], m.row[0]), n),
        vec_dot(vec_cross(m.row[0], m.row[1]), n),
    };
    return vec_normalize(linear_determinant(m.row) < 0 ? vec_scale(carried, -1) : carried);
}

// One-sided Jacobi: turns columns a and b so that they are orthogonal. Returns whether they were not.
static bool orthogonalize(Vec3 *a, Vec3 *b)
{
    const f64 aa = vec_dot(*a, *a), bb = vec_dot(*b, *b), ab = vec_dot(*a, *b);
    if (fabs(ab) <= DBL_EPSILON * sqrt(aa) * sqrt(bb))
        return false;
    const f64 zeta = (bb - aa) / (2 * ab);
    const f64 t = copysign(1, zeta) / (fabs(zeta) + hypot(1, zeta));
    const f64 c = 1 / sqrt(1 + t * t), s = c * t;
    const Vec3 old = *a;
    *a = vec_sub(vec_scale(old, c), vec_scale(*b, s));
    *b = vec_add(vec_scale(old, s), vec_scale(*b, c));
    return true;
}

// Hestenes' method, because the eigenvalues of the product with the transpose would lose half of the
// digits of a small singular value.
void affine_singular_values(Affine m, f64 values[3])
{
    const int exponent = balance(&m);
    Vec3 a = column(m, 0), b = column(m, 1), c = column(m, 2);
    for (int sweep = 0; sweep < 40; ++sweep) {
        const bool ab = orthogonalize(&a, &b);
        const bool ac = orthogonalize(&a, &c);
        const bool bc = orthogonalize(&b, &c);
        if (!ab && !ac && !bc)
            break;
    }
    const f64 x = vec_length(a), y = vec_length(b), z = vec_length(c);
    values[0] = scalbn(fmax(x, fmax(y, z)), exponent);
    values[1] = scalbn(fmax(fmin(x, y), fmin(fmax(x, y), z)), exponent);
    values[2] = scalbn(fmin(x, fmin(y, z)), exponent);
}
