#include "render/aov.h"

#include <string.h>

static const char *const NAMES[AOV_COUNT] = {
    [AOV_DEPTH] = "depth",   [AOV_NORMAL] = "normal", [AOV_POSITION] = "position",
    [AOV_ALBEDO] = "albedo", [AOV_ID] = "id",
};

const char *aov_name(u32 aov)
{
    return NAMES[aov];
}

u32 aov_find(const char *text, size_t length)
{
    for (u32 aov = AOV_NONE + 1; aov < AOV_COUNT; aov++)
        if (strlen(NAMES[aov]) == length && memcmp(NAMES[aov], text, length) == 0)
            return aov;
    return AOV_NONE;
}

// Features that find no hits and tell nothing of them.
static const Feature LIGHTING[] = {
    FEATURE_LIGHTS,  FEATURE_POINT,   FEATURE_DIRECTIONAL, FEATURE_SPOT,    FEATURE_SHADOWS, FEATURE_TRANSMITTANCE,
    FEATURE_SPECULAR, FEATURE_PHONG,  FEATURE_BLINN,       FEATURE_EMISSION, FEATURE_AMBIENT, FEATURE_BACKGROUND,
    FEATURE_REFLECT, FEATURE_TRANSMIT, FEATURE_FRESNEL,    FEATURE_BRANCHING,
    FEATURE_PBR,     FEATURE_TRANSMIT_TEXTURE, FEATURE_SPHERE_LIGHT, FEATURE_RECTANGLE_LIGHT, FEATURE_OCCLUSION, FEATURE_ENVIRONMENT,
    FEATURE_ENVIRONMENT_LIGHT, FEATURE_PREFILTERED, FEATURE_HIT_RANDOM, FEATURE_TERMINATOR, FEATURE_CLAMP,
    FEATURE_PATH,    FEATURE_MANY_LIGHTS,
};
static const Feature TEXTURING[] = {FEATURE_UV,        FEATURE_MESH_UVS, FEATURE_CHECKER,
                                    FEATURE_CHECKER3D, FEATURE_IMAGE};

static const Feature SAMPLING[] = {FEATURE_SAMPLES, FEATURE_APERTURE, FEATURE_FILTER_TENT, FEATURE_FILTER_TABLE,
                                   FEATURE_FILTER_LOBES};

static FeatureSet bits_of(const Feature *features, size_t count)
{
    FeatureSet set = 0;
    for (size_t i = 0; i < count; i++)
        set |= feature_bit(features[i]);
    return set;
}

void aov_reduce(Layout *layout, u32 aov)
{
    FeatureSet dropped = bits_of(LIGHTING, sizeof LIGHTING / sizeof LIGHTING[0]);
    const bool mapped = aov == AOV_NORMAL && features_have(layout->features, FEATURE_NORMAL_MAP);
    if (aov != AOV_ALBEDO && !mapped)
        dropped |= bits_of(TEXTURING, sizeof TEXTURING / sizeof TEXTURING[0]);
    if (aov != AOV_NORMAL)
        dropped |= feature_bit(FEATURE_MESH_NORMALS) | feature_bit(FEATURE_NORMAL_MAP);
    if (aov == AOV_DEPTH || aov == AOV_POSITION || aov == AOV_ID) {
        dropped |= bits_of(SAMPLING, sizeof SAMPLING / sizeof SAMPLING[0]);
        layout->params.samples = 1;
    }
    layout->features &= ~dropped;
}
