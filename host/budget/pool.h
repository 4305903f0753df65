// BudgetPool: what the error budget keeps of an image while its rows go by, a few sums. Knows no scene.
#ifndef CLRT_BUDGET_POOL_H
#define CLRT_BUDGET_POOL_H

#include "base/types.h"

typedef struct BudgetPool {
    u64 pixels;
    u64 nan, infinite, negative; // values, three a pixel
    f64 radiance;                // sum of the finite values
    f64 m2, m2_squared, m2_max;  // of RenderRows.m2: sum, sum of squares, greatest; 0 without samples
    f64 clamped, clamped_squared; // of RenderRows.clamped, three numbers a pixel: sum, sum of squares
    u64 clamped_samples;         // those that lost anything
} BudgetPool;

// Adds a row of `width` pixels, 3 linear numbers each, and their m2 (RenderRows.m2), or NULL. Rows in the
// same order give the same bits however many come at once. A pool of zeros is empty.
void budget_pool_add_row(BudgetPool *pool, const f32 *rgb, const f32 *m2, u32 width);

// What the samples of that row lost to a limit: RenderRows.clamped, which is NULL where there is none.
void budget_pool_add_clamped(BudgetPool *pool, const f32 *clamped, u32 width);

#endif
