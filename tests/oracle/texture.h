/* Checker textures of section 2. */
#ifndef ORACLE_TEXTURE_H
#define ORACLE_TEXTURE_H

#include "shape.h"

/* Value of a paint at a point p of a shape, both in the shape's own space. */
Vec paint_color(const Scene *scene, const Paint *paint, Vec p, const Surface *surface);

#endif
