// The synthetic pictures that FLIP, SSIM and relMSE are checked on: whole levels of 8 bits, RGB.
// After cmocka.h.
#ifndef SYNTHETIC_H
#define SYNTHETIC_H

#include "image/image.h"

enum { SYNTHETIC_WIDTH = 75, SYNTHETIC_HEIGHT = 130, SYNTHETIC_COUNT = SYNTHETIC_WIDTH * SYNTHETIC_HEIGHT };

typedef enum Synthetic {
    SYNTHETIC_BLACK,
    SYNTHETIC_WHITE,
    SYNTHETIC_GREEN,
    SYNTHETIC_BLUE,
    SYNTHETIC_RAMP,    // smooth in all channels
    SYNTHETIC_FIREFLY, // the ramp with one white pixel
    SYNTHETIC_SHIFTED, // the ramp two levels brighter
    SYNTHETIC_NOISE,
    SYNTHETIC_OTHER_NOISE,
    SYNTHETIC_CHECKER,       // squares of five pixels, orange and blue
    SYNTHETIC_MOVED_CHECKER, // the same moved by one pixel
} Synthetic;

static inline u32 synthetic_noise(u32 x, u32 y, u32 channel, u32 seed)
{
    u32 h = (x * 0x9E3779B1u) ^ (y * 0x85EBCA77u) ^ (channel * 0xC2B2AE3Du) ^ seed;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return (h ^ h >> 15) >> 24;
}

static inline u32 synthetic_level(Synthetic kind, u32 x, u32 y, u32 channel)
{
    static const u32 SQUARES[2][3] = {{240, 150, 30}, {20, 60, 200}};
    const u32 ramp = channel == 0 ? x * 3 : channel == 1 ? y : 200 - x - y / 2;
    switch (kind) {
    case SYNTHETIC_BLACK:
        return 0;
    case SYNTHETIC_WHITE:
        return 255;
    case SYNTHETIC_GREEN:
        return channel == 1 ? 255 : 0;
    case SYNTHETIC_BLUE:
        return channel == 2 ? 255 : 0;
    case SYNTHETIC_RAMP:
        return ramp;
    case SYNTHETIC_FIREFLY:
        return x == 40 && y == 50 ? 255 : ramp;
    case SYNTHETIC_SHIFTED:
        return ramp + 2;
    case SYNTHETIC_NOISE:
        return synthetic_noise(x, y, channel, 1);
    case SYNTHETIC_OTHER_NOISE:
        return synthetic_noise(x, y, channel, 2);
    case SYNTHETIC_CHECKER:
        return SQUARES[(x / 5 + y / 5) % 2][channel];
    case SYNTHETIC_MOVED_CHECKER:
        return SQUARES[((x + 1) / 5 + y / 5) % 2][channel];
    }
    return 0;
}

static inline Image *synthetic_image(Synthetic kind)
{
    Error error;
    Image *image = image_create(SYNTHETIC_WIDTH, SYNTHETIC_HEIGHT, 3, &error);
    assert_non_null(image);
    for (u32 y = 0; y < SYNTHETIC_HEIGHT; y++) {
        for (u32 i = 0; i < SYNTHETIC_WIDTH * 3; i++)
            image_row(image, y)[i] = (f32)synthetic_level(kind, i / 3, y, i % 3);
    }
    return image;
}

#endif
