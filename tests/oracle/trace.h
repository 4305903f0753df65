/* Sections 4 and 5: the Whitted integrator, and the ray of a pixel position. */
#ifndef ORACLE_TRACE_H
#define ORACLE_TRACE_H

#include "hit.h"

/* Frame of the camera, made once. */
typedef struct Camera {
    Vec position, u, v, w;
    real k;
    real aperture, focus;
    bool orthographic;
    int width, height;
} Camera;

Camera camera_make(const Scene *scene);
/* px, py in pixels from the top-left corner of the image; lens: a point of the unit disk. */
Ray camera_ray(const Camera *camera, real px, real py, Vec lens);

/* Radiance along a camera ray. */
Vec trace_radiance(const Scene *scene, const Ray *ray);

#endif
