// image, camera, render, output, environment, background, ambient: what stands once.
#include <math.h>
#include <string.h>

#include "scene/statement.h"

static const char *const FILTERS[] = {"box", "tent", "gaussian", "mitchell", NULL};
static const char *const INTEGRATORS[] = {"whitted", "path", NULL};
static const char *const LIGHTINGS[] = {"sampled", "prefiltered", NULL};
static const char *const ENCODINGS[] = {"srgb", "linear", NULL};
static const char *const TONE_MAPS[] = {"none", "reinhard", "reinhard_extended", "aces", "hable", NULL};

// ---- image ----------------------------------------------------------------------------------

static const Property IMAGE_PROPERTIES[] = {
    {"size", VALUE_WHOLE, AT(ImageSettings, width), RANGE_PIXELS, .count = 2},
    {"samples", VALUE_WHOLE, AT(ImageSettings, samples), RANGE_SAMPLES, .count = 1},
    {"filter", VALUE_WORD, AT(ImageSettings, filter), .words = FILTERS,
     .position = offsetof(ImageSettings, filter_at)},
    {"seed", VALUE_WHOLE, AT(ImageSettings, seed), RANGE_U32, .count = 1},
};
_Static_assert(offsetof(ImageSettings, height) == offsetof(ImageSettings, width) + sizeof(u32),
               "size is read as one array");

const BlockType IMAGE_BLOCK = BLOCK_TYPE("image", IMAGE_PROPERTIES, NULL);

// ---- camera ---------------------------------------------------------------------------------

static const Property CAMERA_PROPERTIES[] = {
    {"position", VALUE_NUMBERS, AT(Camera, position), .count = 3},
    {"look_at", VALUE_NUMBERS, AT(Camera, look_at), .count = 3},
    {"up", VALUE_NUMBERS, AT(Camera, up), RANGE_DIRECTION, .count = 3},
    {"fov", VALUE_NUMBERS, AT(Camera, fov), RANGE_FOV, .count = 1},
    {"orthographic", VALUE_NUMBERS, AT(Camera, height), RANGE_POSITIVE, .count = 1},
    {"aperture", VALUE_NUMBERS, AT(Camera, aperture), RANGE_NOT_NEGATIVE, .count = 1,
     .position = offsetof(Camera, aperture_at)},
    {"focus_distance", VALUE_NUMBERS, AT(Camera, focus_distance), RANGE_POSITIVE, .count = 1},
};

static void check_view(Parser *parser, const Block *block, const Camera *camera)
{
    const f64 sine_min = 1e-6;
    const Vec3 back = vec_sub(camera->position, camera->look_at);
    if (vec_length(back) == 0) {
        parser_error(parser, block_later(block, "position", "look_at"),
                     "the camera looks at its own position (%g %g %g)", camera->position.x,
                     camera->position.y, camera->position.z);
        return;
    }
    const Vec3 across = vec_cross(vec_normalize(camera->up), vec_normalize(back));
    if (block_good(block, "up") && vec_length(across) < sine_min)
        parser_error(parser, block_place(block, "up"), "the camera's 'up' is parallel to its view");
}

static void check_camera(Parser *parser, Block *block)
{
    Camera *camera = block->target;
    camera->orthographic = block_given(block, "orthographic");
    block_refuse_both(parser, block, "fov", "orthographic");
    block_refuse_both(parser, block, "aperture", "orthographic");
    block_refuse_both(parser, block, "focus_distance", "orthographic");
    if (!block_good(block, "position") || !block_good(block, "look_at"))
        return;
    check_view(parser, block, camera);
    if (!block_given(block, "focus_distance"))
        camera->focus_distance = vec_length(vec_sub(camera->position, camera->look_at));
}

const BlockType CAMERA_BLOCK = BLOCK_TYPE("camera", CAMERA_PROPERTIES, check_camera);

// ---- render ---------------------------------------------------------------------------------

static bool read_ambient_occlusion(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const Property samples = {"ambient_occlusion", VALUE_WHOLE, 0, RANGE_SAMPLES, .count = 1};
    static const Property distance = {"ambient_occlusion", VALUE_NUMBERS, 0, RANGE_POSITIVE, .count = 1};
    (void)value;
    RenderSettings *render = &parser->scene->render;
    if (parser->token.kind != TOKEN_NUMBER)
        return value_refuse(parser, property, name, 0);
    const bool good = value_read(parser, &samples, name, &render->ambient_occlusion_samples);
    if (parser->token.kind != TOKEN_NUMBER)
        return good && value_refuse(parser, property, name, 1);
    return value_read(parser, &distance, name, &render->ambient_occlusion_distance) && good;
}

