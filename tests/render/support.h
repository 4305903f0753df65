// What the tests of whole renders share: a device, scenes from text, pictures as floats in memory.
#ifndef CLRT_TESTS_RENDER_SUPPORT_H
#define CLRT_TESTS_RENDER_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/arena.h"
#include "device/device.h"
#include "layout/layout.h"
#include "render/render.h"
#include "scene/parse.h"

enum { TEST_SKIP = 77 };

// The device that CLRT_DEVICE names, else the one that clrt itself would take; threads 0: all. NULL, with the
// reason on standard output, where there is none: the test then returns TEST_SKIP.
Device *test_device_open(u32 threads);

// The layout of a scene without errors; a scene that has some fails the running test. Files that it names
// without a folder are those of meshes/.
Layout *layout_of(const char *text);
// The same, where paths look for light in the given way.
Layout *layout_by(const char *text, LightSampling sampling);

// How a picture is made where that shall not be seen in it. Zeros are the defaults.
typedef struct RenderHow {
    const char *shape; // CLRT_SHAPE
    u64 memory;        // bytes
    u32 left, top, width, height; // crop; width 0: the whole image
    MathMode math;
    f32 clamp;
} RenderHow;

typedef struct Picture {
    u32 width, height;
    f32 *rgb; // 3 numbers a pixel, top first
    f32 *clamped; // RenderRows.clamped, NULL where clamp is 0
    RenderStats stats;
} Picture;

// Errors fail the running test.
Picture render_layout(Device *device, const Layout *layout, const RenderHow *how);
// how NULL: the defaults.
Picture render_text(Device *device, const char *text, const RenderHow *how);
void picture_destroy(Picture *picture);
// `count` pictures one behind the other, with seeds first, first + 1, ...; the caller's to free.
f32 *render_with_seeds(Device *device, const Layout *layout, u32 first, u32 count);

const f32 *pixel_at(const Picture *picture, u32 x, u32 y);

// Fails the running test, with the first pixel that differs, unless all bits agree.
void assert_same_picture(const Picture *a, const Picture *b, const char *what);

// Values (channels) that differ by more than `tolerance` after clamping to [0, 1] and sRGB encoding, in
// levels of 255.
u32 levels_apart(const Picture *a, const Picture *b, f64 tolerance);

// printf into a new string; the caller's to free.
char *text_of(const char *format, ...) __attribute__((format(printf, 1, 2)));
// The same, appended to *text, which may be NULL.
void text_append(char **text, const char *format, ...) __attribute__((format(printf, 2, 3)));
// Content of a file that must be there.
char *text_of_file(const char *path);

// Uniform in [0, 1), and in a range; *state is any number.
f64 random_unit(u64 *state);
f64 random_in(u64 *state, f64 low, f64 high);

#endif
