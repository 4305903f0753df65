/* Values of pixels: the filter's and the lens's integrals over camera rays. Knows nothing of files. */
#ifndef ORACLE_FILM_H
#define ORACLE_FILM_H

#include "trace.h"

/* How far from the pixel's centre a filter reaches, in pixels. */
real filter_radius(Filter filter);
/* One axis of a filter; its integral is not 1. */
real filter_value(Filter filter, real x);

/* grid x grid staggered positions over the filter's support, weighted by it; 1: the centre. Where the camera
 * has an aperture, each with as many points of the lens as the scene has points. (dx, dy) moves all by so
 * many pixels. */
Vec film_pixel(const Scene *scene, const Camera *camera, int grid, int x, int y, real dx, real dy);

#endif
