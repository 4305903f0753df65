#include "ssim.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TAPS = 2 * SSIM_RADIUS + 1 };

static const f64 WINDOW_DEVIATION = 1.5;
// (K L)^2 for a range L of 1.
static const f64 C1 = 0.01 * 0.01, C2 = 0.03 * 0.03;
// Luma of ITU-R BT.709, whose primaries sRGB has.
static const f64 LUMA[3] = {0.2126, 0.7152, 0.0722};

// What the windows average: both pictures, their squares and their product.
enum { MEAN_A, MEAN_B, SQUARE_A, SQUARE_B, PRODUCT, MOMENT_COUNT };

typedef struct Workspace {
    u32 width, columns; // of a row, and of the windows' centres in it
    f64 weights[TAPS];
    f64 *luma[2];               // one row
    f64 *products;              // one row
    f64 *passed[MOMENT_COUNT];  // the last TAPS rows, filtered horizontally, row y at y % TAPS
    f64 *moments[MOMENT_COUNT]; // one row
    f64 *memory;                // all of the above
} Workspace;

static bool make_workspace(Workspace *work, Error *error)
{
    const u32 width = work->width;
    f64 sum = 0;
    for (int i = 0; i < TAPS; i++) {
        const f64 d = i - SSIM_RADIUS;
        work->weights[i] = exp(-d * d / (2 * WINDOW_DEVIATION * WINDOW_DEVIATION));
        sum += work->weights[i];
    }
    for (int i = 0; i < TAPS; i++)
        work->weights[i] /= sum;
    work->memory = malloc((size_t)width * (3 + MOMENT_COUNT * (TAPS + 1)) * sizeof(f64));
    if (!work->memory)
        return error_set(error, ERROR_MEMORY, "no memory to compute SSIM");
    f64 *next = work->memory;
    for (int i = 0; i < 2; i++, next += width)
        work->luma[i] = next;
    work->products = next;
    next += width;
    for (int i = 0; i < MOMENT_COUNT; i++, next += width)
        work->moments[i] = next;
    for (int i = 0; i < MOMENT_COUNT; i++, next += (size_t)width * TAPS)
        work->passed[i] = next;
    return true;
}

static void read_luma(const Image *image, ValueScale scale, u32 y, f64 *luma)
{
    const u32 channels = image->channels;
    const f32 *values = image_row(image, y);
    for (u32 x = 0; x < image->width; x++, values += channels) {
        if (channels < 3) {
            luma[x] = value_display(scale, values[0]);
            continue;
        }
        luma[x] = 0;
        for (int c = 0; c < 3; c++)
            luma[x] += LUMA[c] * value_display(scale, values[c]);
    }
}

static void pass_horizontally(const Workspace *work, const f64 *line, f64 *out)
{
    memset(out, 0, work->columns * sizeof *out);
    for (u32 i = 0; i < TAPS; i++) {
        const f64 weight = work->weights[i];
        for (u32 x = 0; x < work->columns; x++)
            out[x] += weight * line[x + i];
    }
}

static void pass_product(const Workspace *work, int first, int second, f64 *out)
{
    for (u32 x = 0; x < work->width; x++)
        work->products[x] = work->luma[first][x] * work->luma[second][x];
    pass_horizontally(work, work->products, out);
}

static void add_row(const Workspace *work, const Image *a, const Image *b, ValueScale scale, u32 y)
{
    read_luma(a, scale, y, work->luma[0]);
    read_luma(b, scale, y, work->luma[1]);
    f64 *rows[MOMENT_COUNT];
    for (int i = 0; i < MOMENT_COUNT; i++)
        rows[i] = work->passed[i] + (size_t)(y % TAPS) * work->columns;
    pass_horizontally(work, work->luma[0], rows[MEAN_A]);
    pass_horizontally(work, work->luma[1], rows[MEAN_B]);
    pass_product(work, 0, 0, rows[SQUARE_A]);
    pass_product(work, 1, 1, rows[SQUARE_B]);
    pass_product(work, 0, 1, rows[PRODUCT]);
}

// Of the windows whose last row is y.
static void sum_windows(const Workspace *work, u32 y)
{
    for (int m = 0; m < MOMENT_COUNT; m++) {
        f64 *out = work->moments[m];
        memset(out, 0, work->columns * sizeof *out);
        for (u32 i = 0; i < TAPS; i++) {
            const f64 weight = work->weights[i];
            const f64 *line = work->passed[m] + (size_t)((y + 1 + i) % TAPS) * work->columns;
            for (u32 x = 0; x < work->columns; x++)
                out[x] += weight * line[x];
        }
    }
}

static void finish_row(const Workspace *work, f32 *similarities)
{
    for (u32 x = 0; x < work->columns; x++) {
        const f64 a = work->moments[MEAN_A][x], b = work->moments[MEAN_B][x];
        const f64 variances = work->moments[SQUARE_A][x] - a * a + (work->moments[SQUARE_B][x] - b * b);
        const f64 covariance = work->moments[PRODUCT][x] - a * b;
        similarities[x] = (f32)((2 * (a * b) + C1) * (2 * covariance + C2) /
                                ((a * a + b * b + C1) * (variances + C2)));
    }
}

bool ssim_compare(const Image *a, const Image *b, ValueScale scale, f32 *similarities, Error *error)
{
    const u32 width = a->width, height = a->height;
    assert(b->width == width && b->height == height);
    for (size_t i = 0; i < (size_t)width * height; i++)
        similarities[i] = NAN;
    if (width < TAPS || height < TAPS)
        return true;
    Workspace work = {.width = width, .columns = width - 2 * SSIM_RADIUS};
    if (!make_workspace(&work, error))
        return false;
    for (u32 y = 0; y < height; y++) {
        add_row(&work, a, b, scale, y);
        if (y + 1 < TAPS)
            continue;
        sum_windows(&work, y);
        finish_row(&work, similarities + (size_t)(y - SSIM_RADIUS) * width + SSIM_RADIUS);
    }
    free(work.memory);
    return true;
}
