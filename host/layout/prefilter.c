#include "layout/prefilter.h"

#include <math.h>
#include <stdlib.h>

static const f64 PI = 3.14159265358979323846;

// The map that all others are made of; its rows stand twice side by side, so that sums may run past the seam.
enum { BASE_WIDTH = 128, BASE_HEIGHT = 64, BASE_STRIDE = 2 * BASE_WIDTH };

typedef struct Base {
    f32 color[3][BASE_HEIGHT][BASE_STRIDE];
} Base;

static const u32 WIDTHS[PREFILTER_MAPS] = { 128, 64, 64, 32, 32, 32, 32, 32 };

u64 prefilter_plan(EnvironmentRecord *record)
{
    u32 count = 0;
    for (u32 k = 0; k < PREFILTER_MAPS; k++) {
        record->maps[k] = (PrefilterMap){ count, WIDTHS[k] };
        count += 3 * WIDTHS[k] * (WIDTHS[k] / 2 + 1);
    }
    record->table = count;
    return (u64)count + 3 * PREFILTER_TABLE * PREFILTER_TABLE;
}

// ---- resampling -------------------------------------------------------------------------------------------

// Points in each texel of the base along a side of `count` texels: at least two a texel of the source.
static u32 points_for(u32 count, u32 base)
{
    return 4 + 2 * ((count + base - 1) / base);
}

// One row of texels, averaged over the columns of the base: the bilinear map at evenly spaced points.
static void narrow_row(const f32 *row, u32 width, f64 *out)
{
    const u32 points = points_for(width, BASE_WIDTH);
    for (u32 t = 0; t < BASE_WIDTH; t++) {
        f64 sum[3] = { 0, 0, 0 };
        for (u32 k = 0; k < points; k++) {
            const f64 x = (t + (k + 0.5) / points) / BASE_WIDTH * width - 0.5, left = floor(x),
                      share = x - left;
            const u32 a = left < 0 ? width - 1 : (u32)left, b = a + 1 < width ? a + 1 : 0;
            for (int c = 0; c < 3; c++)
                sum[c] += (1 - share) * (f64)row[3 * (u64)a + (u64)c] + share * (f64)row[3 * (u64)b + (u64)c];
        }
        for (u32 c = 0; c < 3; c++)
            out[3 * t + c] = sum[c] / points;
    }
}

// narrow: all rows of the source, BASE_WIDTH colours each. Points of a texel count by the sine of their
// angle.
static void shorten(const f64 *narrow, u32 height, Base *base)
{
    const u32 points = points_for(height, BASE_HEIGHT);
    for (u32 r = 0; r < BASE_HEIGHT; r++) {
        f64 sums[3 * BASE_WIDTH] = { 0 }, weights = 0;
        for (u32 k = 0; k < points; k++) {
            const f64 v = (r + (k + 0.5) / points) / BASE_HEIGHT, weight = sin(PI * v);
            const f64 y = fmin(fmax(v * height - 0.5, 0), height - 1.0), above = floor(y);
            const f64 *a = narrow + 3 * BASE_WIDTH * (u64)above;
            const f64 *b = (u32)above + 1 < height ? a + 3 * BASE_WIDTH : a;
            for (u32 i = 0; i < 3 * BASE_WIDTH; i++)
                sums[i] += weight * (a[i] + (y - above) * (b[i] - a[i]));
            weights += weight;
        }
        for (u32 x = 0; x < BASE_STRIDE; x++)
            for (u32 c = 0; c < 3; c++)
                base->color[c][r][x] = (f32)(sums[3 * (x % BASE_WIDTH) + c] / weights);
    }
}

static bool make_base(const EnvironmentRecord *record, const f32 *texels, Base *base)
{
    f64 *narrow = malloc((u64)record->height * 3 * BASE_WIDTH * sizeof *narrow);
    if (!narrow)
        return false;
#pragma omp parallel for
    for (u32 y = 0; y < record->height; y++)
        narrow_row(texels + 3 * (u64)y * record->width, record->width, narrow + 3 * BASE_WIDTH * (u64)y);
    shorten(narrow, record->height, base);
    free(narrow);
    return true;
}

// ---- blurring ---------------------------------------------------------------------------------------------

// Weight of light at the angle with this cosine to the direction that a map is asked for: of a lobe of width
// a seen along its normal, D(H) N.L; of diffuse reflection (a = 0) N.L.
static f64 kernel_weight(f64 a, f64 cosine)
{
    if (!(cosine > 0))
        return 0;
    const f64 sine2 = (1 - cosine) / 2, t = sine2 + a * a * (1 - sine2); // of the angle to H
    return a > 0 ? cosine / (t * t) : cosine;
}

