// The environment: radiance of a direction, and directions drawn by it.
#ifndef CLRT_KERNELS_LIGHT_ENVIRONMENT_H
#define CLRT_KERNELS_LIGHT_ENVIRONMENT_H

#include "base/frame.h"
#if HAS_PATH
#include "base/gather4.h"
#endif
#include "base/math.h"
#include "base/offset.h"
#include "base/sampling.h"
#include "shared/environment.h"

typedef struct {
    global const EnvironmentRecord *record;
    global const f32 *map; // 3 numbers a texel, the top row first
#if HAS_ENVIRONMENT_LIGHT
    // Probability of what is before (2^32 is 1): of each row of cells, then for each row of its columns.
    global const uint *cdf;
    // Half of 1 - cosine of the polar angle where rows of cells begin, and where the last ends.
    global const f32 *edges;
#if HAS_PATH
    global const int *guides; // shared/environment.h
    f32 floor;                // strength that is left to directions drawn by surfaces
#endif
#endif
#if HAS_PREFILTERED
    global const f32 *levels;
#endif
} Environment;

// A place on a map: a cell and the shares of its right and lower corners.
typedef struct {
    vi column, row;
    vf right, below;
} MapPlace;

#if HAS_PATH
// p has one number more than it needs.
static inline v3 v3_gather(global const f32 *p, vi index)
{
    const Gather4 four = gather4(p, index);
    return v3_make(four.x, four.y, four.z);
}
#else
static inline v3 v3_gather(global const f32 *p, vi index)
{
    return v3_make(vf_gather(p, index), vf_gather(p, index + 1), vf_gather(p, index + 2));
}

#endif

static inline v3 v3_lerp(v3 a, v3 b, vf t) { return v3_fma(v3_sub(b, a), t, a); }

// Share of a turn about the vertical axis, 0 in the middle of an unturned map; and fall: angle
// from the top over pi.
static inline vf direction_turn(v3 dir) { return vf_atan2(dir.x, -dir.z) / TWO_PI; }
static inline vf direction_fall(v3 dir)
{
    return vf_atan2(sqrt(fma(dir.x, dir.x, dir.z * dir.z)), dir.y) / PI;
}

// u in turns, y in rows from the centre of the first; width, height: of the map, in every lane.
static inline MapPlace map_place(vf u, vf y, vf width, vf height)
{
    MapPlace place;
    const vf x = fma(u - floor(u), width, (vf)(-0.5f));
    const vf left = floor(x), above = vf_min(vf_max(floor(y), (vf)(-1.0f)), height - 1.0f);
    place.right = x - left;
    place.below = vf_clamp(y - above, 0.0f, 1.0f);
    const vf column = left < (vf)(0.0f) ? width - 1.0f : vf_min(left, width - 1.0f);
    place.column = VI_FROM_VF(column);
    place.row = VI_FROM_VF(above) + 1;
    return place;
}

// The corners of a cell, two a row of texels.
typedef struct { v3 corner[4]; } MapCell;

// Of the map whose numbers begin at `offset`.
static inline MapCell map_cell(global const f32 *numbers, vi offset, const MapPlace *place, vi width,
                               vi height)
{
    MapCell cell;
    const vi column = place->column, row = place->row;
    const vi next = column + 1 < width ? column + 1 : (vi)(0);
    const vi above = (row > (vi)(0) ? row - 1 : row) * width,
             below = (row < height ? row : height - 1) * width;
    cell.corner[0] = v3_gather(numbers, offset + 3 * (above + column));
    cell.corner[1] = v3_gather(numbers, offset + 3 * (above + next));
    cell.corner[2] = v3_gather(numbers, offset + 3 * (below + column));
    cell.corner[3] = v3_gather(numbers, offset + 3 * (below + next));
    return cell;
}

static inline v3 cell_radiance(const MapCell *cell, vf right, vf below)
{
    return v3_lerp(v3_lerp(cell->corner[0], cell->corner[1], right),
                   v3_lerp(cell->corner[2], cell->corner[3], right), below);
}

