// The HDR reader under a fuzzer: any bytes give a picture of finite values that are not below 0, or an error.
// Built with -fsanitize=fuzzer it is a libFuzzer target; without (no CLRT_FUZZ) it is a program that runs the
// files it is given.
#include <float.h>
#include <stdlib.h>

#include "image/bitmap_formats.h"

int LLVMFuzzerTestOneInput(const u8 *data, size_t size);

// Larger pictures take memory and time, and no other ways.
enum { TEXELS_MAX = 1 << 20 };

static bool is_small(const u8 *data, size_t size)
{
    HdrHeader header;
    Error error;
    return !hdr_read_header(data, size, &header, &error) ||
           (u64)header.width * header.height <= TEXELS_MAX;
}

int LLVMFuzzerTestOneInput(const u8 *data, size_t size)
{
    Bitmap bitmap = {0};
    Error error = {0};
    if (!is_small(data, size))
        return 0;
    if (bitmap_decode_hdr(data, size, &bitmap, &error)) {
        if (bitmap.channels != 3 || bitmap.type != BITMAP_FLOAT || bitmap_repair(&bitmap) != 0)
            abort();
    } else if (error.code == ERROR_NONE || !error.text[0]) {
        abort();
    }
    bitmap_destroy(&bitmap);
    return 0;
}

#include "fuzz_main.h"
