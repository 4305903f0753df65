// Text: UTF-8 and decimal numbers, independent of what the text says.
#ifndef CLRT_BASE_TEXT_H
#define CLRT_BASE_TEXT_H

#include "base/types.h"

// The number of characters (code points) in length bytes of UTF-8. Bytes that are no UTF-8 count
// one each unless they look like the inside of a character.
size_t text_count_characters(const char *text, size_t length);

// Offset of the first byte that is not part of well-formed UTF-8 (overlong forms, surrogates and
// values above 10FFFF are not); length where there is none.
size_t text_find_invalid_utf8(const char *text, size_t length);

// Reads the length bytes at text as a decimal number, sign point and exponent optional, correctly
// rounded. Returns false where they are anything else. The value may be infinite, or zero where the
// number is too small. text[length] must be readable and no character that could continue a
// number; LC_NUMERIC of the calling thread must be that of the "C" locale.
bool text_parse_decimal(const char *text, size_t length, f64 *value);

// Reads the decimal digits at text, which ends in 0, and returns what follows them; NULL where there are
// none, or beyond 2^32 - 1.
const char *text_read_whole(const char *text, u32 *number);

#endif
