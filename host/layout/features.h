// FeatureSet: what a scene really uses, from its layout. It decides what the device program contains.
#ifndef CLRT_LAYOUT_FEATURES_H
#define CLRT_LAYOUT_FEATURES_H

#include "base/types.h"

typedef enum Feature {
#define FEATURE(name, meaning) FEATURE_##name,
#include "shared/features.def"
#undef FEATURE
    FEATURE_COUNT
} Feature;

// Bit f is set where the scene has feature f.
typedef u64 FeatureSet;

static inline FeatureSet feature_bit(Feature feature)
{
    return (FeatureSet)1 << feature;
}

// What a render is asked for besides its scene: no layout has them.
#define FEATURES_OF_RENDERS feature_bit(FEATURE_CLAMP)

static inline bool features_have(FeatureSet set, Feature feature)
{
    return (set & feature_bit(feature)) != 0;
}

// "SPHERE", and what it means in a few words.
const char *feature_name(Feature feature);
const char *feature_meaning(Feature feature);

// Compiler options " -DHAS_X=0 -DHAS_Y=1 ..." for all features, into text of size bytes; returns the length
// that a large enough text would have.
size_t features_options(FeatureSet set, char *text, size_t size);

#endif
