/* Radiance to levels (section 2, output) and the image files. */
#ifndef ORACLE_PICTURE_H
#define ORACLE_PICTURE_H

#include "scene.h"

typedef struct Picture {
    int width, height;
    Vec *pixels; /* radiance, top row first */
} Picture;

/* One channel: exposure, tone map, clamp, encoding; in [0, 1]. */
real output_value(const Scene *scene, real radiance);
/* The same as a level of 255 or 65535, halves away from zero. */
int output_level(const Scene *scene, real radiance, int bits);

void picture_write_png(const Picture *picture, const Scene *scene, int bits, const char *path);
void picture_write_pfm(const Picture *picture, const char *path);
/* A grey 8-bit image, one byte a pixel. */
void mask_write_png(const unsigned char *mask, int width, int height, const char *path);

#endif
