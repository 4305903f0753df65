#include "series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "doc.h"

enum { RATIOS_MAX = 1000 };

static const f64 TARGET_RMSE = 0.01;

bool series_create(Series *series, u32 samples, u32 capacity, Arena *arena)
{
    *series = (Series){.samples = samples, .capacity = capacity};
    bool ok = true;
    for (u32 i = 0; i < ROW_STAGE_COUNT; i++)
        ok = (series->stages[i] = arena_alloc(arena, capacity, sizeof(f64))) && ok;
    series->mse = arena_alloc(arena, capacity, sizeof(f64));
    series->level = arena_alloc(arena, capacity, sizeof(f64));
    return ok && series->mse && series->level;
}

void series_add(Series *series, const json_t *stats, f64 wall)
{
    if (series->count == 0)
        series->rays = row_rays(stats);
    for (u32 i = 0; i < ROW_STAGE_COUNT; i++)
        series->stages[i][series->count] = row_stage_seconds(stats, wall, ROW_STAGES[i].key);
    series->count++;
}

json_t *series_times(const Series *series)
{
    json_t *times = json_object();
    for (u32 i = 0; i < ROW_STAGE_COUNT; i++) {
        const bool told = series->count > 0 && !isnan(series->stages[i][0]);
        json_object_set_new(times, ROW_STAGES[i].key,
                            doc_spread(series->stages[i], told ? series->count : 0));
    }
    return times;
}

static u32 stage_index(const char *key)
{
    u32 i = 0;
    while (strcmp(ROW_STAGES[i].key, key) != 0)
        i++;
    return i;
}

json_t *series_ratio(const Series *series, const Series *base)
{
    f64 ratios[RATIOS_MAX];
    const u32 stage = stage_index("kernel_s");
    size_t count = 0;
    for (; count < series->count && count < base->count && count < RATIOS_MAX; count++)
        ratios[count] = series->stages[stage][count] / base->stages[stage][count];
    return doc_spread(ratios, count);
}

// ---- a point --------------------------------------------------------------------------------

// What is wrong with the reference for an error of this size; false where nothing is.
static bool refuse(const Reference *reference, f64 rmse, char *reason, size_t bytes)
{
    if (!reference->mean)
        snprintf(reason, bytes, "%s", reference->reason);
    else if (!(reference->standard_error <= REFERENCE_SHARE * rmse))
        snprintf(reason, bytes,
                 "the reference's standard error, %.3g, is more than a quarter of this error, %.3g",
                 reference->standard_error, rmse);
    else
        return false;
    return true;
}

static f64 root(f64 square)
{
    return isnan(square) ? square : sqrt(fmax(square, 0));
}

static void set_errors(json_t *point, const Series *series, const Reference *reference)
{
    const Estimate mse = statistics_batches(series->mse, series->count);
    doc_set_estimate(point, "mse", mse);
    // fmax takes the number of the two where one is NaN.
    doc_set(point, "mse_low", doc_real(isnan(mse.low) ? mse.low : fmax(mse.low, 0)));
    doc_set_estimate(point, "rmse", (Estimate){root(mse.value), root(mse.low), root(mse.high)});
    doc_set(point, "relmse", doc_real(series->first.relmse));
    doc_set(point, "psnr_db", doc_real(-10 * log10(mse.value)));
    doc_set(point, "flip_mean", doc_real(series->first.flip_mean));
    doc_set(point, "ssim_mean", doc_real(series->first.ssim_mean));
    doc_set_estimate(point, "bias",
                     statistics_difference(statistics_mean(series->level, series->count), reference->level));
}

json_t *series_point(const Series *series, const Reference *reference)
{
    static const char *const NULLS[] = {"mse",       "mse_low",      "mse_high",       "rmse",
                                        "rmse_low",  "rmse_high",    "relmse",         "psnr_db",
                                        "flip_mean", "ssim_mean",    "bias",           "bias_low",
                                        "bias_high", "per_mse_wall", "per_mse_kernel", "reason"};
    json_t *times = series_times(series);
    json_t *point = json_pack("{s:i, s:i, s:O, s:O, s:f}", "spp", (int)series->samples, "runs",
                              (int)series->count, "wall_s", json_object_get(times, "wall_s"), "kernel_s",
                              json_object_get(times, "kernel_s"), "rays", series->rays);
    json_decref(times);
    for (size_t i = 0; i < sizeof NULLS / sizeof NULLS[0]; i++)
        doc_set(point, NULLS[i], NULL);
    char reason[320];
    const f64 mse = reference->mean ? statistics_mean(series->mse, series->count).value : 0;
    if (refuse(reference, sqrt(mse), reason, sizeof reason)) {
        doc_set(point, "reason", doc_string(reason));
        return point;
    }
    set_errors(point, series, reference);
    doc_set(point, "per_mse_wall", doc_real(1 / (mse * doc_number(point, "wall_s.median"))));
    doc_set(point, "per_mse_kernel", doc_real(1 / (mse * doc_number(point, "kernel_s.median"))));
    return point;
}

void series_set_rinf(json_t *row, const json_t *point, json_t *reference)
{
    json_t *rinf = doc_at(row, "error.rinf");
    json_object_update_existing(rinf, (json_t *)(uintptr_t)point);
    json_object_set(rinf, "reference", reference);
}

// ---- efficiency -----------------------------------------------------------------------------

// log RMSE against the log of the seconds of a stage, over all runs. False where there is no line.
static bool fit(const json_t *convergence, const Series *series, u32 count, const char *key, Arena *arena,
                Line *line, f64 *slowest)
{
    size_t runs = 0;
    for (u32 k = 0; k < count; k++)
        runs += series[k].count;
    f64 *seconds = arena_alloc(arena, runs, sizeof *seconds),
        *errors = arena_alloc(arena, runs, sizeof *errors);
    if (!seconds || !errors)
        return false;
    const u32 stage = stage_index(key);
    runs = 0;
    *slowest = 0;
    for (u32 k = 0; k < count; k++) {
        if (!(doc_number(json_array_get(convergence, k), "rmse") > 0))
            continue;
        for (u32 i = 0; i < series[k].count; i++) {
            seconds[runs] = series[k].stages[stage][i];
            errors[runs] = sqrt(series[k].mse[i]);
            *slowest = fmax(*slowest, seconds[runs]);
            runs += seconds[runs] > 0 && errors[runs] > 0;
        }
    }
    return statistics_log_line(seconds, errors, runs, line);
}

void series_set_efficiency(json_t *row, const json_t *point, const Series *series, u32 count, Arena *arena)
{
    json_t *efficiency = json_object_get(row, "efficiency");
    const json_t *convergence = json_object_get(row, "convergence");
    Line line;
    f64 slowest;
    json_object_set(efficiency, "per_mse_wall", json_object_get(point, "per_mse_wall"));
    json_object_set(efficiency, "per_mse_kernel", json_object_get(point, "per_mse_kernel"));
    if (fit(convergence, series, count, "kernel_s", arena, &line, &slowest))
        doc_set_estimate(efficiency, "slope_kernel", line.slope);
    if (!fit(convergence, series, count, "wall_s", arena, &line, &slowest))
        return;
    doc_set_estimate(efficiency, "slope_wall", line.slope);
    const f64 seconds = exp((log(TARGET_RMSE) - line.intercept) / line.slope.value);
    if (!(line.slope.value < 0) || !isfinite(seconds))
        return;
    doc_set(efficiency, "seconds_to_rmse_0_01", doc_real(seconds));
    doc_set(efficiency, "seconds_extrapolated", json_boolean(seconds > slowest));
}
