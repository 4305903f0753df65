#include "shape.h"

void tangents_of(Vec n, Vec *t1, Vec *t2)
{
    Vec up = fabsl(n.y) > 0.9L ? vec(0, 0, -1) : vec(0, 1, 0);
    *t1 = normalized(cross(up, n));
    *t2 = cross(n, *t1);
}

void shape_finish(Shape *shape)
{
    switch (shape->kind) {
    case SHAPE_CONE:
        /* Here `normal` comes as the vector from base to top. */
        shape->height = length(shape->normal);
        /* fall through */
    case SHAPE_PLANE:
    case SHAPE_DISK:
    case SHAPE_TORUS:
        shape->normal = normalized(shape->normal);
        tangents_of(shape->normal, &shape->t1, &shape->t2);
        break;
    case SHAPE_TRIANGLE:
        if (shape->has_normals)
            for (int i = 0; i < 3; i++)
                shape->normals[i] = normalized(shape->normals[i]);
        break;
    case SHAPE_SPHERE:
    case SHAPE_PARALLELOGRAM:
    case SHAPE_BOX:
    case SHAPE_TETRAHEDRON:
    case SHAPE_MESH:
        break;
    }
}

static real farthest_vertex(const Shape *shape, Vec center, int count)
{
    real radius = 0;
    for (int i = 0; i < count; i++)
        radius = fmaxl(radius, length(sub(shape->vertices[i], center)));
    return radius;
}

bool shape_bound(const Shape *shape, Vec *center, real *radius)
{
    *center = shape->center;
    *radius = shape->radius;
    switch (shape->kind) {
    case SHAPE_PLANE:
        *radius = 0;
        return false;
    case SHAPE_SPHERE:
    case SHAPE_DISK:
        return true;
    case SHAPE_TORUS:
        *radius = shape->radius + shape->top_radius;
        return true;
    case SHAPE_BOX:
        *radius = length(shape->half);
        return true;
    case SHAPE_CONE:
        *center = add(shape->center, scaled(shape->normal, shape->height / 2));
        *radius = hypotl(shape->height / 2, fmaxl(shape->radius, shape->top_radius));
        return true;
    case SHAPE_TRIANGLE:
        *center = shape->vertices[0];
        *radius = farthest_vertex(shape, *center, 3);
        return true;
    case SHAPE_PARALLELOGRAM:
        *center = shape->vertices[0];
        *radius = length(sub(shape->vertices[1], *center)) + length(sub(shape->vertices[2], *center));
        return true;
    case SHAPE_TETRAHEDRON:
        *center = shape->vertices[0];
        *radius = farthest_vertex(shape, *center, 4);
        return true;
    case SHAPE_MESH:
        break;
    }
    return false;
}

int shape_crossings(const Shape *shape, const Line *line, Crossing out[CROSSINGS_MAX])
{
    switch (shape->kind) {
    case SHAPE_SPHERE:
        return sphere_crossings(shape, line, out);
    case SHAPE_PLANE:
        return plane_crossings(shape, line, out);
    case SHAPE_BOX:
        return box_crossings(shape, line, out);
    case SHAPE_TETRAHEDRON:
        return tetrahedron_crossings(shape, line, out);
    case SHAPE_TRIANGLE:
        return triangle_crossings(shape, line, out);
    case SHAPE_PARALLELOGRAM:
        return parallelogram_crossings(shape, line, out);
    case SHAPE_DISK:
        return disk_crossings(shape, line, out);
    case SHAPE_CONE:
        return cone_crossings(shape, line, out);
    case SHAPE_TORUS:
        return torus_crossings(shape, line, out);
    case SHAPE_MESH:
        break;
    }
    return 0;
}

bool shape_patch_is_flat(const Shape *shape, int patch)
{
    if (shape->kind == SHAPE_SPHERE || shape->kind == SHAPE_TORUS)
        return false;
    return shape->kind != SHAPE_CONE || patch != 0;
}

Surface shape_surface(const Shape *shape, Vec p, int patch)
{
    switch (shape->kind) {
    case SHAPE_SPHERE:
        return sphere_surface(shape, p);
    case SHAPE_PLANE:
        return plane_surface(shape, p);
    case SHAPE_BOX:
        return box_surface(shape, p, patch);
    case SHAPE_TETRAHEDRON:
        return tetrahedron_surface(shape, p, patch);
    case SHAPE_TRIANGLE:
        return triangle_surface(shape, p);
    case SHAPE_PARALLELOGRAM:
        return parallelogram_surface(shape, p);
    case SHAPE_DISK:
        return disk_surface(shape, p);
    case SHAPE_CONE:
        return cone_surface(shape, p, patch);
    case SHAPE_TORUS:
        return torus_surface(shape, p);
    case SHAPE_MESH:
        break;
    }
    return (Surface){0};
}
