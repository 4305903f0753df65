#include <string.h>

#include "parse.h"

void parse_unknown(const Parser *parser, const char *what)
{
    die("%s:%d: %s `%s`: not in the oracle's part of the language", parser->path, parser->at->line, what,
        parser->at->text != NULL ? parser->at->text : "?");
}

static const Token *take(Parser *parser, TokenKind kind, const char *what)
{
    if (parser->at->kind != kind)
        die("%s:%d: %s expected", parser->path, parser->at->line, what);
    return parser->at++;
}

real parse_number(Parser *parser)
{
    return take(parser, TOKEN_NUMBER, "a number")->number;
}

Vec parse_vec(Parser *parser)
{
    real x = parse_number(parser);
    real y = parse_number(parser);
    real z = parse_number(parser);
    return vec(x, y, z);
}

const char *parse_name(Parser *parser)
{
    return take(parser, TOKEN_NAME, "a name")->text;
}

const char *parse_string(Parser *parser)
{
    return take(parser, TOKEN_STRING, "a string")->text;
}

bool parse_accept(Parser *parser, const char *name)
{
    if (parser->at->kind != TOKEN_NAME || strcmp(parser->at->text, name) != 0)
        return false;
    parser->at++;
    return true;
}

bool parse_on_off(Parser *parser)
{
    if (parse_accept(parser, "on"))
        return true;
    if (!parse_accept(parser, "off"))
        parse_unknown(parser, "value");
    return false;
}

int parse_choice(Parser *parser, const char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (parse_accept(parser, names[i]))
            return i;
    parse_unknown(parser, "value");
}

const char *parse_path(Parser *parser)
{
    return store_beside(&parser->scene->store, parser->path, parse_string(parser));
}

Vec parse_one_or_three(Parser *parser)
{
    real x = parse_number(parser);
    if (parser->at->kind != TOKEN_NUMBER)
        return grey(x);
    real y = parse_number(parser);
    real z = parse_number(parser);
    return vec(x, y, z);
}

static int hex_digit(char c)
{
    const char *digits = "0123456789abcdef";
    const char *lower = strchr(digits, c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c);
    return lower != NULL && c != '\0' ? (int)(lower - digits) : -1;
}

Vec parse_color(Parser *parser)
{
    if (parser->at->kind != TOKEN_STRING)
        return parse_one_or_three(parser);
    const char *text = parser->at->text;
    real channels[3];
    if (text[0] != '#' || strlen(text) != 7)
        parse_unknown(parser, "color");
    for (int i = 0; i < 3; i++) {
        int level = 16 * hex_digit(text[1 + 2 * i]) + hex_digit(text[2 + 2 * i]);
        channels[i] = srgb_decode((real)level / 255);
    }
    parser->at++;
    return vec(channels[0], channels[1], channels[2]);
}

int parse_texture_name(Parser *parser)
{
    int texture = scene_find_texture(parser->scene, parser->at->text);
    if (texture < 0)
        parse_unknown(parser, "texture");
    parser->at++;
    return texture;
}

Paint parse_paint(Parser *parser)
{
    if (parser->at->kind != TOKEN_NAME)
        return (Paint){parse_color(parser), -1};
    return (Paint){grey(1), parse_texture_name(parser)};
}

void parse_open(Parser *parser)
{
    take(parser, TOKEN_OPEN, "`{`");
}

bool parse_closed(Parser *parser)
{
    if (parser->at->kind == TOKEN_END)
        die("%s: `}` expected", parser->path);
    if (parser->at->kind != TOKEN_CLOSE)
        return false;
    parser->at++;
    return true;
}
