// What the tests of bitmaps share: bytes that grow, and decoding them.
#ifndef CLRT_TESTS_IMAGE_BITMAP_FIXTURE_H
#define CLRT_TESTS_IMAGE_BITMAP_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "image/bitmap.h"

enum { BYTES_MAX = 1 << 20 };

typedef struct Bytes {
    u8 *data;
    size_t size;
} Bytes;

static inline Bytes bytes_begin(void)
{
    const Bytes bytes = {malloc(BYTES_MAX), 0};
    assert_non_null(bytes.data);
    return bytes;
}

static inline void bytes_end(Bytes *bytes)
{
    free(bytes->data);
    *bytes = (Bytes){NULL, 0};
}

static inline void bytes_add(Bytes *bytes, const void *data, size_t size)
{
    assert_true(size <= BYTES_MAX - bytes->size);
    if (size > 0)
        memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
}

static inline void bytes_add_text(Bytes *bytes, const char *text)
{
    bytes_add(bytes, text, strlen(text));
}

// A copy of just the size bytes, so that a sanitizer sees a step beyond them.
static inline bool decode(const void *data, size_t size, Bitmap *bitmap, Error *error)
{
    u8 *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, data, size);
    const bool done = bitmap_decode(copy, size, bitmap, error);
    free(copy);
    if (!done)
        assert_null(bitmap->texels);
    return done;
}

static inline Bitmap expect_bitmap(const Bytes *bytes, u32 width, u32 height, u32 channels, BitmapType type)
{
    Bitmap bitmap;
    Error error;
    if (!decode(bytes->data, bytes->size, &bitmap, &error))
        fail_msg("%s", error.text);
    assert_int_equal(bitmap.width, width);
    assert_int_equal(bitmap.height, height);
    assert_int_equal(bitmap.channels, channels);
    assert_int_equal(bitmap.type, type);
    return bitmap;
}

static inline void expect_refusal(const void *data, size_t size, const char *text)
{
    Bitmap bitmap;
    Error error;
    if (decode(data, size, &bitmap, &error))
        fail_msg("not refused: %s", text);
    if (!strstr(error.text, text))
        fail_msg("\"%s\" says nothing of \"%s\"", error.text, text);
}

// Cut short anywhere, it must be refused; with a bit changed anywhere it must only return.
static inline void expect_sturdy(const Bytes *bytes, size_t step)
{
    Bitmap bitmap;
    Error error;
    for (size_t size = 0; size < bytes->size; size += step) {
        if (decode(bytes->data, size, &bitmap, &error))
            fail_msg("%zu of %zu bytes give a picture", size, bytes->size);
    }
    for (size_t i = 0; i < bytes->size; i += step) {
        const u8 bit = (u8)(1u << i % 8);
        bytes->data[i] ^= bit;
        if (decode(bytes->data, bytes->size, &bitmap, &error))
            bitmap_destroy(&bitmap);
        bytes->data[i] ^= bit;
    }
}

#endif
