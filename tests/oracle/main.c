/* clrt-oracle SCENE OUT: the slow reference renderer. README.md says what it is for. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film.h"
#include "picture.h"

typedef struct Options {
    const char *scene, *out, *unstable, *variance;
    int width, height; /* 0: the scene's */
    int bits, grid;    /* grid 0: the pixel's centre, or 16 where the scene has several samples */
    int points;        /* 0: the scene's default */
    int rounds;
    unsigned int seed;
    int threshold;     /* levels; 0: one 8-bit level */
    double dx, dy;
    bool pfm;
} Options;

static const char USAGE[] =
    "usage: clrt-oracle [options] SCENE OUT\n"
    "  --size WxH          image size in place of the scene's\n"
    "  --bits 8|16         bits of the PNG's values (8)\n"
    "  --offset DX,DY      moves every sample, in pixels (0,0)\n"
    "  --samples-grid K    K x K staggered positions a pixel, by the filter's weights\n"
    "  --points N          points of each integral over a light, a lens, a hemisphere (256)\n"
    "  --rounds N          integrator path: as many times a path through each position (16)\n"
    "  --seed N            integrator path: another number, other paths (0)\n"
    "  --variance PFM      integrator path: also writes the variance of each value\n"
    "  --unstable MASK     also writes a PNG: 255 where the value changes by more than the threshold\n"
    "                      at one of eight positions 0.02 pixel away\n"
    "  --threshold LEVELS  of --unstable, in levels of --bits (one 8-bit level)\n"
    "  --pfm               OUT is a PFM of radiance, as it is where OUT ends in .pfm\n";

static bool read_option(Options *options, const char *name, const char *value)
{
    if (strcmp(name, "--size") == 0)
        return sscanf(value, "%dx%d", &options->width, &options->height) == 2 && options->width > 0 &&
               options->height > 0;
    if (strcmp(name, "--bits") == 0)
        return sscanf(value, "%d", &options->bits) == 1 && (options->bits == 8 || options->bits == 16);
    if (strcmp(name, "--offset") == 0)
        return sscanf(value, "%lf,%lf", &options->dx, &options->dy) == 2;
    if (strcmp(name, "--samples-grid") == 0)
        return sscanf(value, "%d", &options->grid) == 1 && options->grid > 0;
    if (strcmp(name, "--points") == 0)
        return sscanf(value, "%d", &options->points) == 1 && options->points > 0;
    if (strcmp(name, "--threshold") == 0)
        return sscanf(value, "%d", &options->threshold) == 1 && options->threshold > 0;
    if (strcmp(name, "--rounds") == 0)
        return sscanf(value, "%d", &options->rounds) == 1 && options->rounds > 1;
    if (strcmp(name, "--seed") == 0)
        return sscanf(value, "%u", &options->seed) == 1;
    if (strcmp(name, "--variance") == 0) {
        options->variance = value;
        return true;
    }
    options->unstable = value;
    return strcmp(name, "--unstable") == 0;
}

static bool read_options(Options *options, int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--pfm") == 0) {
            options->pfm = true;
        } else if (argv[i][0] == '-' && argv[i][1] != '\0') {
            if (i + 1 == argc || !read_option(options, argv[i], argv[i + 1]))
                return false;
            i++;
        } else if (options->scene == NULL) {
            options->scene = argv[i];
        } else if (options->out == NULL) {
            options->out = argv[i];
        } else {
            return false;
        }
    }
    if (options->out != NULL && strlen(options->out) > 4)
        options->pfm |= strcmp(options->out + strlen(options->out) - 4, ".pfm") == 0;
    return options->out != NULL;
}

static bool differs(const Scene *scene, Vec a, Vec b, int bits, int threshold)
{
    for (int channel = 0; channel < 3; channel++)
        if (abs(output_level(scene, component(a, channel), bits) -
                output_level(scene, component(b, channel), bits)) > threshold)
            return true;
    return false;
}

static bool is_unstable(const Scene *scene, const Camera *camera, const Options *options, int x, int y,
                        Vec value)
{
    for (int i = 0; i < 8; i++) {
        real dx = options->dx + 0.02L * cosl((real)i * PI / 4);
        real dy = options->dy + 0.02L * sinl((real)i * PI / 4);
        Vec moved = film_pixel(scene, camera, options->grid, x, y, dx, dy);
        if (differs(scene, value, moved, options->bits, options->threshold))
            return true;
    }
    return false;
}

static void render_paths(const Scene *scene, const Options *options, Picture *picture, Picture *variance)
{
    Camera camera = camera_make(scene);
    Paths paths = {options->grid, options->rounds, options->seed};
#pragma omp parallel for schedule(dynamic)
    for (int y = 0; y < scene->height; y++) {
        for (int x = 0; x < scene->width; x++) {
            size_t i = (size_t)y * (size_t)scene->width + (size_t)x;
            Estimate value = film_paths(scene, &camera, &paths, x, y, options->dx, options->dy);
            picture->pixels[i] = value.mean;
            variance->pixels[i] = value.variance;
        }
    }
}

static void render(const Scene *scene, const Options *options, Picture *picture, unsigned char *mask)
{
    Camera camera = camera_make(scene);
#pragma omp parallel for schedule(dynamic)
    for (int y = 0; y < scene->height; y++) {
        for (int x = 0; x < scene->width; x++) {
            size_t i = (size_t)y * (size_t)scene->width + (size_t)x;
            picture->pixels[i] = film_pixel(scene, &camera, options->grid, x, y, options->dx, options->dy);
            if (mask != NULL)
                mask[i] = is_unstable(scene, &camera, options, x, y, picture->pixels[i]) ? 255 : 0;
        }
    }
}

int main(int argc, char **argv)
{
    Options options = {.bits = 8, .rounds = 16};
    if (!read_options(&options, argc, argv)) {
        fputs(USAGE, stderr);
        return 2;
    }
    Scene scene;
    scene_init(&scene);
    scene_read(&scene, options.scene);
    if (options.width > 0) {
        scene.width = options.width;
        scene.height = options.height;
    }
    if (options.points > 0)
        scene.points = options.points;
    if (options.grid == 0)
        options.grid = scene.samples > 1 ? 16 : 1;
    if (options.threshold == 0)
        options.threshold = options.bits == 16 ? 257 : 1;
    if (scene.path ? options.unstable != NULL : options.variance != NULL)
        die("%s is not for this integrator", scene.path ? "--unstable" : "--variance");
    size_t count = (size_t)scene.width * (size_t)scene.height;
    Picture picture = {scene.width, scene.height, store_alloc(&scene.store, count * sizeof *picture.pixels)};
    unsigned char *mask = options.unstable != NULL ? store_alloc(&scene.store, count) : NULL;
    Picture variance = picture;
    if (scene.path) {
        variance.pixels = store_alloc(&scene.store, count * sizeof *variance.pixels);
        render_paths(&scene, &options, &picture, &variance);
    } else {
        render(&scene, &options, &picture, mask);
    }
    if (options.pfm)
        picture_write_pfm(&picture, options.out);
    else
        picture_write_png(&picture, &scene, options.bits, options.out);
    if (options.variance != NULL)
        picture_write_pfm(&variance, options.variance);
    if (mask != NULL)
        mask_write_png(mask, scene.width, scene.height, options.unstable);
    scene_free(&scene);
    return 0;
}