// One row of a map, at polar angle `angle`; `step` columns of the base to one of the map.
static void blur_row(const Base *base, f64 a, f64 angle, u32 step, f32 *out)
{
    f64 weights[BASE_HEIGHT][BASE_WIDTH], sum = 0;
    f32 shares[BASE_HEIGHT][BASE_WIDTH];
    for (u32 y = 0; y < BASE_HEIGHT; y++) {
        const f64 top = PI * y / BASE_HEIGHT, other = top + PI / 2 / BASE_HEIGHT;
        const f64 solid = cos(top) - cos(top + PI / BASE_HEIGHT);
        for (u32 x = 0; x < BASE_WIDTH; x++) {
            const f64 turn = 2 * PI * (x + 0.5 - step / 2.0) / BASE_WIDTH;
            const f64 cosine = cos(angle) * cos(other) + sin(angle) * sin(other) * cos(turn);
            weights[y][x] = solid * kernel_weight(a, cosine);
            sum += weights[y][x];
        }
    }
    for (u32 y = 0; y < BASE_HEIGHT; y++)
        for (u32 x = 0; x < BASE_WIDTH; x++)
            shares[y][x] = (f32)(weights[y][x] / sum);
    for (u32 t = 0; t < BASE_WIDTH / step; t++) {
        for (u32 c = 0; c < 3; c++) {
            f32 total = 0;
            for (u32 y = 0; y < BASE_HEIGHT; y++) {
                const f32 *from = base->color[c][y] + t * step;
                f32 part = 0;
#pragma omp simd reduction(+ : part)
                for (u32 x = 0; x < BASE_WIDTH; x++)
                    part += shares[y][x] * from[x];
                total += part;
            }
            out[3 * t + c] = total;
        }
    }
}

// ---- reflectance ------------------------------------------------------------------------------------------

typedef struct Direction {
    f64 x, y, z;
} Direction;

static f64 masking(f64 a2, f64 cosine) // Smith's G1
{
    return 2 * cosine / (cosine + sqrt(a2 + (1 - a2) * cosine * cosine));
}

// Visible normal of a lobe for an eye at (sine, 0, cosine): Dupuy and Benyoub, "Sampling Visible GGX Normals
// with Spherical Caps", 2023.
static Direction visible_normal(f64 a, f64 sine, f64 cosine, f64 u, f64 v)
{
    const f64 length = sqrt(a * a * sine * sine + cosine * cosine), z = 1 - u * (1 + cosine / length);
    const f64 radius = sqrt(fmax(1 - z * z, 0));
    const Direction h = { a * (radius * cos(2 * PI * v) + a * sine / length), a * radius * sin(2 * PI * v),
                          fmax(z + cosine / length, 0) };
    const f64 size = sqrt(h.x * h.x + h.y * h.y + h.z * h.z);
    return (Direction){ h.x / size, h.y / size, h.z / size };
}

static f64 fifth_power(f64 x)
{
    return x * x * x * x * x;
}

// What a lobe and diffuse reflection send towards the eye of light that is the same from everywhere; see
// PREFILTER_TABLE.
static void reflectance(f64 cosine, f64 roughness, f32 out[3])
{
    enum { STEPS = 24 };
    // Points of u crowd at its end, where the tail of the lobe is.
    const f64 a = roughness * roughness, a2 = a * a, sine = sqrt(1 - cosine * cosine);
    f64 factor = 0, summand = 0, diffuse = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        const f64 s = (i / STEPS + 0.5) / STEPS, v = (i % STEPS + 0.5) / STEPS;
        const f64 u = 1 - (1 - s) * (1 - s) * (1 - s), share = 3 * (1 - s) * (1 - s);
        const Direction h = visible_normal(a, sine, cosine, u, v);
        const f64 vh = sine * h.x + cosine * h.z, nl = 2 * vh * h.z - cosine;
        if (nl > 0 && vh > 0) {
            const f64 vis = 0.5 / (nl * sqrt(a2 + (1 - a2) * cosine * cosine) +
                                   cosine * sqrt(a2 + (1 - a2) * nl * nl));
            const f64 weight = share * 4 * vis * nl * cosine / masking(a2, cosine),
                      rest = fifth_power(1 - vh);
            factor += weight * (1 - rest);
            summand += weight * rest;
        }
        // Light at the cosine sqrt(1 - s): V.H is half the length of V + L.
        const f64 lz = sqrt(1 - s), lx = sqrt(s) * cos(2 * PI * v);
        diffuse += 1 - fifth_power(1 - sqrt(fmax((1 + sine * lx + cosine * lz) / 2, 0)));
    }
    out[0] = (f32)(factor / (STEPS * STEPS));
    out[1] = (f32)(summand / (STEPS * STEPS));
    out[2] = (f32)(diffuse / (STEPS * STEPS));
}

bool prefilter_run(const EnvironmentRecord *record, const f32 *texels, f32 *numbers)
{
    Base *base = malloc(sizeof *base);
    if (!base || !make_base(record, texels, base)) {
        free(base);
        return false;
    }
    for (u32 k = 0; k < PREFILTER_MAPS; k++) {
        const PrefilterMap *map = &record->maps[k];
        const u32 height = map->width / 2;
        const f64 a = k < PREFILTER_LOBES ? ldexp(1, (int)k + 1 - PREFILTER_LOBES) : 0;
#pragma omp parallel for
        for (u32 y = 0; y <= height; y++)
            blur_row(base, a, PI * y / height, BASE_WIDTH / map->width,
                     numbers + map->offset + 3 * map->width * y);
    }
    const f64 least = 0.02; // roughness and, as the masking has it, cosine of grazing rays
#pragma omp parallel for
    for (u32 i = 0; i < PREFILTER_TABLE * PREFILTER_TABLE; i++) {
        const f64 cosine = (f64)(i % PREFILTER_TABLE) / (PREFILTER_TABLE - 1);
        const f64 roughness = (f64)(i / PREFILTER_TABLE) / (PREFILTER_TABLE - 1);
        reflectance(fmax(cosine, 1e-4), fmax(roughness, least), numbers + record->table + 3 * i);
    }
    free(base);
    return true;
}
