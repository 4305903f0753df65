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
    f64 sum = budget->bounds.depth + budget->bounds.min_weight;
    if (!exact)
        sum += budget->sampling.rmse;
    if (budget->covers_arithmetic)
        sum += budget->arithmetic;
    budget->total = budget->nan + budget->infinite > 0 ? NAN : sum;
}

ErrorBudget budget_make(const Scene *scene, const SceneBounds *bounds, const BudgetPool *pool, u32 bits,
                        f64 arithmetic)
{
    ErrorBudget budget = {
        .confidence = BUDGET_CONFIDENCE,
        .estimator = estimator_of(scene),
        .bounds = *bounds,
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
