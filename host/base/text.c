#include "base/text.h"

#include <stdlib.h>
#include <string.h>

static bool is_inner_byte(char c)
{
    return ((unsigned char)c & 0xC0) == 0x80;
}

size_t text_count_characters(const char *text, size_t length)
{
    size_t inner = 0;
    for (size_t i = 0; i < length; ++i)
        inner += is_inner_byte(text[i]);
    return length - inner;
}

// Bytes of the well-formed character at text, 0 where there is none.
static size_t character_bytes(const unsigned char *text, size_t left)
{
    const unsigned first = text[0];
    if (first < 0x80)
        return 1;
    const size_t bytes = first >= 0xC2 && first <= 0xDF   ? 2
                         : first >= 0xE0 && first <= 0xEF ? 3
                         : first >= 0xF0 && first <= 0xF4 ? 4
                                                          : 0;
    if (bytes == 0 || left < bytes)
        return 0;
    for (size_t i = 1; i < bytes; ++i) {
        if ((text[i] & 0xC0) != 0x80)
            return 0;
    }
    // The second byte tells overlong forms, surrogates and what lies above 10FFFF.
    const bool refused = (first == 0xE0 && text[1] < 0xA0) || (first == 0xED && text[1] > 0x9F) ||
                         (first == 0xF0 && text[1] < 0x90) || (first == 0xF4 && text[1] > 0x8F);
    return refused ? 0 : bytes;
}

size_t text_find_invalid_utf8(const char *text, size_t length)
{
    size_t i = 0;
    while (i < length) {
        u64 word;
        while (length - i >= sizeof word) {
            memcpy(&word, text + i, sizeof word);
            if (word & UINT64_C(0x8080808080808080))
                break;
            i += sizeof word;
        }
        if (i == length)
            break;
        const size_t bytes = character_bytes((const unsigned char *)text + i, length - i);
        if (bytes == 0)
            return i;
        i += bytes;
    }
    return length;
}

typedef struct Decimal {
    u64 mantissa;
    i32 exponent;
    bool any;  // at least one digit
    bool overlong; // more digits than mantissa holds
} Decimal;

static const char *read_digits(const char *p, const char *end, i32 exponent_step, Decimal *decimal)
{
    for (; p < end && *p >= '0' && *p <= '9'; ++p) {
        decimal->any = true;
        if (decimal->mantissa < UINT64_C(100000000000000000)) {
            decimal->mantissa = decimal->mantissa * 10 + (u64)(*p - '0');
            decimal->exponent += exponent_step;
        } else {
            decimal->overlong = true;
        }
    }
    return p;
}

// Reads "e+12" into decimal; NULL where it is malformed.
static const char *read_exponent(const char *p, const char *end, Decimal *decimal)
{
    ++p;
    bool negative = false;
    if (p < end && (*p == '+' || *p == '-'))
        negative = *p++ == '-';
    if (p == end)
        return NULL;
    i32 exponent = 0;
    for (; p < end && *p >= '0' && *p <= '9'; ++p) {
        if (exponent < 100000)
            exponent = exponent * 10 + (*p - '0');
    }
    decimal->exponent += negative ? -exponent : exponent;
    return p;
}

bool text_parse_decimal(const char *text, size_t length, f64 *value)
{
    const char *p = text, *end = text + length;
    Decimal decimal = {0};
    bool negative = false;
    if (p < end && (*p == '+' || *p == '-'))
        negative = *p++ == '-';
    p = read_digits(p, end, 0, &decimal);
    if (p < end && *p == '.')
        p = read_digits(p + 1, end, -1, &decimal);
    if (!decimal.any)
        return false;
    if (p < end && (*p == 'e' || *p == 'E'))
        p = read_exponent(p, end, &decimal);
    if (p != end)
        return false;

    // Both factors are exact, so that the one rounding is the correct one (Clinger 1990).
    static const f64 powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (!decimal.overlong && decimal.mantissa <= UINT64_C(1) << 53 && decimal.exponent >= -22 &&
        decimal.exponent <= 22) {
        const f64 mantissa = (f64)decimal.mantissa;
        const f64 magnitude =
            decimal.exponent < 0 ? mantissa / powers[-decimal.exponent] : mantissa * powers[decimal.exponent];
        *value = negative ? -magnitude : magnitude;
        return true;
    }
    *value = strtod(text, NULL);
    return true;
}

const char *text_read_whole(const char *text, u32 *number)
{
    if (*text < '0' || *text > '9')
        return NULL;
    u64 value = 0;
    for (; *text >= '0' && *text <= '9'; ++text) {
        value = value * 10 + (u64)(*text - '0');
        if (value > UINT32_MAX)
            return NULL;
    }
    *number = (u32)value;
    return text;
}
