#include "budget/budget.h"

#include <math.h>
#include <string.h>

// A part as people read it.
typedef struct PartText {
    char text[32];
} PartText;

static PartText part(f64 value, const char *unknown)
{
    PartText part;
    if (isnan(value))
        snprintf(part.text, sizeof part.text, "%s", unknown);
    else if (isinf(value))
        snprintf(part.text, sizeof part.text, "unbounded");
    else
        snprintf(part.text, sizeof part.text, "%.3g", value);
    return part;
}

static void print_sampling(const ErrorBudget *budget, const char *indent, FILE *stream)
{
    const SamplingBudget *sampling = &budget->sampling;
    if (sampling->assumption == SAMPLING_NONE) {
        fprintf(stream, "%ssampling      none: %s\n", indent, budget->estimator);
        return;
    }
    fprintf(stream, "%ssampling      rmse <= %.3g, largest <= %.3g, ", indent, sampling->rmse, sampling->largest);
    fprintf(stream, "mean %.6g in [%.6g, %.6g], each at %g %%\n", sampling->mean, sampling->mean_low,
            sampling->mean_high, 100 * budget->confidence);
    fprintf(stream, "%s              standard error %.3g; %s; ", indent, sampling->standard_error,
            budget->estimator);
    if (sampling->assumption == SAMPLING_BOUNDED)
        fprintf(stream, "radiance is bounded by %.3g %.3g %.3g\n", budget->bounds.radiance[0],
                budget->bounds.radiance[1], budget->bounds.radiance[2]);
    else
        fprintf(stream, "errors taken for normal, no bound for %s\n", budget->bounds.unbounded);
}

static void print_clamp(const ClampBudget *clamp, const char *indent, FILE *stream)
{
    fprintf(stream, "%sclamp         %.6g: bias of the mean %.3g (%.3g %%), rmse %.3g, ", indent, clamp->limit,
            -clamp->removed, 100 * clamp->share, clamp->rmse);
    fprintf(stream, "%llu of %llu samples\n", (unsigned long long)clamp->clamped,
            (unsigned long long)clamp->samples);
}

void budget_print(const ErrorBudget *budget, const char *indent, FILE *stream)
{
    print_sampling(budget, indent, stream);
    fprintf(stream, "%smax_depth     <= %s\n", indent, part(budget->bounds.depth, "unknown").text);
    fprintf(stream, "%smin_weight    <= %s\n", indent, part(budget->bounds.min_weight, "unknown").text);
    if (budget->clamp.limit > 0)
        print_clamp(&budget->clamp, indent, stream);
    fprintf(stream, "%sarithmetic    %s\n", indent, part(budget->arithmetic, "not measured").text);
    fprintf(stream, "%squantisation  <= %s of the encoded range\n", indent,
            part(budget->quantisation, "unknown").text);
    fprintf(stream, "%stotal         rmse <= %s, without %squantisation\n", indent,
            part(budget->total, "unknown").text, budget->covers_arithmetic ? "" : "arithmetic and ");
    fprintf(stream, "%svalues        %llu NaN, %llu infinite, %llu negative\n", indent,
            (unsigned long long)budget->nan, (unsigned long long)budget->infinite,
            (unsigned long long)budget->negative);
}

void budget_summary(const ErrorBudget *budget, char *text, size_t size)
{
    const SamplingBudget *sampling = &budget->sampling;
    char samples[256];
    if (sampling->assumption == SAMPLING_NONE)
        snprintf(samples, sizeof samples, "none (%s)", budget->estimator);
    else
        snprintf(samples, sizeof samples, "rmse<=%.3g largest<=%.3g mean=%.6g in [%.6g,%.6g] (%g%%, %s)",
                 sampling->rmse, sampling->largest, sampling->mean, sampling->mean_low, sampling->mean_high,
                 100 * budget->confidence, budget_assumption(budget));
    char clamped[128] = "";
    if (budget->clamp.limit > 0)
        snprintf(clamped, sizeof clamped,
                 " clamp %.9g: bias of the mean %.3g, rmse %.3g, %llu of %llu samples;", budget->clamp.limit,
                 -budget->clamp.removed, budget->clamp.rmse, (unsigned long long)budget->clamp.clamped,
                 (unsigned long long)budget->clamp.samples);
    snprintf(text, size,
             "sampling %s; max_depth<=%s; min_weight<=%s;%s arithmetic %s; quantisation<=%s; nan %llu, "
             "infinite %llu, negative %llu",
             samples, part(budget->bounds.depth, "unknown").text,
             part(budget->bounds.min_weight, "unknown").text, clamped,
             part(budget->arithmetic, "not measured").text, part(budget->quantisation, "unknown").text,
             (unsigned long long)budget->nan, (unsigned long long)budget->infinite,
             (unsigned long long)budget->negative);
}
