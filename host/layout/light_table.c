#include "layout/light_table.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

static const f64 PI = 3.14159265358979323846;

// Of the choices so many are spread over all lights alike, so that one which is near to something, although weak, is
// found there.
static const f64 EVEN_SHARE = 0.1;

bool light_table_plan(Layout *layout, Error *error)
{
    const bool all = layout->light_count <= LIGHT_CHOICES;
    layout->path.light_choices = all ? layout->light_count : LIGHT_CHOICES;
    if (all)
        return true;
    layout->light_table = page_alloc(layout->light_count * sizeof *layout->light_table);
    return layout->light_table || error_set(error, ERROR_MEMORY, "no memory for %u lights", layout->light_count);
}

// Half of the diagonal of what is bounded and of the lights that stand somewhere: a distance over which light goes.
static f64 scene_size(const Layout *layout)
{
    f64 low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    if (layout->root != NO_INDEX)
        for (u32 k = 0; k < BVH_WIDTH; k++) {
            const BvhNode *node = &layout->nodes[layout->root];
            const f32 lower[3] = { node->lower_x[k], node->lower_y[k], node->lower_z[k] };
            const f32 upper[3] = { node->upper_x[k], node->upper_y[k], node->upper_z[k] };
            for (u32 c = 0; c < 3; c++) {
                low[c] = fmin(low[c], (f64)lower[c]);
                high[c] = fmax(high[c], (f64)upper[c]);
            }
        }
    for (u32 i = 0; i < layout->light_count; i++) {
        const LightRecord *light = &layout->lights[i];
        const f64 at[3] = { (f64)light->position.x, (f64)light->position.y, (f64)light->position.z };
        const bool somewhere = light->kind != LIGHT_KIND_DIRECTIONAL && light->kind != LIGHT_KIND_ENVIRONMENT;
        for (u32 c = 0; c < 3 && somewhere; c++) {
            low[c] = fmin(low[c], at[c]);
            high[c] = fmax(high[c], at[c]);
        }
    }
    f64 square = 0;
    for (u32 c = 0; c < 3; c++)
        square += high[c] > low[c] ? (high[c] - low[c]) * (high[c] - low[c]) : 0;
    return square > 0 && isfinite(square) ? sqrt(square) / 2 : 1;
}

static f64 sky_power(const Layout *layout)
{
    const EnvironmentRecord *record = layout->environment;
    // 1 / density: the integral over all directions of the strength, which is scaled radiance of three channels.
    return record->density > 0 ? 1 / (4 * (f64)record->density * (f64)record->scale * 3) : 0;
}

// Irradiance that the light brings over that distance to what faces it.
static f64 light_power(const Layout *layout, const LightRecord *light, f64 distance)
{
    const f64 mean = ((f64)light->intensity.x + (f64)light->intensity.y + (f64)light->intensity.z) / 3;
    const f64 square = distance * distance, size = (f64)light->size;
    const f64 fall = (f64)light->attenuation[0] + (f64)light->attenuation[1] * distance +
                     (f64)light->attenuation[2] * square;
    switch (light->kind) {
    case LIGHT_KIND_SPHERE:
        return mean * PI * fmin(size * size / square, 1);
    case LIGHT_KIND_RECTANGLE:
        return mean * fmin(size / square, PI) / 2; // half of what it would be in front of it
    case LIGHT_KIND_ENVIRONMENT:
        return sky_power(layout);
    case LIGHT_KIND_SPOT:
        return PI * mean / fmax(fall, 1e-30) * fmin((f64)light->versine_outer, 1);
    case LIGHT_KIND_POINT:
        return PI * mean / fmax(fall, 1e-30);
    default:
        return PI * mean;
    }
}

// Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991. rest: count numbers, used up.
static void fill_aliases(LightTableEntry *table, u32 count, f64 *rest, u32 *order)
{
    u32 small = 0, large = count;
    for (u32 i = 0; i < count; i++) {
        rest[i] = (f64)table[i].share * count;
        if (rest[i] < 1)
            order[small++] = i;
        else
            order[--large] = i;
        table[i].keep = 1;
        table[i].alias = i;
    }
    while (small > 0 && large < count) {
        const u32 poor = order[--small], rich = order[large];
        table[poor].keep = (f32)rest[poor];
        table[poor].alias = rich;
        rest[rich] -= 1 - rest[poor];
        if (rest[rich] < 1) {
            order[small++] = rich;
            large++;
        }
    }
}

bool light_table_fill(Layout *layout, Error *error)
{
    const u32 count = layout->light_count;
    f64 *powers = malloc(count * sizeof *powers);
    u32 *order = malloc(count * sizeof *order);
    const bool enough = powers && order;
    f64 sum = 0;
    const f64 size = scene_size(layout);
    for (u32 i = 0; enough && i < count; i++)
        sum += powers[i] = light_power(layout, &layout->lights[i], size);
    for (u32 i = 0; enough && i < count; i++) {
        const f64 share = sum > 0 && isfinite(sum) ? powers[i] / sum : 1.0 / count;
        layout->light_table[i].share = (f32)(share * (1 - EVEN_SHARE) + EVEN_SHARE / count);
    }
    if (enough)
        fill_aliases(layout->light_table, count, powers, order);
    free(powers);
    free(order);
    return enough || error_set(error, ERROR_MEMORY, "no memory for %u lights", count);
}
