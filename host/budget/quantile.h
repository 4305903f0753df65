// Quantiles of the F distribution, and so of Student's t: t(p two-sided, n)^2 = F(p; 1, n).
#ifndef CLRT_BUDGET_QUANTILE_H
#define CLRT_BUDGET_QUANTILE_H

#include "base/types.h"

// The x that a variable of F(d1, d2) exceeds with probability `upper`, 0 < upper < 1; d1, d2 > 0, any real
// numbers. To a relative 1e-9; INFINITY beyond 1e300.
f64 quantile_f(f64 upper, f64 d1, f64 d2);

#endif