static inline MapPlace environment_place(global const EnvironmentRecord *record, v3 dir)
{
    const vf width = (vf)((real)record->width), height = (vf)((real)record->height);
    return map_place(direction_turn(dir) + record->turn, fma(direction_fall(dir), height, (vf)(-0.5f)), width,
                     height);
}

static inline MapCell environment_cell(const Environment *environment, const MapPlace *place)
{
    global const EnvironmentRecord *record = environment->record;
    return map_cell(environment->map, (vi)(0), place, (vi)((int)record->width), (vi)((int)record->height));
}

OUTLINE v3 environment_radiance(const Environment *environment, v3 dir)
{
    const MapPlace place = environment_place(environment->record, dir);
    const MapCell cell = environment_cell(environment, &place);
    return cell_radiance(&cell, place.right, place.below);
}

#if HAS_ENVIRONMENT_LIGHT
typedef struct {
    v3 dir, radiance;
    vf density; // with which environment_sample gives dir, over solid angle
} EnvironmentSample;

static inline vf cell_strength(const Environment *environment, const MapCell *cell, int corner)
{
    const vf scale = (vf)(environment->record->scale);
    const v3 c = cell->corner[corner];
#if HAS_PATH
    return vf_max(fma(c.z, scale, fma(c.y, scale, fma(c.x, scale, (vf)(-environment->floor)))), (vf)(0.0f));
#else
    return fma(c.z, scale, fma(c.y, scale, c.x * scale));
#endif
}

// Half of 1 - cos and of 1 + cos of the polar angle where rows of cells begin: neither loses the digits that
// it has near its own pole.
static inline vf edge_from_top(const Environment *environment, vi row)
{
    return vf_gather(environment->edges, row);
}
static inline vf edge_from_bottom(const Environment *environment, vi row)
{
    return vf_gather(environment->edges, (int)environment->record->height + 1 - row);
}

// The radiance of dir, and the density with which environment_sample gives it.
OUTLINE EnvironmentSample environment_look(const Environment *environment, v3 dir)
{
    EnvironmentSample sample;
    const MapPlace place = environment_place(environment->record, dir);
    const MapCell cell = environment_cell(environment, &place);
    const vf flat = fma(dir.x, dir.x, dir.z * dir.z), half_flat = 0.5f * flat / (1.0f + fabs(dir.y));
    const vm upper = dir.y > (vf)(0.0f);
    const vf top = edge_from_top(environment, place.row), bottom = edge_from_bottom(environment, place.row);
    const vf height = upper ? edge_from_top(environment, place.row + 1) - top
                            : bottom - edge_from_bottom(environment, place.row + 1);
    const vf below = vf_clamp((upper ? half_flat - top : bottom - half_flat) / height, 0.0f, 1.0f);
    const vf left = cell_strength(environment, &cell, 0), right = cell_strength(environment, &cell, 1);
    const vf left_end = fma(cell_strength(environment, &cell, 2) - left, below, left);
    const vf right_end = fma(cell_strength(environment, &cell, 3) - right, below, right);
    sample.dir = dir;
    sample.radiance = cell_radiance(&cell, place.right, place.below);
    sample.density = environment->record->density * fma(right_end - left_end, place.right, left_end);
    return sample;
}

typedef struct {
    vi index;
    vf rest; // of the number within what the index stands for, in [0, 1)
} Drawn;

