#include "heatmap.h"

#include "image/color.h"
#include "output/output.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct Color {
    u8 r, g, b;
} Color;

static const Color BLACK = {0, 0, 0}, WHITE = {255, 255, 255}, GREY = {90, 90, 90}, CYAN = {0, 255, 255};

// From just visible to glaring.
static const Color RAMP[] = {{45, 20, 110}, {125, 30, 125}, {205, 50, 80}, {245, 130, 30}, {255, 240, 130}};
enum { RAMP_STEPS = sizeof RAMP / sizeof RAMP[0] - 1 };

// What the ends of the ramp stand for, and the labels below it.
typedef struct Scale {
    f64 low, high;
    const char *labels[6];
} Scale;

static Scale format_scale(Format format)
{
    switch (format) {
    case FORMAT_PNG8:
        return (Scale){1, 255, {"1", "10", "100"}};
    case FORMAT_PNG16:
        return (Scale){1, 65535, {"1", "10", "100", "1000", "10000"}};
    case FORMAT_PFM:
        break;
    }
    return (Scale){1e-7, 10, {"1e-7", "1e-5", "1e-3", "0.1", "10"}};
}

// 0 and below: the low end; 1 and above: the high one.
static f64 scale_place(const Scale *scale, f64 value)
{
    return log(value / scale->low) / log(scale->high / scale->low);
}

static Color ramp_color(f64 place)
{
    const f64 at = fmin(fmax(place, 0), 1) * RAMP_STEPS;
    const int step = at >= RAMP_STEPS ? RAMP_STEPS - 1 : (int)at;
    const f64 part = at - step;
    const Color a = RAMP[step], b = RAMP[step + 1];
    return (Color){(u8)lround(a.r + (b.r - a.r) * part), (u8)lround(a.g + (b.g - a.g) * part),
                   (u8)lround(a.b + (b.b - a.b) * part)};
}

// ---- the picture ----------------------------------------------------------------------------

// Levels, kept as the light that encodes to them.
static void put(Image *canvas, u32 x, u32 y, Color color)
{
    if (x >= canvas->width || y >= canvas->height)
        return;
    f32 *rgb = image_row(canvas, y) + (size_t)x * 3;
    rgb[0] = (f32)srgb_decode(color.r / 255.0);
    rgb[1] = (f32)srgb_decode(color.g / 255.0);
    rgb[2] = (f32)srgb_decode(color.b / 255.0);
}

static Color pixel_color(const Pictures *pictures, const Scale *scale, u32 x, u32 y)
{
    if (pictures->left_out && pictures->left_out[(size_t)y * pictures->region.width + x])
        return GREY;
    const u32 channels = pictures->images[0]->channels;
    const f32 *a = image_row(pictures->images[0], y) + (size_t)x * channels;
    const f32 *b = image_row(pictures->images[1], y) + (size_t)x * channels;
    f64 most = 0;
    for (u32 c = 0; c < channels; c++) {
        if (isnan(a[c]) || isnan(b[c]))
            return CYAN;
        if (a[c] != b[c])
            most = fmax(most, fabs((f64)a[c] - (f64)b[c]));
    }
    return most > 0 ? ramp_color(scale_place(scale, most)) : BLACK;
}

// ---- the legend -----------------------------------------------------------------------------

// Glyphs of 3 x 5, top row first, three bits a row.
typedef struct Glyph {
    char character;
    u8 rows[5];
} Glyph;

static const Glyph GLYPHS[] = {
    {'0', {7, 5, 5, 5, 7}}, {'1', {2, 6, 2, 2, 7}}, {'3', {7, 1, 3, 1, 7}}, {'5', {7, 4, 7, 1, 7}},
    {'7', {7, 1, 1, 2, 2}}, {'.', {0, 0, 0, 0, 2}}, {'-', {0, 0, 7, 0, 0}}, {'e', {0, 7, 7, 4, 3}},
    {'N', {5, 7, 7, 7, 5}}, {'a', {0, 3, 5, 5, 3}}, {'o', {0, 2, 5, 5, 2}}, {'u', {0, 5, 5, 5, 7}},
    {'t', {2, 7, 2, 2, 3}},
};

enum {
    GLYPH_SCALE = 2, // pixels a side of a glyph's dot
    GLYPH_STEP = 4 * GLYPH_SCALE,
    MARGIN = 6,
    BAR_HEIGHT = 12,
    TEXT_HEIGHT = 5 * GLYPH_SCALE,
    SWATCH = 26,
    BAR_WIDTH = 220,
    LEGEND_WIDTH = 5 * MARGIN + 3 * SWATCH + BAR_WIDTH + 4 * GLYPH_STEP,
    LEGEND_HEIGHT = 3 * MARGIN + BAR_HEIGHT + TEXT_HEIGHT
};

