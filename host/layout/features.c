#include "layout/features.h"

#include <stdio.h>

const char *feature_name(Feature feature)
{
    static const char *const names[] = {
#define FEATURE(name, meaning) #name,
#include "shared/features.def"
#undef FEATURE
    };
    return names[feature];
}

const char *feature_meaning(Feature feature)
{
    static const char *const meanings[] = {
#define FEATURE(name, meaning) meaning,
#include "shared/features.def"
#undef FEATURE
    };
    return meanings[feature];
}

size_t features_options(FeatureSet set, char *text, size_t size)
{
    size_t length = 0;
    for (Feature f = 0; f < FEATURE_COUNT; f++) {
        const int written = snprintf(length < size ? text + length : NULL, length < size ? size - length : 0,
                                     " -DHAS_%s=%d", feature_name(f), features_have(set, f) ? 1 : 0);
        length += (size_t)written;
    }
    return length;
}
