/* Statements of a scene file, objects and includes. */
#include "parse.h"

#include <string.h>

#include "environment.h"

static void parse_image(Parser *parser)
{
    Scene *scene = parser->scene;
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "size")) {
            scene->width = (int)parse_number(parser);
            scene->height = (int)parse_number(parser);
        } else if (parse_accept(parser, "samples")) {
            scene->samples = (int)parse_number(parser);
        } else if (parse_accept(parser, "seed")) {
            parse_number(parser);
        } else if (parse_accept(parser, "filter")) {
            static const char *const NAMES[] = {"box", "tent", "gaussian", "mitchell"};
            scene->filter = (Filter)parse_choice(parser, NAMES, 4);
        } else {
            parse_unknown(parser, "property");
        }
    }
}

static void parse_camera(Parser *parser)
{
    Scene *scene = parser->scene;
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "position"))
            scene->camera_position = parse_vec(parser);
        else if (parse_accept(parser, "look_at"))
            scene->camera_look_at = parse_vec(parser);
        else if (parse_accept(parser, "up"))
            scene->camera_up = parse_vec(parser);
        else if (parse_accept(parser, "fov"))
            scene->fov = parse_number(parser);
        else if (parse_accept(parser, "orthographic"))
            scene->orthographic = parse_number(parser);
        else if (parse_accept(parser, "aperture"))
            scene->aperture = parse_number(parser);
        else if (parse_accept(parser, "focus_distance"))
            scene->focus_distance = parse_number(parser);
        else
            parse_unknown(parser, "property");
    }
}

/* The number of rays does not matter here: the oracle has the limit of many. */
static void parse_occlusion(Parser *parser)
{
    parse_number(parser);
    parser->scene->occlusion_distance = parse_number(parser);
}

static bool parse_integrator(Parser *parser)
{
    static const char *const NAMES[] = {"whitted", "path"};
    return parse_choice(parser, NAMES, 2) == 1;
}

static void parse_render(Parser *parser)
{
    Scene *scene = parser->scene;
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "max_depth"))
            scene->max_depth = (int)parse_number(parser);
        else if (parse_accept(parser, "min_weight"))
            scene->min_weight = parse_number(parser);
        else if (parse_accept(parser, "shadows"))
            scene->shadows = parse_on_off(parser);
        else if (parse_accept(parser, "ambient_occlusion"))
            parse_occlusion(parser);
        else if (parse_accept(parser, "environment_samples"))
            parse_number(parser);
        else if (parse_accept(parser, "environment_lighting") && parse_accept(parser, "sampled"))
            continue;
        else if (parse_accept(parser, "integrator"))
            scene->path = parse_integrator(parser);
        else
            parse_unknown(parser, "property");
    }
}

static void parse_tone_map(Parser *parser)
{
    static const char *const NAMES[] = {"none", "reinhard", "reinhard_extended", "aces", "hable"};
    parser->scene->tone_map = (ToneMap)parse_choice(parser, NAMES, 5);
    if (parser->scene->tone_map == TONE_REINHARD_EXTENDED)
        parser->scene->white = parse_number(parser);
}

static void parse_output(Parser *parser)
{
    Scene *scene = parser->scene;
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "exposure")) {
            scene->exposure = parse_number(parser);
        } else if (parse_accept(parser, "tone_map")) {
            parse_tone_map(parser);
        } else if (parse_accept(parser, "encoding")) {
            scene->srgb = parse_accept(parser, "srgb");
            if (!scene->srgb && !parse_accept(parser, "linear"))
                parse_unknown(parser, "encoding");
        } else {
            parse_unknown(parser, "property");
        }
    }
}

static void parse_environment(Parser *parser)
{
    Scene *scene = parser->scene;
    Environment *environment = &scene->environment;
    environment->intensity = grey(1);
    environment_turn(environment, 0);
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "file"))
            environment->image = image_read(&scene->store, parse_path(parser));
        else if (parse_accept(parser, "intensity"))
            environment->intensity = parse_color(parser);
        else if (parse_accept(parser, "rotate"))
            environment_turn(environment, parse_number(parser));
        else
            parse_unknown(parser, "property");
    }
    environment_prepare(&scene->store, environment);
}

static void append_item(Scene *scene, size_t object, const Item *item)
{
    Object *target = &scene->objects[object];
    target->items = store_grow(&scene->store, target->items, target->count, sizeof *item);
    target->items[target->count++] = *item;
}

static void parse_object(Parser *parser)
{
    Scene *scene = parser->scene;
    size_t index = scene->object_count;
    scene->objects = store_grow(&scene->store, scene->objects, index, sizeof *scene->objects);
    /* Named when complete, so that it cannot hold itself. */
    scene->objects[index] = (Object){"", NULL, 0};
    scene->object_count++;
    const char *name = parse_name(parser);
    parse_open(parser);
    while (!parse_closed(parser)) {
        Item item;
        if (!parse_item(parser, &item))
            parse_unknown(parser, "shape");
        append_item(scene, index, &item);
    }
    scene->objects[index].name = name;
}

static void read_file(Scene *scene, const char *path);

static void parse_include(Parser *parser)
{
    read_file(parser->scene, parse_path(parser));
}

static void parse_light_statement(Parser *parser)
{
    Item item;
    if (parse_light(parser, &item))
        append_item(parser->scene, 0, &item);
}

static const struct {
    const char *name;
    void (*parse)(Parser *parser);
} STATEMENTS[] = {
    {"image", parse_image},     {"camera", parse_camera},   {"render", parse_render},
    {"output", parse_output},   {"texture", parse_texture}, {"material", parse_material},
    {"light", parse_light_statement}, {"object", parse_object}, {"include", parse_include},
    {"environment", parse_environment},
};

static bool parse_statement(Parser *parser)
{
    for (size_t i = 0; i < sizeof STATEMENTS / sizeof STATEMENTS[0]; i++) {
        if (parse_accept(parser, STATEMENTS[i].name)) {
            STATEMENTS[i].parse(parser);
            return true;
        }
    }
    Item item;
    if (parse_accept(parser, "background"))
        parser->scene->background = parse_color(parser);
    else if (parse_accept(parser, "ambient"))
        parser->scene->ambient = parse_color(parser);
    else if (parse_item(parser, &item))
        append_item(parser->scene, 0, &item);
    else
        return false;
    return true;
}

static void parse_tokens(Scene *scene, const char *path, const Token *tokens)
{
    Parser parser = {scene, path, tokens};
    while (parser.at->kind != TOKEN_END)
        if (!parse_statement(&parser))
            parse_unknown(&parser, "statement");
}

static void read_file(Scene *scene, const char *path)
{
    parse_tokens(scene, path, tokens_read(&scene->store, path));
}

void scene_read(Scene *scene, const char *path)
{
    read_file(scene, path);
    scene_place(scene);
}

void scene_read_text(Scene *scene, const char *text)
{
    parse_tokens(scene, "text", tokens_from_text(&scene->store, "text", text, strlen(text)));
    scene_place(scene);
}