// Inverts `count` increasing numbers of the table from `first` on, the first of them 0.
OUTLINE Drawn draw_index(global const uint *table, vi first, uint count,
#if HAS_PATH
                         vi low, vi high, // between them is the index
#endif
                         vu number)
{
    Drawn drawn;
#if HAS_PATH
    while (vm_any(high - low > (vi)(1))) {
        const vi middle = (low + high) >> 1;
        const vm reached = number >= VU_FROM_VI(vi_gather((global const int *)table, first + middle));
        low = reached ? middle : low;
        high = reached ? high : middle;
    }
#else
    uint step = 1;
    while (step < count)
        step *= 2;
    vi low = (vi)(0);
    for (step /= 2; step > 0; step /= 2) {
        const vi middle = low + (int)step;
        const vm within = middle < (vi)((int)count);
        const vu value =
            VU_FROM_VI(vi_gather((global const int *)table, first + (within ? middle : (vi)(0))));
        const vm reached = within & (number >= value);
        low = reached ? middle : low;
    }
#endif
    const vm last = low + 1 >= (vi)((int)count);
    const vi begin = vi_gather((global const int *)table, first + low);
    const vi end = last ? (vi)(0) : vi_gather((global const int *)table, first + (last ? (vi)(0) : low + 1));
    const vf size = VF_FROM_VU(VU_FROM_VI(end) - VU_FROM_VI(begin)); // 2^32 is 0
    const vf at = VF_FROM_VU(number - VU_FROM_VI(begin)) + 0.5f;
    drawn.index = low;
    drawn.rest = vf_clamp(at / (size > (vf)(0.0f) ? size : (vf)(0x1p32f)), 0.0f, 1.0f - ROUNDING);
    return drawn;
}

#if HAS_PATH
// The same with the guides of that number.
static inline Drawn draw_guided(const Environment *environment, vi first, uint count, vi guides, vu number)
{
    const vi step = guides * (ENVIRONMENT_GUIDES + 1) + VI_FROM_VU(number >> (32 - ENVIRONMENT_GUIDES_LOG2));
    return draw_index(environment->cdf, first, count, vi_gather(environment->guides, step),
                      vi_gather(environment->guides, step + 1) + 1, number);
}
#endif

// Inverts the integral of a density that goes linearly from a at 0 to b at 1.
static inline vf draw_linear(vf u, vf a, vf b)
{
    const vf root = sqrt(fma(b * b - a * a, u, a * a)), below = a + root;
    return vf_clamp(below > (vf)(0.0f) ? u * (a + b) / below : u, 0.0f, 1.0f);
}

// A direction with a density in proportion to the map's strength.
OUTLINE EnvironmentSample environment_sample(const Environment *environment, SampleBits bits)
{
    EnvironmentSample sample;
    global const EnvironmentRecord *record = environment->record;
    const int width = (int)record->width, height = (int)record->height;
#if HAS_PATH
    const Drawn row = draw_guided(environment, (vi)(0), record->height + 1, (vi)(0), bits.y);
    const Drawn column = draw_guided(environment, row.index * width + (height + 1), record->width, row.index + 1,
                                     bits.x);
#else
    const Drawn row = draw_index(environment->cdf, (vi)(0), record->height + 1, bits.y);
    const Drawn column =
        draw_index(environment->cdf, row.index * width + (height + 1), record->width, bits.x);
#endif
    MapPlace place;
    place.column = column.index;
    place.row = row.index;
    const MapCell cell = environment_cell(environment, &place);
    const vf left = cell_strength(environment, &cell, 0), right = cell_strength(environment, &cell, 1);
    const vf left_end = cell_strength(environment, &cell, 2),
             right_end = cell_strength(environment, &cell, 3);
    const vf below = draw_linear(row.rest, left + right, left_end + right_end);
    const vf at_left = fma(left_end - left, below, left), at_right = fma(right_end - right, below, right);
    const vf beside = draw_linear(column.rest, at_left, at_right);
    const vf top = edge_from_top(environment, row.index), bottom = edge_from_bottom(environment, row.index);
    const vf from_top = fma(edge_from_top(environment, row.index + 1) - top, below, top);
    const vf from_bottom = fma(edge_from_bottom(environment, row.index + 1) - bottom, below, bottom);
    const vf sine = 2.0f * sqrt(from_top * from_bottom);
    const vf u = (VF_FROM_VI(column.index) + (beside + 0.5f)) / (real)width - record->turn;
    const SineCosine angle = vf_sincos((u - floor(u)) * TWO_PI);
    const vf v = 2.0f * vf_atan2(sqrt(from_top), sqrt(from_bottom)) / PI;
    const vf fall = vf_clamp(fma(v, (vf)((real)height), (vf)(0.5f)) - VF_FROM_VI(row.index), 0.0f, 1.0f);
    sample.dir = v3_normalize(v3_make(sine * angle.sine, from_bottom - from_top, -(sine * angle.cosine)));
    sample.radiance = cell_radiance(&cell, beside, fall);
    sample.density = record->density * fma(at_right - at_left, beside, at_left);
    return sample;
}
#endif

