#include "selftest/agreed.h"

#include <float.h>
#include <math.h>
#include <string.h>

const u64 AGREED_HASHES[AGREED_FUNCTIONS] = {
    0xac5a70a86a6d8fe6, 0xc0c2cec040300fd3, 0x816e730551a8fbea, 0x0fec86e1287d0b74, 0xdb4e49464f68157c,
    0x0569891f19897bf4, 0xd0d6512a43ef94ff, 0xaf23c84feb78e457, 0xc6fc2b9f9e3d0b35,
};

static f32 from_bits(u32 bits)
{
    f32 x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

// After Wellons, "Prospecting for Hash Functions", 2018 (lowbias32).
static u32 mix(u32 x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

void agreed_fill(f32 *x, f32 *y)
{
    for (u32 i = 0; i < AGREED_INPUTS; i++) {
        const u32 any = i * 4093u, other = mix(i);
        const f32 a = from_bits(i & 1u ? any : (any & 0x87ffffffu) | 0x38000000u);
        const f32 b = from_bits(i & 2u ? other : (other & 0x87ffffffu) | 0x38000000u);
        x[i] = fabsf(a) < FLT_MIN ? 0 : a;
        y[i] = fabsf(b) < FLT_MIN ? 0 : fabsf(b);
    }
}

// FNV-1a over the bytes, the lowest of each number first.
u64 agreed_hash(const f32 *results)
{
    u64 hash = 0xcbf29ce484222325u;
    for (u32 i = 0; i < AGREED_INPUTS; i++) {
        u32 bits;
        memcpy(&bits, &results[i], sizeof bits);
        if (isnan(results[i]))
            bits = 0x7fc00000u;
        for (u32 byte = 0; byte < 4; byte++)
            hash = (hash ^ (bits >> 8 * byte & 0xffu)) * 0x100000001b3u;
    }
    return hash;
}
