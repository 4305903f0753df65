#include "scene/block.h"

#include <stdio.h>
#include <string.h>

#include "scene/statement.h"

static i32 find_property(const BlockType *type, const Token *name)
{
    for (u32 i = 0; i < type->count; ++i) {
        if (token_is(name, type->properties[i].name))
            return (i32)i;
    }
    return -1;
}

bool block_has_property(const BlockType *type, const Token *name)
{
    return find_property(type, name) >= 0;
}

static void refuse_unknown_property(Parser *parser, Block *block)
{
    const Token name = parser->token;
    Suggestion suggestion = suggest_begin(name.text, name.length);
    for (u32 i = 0; i < block->type->count; ++i) {
        const Property *property = &block->type->properties[i];
        if (property->repeatable || !(block->given >> i & 1))
            suggest_offer(&suggestion, property->name, strlen(property->name));
    }
    char shown[TOKEN_SHOWN_MAX], hint[SUGGEST_TEXT_MAX];
    parser_error(parser, &name, "unknown property %s of %s%s", parser_show(&name, shown), block->type->title,
                 suggest_text(&suggestion, hint));
    block->unknown_property = true;
    parser_advance(parser);
    // A word behind it is its value rather than a second mistake.
    if (parser->token.kind == TOKEN_NAME && !block_has_property(block->type, &parser->token) &&
        !statement_begins(parser))
        parser_advance(parser);
    parser_skip_values(parser);
}

static void refuse_loose_value(Parser *parser, const Block *block, const Property *last)
{
    char shown[TOKEN_SHOWN_MAX], takes[VALUE_TAKES_MAX];
    parser_show(&parser->token, shown);
    if (last && parser->token.kind != TOKEN_OPEN)
        parser_error(parser, &parser->token, "unexpected %s; '%s' takes %s", shown, last->name,
                     value_takes(last, takes));
    else
        parser_error(parser, &parser->token, "expected a property of %s, found %s", block->type->title,
                     shown);
    parser_skip_values(parser);
}

static void read_property(Parser *parser, Block *block, u32 index)
{
    const Property *property = &block->type->properties[index];
    const u32 bit = 1u << index;
    const Token name = parser->token;
    parser_advance(parser);
    bool good = true;
    if ((block->given & bit) && !property->repeatable) {
        parser_error(parser, &name, "'%s' is given twice", property->name);
        good = false;
    }
    block->given |= bit;
    block->names[index] = name;
    char *target = block->target;
    if (property->position) {
        const SourcePos position = parser_position(parser, &name);
        memcpy(target + property->position, &position, sizeof position);
    }
    if (!value_read(parser, property, &name, target + property->offset)) {
        good = false;
        parser_skip_values(parser);
    }
    if (!good)
        block->bad |= bit;
}

// Reads up to and with the `}`; returns false where there is none.
static bool read_properties(Parser *parser, Block *block, const Token *open)
{
    const Property *last = NULL;
    for (;;) {
        const Token *token = &parser->token;
        if (token->kind == TOKEN_CLOSE)
            return true;
        if (token->kind == TOKEN_END) {
            parser_error(parser, open, "this '{' is never closed");
            return false;
        }
        if (token->kind != TOKEN_NAME) {
            refuse_loose_value(parser, block, last);
            continue;
        }
        const i32 index = find_property(block->type, token);
        const bool statement_word = index < 0 || block->type->properties[index].kind == VALUE_MATERIAL;
        if (statement_word && statement_begins(parser)) {
            char shown[TOKEN_SHOWN_MAX];
            parser_error(parser, token, "%s is not a property of %s; is a '}' missing before it?",
                         parser_show(token, shown), block->type->title);
            parser->stray_close_expected = true;
            return false;
        }
        if (index < 0) {
            refuse_unknown_property(parser, block);
            last = NULL;
        } else {
            read_property(parser, block, (u32)index);
            last = &block->type->properties[index];
        }
    }
}

static void check_required(Parser *parser, const Block *block)
{
    char missing[256] = "";
    size_t length = 0;
    for (u32 i = 0; i < block->type->count; ++i) {
        const Property *property = &block->type->properties[i];
        if (property->required && !(block->given >> i & 1) && length < sizeof missing)
            length += (size_t)snprintf(missing + length, sizeof missing - length, "%s'%s'",
                                       length ? ", " : "", property->name);
    }
    if (length > 0 && !block->unknown_property)
        parser_error(parser, block->word, "%s lacks %s", block->type->title, missing);
}

bool block_parse(Parser *parser, const BlockType *type, const Token *word, void *target)
{
    const Token open = parser->token;
    if (!parser_expect_open(parser) && (open.kind != TOKEN_NAME || !block_has_property(type, &open))) {
        parser_skip_statement(parser);
        parser->stray_close_expected = true;
        return false;
    }
    Block block; // its names are not cleared: blocks are many
    block.type = type;
    block.target = target;
    block.word = word;
    block.given = block.bad = 0;
    block.unknown_property = false;
    parser->block = &block;
    const bool closed = read_properties(parser, &block, &open);
    parser->block = NULL;
    if (closed) {
        check_required(parser, &block);
        if (type->check)
            type->check(parser, &block);
        parser_advance(parser);
    }
    return !parser->out_of_memory;
}

static u32 bit_of(const Block *block, const char *property)
{
    for (u32 i = 0; i < block->type->count; ++i) {
        if (strcmp(block->type->properties[i].name, property) == 0)
            return 1u << i;
    }
    return 0;
}

bool block_given(const Block *block, const char *property)
{
    return (block->given & bit_of(block, property)) != 0;
}

bool block_good(const Block *block, const char *property)
{
    return (block->bad & bit_of(block, property)) == 0;
}

const Token *block_place(const Block *block, const char *property)
{
    const u32 bit = bit_of(block, property);
    for (u32 i = 0; i < block->type->count; ++i) {
        if (bit >> i == 1)
            return block->given & bit ? &block->names[i] : block->word;
    }
    return block->word;
}

const Token *block_later(const Block *block, const char *a, const char *b)
{
    const Token *x = block_place(block, a), *y = block_place(block, b);
    return x->text > y->text ? x : y;
}

bool block_refuse_both(Parser *parser, const Block *block, const char *a, const char *b)
{
    if (!block_given(block, a) || !block_given(block, b))
        return false;
    parser_error(parser, block_later(block, a, b), "'%s' and '%s' exclude each other", a, b);
    return true;
}
