/* What the oracle's own tests share. */
#ifndef ORACLE_TEST_H
#define ORACLE_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "spot.h"
#include "trace.h"

#define CASES(tests) (sizeof(tests) / sizeof(tests)[0])

static inline void check_near(real value, real expected, real tolerance, const char *file, int line)
{
    if (fabsl(value - expected) <= tolerance)
        return;
    print_error("%.21Lg is not %.21Lg within %.3Lg\n", value, expected, tolerance);
    _fail(file, line);
}

#define assert_near(value, expected, tolerance) check_near(value, expected, tolerance, __FILE__, __LINE__)
#define assert_vec_near(value, expected, tolerance) \
    check_near(length(sub(value, expected)), 0, tolerance, __FILE__, __LINE__)

/* Radiance of the pixel's centre in a scene of one pixel. */
static inline Vec pixel_of(const char *text)
{
    Scene scene;
    scene_init(&scene);
    scene.width = 1;
    scene.height = 1;
    scene_read_text(&scene, text);
    Camera camera = camera_make(&scene);
    Ray ray = camera_ray(&camera, scene.width / 2.0L, scene.height / 2.0L, vec(0, 0, 0));
    Vec value = trace_radiance(&scene, &ray);
    scene_free(&scene);
    return value;
}

#endif
