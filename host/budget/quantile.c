#include "budget/quantile.h"

#include <math.h>

// The continued fraction of the incomplete beta function by Lentz's method (Press et al., Numerical Recipes,
// 6.4), for x below (a + 1) / (a + b + 2), where it converges in O(sqrt(max(a, b))) steps.
static f64 beta_fraction(f64 x, f64 a, f64 b)
{
    const f64 tiny = 1e-300;
    f64 c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (fabs(d) < tiny ? tiny : d);
    f64 product = d;
    for (u32 m = 1; m < 100000; m++) {
        const f64 even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const f64 odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 + even * d;
        c = 1 + even / c;
        d = 1 / (fabs(d) < tiny ? tiny : d);
        c = fabs(c) < tiny ? tiny : c;
        product *= d * c;
        d = 1 + odd * d;
        c = 1 + odd / c;
        d = 1 / (fabs(d) < tiny ? tiny : d);
        c = fabs(c) < tiny ? tiny : c;
        product *= d * c;
        if (fabs(d * c - 1) < 1e-15)
            break;
    }
    return product;
}

// The regularised incomplete beta function I_x(a, b); y = 1 - x, given so that neither loses digits.
static f64 beta_regularised(f64 x, f64 y, f64 a, f64 b)
{
    if (x <= 0 || y <= 0)
        return x <= 0 ? 0 : 1;
    const f64 front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log(y));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(x, a, b) / a;
    return 1 - front * beta_fraction(y, b, a) / b;
}

// Probability that a variable of F(d1, d2) exceeds x: I of d2 / (d2 + d1 x) at (d2 / 2, d1 / 2).
static f64 f_above(f64 x, f64 d1, f64 d2)
{
    const f64 whole = d2 + d1 * x;
    return beta_regularised(d2 / whole, d1 * x / whole, d2 / 2, d1 / 2);
}

f64 quantile_f(f64 upper, f64 d1, f64 d2)
{
    f64 low = -700, high = 690; // of log x
    if (f_above(exp(high), d1, d2) > upper)
        return INFINITY;
    while (high - low > 1e-10) {
        const f64 middle = low + (high - low) / 2;
        if (f_above(exp(middle), d1, d2) > upper)
            low = middle;
        else
            high = middle;
    }
    return exp(high);
}