static const Property RENDER_PROPERTIES[] = {
    {"max_depth", VALUE_WHOLE, AT(RenderSettings, max_depth), RANGE_DEPTH, .count = 1},
    {"min_weight", VALUE_NUMBERS, AT(RenderSettings, min_weight), RANGE_NOT_NEGATIVE, .count = 1},
    {"integrator", VALUE_WORD, AT(RenderSettings, integrator), .words = INTEGRATORS,
     .position = offsetof(RenderSettings, integrator_at)},
    {"ambient_occlusion", VALUE_OTHER, 0, .read = read_ambient_occlusion,
     .takes = "a whole number of rays and a distance",
     .position = offsetof(RenderSettings, ambient_occlusion_at)},
    {"environment_samples", VALUE_WHOLE, AT(RenderSettings, environment_samples), RANGE_SAMPLES,
     .count = 1},
    {"environment_lighting", VALUE_WORD, AT(RenderSettings, environment_lighting), .words = LIGHTINGS,
     .position = offsetof(RenderSettings, environment_lighting_at)},
    {"shadows", VALUE_SWITCH, AT(RenderSettings, shadows)},
};

const BlockType RENDER_BLOCK = BLOCK_TYPE("render", RENDER_PROPERTIES, NULL);

// ---- output ---------------------------------------------------------------------------------

static bool read_tone_map(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const Property word = {"tone_map", VALUE_WORD, 0, .words = TONE_MAPS};
    static const Property white = {"tone_map reinhard_extended", VALUE_NUMBERS, 0, RANGE_POSITIVE,
                                   .count = 1};
    (void)property;
    (void)value;
    OutputSettings *output = &parser->scene->output;
    if (!value_read(parser, &word, name, &output->tone_map))
        return false;
    return output->tone_map != TONE_MAP_REINHARD_EXTENDED || value_read(parser, &white, name, &output->white);
}

static const Property OUTPUT_PROPERTIES[] = {
    {"exposure", VALUE_NUMBERS, AT(OutputSettings, exposure), .count = 1},
    {"tone_map", VALUE_OTHER, 0, .read = read_tone_map,
     .takes = "none, reinhard, reinhard_extended and a number, aces or hable"},
    {"encoding", VALUE_WORD, AT(OutputSettings, encoding), .words = ENCODINGS},
};

static void check_output(Parser *parser, Block *block)
{
    (void)parser;
    OutputSettings *output = block->target;
    output->exposure_given = block_given(block, "exposure");
    output->tone_map_given = block_given(block, "tone_map");
}

const BlockType OUTPUT_BLOCK = BLOCK_TYPE("output", OUTPUT_PROPERTIES, check_output);

// ---- environment ----------------------------------------------------------------------------

static const Property ENVIRONMENT_PROPERTIES[] = {
    {"file", VALUE_FILE, AT(Environment, file), .required = true,
     .position = offsetof(Environment, file_at)},
    {"intensity", VALUE_COLOR, AT(Environment, intensity)},
    {"rotate", VALUE_NUMBERS, AT(Environment, rotate), .count = 1},
};

static void check_environment(Parser *parser, Block *block)
{
    Environment *environment = block->target;
    environment->present = true;
    environment->at = parser_position(parser, block->word);
}

const BlockType ENVIRONMENT_BLOCK = BLOCK_TYPE("environment", ENVIRONMENT_PROPERTIES, check_environment);

// ---- statements -----------------------------------------------------------------------------

// Notes that the statement stands here; reports a second one, and environment beside background.
static void stand_once(Parser *parser, const Statement *statement, const Token *word)
{
    SourcePos *first = &parser->once[statement->kind];
    if (first->line > 0) {
        char place[PLACE_SHOWN_MAX];
        parser_error(parser, word, "'%s' stands once in a scene; the first is at %s", statement->name,
                     parser_show_place(parser, *first, place));
        return;
    }
    *first = parser_position(parser, word);
    const bool sky = statement->kind == ONCE_ENVIRONMENT || statement->kind == ONCE_BACKGROUND;
    if (sky && parser->once[ONCE_ENVIRONMENT].line > 0 && parser->once[ONCE_BACKGROUND].line > 0)
        parser_error(parser, word, "'environment' and 'background' exclude each other");
}

void settings_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)inside;
    stand_once(parser, statement, word);
    block_parse(parser, statement->block, word, (char *)parser->scene + statement->offset);
}

void value_statement_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)inside;
    stand_once(parser, statement, word);
    const Property property = {.name = statement->name, .kind = VALUE_COLOR};
    if (!value_read(parser, &property, word, (char *)parser->scene + statement->offset))
        parser_skip_values(parser);
}
