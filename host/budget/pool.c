#include "budget/pool.h"

#include <math.h>

enum { PARTS = 4 }; // sums side by side, so that an addition need not wait for the one before

static void add_radiance(BudgetPool *pool, const f32 *rgb, size_t count)
{
    f64 sums[PARTS] = {0};
    u32 nan = 0, infinite = 0, negative = 0; // a row has at most 3 * 65536 values
    for (size_t i = 0; i < count; i++) {
        const f32 value = rgb[i];
        const bool finite = fabsf(value) <= 3.40282347e38f;
        nan += value != value;
        infinite += fabsf(value) > 3.40282347e38f;
        negative += value < 0;
        sums[i % PARTS] += finite ? (f64)value : 0.0;
    }
    pool->nan += nan;
    pool->infinite += infinite;
    pool->negative += negative;
    pool->radiance += (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

static void add_m2(BudgetPool *pool, const f32 *m2, size_t count)
{
    f64 sums[PARTS] = {0}, squares[PARTS] = {0}, most = pool->m2_max;
    for (size_t i = 0; i < count; i++) {
        const f64 value = (f64)m2[i];
        sums[i % PARTS] += value;
        squares[i % PARTS] += value * value;
        most = value > most ? value : most;
    }
    pool->m2 += (sums[0] + sums[1]) + (sums[2] + sums[3]);
    pool->m2_squared += (squares[0] + squares[1]) + (squares[2] + squares[3]);
    pool->m2_max = most;
}

void budget_pool_add_row(BudgetPool *pool, const f32 *rgb, const f32 *m2, u32 width)
{
    add_radiance(pool, rgb, 3 * (size_t)width);
    if (m2)
        add_m2(pool, m2, width);
    pool->pixels += width;
}

void budget_pool_add_clamped(BudgetPool *pool, const f32 *clamped, u32 width)
{
    f64 sum = 0, squares = 0;
    for (size_t i = 0; clamped && i < width; i++) {
        const f32 *lost = clamped + 4 * i;
        for (u32 c = 0; c < 3; c++) {
            sum += (f64)lost[c];
            squares += (f64)lost[c] * (f64)lost[c];
        }
        pool->clamped_samples += (u64)lost[3];
    }
    pool->clamped += sum;
    pool->clamped_squared += squares;
}
