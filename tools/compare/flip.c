#include "flip.h"

#include "image/color.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Rows are worked on in bands, so that memory does not grow with the height.
enum { BAND_ROWS = 96, MAX_RADIUS = 15, MAX_TAPS = 2 * MAX_RADIUS + 1 };

static const f64 PI = 3.14159265358979323846;

// A display of 3840 pixels on 0.7 m, seen from 0.7 m: 3840 pi / 180.
static const f64 PIXELS_PER_DEGREE = 67.020643276582255;

// Color pipeline, spatial filtering and its table of constants: sums of two Gaussians
// a sqrt(pi/b) exp(-pi^2 d^2 / b) per channel, the second only of the blue-yellow one.
static const f64 SCALE_Y = 0.0047, SCALE_CX = 0.0053, SCALE_CZ[2] = {0.04, 0.025};
static const f64 AMOUNT_CZ[2] = {34.1, 13.5};
// Color pipeline, redistribution of errors: exponent of the difference, where its range is bent and to what.
static const f64 COLOR_EXPONENT = 0.7, BEND_AT = 0.4, BEND_TO = 0.95;
// Feature pipeline: width of the detectors in degrees, and the exponent of their difference.
static const f64 FEATURE_WIDTH = 0.082, FEATURE_EXPONENT = 0.5;

// Rec. 709 primaries to CIE XYZ as the authors' programs have it; the white of the picture is its row sums.
static const f64 TO_XYZ[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382},
};

typedef struct Kernel {
    int radius;
    f64 weights[MAX_TAPS];
} Kernel;

enum { KERNEL_Y, KERNEL_CX, KERNEL_CZ1, KERNEL_CZ2, KERNEL_GAUSS, KERNEL_EDGE, KERNEL_POINT, KERNEL_COUNT };

typedef struct Flip {
    Kernel kernels[KERNEL_COUNT];
    f64 white[3];
    f64 from_xyz[3][3];
    f64 max_color_difference;
} Flip;

// In double throughout: the feature difference is a square root, which makes 3e-4 of a rounding of 1e-7.

// What is compared of a picture: Lab with chroma scaled by lightness, and the strengths of edges and points.
enum { PLANE_L, PLANE_A, PLANE_B, PLANE_EDGE, PLANE_POINT, PLANE_COUNT };

// Where a picture is filtered: rows of light (Y, Cx, Cz) with margins, and what the kernels made of them
// horizontally.
typedef struct Workspace {
    u32 width;
    ValueScale scale;
    f64 *light[3];             // one row, with MAX_RADIUS more pixels at both ends
    f64 *passed[KERNEL_COUNT]; // BAND_ROWS and MAX_RADIUS more rows above and below
    f64 *columns[4];           // one row: sums over the taps
    f64 *planes[2][PLANE_COUNT];
    f64 *decoded; // the light of each level, for sRGB pictures
    f64 *memory;  // all of the above
} Workspace;

// ---- kernels --------------------------------------------------------------------------------

static void set_kernel(Kernel *kernel, int radius, const f64 *weights, f64 factor)
{
    kernel->radius = radius;
    for (int i = 0; i <= 2 * radius; i++)
        kernel->weights[i] = (weights[i] * factor);
}

// One axis of a Gaussian of the spatial filter; returns its sum.
static f64 spatial_weights(f64 amount, f64 scale, int radius, f64 weights[MAX_TAPS])
{
    f64 sum = 0;
    for (int i = -radius; i <= radius; i++) {
        const f64 d = i / PIXELS_PER_DEGREE;
        weights[i + radius] = sqrt(amount * sqrt(PI / scale)) * exp(-PI * PI * d * d / scale);
        sum += weights[i + radius];
    }
    return sum;
}

static void make_spatial_kernels(Flip *flip)
{
    // Three standard deviations of the widest.
    const int radius = (int)ceil(3 * sqrt(SCALE_CZ[0] / (2 * PI * PI)) * PIXELS_PER_DEGREE);
    f64 weights[2][MAX_TAPS];
    set_kernel(&flip->kernels[KERNEL_Y], radius, weights[0],
               1 / spatial_weights(1, SCALE_Y, radius, weights[0]));
    set_kernel(&flip->kernels[KERNEL_CX], radius, weights[0],
               1 / spatial_weights(1, SCALE_CX, radius, weights[0]));
    // The two-dimensional sum of both Gaussians is normalised as one; each is the square of its axis.
    f64 sums[2];
    for (int i = 0; i < 2; i++)
        sums[i] = spatial_weights(AMOUNT_CZ[i], SCALE_CZ[i], radius, weights[i]);
    const f64 factor = 1 / sqrt(sums[0] * sums[0] + sums[1] * sums[1]);
    set_kernel(&flip->kernels[KERNEL_CZ1], radius, weights[0], factor);
    set_kernel(&flip->kernels[KERNEL_CZ2], radius, weights[1], factor);
}

