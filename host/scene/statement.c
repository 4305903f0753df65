#include "scene/statement.h"

#include <string.h>

#define SETTINGS(name, once, block, member) \
    {name, FORM_BLOCK, settings_parse, false, once, block, offsetof(Scene, member)}
#define VALUE(name, once, member) \
    {name, FORM_VALUE, value_statement_parse, false, once, NULL, offsetof(Scene, member)}
#define SHAPE(name, kind) {name, FORM_BLOCK, shape_parse, true, kind, NULL, 0}

static const Statement STATEMENTS[] = {
    SHAPE("sphere", SHAPE_SPHERE),
    SHAPE("triangle", SHAPE_TRIANGLE),
    SHAPE("box", SHAPE_BOX),
    SHAPE("plane", SHAPE_PLANE),
    SHAPE("tetrahedron", SHAPE_TETRAHEDRON),
    SHAPE("disk", SHAPE_DISK),
    SHAPE("cylinder", SHAPE_CYLINDER),
    SHAPE("cone", SHAPE_CONE),
    SHAPE("torus", SHAPE_TORUS),
    SHAPE("mesh", SHAPE_MESH),
    {"instance", FORM_NAME_BLOCK, instance_parse, true, 0, NULL, 0},
    {"object", FORM_NAME_BLOCK, object_parse, false, 0, NULL, 0},
    {"material", FORM_NAME_NAME_BLOCK, material_parse, false, 0, NULL, 0},
    {"texture", FORM_NAME_NAME_BLOCK, texture_parse, false, 0, NULL, 0},
    {"light", FORM_NAME_BLOCK, light_parse, false, 0, NULL, 0},
    {"include", FORM_STRING, include_parse, false, 0, NULL, 0},
    SETTINGS("image", ONCE_IMAGE, &IMAGE_BLOCK, image),
    SETTINGS("camera", ONCE_CAMERA, &CAMERA_BLOCK, camera),
    SETTINGS("render", ONCE_RENDER, &RENDER_BLOCK, render),
    SETTINGS("output", ONCE_OUTPUT, &OUTPUT_BLOCK, output),
    SETTINGS("environment", ONCE_ENVIRONMENT, &ENVIRONMENT_BLOCK, environment),
    VALUE("background", ONCE_BACKGROUND, background),
    VALUE("ambient", ONCE_AMBIENT, ambient),
};

enum { STATEMENT_COUNT = sizeof STATEMENTS / sizeof *STATEMENTS };

const Statement *statement_find(const Token *word)
{
    for (u32 i = 0; i < STATEMENT_COUNT; ++i) {
        if (token_is(word, STATEMENTS[i].name))
            return &STATEMENTS[i];
    }
    return NULL;
}

bool statement_begins(const Parser *parser)
{
    const Statement *statement = statement_find(&parser->token);
    if (!statement)
        return false;
    Lexer lexer = parser->input->lexer; // a copy: nothing is consumed
    Token next;
    lexer_next(&lexer, &next);
    u32 names = 0;
    switch (statement->form) {
    case FORM_VALUE: return next.kind == TOKEN_NUMBER || next.kind == TOKEN_STRING;
    case FORM_STRING: return next.kind == TOKEN_STRING;
    case FORM_BLOCK: names = 0; break;
    case FORM_NAME_BLOCK: names = 1; break;
    case FORM_NAME_NAME_BLOCK: names = 2; break;
    }
    for (; names > 0 && next.kind == TOKEN_NAME; --names)
        lexer_next(&lexer, &next);
    return names == 0 && next.kind == TOKEN_OPEN;
}

static void refuse_unknown_statement(Parser *parser, bool in_object)
{
    char shown[TOKEN_SHOWN_MAX], hint[SUGGEST_TEXT_MAX];
    const Token *word = &parser->token;
    parser_show(word, shown);
    if (word->kind != TOKEN_NAME) {
        parser_error(parser, word, "expected a statement, found %s", shown);
    } else {
        Suggestion suggestion = suggest_begin(word->text, word->length);
        for (u32 i = 0; i < STATEMENT_COUNT; ++i) {
            if (!in_object || STATEMENTS[i].in_object)
                suggest_offer(&suggestion, STATEMENTS[i].name, strlen(STATEMENTS[i].name));
        }
        parser_error(parser, word, "unknown statement %s%s", shown, suggest_text(&suggestion, hint));
    }
    parser_skip_statement(parser);
}

void statement_parse(Parser *parser, Group *inside)
{
    const Token word = parser->token;
    const Statement *statement = statement_find(&word);
    if (!statement) {
        refuse_unknown_statement(parser, false);
        return;
    }
    parser_advance(parser);
    statement->parse(parser, statement, &word, inside);
}

bool statement_parse_in_object(Parser *parser, Group *inside)
{
    const Token word = parser->token;
    const Statement *statement = statement_find(&word);
    if (!statement) {
        refuse_unknown_statement(parser, true);
        return true;
    }
    if (!statement->in_object) {
        parser_error(parser, &word, "'%s' cannot stand in an object; is a '}' missing before it?",
                     statement->name);
        parser->stray_close_expected = true;
        return false;
    }
    parser_advance(parser);
    statement->parse(parser, statement, &word, inside);
    return true;
}

bool group_add(Parser *parser, Group *group, ItemKind kind, u32 index)
{
    Item *items = parser_grow(parser, group->items, group->count, sizeof *items);
    if (!items)
        return false;
    group->items = items;
    items[group->count++] = (Item){kind, index};
    return true;
}
