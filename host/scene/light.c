// light: five kinds.
#include "scene/statement.h"

#define INTENSITY {"intensity", VALUE_COLOR, AT(Light, intensity)}
#define ATTENUATION \
    {"attenuation", VALUE_NUMBERS, AT(Light, attenuation), RANGE_ATTENUATION, .count = 3}
#define RADIANCE {"radiance", VALUE_COLOR, AT(Light, intensity), .required = true}
#define SAMPLES {"samples", VALUE_WHOLE, AT(Light, samples), RANGE_SAMPLES, .count = 1}

static const Property POINT_PROPERTIES[] = {
    {"position", VALUE_NUMBERS, AT(Light, position), .count = 3, .required = true},
    INTENSITY,
    ATTENUATION,
};

static const Property DIRECTIONAL_PROPERTIES[] = {
    {"direction", VALUE_NUMBERS, AT(Light, direction), RANGE_DIRECTION, .count = 3, .required = true},
    INTENSITY,
};

static const Property SPOT_PROPERTIES[] = {
    {"position", VALUE_NUMBERS, AT(Light, position), .count = 3, .required = true},
    {"look_at", VALUE_NUMBERS, AT(Light, look_at), .count = 3, .required = true},
    INTENSITY,
    ATTENUATION,
    {"inner", VALUE_NUMBERS, AT(Light, inner), RANGE_INNER, .count = 1},
    {"outer", VALUE_NUMBERS, AT(Light, outer), RANGE_OUTER, .count = 1},
};

static const Property SPHERE_PROPERTIES[] = {
    {"center", VALUE_NUMBERS, AT(Light, position), .count = 3, .required = true},
    {"radius", VALUE_NUMBERS, AT(Light, radius), RANGE_POSITIVE, .count = 1, .required = true},
    RADIANCE,
    SAMPLES,
};

static const Property RECTANGLE_PROPERTIES[] = {
    {"corner", VALUE_NUMBERS, AT(Light, position), .count = 3, .required = true},
    {"edge1", VALUE_NUMBERS, AT(Light, edge1), RANGE_DIRECTION, .count = 3, .required = true},
    {"edge2", VALUE_NUMBERS, AT(Light, edge2), RANGE_DIRECTION, .count = 3, .required = true},
    RADIANCE,
    SAMPLES,
};

static void check_spot(Parser *parser, Block *block)
{
    Light *light = block->target;
    if (!block_given(block, "inner"))
        light->inner = light->outer;
    else if (block_good(block, "inner") && block_good(block, "outer") && light->inner > light->outer)
        parser_error(parser, block_later(block, "inner", "outer"), "'inner' (%g) is above 'outer' (%g)",
                     light->inner, light->outer);
    const bool both = block_given(block, "position") && block_given(block, "look_at");
    if (both && block_good(block, "position") && block_good(block, "look_at") &&
        vec_length(vec_sub(light->look_at, light->position)) == 0)
        parser_error(parser, block_later(block, "position", "look_at"),
                     "the spot looks at its own position");
}

static void check_rectangle(Parser *parser, Block *block)
{
    const Light *light = block->target;
    const bool both = block_given(block, "edge1") && block_given(block, "edge2");
    if (!both || !block_good(block, "edge1") || !block_good(block, "edge2"))
        return;
    const f64 sine_min = 1e-12; // decimal edges that are parallel are so only up to rounding
    if (vec_length(vec_cross(vec_normalize(light->edge1), vec_normalize(light->edge2))) < sine_min)
        parser_error(parser, block_later(block, "edge1", "edge2"), "the rectangle has no area");
}

static const BlockType LIGHT_BLOCKS[] = {
    [LIGHT_POINT] = BLOCK_TYPE("point light", POINT_PROPERTIES, NULL),
    [LIGHT_DIRECTIONAL] = BLOCK_TYPE("directional light", DIRECTIONAL_PROPERTIES, NULL),
    [LIGHT_SPOT] = BLOCK_TYPE("spot light", SPOT_PROPERTIES, check_spot),
    [LIGHT_SPHERE] = BLOCK_TYPE("sphere light", SPHERE_PROPERTIES, NULL),
    [LIGHT_RECTANGLE] = BLOCK_TYPE("rectangle light", RECTANGLE_PROPERTIES, check_rectangle),
};

static const char *const LIGHT_KINDS[] = {"point", "directional", "spot", "sphere", "rectangle", NULL};

void light_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)statement;
    u32 kind;
    if (!parser_read_word(parser, LIGHT_KINDS, "kind of light", &kind)) {
        parser_skip_statement(parser);
        return;
    }
    Light light = {.kind = (LightKind)kind,
                   .at = parser_position(parser, word),
                   .intensity = {1, 1, 1},
                   .attenuation = {1, 0, 0},
                   .outer = 45,
                   .samples = 1};
    if (!block_parse(parser, &LIGHT_BLOCKS[kind], word, &light))
        return;
    Scene *scene = parser->scene;
    Light *lights = parser_grow(parser, scene->lights, scene->light_count, sizeof *lights);
    if (!lights)
        return;
    scene->lights = lights;
    lights[scene->light_count++] = light;
    if (kind == LIGHT_SPHERE || kind == LIGHT_RECTANGLE)
        group_add(parser, inside, ITEM_LIGHT, scene->light_count - 1);
}
