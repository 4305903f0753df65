/* Textures of section 2, and what a material is at a point. Knows nothing of light. */
#ifndef ORACLE_TEXTURE_H
#define ORACLE_TEXTURE_H

#include "shape.h"

/* Value of a paint at a point p of a shape, both in the shape's own space. */
Vec paint_color(const Scene *scene, const Paint *paint, Vec p, const Surface *surface);
/* The same of a paint that stands for a number: its first channel, decoded linearly. */
real paint_number(const Scene *scene, const Paint *paint, Vec p, const Surface *surface);

/* World normal that a material's normal map makes of the interpolated one; `shading` itself without a map. */
Vec mapped_normal(const Scene *scene, const Primitive *primitive, Vec p, const Surface *surface, Vec shading);
/* k_t for shadow rays. */
Vec shadow_transmit(const Scene *scene, const Primitive *primitive, Vec p, const Surface *surface);

#endif
