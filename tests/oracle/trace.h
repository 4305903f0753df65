/* Section 4: the Whitted integrator, and the ray of a pixel position. */
#ifndef ORACLE_TRACE_H
#define ORACLE_TRACE_H

#include "hit.h"

/* Frame of the camera, made once. */
typedef struct Camera {
    Vec position, u, v, w;
    real k;
    bool orthographic;
    int width, height;
} Camera;

Camera camera_make(const Scene *scene);
/* px, py in pixels from the top-left corner of the image. */
Ray camera_ray(const Camera *camera, real px, real py);

/* Exact unpolarised reflectance of a dielectric; `cosine` of the incoming angle >= 0, `eta` the ratio of the
 * indices before and behind. 1 on total internal reflection. */
real fresnel_reflectance(real cosine, real eta);
/* Specular term S of section 4 for unit vectors. */
real specular_term(bool blinn, real shininess, Vec n, Vec to_light, Vec to_eye);

/* Radiance along a camera ray. */
Vec trace_radiance(const Scene *scene, const Ray *ray);

#endif
