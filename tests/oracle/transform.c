#include "transform.h"

Transform transform_identity(void)
{
    return (Transform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

Transform transform_translate(Vec by)
{
    return (Transform){{{1, 0, 0, by.x}, {0, 1, 0, by.y}, {0, 0, 1, by.z}}};
}

Transform transform_scale(Vec by)
{
    return (Transform){{{by.x, 0, 0, 0}, {0, by.y, 0, 0}, {0, 0, by.z, 0}}};
}

Transform transform_rotate(Vec axis, real degrees)
{
    /* Rodrigues: v cos + (a x v) sin + a (a.v) (1 - cos), applied to the three unit vectors. */
    Vec a = normalized(axis);
    real angle = degrees * PI / 180;
    real c = cosl(angle);
    real s = sinl(angle);
    Transform t = transform_identity();
    for (int column = 0; column < 3; column++) {
        Vec e = vec(column == 0, column == 1, column == 2);
        Vec image = add(add(scaled(e, c), scaled(cross(a, e), s)), scaled(a, dot(a, e) * (1 - c)));
        t.m[0][column] = image.x;
        t.m[1][column] = image.y;
        t.m[2][column] = image.z;
    }
    return t;
}

Transform transform_then(const Transform *first, const Transform *second)
{
    Transform t;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            real sum = column == 3 ? second->m[row][3] : 0;
            for (int k = 0; k < 3; k++)
                sum += second->m[row][k] * first->m[k][column];
            t.m[row][column] = sum;
        }
    }
    return t;
}

Transform transform_inverse(const Transform *t)
{
    Vec r0 = vec(t->m[0][0], t->m[0][1], t->m[0][2]);
    Vec r1 = vec(t->m[1][0], t->m[1][1], t->m[1][2]);
    Vec r2 = vec(t->m[2][0], t->m[2][1], t->m[2][2]);
    real determinant = dot(r0, cross(r1, r2));
    Vec columns[3] = {cross(r1, r2), cross(r2, r0), cross(r0, r1)};
    Transform inverse;
    for (int column = 0; column < 3; column++) {
        inverse.m[0][column] = columns[column].x / determinant;
        inverse.m[1][column] = columns[column].y / determinant;
        inverse.m[2][column] = columns[column].z / determinant;
    }
    for (int row = 0; row < 3; row++) {
        inverse.m[row][3] = 0;
        Vec moved = transform_vector(&inverse, vec(t->m[0][3], t->m[1][3], t->m[2][3]));
        inverse.m[row][3] = -component(moved, row);
    }
    return inverse;
}

real transform_norm(const Transform *t)
{
    real sum = 0;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            sum += t->m[row][column] * t->m[row][column];
    return sqrtl(sum);
}

Vec transform_vector(const Transform *t, Vec v)
{
    return vec(t->m[0][0] * v.x + t->m[0][1] * v.y + t->m[0][2] * v.z,
               t->m[1][0] * v.x + t->m[1][1] * v.y + t->m[1][2] * v.z,
               t->m[2][0] * v.x + t->m[2][1] * v.y + t->m[2][2] * v.z);
}

Vec transform_point(const Transform *t, Vec p)
{
    return add(transform_vector(t, p), vec(t->m[0][3], t->m[1][3], t->m[2][3]));
}

Vec transform_normal(const Transform *inverse, Vec n)
{
    return normalized(vec(inverse->m[0][0] * n.x + inverse->m[1][0] * n.y + inverse->m[2][0] * n.z,
                          inverse->m[0][1] * n.x + inverse->m[1][1] * n.y + inverse->m[2][1] * n.z,
                          inverse->m[0][2] * n.x + inverse->m[1][2] * n.y + inverse->m[2][2] * n.z));
}
