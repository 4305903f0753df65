#include "assets/obj_number.h"

#include <float.h>
#include <math.h>

#include "base/text.h"

const f64 obj_powers_f64[23] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };

const u32 obj_powers_u32[9] = { 1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000 };

enum { EXPONENT_LIMIT = 100000, DIVIDED_PLACES_MAX = 27 };

typedef struct Decimal {
    u64 mantissa; // below 10^19
    i32 exponent;
    bool any;      // at least one digit
    bool overlong; // more digits than the mantissa holds
} Decimal;

// Reads digits into the mantissa, with an exponent that goes by step for each.
static const char *read_digits(const char *p, i32 step, Decimal *decimal)
{
    // A mantissa below limits[n] has room for n digits more.
    static const u64 limits[9] = { UINT64_C(10000000000000000000), UINT64_C(1000000000000000000),
                                   UINT64_C(100000000000000000),   UINT64_C(10000000000000000),
                                   UINT64_C(1000000000000000),     UINT64_C(100000000000000),
                                   UINT64_C(10000000000000),       UINT64_C(1000000000000),
                                   UINT64_C(100000000000) };
    unsigned count = 8;
    while (count == 8) {
        const u64 eight = obj_eight(p);
        const unsigned digits_end = obj_digits_end(eight);
        count = digits_end / 8;
        if (count == 0)
            break;
        if (decimal->mantissa < limits[count]) {
            decimal->mantissa *= obj_powers_u32[count];
            decimal->mantissa += obj_digits_value(eight, digits_end);
            decimal->exponent += step * (i32)count;
        } else {
            decimal->overlong = true;
        }
        decimal->any = true;
        p += count;
    }
    return p;
}

// Reads "e+12"; NULL where it is malformed.
static const char *read_exponent(const char *p, Decimal *decimal)
{
    ++p;
    const bool negative = *p == '-';
    p += negative || *p == '+';
    if (*p < '0' || *p > '9')
        return NULL;
    i32 exponent = 0;
    for (; *p >= '0' && *p <= '9'; ++p) {
        if (exponent < EXPONENT_LIMIT)
            exponent = exponent * 10 + (*p - '0');
    }
    decimal->exponent += negative ? -exponent : exponent;
    return p;
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 u128;

// mantissa / 10^places, rounded once: the quotient by 5^places has 63 bits or more, the last one says whether
// anything follows, and the conversion to double rounds it. mantissa is not 0.
static f64 divide_exactly(u64 mantissa, unsigned places)
{
    u64 divisor = 1;
    for (unsigned i = 0; i < places; ++i)
        divisor *= 5; // 5^27 < 2^63
    const int mantissa_shift = __builtin_clzll(mantissa), divisor_shift = __builtin_clzll(divisor);
    const u128 numerator = (u128)(mantissa << mantissa_shift) << 63;
    divisor <<= divisor_shift;
    u64 quotient = (u64)(numerator / divisor);
    quotient |= (u64)numerator - quotient * divisor != 0;
    return ldexp((f64)quotient, divisor_shift - mantissa_shift - 63 - (int)places);
}
#endif

const char *obj_number(const char *text, f64 *value)
{
    const bool negative = *text == '-';
    const char *p = text + (negative || *text == '+');
    Decimal decimal = { 0 };
    p = read_digits(p, 0, &decimal);
    if (*p == '.')
        p = read_digits(p + 1, -1, &decimal);
    if (!decimal.any)
        return NULL;
    if (*p == 'e' || *p == 'E') {
        p = read_exponent(p, &decimal);
        if (!p)
            return NULL;
    }
    const u64 mantissa = decimal.mantissa;
    const i32 exponent = decimal.exponent;
    f64 magnitude;
    if (mantissa == 0 && !decimal.overlong) {
        magnitude = 0;
    } else if (!decimal.overlong && mantissa <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22) {
        // Both factors are exact (Clinger 1990).
        const f64 whole = (f64)(i64)mantissa;
        magnitude = exponent < 0 ? whole / obj_powers_f64[-exponent] : whole * obj_powers_f64[exponent];
#ifdef __SIZEOF_INT128__
    } else if (!decimal.overlong && exponent < 0 && exponent >= -DIVIDED_PLACES_MAX) {
        magnitude = divide_exactly(mantissa, (unsigned)-exponent);
#endif
    } else {
        if (!text_parse_decimal(text, (size_t)(p - text), value))
            return NULL;
        return fabs(*value) <= (f64)FLT_MAX ? p : NULL;
    }
    *value = negative ? -magnitude : magnitude;
    return magnitude <= (f64)FLT_MAX ? p : NULL;
}
