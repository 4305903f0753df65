#include "layout/environment.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "layout/prefilter.h"

static const f64 PI = 3.14159265358979323846;

// Numbers of a map are counted by the kernels' ints.
static const u64 NUMBERS_MAX = 0x7fffffff;

static f32 limited(f64 x)
{
    return x < FLT_MAX ? (f32)x : FLT_MAX;
}

// An environment as it lights a scene: a picture, or one color everywhere.
typedef struct Sky {
    const Bitmap *bitmap; // NULL: the color
    Vec3 factors;
    u32 width, height;
} Sky;

static Sky sky_of(const Scene *scene, bool path)
{
    const Environment *environment = &scene->environment;
    if (environment->present && environment->bitmap)
        return (Sky){ environment->bitmap, environment->intensity, environment->bitmap->width,
                      environment->bitmap->height };
    return (Sky){ NULL, path ? scene->background : (Vec3){ 0, 0, 0 }, 1, 1 };
}

// Fills the texels, 3 numbers each; returns the largest sum of the three.
static f64 fill_texels(const Sky *sky, f32 *texels)
{
    const Bitmap *bitmap = sky->bitmap;
    const f64 factors[3] = { sky->factors.x, sky->factors.y, sky->factors.z };
    f64 largest = 0;
#pragma omp parallel for reduction(max : largest)
    for (u32 y = 0; y < sky->height; y++) {
        f32 *texel = texels + 3 * (u64)y * sky->width;
        for (u32 x = 0; x < sky->width; x++, texel += 3) {
            for (u32 c = 0; c < 3; c++)
                texel[c] = limited(factors[c] * (bitmap ? bitmap_value(bitmap, x, y, bitmap->channels == 3 ? c : 0)
                                                        : 1));
            largest = fmax(largest, (f64)texel[0] + (f64)texel[1] + (f64)texel[2]);
        }
    }
    return largest;
}

static f64 texel_strength(const Layout *layout, u32 x, u32 y)
{
    const EnvironmentRecord *record = layout->environment;
    const f32 *texel = layout->environment_texels + 3 * ((u64)y * record->width + x);
    return (f64)record->scale * ((f64)texel[0] + (f64)texel[1] + (f64)texel[2]);
}

// What of it directions are drawn for.
static f64 strength(const Layout *layout, u32 x, u32 y)
{
    return fmax(texel_strength(layout, x, y) - (f64)layout->path.sky_floor, 0);
}

// The mean over all directions.
static f64 mean_strength(const Layout *layout)
{
    const EnvironmentRecord *record = layout->environment;
    f64 sum = 0;
    for (u32 y = 0; y < record->height; y++) {
        f64 row = 0;
        for (u32 x = 0; x < record->width; x++)
            row += texel_strength(layout, x, y);
        sum += row * (cos(PI * y / record->height) - cos(PI * (y + 1.0) / record->height));
    }
    return sum / (2 * (f64)record->width);
}

// Turns weights into what comes before each, in shares of 2^32; returns their sum.
static f64 accumulate(const f64 *weights, u32 count, u32 *cdf)
{
    f64 sum = 0, before = 0;
    for (u32 i = 0; i < count; i++)
        sum += weights[i];
    for (u32 i = 0; i < count; i++) {
        const f64 share = sum > 0 ? before / sum : (f64)i / count;
        cdf[i] = (u32)fmin(rint(share * 0x1p32), 0xffffffffp0);
        before += weights[i];
    }
    return sum;
}

// sin^2 of half the polar angle where row `row` of cells begins; height + 1 is the end of the last.
static f64 edge(u32 row, u32 height)
{
    const f64 angle = row == 0 ? 0 : row > height ? PI : PI * (row - 0.5) / height;
    return sin(angle / 2) * sin(angle / 2);
}

static bool add_tables(Layout *layout, Error *error)
{
    EnvironmentRecord *record = layout->environment;
    const u32 width = record->width, height = record->height, rows = height + 1;
    layout->environment_cdf_count = rows + (u64)rows * width;
    layout->environment_edge_count = height + 2;
    layout->environment_cdf = page_alloc(layout->environment_cdf_count * sizeof *layout->environment_cdf);
    layout->environment_edges =
        page_alloc(layout->environment_edge_count * sizeof *layout->environment_edges);
    f64 *sums = calloc(rows, sizeof *sums), *weights = calloc(rows, sizeof *weights);
    bool enough = layout->environment_cdf && layout->environment_edges && sums && weights;
#pragma omp parallel if (enough)
    {
        f64 *line = calloc(width, sizeof *line);
#pragma omp for reduction(&& : enough)
        for (u32 row = 0; row < rows; row++) {
            const u32 above = row > 0 ? row - 1 : 0, below = row < height ? row : height - 1;
            enough = enough && line;
            for (u32 x = 0; line && x < width; x++) {
                const u32 next = x + 1 < width ? x + 1 : 0;
                line[x] = strength(layout, x, above) + strength(layout, next, above) +
                          strength(layout, x, below) + strength(layout, next, below);
            }
            if (line)
                sums[row] = accumulate(line, width, layout->environment_cdf + rows + (u64)row * width);
        }
        free(line);
    }
    if (enough) {
        // Cells of a row fill the same solid angle, 2 pi / width times what the cosine falls by.
        for (u32 row = 0; row < rows; row++)
            weights[row] = sums[row] / 4 * (4 * PI / width) * (edge(row + 1, height) - edge(row, height));
        for (u32 row = 0; row < layout->environment_edge_count; row++)
            layout->environment_edges[row] = (f32)edge(row, height);
        record->density = (f32)(1 / accumulate(weights, rows, layout->environment_cdf));
    }
    free(sums);
    free(weights);
    return enough || error_set(error, ERROR_MEMORY, "no memory for the tables of the environment");
}

