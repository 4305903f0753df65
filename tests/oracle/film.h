/* Values of pixels: the filter's and the lens's integrals over camera rays. Knows nothing of files. */
#ifndef ORACLE_FILM_H
#define ORACLE_FILM_H

#include <stdint.h>

#include "trace.h"

/* How far from the pixel's centre a filter reaches, in pixels. */
real filter_radius(Filter filter);
/* One axis of a filter; its integral is not 1. */
real filter_value(Filter filter, real x);
/* That integral over the axis. */
real filter_integral(Filter filter);

/* grid x grid staggered positions over the filter's support, weighted by it; 1: the centre. Where the camera
 * has an aperture, each with as many points of the lens as the scene has points. (dx, dy) moves all by so
 * many pixels. */
Vec film_pixel(const Scene *scene, const Camera *camera, int grid, int x, int y, real dx, real dy);

/* A value and the variance of its error. */
typedef struct Estimate {
    Vec mean, variance;
} Estimate;

/* How the paths of a pixel are drawn. */
typedef struct Paths {
    int grid;   /* grid x grid paths a round, over the filter's support; 1: the centre */
    int rounds; /* independent of each other; one alone has no variance */
    uint64_t seed;
} Paths;

/* By random paths (integrator path); the lens takes a random point each. */
Estimate film_paths(const Scene *scene, const Camera *camera, const Paths *paths, int x, int y, real dx,
                    real dy);

#endif
