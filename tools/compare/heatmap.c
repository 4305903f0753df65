#include "heatmap.h"

#include "font.h"
#include "image/color.h"
#include "image/image.h"
#include "output/output.h"

#include <math.h>
#include <stdio.h>

typedef struct Color {
    u8 r, g, b;
} Color;

static const Color BLACK = {0, 0, 0}, WHITE = {255, 255, 255}, GREY = {90, 90, 90}, CYAN = {0, 255, 255};

// From just visible to glaring.
static const Color RAMP[] = {{45, 20, 110}, {125, 30, 125}, {205, 50, 80}, {245, 130, 30}, {255, 240, 130}};
enum { RAMP_STEPS = sizeof RAMP / sizeof RAMP[0] - 1 };

// 0 and below: the low end; 1 and above: the high one.
static f64 scale_place(const HeatScale *scale, f64 value)
{
    if (!scale->logarithmic)
        return (value - scale->low) / (scale->high - scale->low);
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

static Color value_color(const HeatScale *scale, f64 value)
{
    if (isnan(value))
        return CYAN;
    if (value < 0)
        return GREY;
    return value > 0 ? ramp_color(scale_place(scale, value)) : BLACK;
}

// ---- the legend -----------------------------------------------------------------------------

enum {
    MARGIN = 6,
    BAR_HEIGHT = 12,
    SWATCH = 26,
    BAR_WIDTH = 220,
    LEGEND_WIDTH = 5 * MARGIN + 3 * SWATCH + BAR_WIDTH + 4 * FONT_STEP,
    LEGEND_HEIGHT = 4 * MARGIN + BAR_HEIGHT + 2 * FONT_HEIGHT
};

static void draw_text(Image *canvas, u32 left, u32 top, const char *text)
{
    for (; *text; text++, left += FONT_STEP) {
        for (u32 y = 0; y < FONT_HEIGHT; y++) {
            for (u32 x = 0; x < FONT_WIDTH; x++) {
                if (font_pixel(*text, x, y))
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

static void draw_bar(Image *canvas, u32 left, u32 top, const HeatScale *scale)
{
    for (u32 x = 0; x < BAR_WIDTH; x++) {
        for (u32 y = 0; y < BAR_HEIGHT; y++)
            put(canvas, left + x, top + y, ramp_color(x / (f64)(BAR_WIDTH - 1)));
    }
    for (size_t i = 0; i < HEATMAP_LABELS && scale->labels[i]; i++) {
        f64 value;
        if (sscanf(scale->labels[i], "%lf", &value) != 1)
            continue;
        const u32 x = left + (u32)lround(scale_place(scale, value) * (BAR_WIDTH - 1));
        for (u32 y = 0; y < MARGIN - 1; y++)
            put(canvas, x, top + BAR_HEIGHT + y, WHITE);
        draw_text(canvas, x, top + BAR_HEIGHT + MARGIN, scale->labels[i]);
    }
}

// Nothing differs, the scale, NaN, not there; below, the caption.
static void draw_legend(Image *canvas, u32 top, const HeatMap *map)
{
    u32 left = MARGIN;
    draw_swatch(canvas, left, top, BLACK, "0");
    left += SWATCH + MARGIN;
    draw_bar(canvas, left, top, &map->scale);
    left += BAR_WIDTH + MARGIN + 4 * FONT_STEP;
    draw_swatch(canvas, left, top, CYAN, "NAN");
    left += SWATCH + MARGIN;
    draw_swatch(canvas, left, top, GREY, "OUT");
    draw_text(canvas, MARGIN, top + BAR_HEIGHT + FONT_HEIGHT + 2 * MARGIN, map->caption);
}

static Image *draw(const HeatMap *map, Error *error)
{
    if (map->height > UINT32_MAX - LEGEND_HEIGHT) {
        error_set(error, ERROR_MEMORY, "no memory for the map");
        return NULL;
    }
    const u32 width = map->width > LEGEND_WIDTH ? map->width : LEGEND_WIDTH;
    Image *canvas = image_create(width, map->height + LEGEND_HEIGHT, 3, error);
    if (!canvas)
        return NULL;
    // Darker than the ramp and lighter than "nothing differs", so that the picture's edge can be seen.
    const Color around = {28, 28, 28};
    for (u32 y = 0; y < canvas->height; y++) {
        const f32 *values = y < map->height ? map->values + (size_t)y * map->width : NULL;
        for (u32 x = 0; x < canvas->width; x++)
            put(canvas, x, y,
                values && x < map->width ? value_color(&map->scale, (f64)values[x]) : around);
    }
    draw_legend(canvas, map->height + MARGIN, map);
    return canvas;
}

bool heatmap_write(const HeatMap *map, const char *path, Error *error)
{
    if (output_ignores_display_settings(path))
        return error_set(error, ERROR_USAGE, "%s: the map is a PNG", path);
    Image *canvas = draw(map, error);
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