static void fill_guides(const u32 *cdf, u32 count, i32 *guides)
{
    u32 index = 0;
    for (u64 k = 0; k <= ENVIRONMENT_GUIDES; k++) {
        while (index + 1 < count && cdf[index + 1] <= k << (32 - ENVIRONMENT_GUIDES_LOG2))
            index++;
        guides[k] = (i32)index;
    }
}

static bool add_guides(Layout *layout, Error *error)
{
    const u32 width = layout->environment->width, rows = layout->environment->height + 1;
    layout->environment_guide_count = (rows + 1) * (ENVIRONMENT_GUIDES + 1);
    layout->environment_guides = page_alloc(layout->environment_guide_count * sizeof *layout->environment_guides);
    if (!layout->environment_guides)
        return error_set(error, ERROR_MEMORY, "no memory for the tables of the environment");
    const u32 *cdf = layout->environment_cdf;
    i32 *guides = layout->environment_guides;
    fill_guides(cdf, rows, guides);
    for (u64 row = 0; row < rows; row++)
        fill_guides(cdf + rows + row * width, width, guides + (row + 1) * (ENVIRONMENT_GUIDES + 1));
    return true;
}

// MIS compensation: rays that surfaces draw find well what is everywhere alike, so that only what the sky has above its
// mean is drawn for, and nothing of an even one (Karlik, Sik, Vevoda, Skrivan and Krivanek, "MIS Compensation: Optimizing
// Sampling Techniques in Multiple Importance Sampling", 2019).
static bool add_path_tables(Layout *layout, f64 largest, Error *error)
{
    if (layout->path.techniques == (LIGHTS_BY_LIGHTS | LIGHTS_BY_SURFACES))
        layout->path.sky_floor = (f32)mean_strength(layout);
    const bool even = (f64)layout->environment->scale * largest <= 1.0001 * (f64)layout->path.sky_floor;
    return even || (add_tables(layout, error) && add_guides(layout, error));
}

static bool add_levels(Layout *layout, Error *error)
{
    layout->environment_level_count = prefilter_plan(layout->environment);
    layout->environment_levels =
        page_alloc(layout->environment_level_count * sizeof *layout->environment_levels);
    return (layout->environment_levels &&
            prefilter_run(layout->environment, layout->environment_texels, layout->environment_levels)) ||
           error_set(error, ERROR_MEMORY, "no memory for the prefiltered environment");
}

static bool bright(const Sky *sky)
{
    return sky->factors.x > 0 || sky->factors.y > 0 || sky->factors.z > 0;
}

bool environment_add(Layout *layout, const Scene *scene, bool lit, Error *error)
{
    const Sky sky = sky_of(scene, layout->path.on);
    if (!bright(&sky))
        return true;
    const u32 width = sky.width, height = sky.height;
    const u64 count = 3 * (u64)width * height + 1; // kernels load four numbers for three
    if (count > NUMBERS_MAX)
        return error_set(error, ERROR_MEMORY, "the environment has %llu texels, too many",
                         (unsigned long long)count / 3);
    layout->environment = page_alloc(sizeof *layout->environment);
    layout->environment_texel_count = count;
    layout->environment_texels = page_alloc(count * sizeof *layout->environment_texels);
    if (!layout->environment || !layout->environment_texels)
        return error_set(error, ERROR_MEMORY, "no memory for the environment of %u x %u texels", width,
                         height);
    EnvironmentRecord *record = layout->environment;
    const f64 turn = 0.5 + scene->environment.rotate / 360,
              largest = fill_texels(&sky, layout->environment_texels);
    const bool prefiltered = scene->render.environment_lighting == ENVIRONMENT_PREFILTERED;
    record->width = width;
    record->height = height;
    record->turn = (f32)(turn - floor(turn));
    record->scale = (f32)fmin(1 / fmax(largest, 1e-30), 1e30);
    if (largest > 0 && layout->path.on)
        return add_path_tables(layout, largest, error);
    if (largest > 0 && lit)
        return prefiltered ? add_levels(layout, error) : add_tables(layout, error);
    if (!(largest > 0)) {
        page_free(layout->environment, sizeof *layout->environment);
        page_free(layout->environment_texels, count * sizeof *layout->environment_texels);
        layout->environment = NULL;
        layout->environment_texels = NULL;
        layout->environment_texel_count = 0;
    }
    return true;
}
