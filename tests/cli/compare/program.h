// The program as the tests use it: pictures in a folder, run, what it wrote. After cmocka.h.
#ifndef PROGRAM_H
#define PROGRAM_H

#include <jansson.h>

#include "output/output.h"

enum { WIDTH = 20, HEIGHT = 10, VALUES = WIDTH * HEIGHT * 3, TEXT_BYTES = 8192 };

typedef struct Fixture {
    char folder[64];
    u8 levels[VALUES];
    f32 floats[VALUES];
    char out[TEXT_BYTES], err[TEXT_BYTES]; // of the last run
} Fixture;

// A folder of its own to work in, and levels and floats to make pictures of; the folder goes with tear_down.
int set_up(void **state);
int tear_down(void **state);

// format: libpng's, sRGB levels.
void write_levels(const char *name, const void *levels, u32 format, u32 width, u32 height);
// WIDTH x HEIGHT, RGB.
void write_rgb(const char *name, const u8 *levels);
void write_output(const char *name, const f32 *rows, const OutputOptions *options);
void write_pfm(const char *name, const f32 *rows);

// Run the program with these arguments as a shell reads them.
int run(Fixture *f, const char *arguments); // gives its exit status
void expect_same(Fixture *f, const char *arguments);
void expect_different(Fixture *f, const char *arguments);
void expect_trouble(Fixture *f, const char *arguments, const char *says);
json_t *run_json(Fixture *f, const char *arguments, int status); // the caller's to decref

// A member of an object that must be a number.
f64 number(const json_t *root, const char *key);

#endif
