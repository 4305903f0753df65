// Feature costs: what each feature of the scene language costs when it is added alone, and when it is
// declared only.
#ifndef CLRT_REPORT_FEATURE_COSTS_H
#define CLRT_REPORT_FEATURE_COSTS_H

#include "measure.h"

// Appends to the array `features` an object each: "feature", "what", "used" and "unused" (null where it
// cannot be declared without use), of: ns_per_ray, added_ns_per_ray (to the base of the same round) as median
// and mad, rays, features, kernel_hash; unused also has within_noise, same_features and same_kernels. Fails
// as clrt does.
bool feature_costs_measure(Campaign *campaign, json_t *features, Error *error);

#endif