// Positive weights to the sum 1, negative ones to -1.
static void set_balanced_kernel(Kernel *kernel, int radius, f64 weights[MAX_TAPS])
{
    f64 positive = 0, negative = 0;
    for (int i = 0; i <= 2 * radius; i++)
        *(weights[i] > 0 ? &positive : &negative) += fabs(weights[i]);
    for (int i = 0; i <= 2 * radius; i++)
        weights[i] /= weights[i] > 0 ? positive : negative;
    set_kernel(kernel, radius, weights, 1);
}

// Feature pipeline, feature detection: a Gaussian and its derivatives.
static void make_feature_kernels(Flip *flip)
{
    const f64 deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    const int radius = (int)ceil(3 * deviation);
    f64 gauss[MAX_TAPS], edge[MAX_TAPS], point[MAX_TAPS];
    f64 sum = 0;
    for (int i = -radius; i <= radius; i++) {
        const f64 g = exp(-i * i / (2 * deviation * deviation));
        gauss[i + radius] = g;
        edge[i + radius] = -i * g;
        point[i + radius] = (i * i / (deviation * deviation) - 1) * g;
        sum += g;
    }
    set_kernel(&flip->kernels[KERNEL_GAUSS], radius, gauss, 1 / sum);
    set_balanced_kernel(&flip->kernels[KERNEL_EDGE], radius, edge);
    set_balanced_kernel(&flip->kernels[KERNEL_POINT], radius, point);
}

// ---- colour ---------------------------------------------------------------------------------

static void invert(const f64 m[3][3], f64 inverse[3][3])
{
    f64 determinant = 0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const int r = (k + 1) % 3, s = (k + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse[i][k] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
        }
    }
    for (int i = 0; i < 3; i++)
        determinant += m[0][i] * inverse[i][0];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            inverse[i][k] /= determinant;
    }
}