static void draw_text(Image *canvas, u32 left, u32 top, const char *text)
{
    for (; *text; text++, left += GLYPH_STEP) {
        for (size_t g = 0; g < sizeof GLYPHS / sizeof GLYPHS[0]; g++) {
            for (u32 i = 0; GLYPHS[g].character == *text && i < 15u * GLYPH_SCALE * GLYPH_SCALE; i++) {
                const u32 x = i % (3 * GLYPH_SCALE), y = i / (3 * GLYPH_SCALE);
                if (GLYPHS[g].rows[y / GLYPH_SCALE] >> (2 - x / GLYPH_SCALE) & 1)
                    put(canvas, left + x, top + y, WHITE);
            }
        }
    }
}

// A bar of one colour with its frame and the text below.
static void draw_swatch(Image *canvas, u32 left, u32 top, Color color, const char *text)
{
    for (u32 y = 0; y < BAR_HEIGHT; y++) {
        for (u32 x = 0; x < SWATCH; x++) {
            const bool frame = x == 0 || y == 0 || x == SWATCH - 1 || y == BAR_HEIGHT - 1;
            put(canvas, left + x, top + y, frame ? WHITE : color);
        }
    }
    draw_text(canvas, left, top + BAR_HEIGHT + MARGIN, text);
}

static void draw_bar(Image *canvas, u32 left, u32 top, const Scale *scale)
{
    for (u32 x = 0; x < BAR_WIDTH; x++) {
        for (u32 y = 0; y < BAR_HEIGHT; y++)
            put(canvas, left + x, top + y, ramp_color(x / (f64)(BAR_WIDTH - 1)));
    }
    for (size_t i = 0; i < sizeof scale->labels / sizeof scale->labels[0] && scale->labels[i]; i++) {
        f64 value;
        if (sscanf(scale->labels[i], "%lf", &value) != 1)
            continue;
        const u32 x = left + (u32)lround(scale_place(scale, value) * (BAR_WIDTH - 1));
        for (u32 y = 0; y < MARGIN - 1; y++)
            put(canvas, x, top + BAR_HEIGHT + y, WHITE);
        draw_text(canvas, x, top + BAR_HEIGHT + MARGIN, scale->labels[i]);
    }
}

// Nothing differs, the scale, NaN, left out.
static void draw_legend(Image *canvas, u32 top, const Scale *scale)
{
    u32 left = MARGIN;
    draw_swatch(canvas, left, top, BLACK, "0");
    left += SWATCH + MARGIN;
    draw_bar(canvas, left, top, scale);
    left += BAR_WIDTH + MARGIN + 4 * GLYPH_STEP;
    draw_swatch(canvas, left, top, CYAN, "NaN");
    left += SWATCH + MARGIN;
    draw_swatch(canvas, left, top, GREY, "out");
}

static Image *draw(const Pictures *pictures, Error *error)
{
    const Region r = pictures->region;
    if (r.height > UINT32_MAX - LEGEND_HEIGHT) {
        error_set(error, ERROR_MEMORY, "no memory for the map");
        return NULL;
    }
    const u32 width = r.width > LEGEND_WIDTH ? r.width : LEGEND_WIDTH;
    Image *canvas = image_create(width, r.height + LEGEND_HEIGHT, 3, error);
    if (!canvas)
        return NULL;
    const Scale scale = format_scale(pictures->format);
    // Darker than the ramp and lighter than "nothing differs", so that the picture's edge can be seen.
    const Color around = {28, 28, 28};
    for (u32 y = 0; y < canvas->height; y++) {
        for (u32 x = 0; x < canvas->width; x++)
            put(canvas, x, y, x < r.width && y < r.height ? pixel_color(pictures, &scale, x, y) : around);
    }
    draw_legend(canvas, r.height + MARGIN, &scale);
    return canvas;
}

bool heatmap_write(const Pictures *pictures, const char *path, Error *error)
{
    if (output_ignores_display_settings(path))
        return error_set(error, ERROR_USAGE, "%s: the map is a PNG", path);
    Image *canvas = draw(pictures, error);
    if (!canvas)
        return false;
    const OutputOptions options = {.settings.encoding = ENCODING_SRGB, .bits = 8};
    Output *output = output_open(path, &options, canvas->width, canvas->height, error);
    bool done = output != NULL;
    if (done) {
        done = output_write_rows(output, canvas->values, canvas->height, error);
        if (done)
            done = output_commit(output, error);
        else
            output_abort(output);
    }
    image_destroy(canvas);
    return done;
}
