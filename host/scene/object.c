// object and instance.
#include "scene/statement.h"
#include "scene/transform.h"

static const u64 PLACED_MAX = UINT64_C(1) << 24;

static const Property INSTANCE_PROPERTIES[] = {
    {"material", VALUE_MATERIAL, AT(Instance, material)},
    TRANSFORM_PROPERTIES(offsetof(Instance, transform)),
};

static void check_instance(Parser *parser, Block *block)
{
    const Instance *instance = block->target;
    transform_check(parser, block, &instance->transform);
}

static const BlockType INSTANCE_BLOCK = BLOCK_TYPE("instance", INSTANCE_PROPERTIES, check_instance);

void object_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)statement;
    (void)inside;
    Scene *scene = parser->scene;
    Object object = {.at = parser_position(parser, word)};
    const u32 first_instance = scene->instance_count;
    if (!parser_define(parser, &parser->objects, "object", &object.name)) {
        parser_skip_statement(parser);
        return;
    }
    const Token open = parser->token;
    const bool opened = parser_expect_open(parser);
    parser->stray_close_expected = parser->stray_close_expected || !opened;
    bool goes_on = opened || statement_begins(parser);
    while (goes_on && parser->token.kind != TOKEN_CLOSE && !parser->out_of_memory) {
        if (parser->token.kind == TOKEN_END) {
            parser_error(parser, &open, "this '{' is never closed");
            goes_on = false;
        } else {
            goes_on = statement_parse_in_object(parser, &object.group);
        }
    }
    if (goes_on)
        parser_advance(parser);
    if (!object.name || parser->out_of_memory)
        return;
    for (u32 i = first_instance; i < scene->instance_count; ++i) {
        object.placed += 1 + scene->objects[scene->instances[i].object].placed;
        if (object.placed > PLACED_MAX)
            object.placed = PLACED_MAX + 1; // enough to be too much, and no overflow
    }
    Object *objects = parser_grow(parser, scene->objects, scene->object_count, sizeof *objects);
    if (!objects)
        return;
    scene->objects = objects;
    objects[scene->object_count++] = object;
}

// Consumes the name of an object that is complete.
static bool find_object(Parser *parser, u32 *index)
{
    const Token name = parser->token;
    char shown[TOKEN_SHOWN_MAX];
    i32 found;
    if (name.kind != TOKEN_NAME) {
        parser_error(parser, &name, "expected the name of an object, found %s", parser_show(&name, shown));
        return false;
    }
    if (!parser_find_defined(parser, &parser->objects, "object", &found))
        return false;
    *index = (u32)found;
    if (*index < parser->scene->object_count)
        return true;
    parser_error(parser, &name, "object %s cannot hold itself", parser_show(&name, shown));
    return false;
}

void instance_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)statement;
    Scene *scene = parser->scene;
    Instance instance = {
        .at = parser_position(parser, word), .material = -1, .transform = affine_identity()};
    const bool found = find_object(parser, &instance.object);
    if (!block_parse(parser, &INSTANCE_BLOCK, word, &instance) || !found)
        return;
    if (inside == &scene->world) {
        const bool fits = parser->placed <= PLACED_MAX;
        parser->placed += 1 + scene->objects[instance.object].placed;
        if (fits && parser->placed > PLACED_MAX)
            parser_error(parser, word, "the scene places more than %llu instances here",
                         (unsigned long long)PLACED_MAX);
    }
    Instance *instances = parser_grow(parser, scene->instances, scene->instance_count, sizeof *instances);
    if (!instances)
        return;
    scene->instances = instances;
    instances[scene->instance_count++] = instance;
    group_add(parser, inside, ITEM_INSTANCE, scene->instance_count - 1);
}