static void multiply(const f64 m[3][3], const f64 v[3], f64 result[3])
{
    for (int i = 0; i < 3; i++)
        result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

static f64 lab_curve(f64 t)
{
    const f64 delta = 6.0 / 29;
    return t > delta * delta * delta ? cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

// Color pipeline, perceptually uniform colour space: CIELAB, a and b scaled by lightness for the Hunt effect.
static void rgb_to_hunt_lab(const Flip *flip, const f64 rgb[3], f64 lab[3])
{
    f64 xyz[3], curve[3];
    multiply(TO_XYZ, rgb, xyz);
    for (int i = 0; i < 3; i++)
        curve[i] = lab_curve(xyz[i] / flip->white[i]);
    lab[0] = 116 * curve[1] - 16;
    lab[1] = 0.01 * lab[0] * 500 * (curve[0] - curve[1]);
    lab[2] = 0.01 * lab[0] * 200 * (curve[1] - curve[2]);
}

// Filtered light to what is compared.
static void light_to_lab(const Flip *flip, f64 y, f64 cx, f64 cz, f64 lab[3])
{
    const f64 relative = (y + 16) / 116;
    const f64 xyz[3] = {(relative + cx / 500) * flip->white[0], relative * flip->white[1],
                        (relative - cz / 200) * flip->white[2]};
    f64 rgb[3];
    multiply(flip->from_xyz, xyz, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = fmin(fmax(rgb[i], 0), 1);
    rgb_to_hunt_lab(flip, rgb, lab);
}

// Color pipeline, colour metric: city block in lightness, Euclid in chroma.
static f64 hyab(f64 dl, f64 da, f64 db)
{
    return fabs(dl) + sqrt(da * da + db * db);
}

static void make_flip(Flip *flip)
{
    make_spatial_kernels(flip);
    make_feature_kernels(flip);
    invert(TO_XYZ, flip->from_xyz);
    for (int i = 0; i < 3; i++)
        flip->white[i] = TO_XYZ[i][0] + TO_XYZ[i][1] + TO_XYZ[i][2];
    f64 green[3], blue[3];
    rgb_to_hunt_lab(flip, (const f64[3]){0, 1, 0}, green);
    rgb_to_hunt_lab(flip, (const f64[3]){0, 0, 1}, blue);
    flip->max_color_difference =
        pow(hyab(green[0] - blue[0], green[1] - blue[1], green[2] - blue[2]), COLOR_EXPONENT);
}

// ---- filtering ------------------------------------------------------------------------------

static f64 decode(const Workspace *work, f32 value)
{
    const f32 clamped = value < 0 ? 0 : value > work->scale.peak ? work->scale.peak : value;
    return work->scale.srgb ? work->decoded[(size_t)clamped] : (f64)clamped / (f64)work->scale.peak;
}

// A row as Y, Cx, Cz (CIELAB without its curve), its ends repeated into the margins.
static void read_light(const Flip *flip, Workspace *work, const Image *image, u32 y)
{
    const u32 channels = image->channels;
    const u32 green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
    const f32 *values = image_row(image, y);
    for (u32 x = 0; x < work->width; x++, values += channels) {
        const f64 rgb[3] = {decode(work, values[0]), decode(work, values[green]), decode(work, values[blue])};
        f64 xyz[3];
        multiply(TO_XYZ, rgb, xyz);
        for (int i = 0; i < 3; i++)
            xyz[i] /= flip->white[i];
        work->light[0][x + MAX_RADIUS] = (116 * xyz[1] - 16);
        work->light[1][x + MAX_RADIUS] = (500 * (xyz[0] - xyz[1]));
        work->light[2][x + MAX_RADIUS] = (200 * (xyz[1] - xyz[2]));
    }
    for (int i = 0; i < 3; i++) {
        f64 *line = work->light[i];
        for (u32 x = 0; x < MAX_RADIUS; x++) {
            line[x] = line[MAX_RADIUS];
            line[MAX_RADIUS + work->width + x] = line[MAX_RADIUS + work->width - 1];
        }
    }
}

static void pass_horizontally(const Flip *flip, Workspace *work, u32 row)
{
    static const int SOURCES[KERNEL_COUNT] = {0, 1, 2, 2, 0, 0, 0};
    for (int k = 0; k < KERNEL_COUNT; k++) {
        const Kernel *kernel = &flip->kernels[k];
        f64 *out = work->passed[k] + (size_t)row * work->width;
        memset(out, 0, work->width * sizeof *out);
        for (int i = 0; i <= 2 * kernel->radius; i++) {
            const f64 weight = kernel->weights[i];
            const f64 *line = work->light[SOURCES[k]] + MAX_RADIUS - kernel->radius + i;
            for (u32 x = 0; x < work->width; x++)
                out[x] += weight * line[x];
        }
    }
}

// Adds the column sums of what kernel `source` made, around the row, weighted by the kernel `taps`.
static void pass_vertically(const Flip *flip, const Workspace *work, int source, int taps, u32 row, f64 *out)
{
    const Kernel *kernel = &flip->kernels[taps];
    for (int i = 0; i <= 2 * kernel->radius; i++) {
        const f64 weight = kernel->weights[i];
        const u32 from = row + MAX_RADIUS + (u32)i - (u32)kernel->radius;
        const f64 *line = work->passed[source] + (size_t)from * work->width;
        for (u32 x = 0; x < work->width; x++)
            out[x] += weight * line[x];
    }
}

static void clear_columns(const Workspace *work)
{
    for (int i = 0; i < 4; i++)
        memset(work->columns[i], 0, work->width * sizeof(f64));
}

static void finish_color(const Flip *flip, const Workspace *work, f64 *const planes[PLANE_COUNT], u32 row)
{
    f64 *const *sums = work->columns;
    clear_columns(work);
    pass_vertically(flip, work, KERNEL_Y, KERNEL_Y, row, sums[0]);
    pass_vertically(flip, work, KERNEL_CX, KERNEL_CX, row, sums[1]);
    pass_vertically(flip, work, KERNEL_CZ1, KERNEL_CZ1, row, sums[2]);
    pass_vertically(flip, work, KERNEL_CZ2, KERNEL_CZ2, row, sums[2]);
    const size_t start = (size_t)row * work->width;
    for (u32 x = 0; x < work->width; x++) {
        f64 lab[3];
        light_to_lab(flip, sums[0][x], sums[1][x], sums[2][x], lab);
        planes[PLANE_L][start + x] = lab[0];
        planes[PLANE_A][start + x] = lab[1];
        planes[PLANE_B][start + x] = lab[2];
    }
}

// Lengths of the gradient and of the vector of second derivatives. The weights of a derivative sum to 0, so
// that Y's offset is gone, and 1/116 is all that its range needs (the paper's erratum).
static void finish_features(const Flip *flip, const Workspace *work, f64 *const planes[PLANE_COUNT], u32 row)
{
    f64 *const *sums = work->columns;
    clear_columns(work);
    pass_vertically(flip, work, KERNEL_EDGE, KERNEL_GAUSS, row, sums[0]);
    pass_vertically(flip, work, KERNEL_GAUSS, KERNEL_EDGE, row, sums[1]);
    pass_vertically(flip, work, KERNEL_POINT, KERNEL_GAUSS, row, sums[2]);
    pass_vertically(flip, work, KERNEL_GAUSS, KERNEL_POINT, row, sums[3]);
    const size_t start = (size_t)row * work->width;
    for (u32 x = 0; x < work->width; x++) {
        planes[PLANE_EDGE][start + x] = sqrt(sums[0][x] * sums[0][x] + sums[1][x] * sums[1][x]) / 116;
        planes[PLANE_POINT][start + x] = sqrt(sums[2][x] * sums[2][x] + sums[3][x] * sums[3][x]) / 116;
    }
}

static void filter_band(const Flip *flip, Workspace *work, const Image *image, u32 top, u32 rows,
                        f64 *const planes[PLANE_COUNT])
{
    const i64 last = (i64)image->height - 1;
    for (u32 row = 0; row < rows + 2 * MAX_RADIUS; row++) {
        const i64 y = (i64)top + row - MAX_RADIUS;
        read_light(flip, work, image, (u32)(y < 0 ? 0 : y > last ? last : y));
        pass_horizontally(flip, work, row);
    }
    for (u32 row = 0; row < rows; row++) {
        finish_color(flip, work, planes, row);
        finish_features(flip, work, planes, row);
    }
}

// ---- the difference -------------------------------------------------------------------------

static f32 pixel_difference(const Flip *flip, const Workspace *work, size_t i)
{
    f64 d[PLANE_COUNT];
    for (int p = 0; p < PLANE_COUNT; p++)
        d[p] = work->planes[0][p][i] - work->planes[1][p][i];
    // Small colour differences get most of the range.
    const f64 most = flip->max_color_difference;
    const f64 bend = BEND_AT * most;
    const f64 raw = pow(hyab(d[PLANE_L], d[PLANE_A], d[PLANE_B]), COLOR_EXPONENT);
    const f64 color =
        raw < bend ? raw * BEND_TO / bend : BEND_TO + (raw - bend) / (most - bend) * (1 - BEND_TO);
    // Final difference: a feature that one picture lacks makes its colour difference more visible.
    const f64 feature = pow(fmax(fabs(d[PLANE_EDGE]), fabs(d[PLANE_POINT])) / sqrt(2), FEATURE_EXPONENT);
    return (f32)pow(color, 1 - feature);
}

static bool make_workspace(Workspace *work, u32 width, Error *error)
{
    work->width = width;
    const size_t line = (size_t)width + 2 * MAX_RADIUS;
    const size_t passed = (size_t)width * (BAND_ROWS + 2 * MAX_RADIUS);
    const size_t plane = (size_t)width * BAND_ROWS;
    enum { LEVELS = 65536 };
    const size_t rows = 3 * line + KERNEL_COUNT * passed + 4 * (size_t)width;
    work->memory = malloc((rows + 2 * PLANE_COUNT * plane + LEVELS) * sizeof(f64));
    if (!work->memory)
        return error_set(error, ERROR_MEMORY, "no memory to compute FLIP");
    f64 *next = work->memory;
    for (int i = 0; i < 3; i++, next += line)
        work->light[i] = next;
    for (int i = 0; i < KERNEL_COUNT; i++, next += passed)
        work->passed[i] = next;
    for (int i = 0; i < 4; i++, next += width)
        work->columns[i] = next;
    for (int i = 0; i < 2 * PLANE_COUNT; i++, next += plane)
        work->planes[i / PLANE_COUNT][i % PLANE_COUNT] = next;
    work->decoded = next;
    return true;
}

static void decode_levels(Workspace *work, ValueScale scale)
{
    for (u32 level = 0; scale.srgb && level <= (u32)scale.peak; level++)
        work->decoded[level] = srgb_decode(level / (f64)scale.peak);
}

bool flip_compare(const Image *reference, const Image *test, ValueScale scale, f32 *differences, Error *error)
{
    const u32 width = reference->width, height = reference->height;
    assert(test->width == width && test->height == height);
    Flip flip;
    make_flip(&flip);
    Workspace work;
    if (!make_workspace(&work, width, error))
        return false;
    work.scale = scale;
    decode_levels(&work, scale);
    for (u32 top = 0; top < height; top += BAND_ROWS) {
        const u32 rows = height - top < BAND_ROWS ? height - top : BAND_ROWS;
        filter_band(&flip, &work, reference, top, rows, work.planes[0]);
        filter_band(&flip, &work, test, top, rows, work.planes[1]);
        const size_t start = (size_t)top * width;
        for (size_t i = 0; i < (size_t)rows * width; i++)
            differences[start + i] = pixel_difference(&flip, &work, i);
    }
    free(work.memory);
    return true;
}