#if HAS_PREFILTERED
static inline v3 prefiltered_map(const Environment *environment, vi map, vf turn, vf fall)
{
    global const int *maps = (global const int *)environment->record->maps;
    const vi offset = vi_gather(maps, 2 * map), width = vi_gather(maps, 2 * map + 1);
    const vf wide = VF_FROM_VI(width), steps = wide * 0.5f;
    const MapPlace place = map_place(turn, fall * steps, wide, steps + 1.0f);
    const MapCell cell = map_cell(environment->levels, offset, &place, width, (width >> 1) + 1);
    return cell_radiance(&cell, place.right, place.below);
}

// Irradiance over pi of a surface with normal n.
OUTLINE v3 prefiltered_irradiance(const Environment *environment, v3 n)
{
    return prefiltered_map(environment, (vi)(PREFILTER_LOBES), direction_turn(n) + environment->record->turn,
                           direction_fall(n));
}

// Mean radiance about dir for a lobe of this roughness. Below the narrowest map, on the way to the map
// itself.
OUTLINE v3 prefiltered_radiance(const Environment *environment, v3 dir, vf roughness)
{
    const vf turn = direction_turn(dir) + environment->record->turn, fall = direction_fall(dir);
    const vf width = vf_log2(vf_max(roughness * roughness, (vf)(0x1p-12f))); // -12 .. 0
    const vf level = width + (PREFILTER_LOBES - 1.0f),
             whole = vf_clamp(floor(level), 0.0f, PREFILTER_LOBES - 2.0f);
    const vi map = VI_FROM_VF(whole);
    const v3 narrow = prefiltered_map(environment, map, turn, fall);
    const v3 wide = prefiltered_map(environment, map + 1, turn, fall);
    const v3 blurred = v3_lerp(narrow, wide, vf_clamp(level - whole, 0.0f, 1.0f));
    const vf sharp = vf_clamp(level * (1.0f / (PREFILTER_LOBES - 13.0f)), 0.0f, 1.0f);
    if (!vm_any(sharp > (vf)(0.0f)))
        return blurred;
    return v3_lerp(blurred, environment_radiance(environment, dir), sharp);
}

// The row of PREFILTER_TABLE for a cosine to the eye and a roughness.
OUTLINE v3 prefiltered_reflectance(const Environment *environment, vf cosine, vf roughness)
{
    const vf x = vf_clamp(cosine, 0.0f, 1.0f) * (PREFILTER_TABLE - 1.0f);
    const vf y = vf_clamp(roughness, 0.0f, 1.0f) * (PREFILTER_TABLE - 1.0f);
    const vf left = vf_min(floor(x), (vf)(PREFILTER_TABLE - 2.0f)),
             above = vf_min(floor(y), (vf)(PREFILTER_TABLE - 2.0f));
    const vi first =
        (int)environment->record->table + 3 * (VI_FROM_VF(above) * PREFILTER_TABLE + VI_FROM_VF(left));
    MapCell cell;
    for (int k = 0; k < 4; k++)
        cell.corner[k] = v3_gather(environment->levels, first + 3 * ((k & 1) + (k >> 1) * PREFILTER_TABLE));
    return cell_radiance(&cell, x - left, y - above);
}
#endif

#endif
