#include "budget/budget.h"

#include <math.h>

// True where one sample a pixel still lies at a random place, or sees a random part of something.
static bool is_random(const Scene *scene)
{
    bool random = scene->camera.aperture > 0 || scene->render.ambient_occlusion_samples > 0 ||
                  scene->environment.present || scene->render.integrator == INTEGRATOR_PATH;
    for (u32 i = 0; i < scene->light_count; i++)
        random |= scene->lights[i].kind == LIGHT_SPHERE || scene->lights[i].kind == LIGHT_RECTANGLE;
    return random;
}

static const char *estimator_of(const Scene *scene)
{
    if (scene->image.samples == 1)
        return is_random(scene) ? "pixel centres, one random sample" : "pixel centres";
    switch (scene->image.filter) {
    case FILTER_BOX:
        return "mean of samples, box filter";
    case FILTER_TENT:
        return "mean of samples, tent filter";
    case FILTER_GAUSSIAN:
        return "mean of samples, gaussian filter";
    case FILTER_MITCHELL:
        return "mean of samples, mitchell filter";
    }
    return "mean of samples";
}

// Parts add up at worst. Sampling is not among them where pixel centres are all that was asked for; where it
// is but nothing is known of it, so is nothing of the total.
static void add_up(ErrorBudget *budget, const Scene *scene)
{
    budget->covers_sampling = budget->sampling.assumption != SAMPLING_NONE;
    budget->covers_arithmetic = !isnan(budget->arithmetic);
    const bool exact = scene->image.samples == 1 && !is_random(scene);
    f64 sum = budget->bounds.depth + budget->bounds.min_weight + budget->clamp.rmse;
    if (!exact)
        sum += budget->sampling.rmse;
    if (budget->covers_arithmetic)
        sum += budget->arithmetic;
    budget->total = budget->nan + budget->infinite > 0 ? NAN : sum;
}

// A limit bounds samples of any scene; not what a filter with negative lobes makes of them.
static SceneBounds bounds_within(const Scene *scene, const SceneBounds *bounds, f64 limit)
{
    SceneBounds within = *bounds;
    if (limit == 0 || (scene->image.samples > 1 && scene->image.filter == FILTER_MITCHELL))
        return within;
    for (u32 c = 0; c < 3; c++)
        within.radiance[c] = fmin(within.radiance[c], limit);
    within.unbounded = NULL;
    return within;
}

static ClampBudget clamp_budget(const BudgetPool *pool, u32 samples, f64 limit)
{
    if (limit == 0 || pool->pixels == 0)
        return (ClampBudget){.limit = limit};
    const f64 values = 3 * (f64)pool->pixels, removed = pool->clamped / samples / values;
    const f64 whole = pool->radiance / values + removed;
    return (ClampBudget){
        .limit = limit,
        .removed = removed,
        .share = whole > 0 ? removed / whole : 0,
        .rmse = sqrt(pool->clamped_squared / values) / samples,
        .clamped = pool->clamped_samples,
        .samples = pool->pixels * samples,
    };
}

ErrorBudget budget_make(const Scene *scene, const SceneBounds *bounds, const BudgetPool *pool, f32 clamp,
                        u32 bits, f64 arithmetic)
{
    ErrorBudget budget = {
        .confidence = BUDGET_CONFIDENCE,
        .estimator = estimator_of(scene),
        .bounds = bounds_within(scene, bounds, (f64)clamp),
        .clamp = clamp_budget(pool, scene->image.samples, (f64)clamp),
        .arithmetic = arithmetic,
        .quantisation = bits ? 0.5 / (exp2(bits) - 1) : 0,
        .nan = pool->nan,
        .infinite = pool->infinite,
        .negative = pool->negative,
    };
    budget.sampling = sampling_budget(pool, scene->image.samples, budget.bounds.radiance, budget.confidence);
    add_up(&budget, scene);
    return budget;
}

const char *budget_assumption(const ErrorBudget *budget)
{
    switch (budget->sampling.assumption) {
    case SAMPLING_BOUNDED:
        return "bounded";
    case SAMPLING_NORMAL:
        return "normal";
    case SAMPLING_NONE:
        break;
    }
    return NULL;
}
