// Numbers of an OBJ, eight characters at a time. Every function may read 16 bytes beyond the end of the text,
// which ends in a character that no number has.
#ifndef CLRT_ASSETS_OBJ_NUMBER_H
#define CLRT_ASSETS_OBJ_NUMBER_H

#include <string.h>

#include "base/types.h"

// Reads the decimal number at text, correctly rounded; returns what follows it, or NULL where there is none
// or it is beyond FLT_MAX. LC_NUMERIC of the calling thread must be that of the "C" locale.
const char *obj_number(const char *text, f64 *value);

// 1, 10, ... 10^22, all exact.
extern const f64 obj_powers_f64[23];
// 1, 10, ... 10^8
extern const u32 obj_powers_u32[9];

// The eight characters at p, the first in the lowest byte, '0' becoming 0.
static inline u64 obj_eight(const char *p)
{
    u64 word;
    memcpy(&word, p, sizeof word);
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    return word ^ UINT64_C(0x3030303030303030);
}

// Where the first of the eight that is no digit ends, in bits less 1: 8 * digits + 7. In the sum a byte above
// 9 has its high bit set; a carry out of a byte changes only those behind.
static inline unsigned obj_digits_end(u64 eight)
{
    const u64 others = ((eight + UINT64_C(0x7676767676767676)) | eight) & UINT64_C(0x8080808080808080);
    return others ? (unsigned)__builtin_ctzll(others) : 8 * 8 + 7;
}

// The value of the digits, of which there is at least one: they are moved to the end behind zeros, then
// pairs, fours and all are joined.
static inline u32 obj_digits_value(u64 eight, unsigned digits_end)
{
    u64 x = eight << (8 * 8 + 7 - digits_end);
    x = x * 10 + (x >> 8);
    x = ((x & UINT64_C(0x000000FF000000FF)) * UINT64_C(0x000F424000000064) +
         ((x >> 16) & UINT64_C(0x000000FF000000FF)) * UINT64_C(0x0000271000000001)) >> 32;
    return (u32)x;
}

// obj_number, with the common form inline: up to seven digits, and up to eight behind a point.
static inline const char *obj_number_inline(const char *text, f64 *value)
{
    const bool negative = *text == '-';
    const char *p = text + negative;
    const u64 before = obj_eight(p);
    const unsigned before_end = obj_digits_end(before), whole = before_end / 8;
    if (whole - 1 > 6)
        return obj_number(text, value);
    u64 mantissa = obj_digits_value(before, before_end);
    unsigned places = 0;
    p += whole;
    if (*p == '.') {
        const u64 behind = obj_eight(++p);
        const unsigned behind_end = obj_digits_end(behind);
        places = behind_end / 8;
        if (places > 0)
            mantissa = mantissa * obj_powers_u32[places] + obj_digits_value(behind, behind_end);
        p += places;
    }
    if ((unsigned char)*p > ' ')
        return obj_number(text, value);
    // Below 10^15 and 10^8: both are exact, so that the division rounds once.
    const f64 magnitude = (f64)(i64)mantissa / obj_powers_f64[places];
    *value = negative ? -magnitude : magnitude;
    return p;
}

#endif
