#include "layout/filter.h"

#include <math.h>

enum { FILTER_CELLS = 1 << 15 }; // of the integration; Simpson's rule in each

static f64 filter_radius(Filter filter)
{
    switch (filter) {
    case FILTER_TENT: return 1;
    case FILTER_GAUSSIAN: return 1.5;
    case FILTER_MITCHELL: return 2;
    default: return 0.5;
    }
}

f64 filter_value(Filter filter, f64 x)
{
    const f64 d = fabs(x);
    if (d > filter_radius(filter))
        return 0;
    switch (filter) {
    case FILTER_TENT: return 1 - d;
    case FILTER_GAUSSIAN: return exp(-2 * d * d) - exp(-2 * 1.5 * 1.5);
    case FILTER_MITCHELL:
        // 7/6 d^3 - 2 d^2 + 8/9 near the centre; -7/18 (d - 2)^2 (d - 8/7) further out.
        return d < 1 ? (7.0 / 6 * d - 2) * d * d + 8.0 / 9 : -7.0 / 18 * (d - 2) * (d - 2) * (d - 8.0 / 7);
    default: return 1;
    }
}

static f64 cell_integral(Filter filter, f64 begin, f64 end, bool absolute)
{
    const f64 middle = (begin + end) / 2;
    const f64 a = filter_value(filter, begin), b = filter_value(filter, middle), c = filter_value(filter, end);
    return (end - begin) / 6 * (absolute ? fabs(a) + 4 * fabs(b) + fabs(c) : a + 4 * b + c);
}

static f64 half_integral(Filter filter, bool absolute)
{
    const f64 step = filter_radius(filter) / FILTER_CELLS;
    f64 sum = 0;
    for (u32 i = 0; i < FILTER_CELLS; i++)
        sum += cell_integral(filter, i * step, (i + 1) * step, absolute);
    return sum;
}

void filter_quantiles(Filter filter, f32 quantiles[FILTER_STEPS + 1])
{
    const f64 step = filter_radius(filter) / FILTER_CELLS, total = half_integral(filter, true);
    f64 sum = 0;
    u32 k = 0;
    for (u32 i = 0; i < FILTER_CELLS; i++) {
        const f64 part = cell_integral(filter, i * step, (i + 1) * step, true);
        for (; k < FILTER_STEPS && k * total <= (sum + part) * FILTER_STEPS; k++)
            quantiles[k] = (f32)((i + (k * total / FILTER_STEPS - sum) / part) * step);
        sum += part;
    }
    for (; k <= FILTER_STEPS; k++)
        quantiles[k] = (f32)filter_radius(filter);
}

f64 filter_ratio(Filter filter)
{
    const f64 axis = half_integral(filter, true) / half_integral(filter, false);
    return axis * axis;
}
