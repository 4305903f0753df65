// Font: numbers and capital letters as dots, for legends. It knows nothing of what they are for.
#ifndef CLRT_COMPARE_FONT_H
#define CLRT_COMPARE_FONT_H

#include "base/types.h"

enum {
    FONT_DOT = 2, // pixels a side of a glyph's dot
    FONT_WIDTH = 3 * FONT_DOT,
    FONT_HEIGHT = 5 * FONT_DOT,
    FONT_STEP = 4 * FONT_DOT // from glyph to glyph
};

// Whether the pixel x, y of the glyph, below FONT_WIDTH and FONT_HEIGHT and from the top left, is set. A
// character that the font does not have is blank.
bool font_pixel(char character, u32 x, u32 y);

#endif
