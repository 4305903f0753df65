/* The reader of scene files: token stream helpers shared by its parts. Assumes a valid scene; what the oracle
 * does not render ends the program with a message. */
#ifndef ORACLE_PARSE_H
#define ORACLE_PARSE_H

#include "scene.h"
#include "token.h"

typedef struct Parser {
    Scene *scene;
    const char *path;
    const Token *at;
} Parser;

/* parse_value.c */
real parse_number(Parser *parser);
Vec parse_vec(Parser *parser);
const char *parse_name(Parser *parser);
const char *parse_string(Parser *parser);
bool parse_on_off(Parser *parser);
/* The place of the name among `count` ones. */
int parse_choice(Parser *parser, const char *const *names, int count);
/* A file name, made relative to the scene's file. */
const char *parse_path(Parser *parser);
/* Takes the token if it is this name. */
bool parse_accept(Parser *parser, const char *name);
/* One number for all components, or three. */
Vec parse_one_or_three(Parser *parser);
Vec parse_color(Parser *parser);
Paint parse_paint(Parser *parser);
/* The index of a texture by its name. */
int parse_texture_name(Parser *parser);
void parse_open(Parser *parser);
/* Takes the closing brace if it is next. */
bool parse_closed(Parser *parser);
__attribute__((noreturn)) void parse_unknown(const Parser *parser, const char *what);

/* Parts of the language, each called behind the statement's own name. */
void parse_texture(Parser *parser);
void parse_material(Parser *parser);
/* True where it is an area light: then `item` is its surface. */
bool parse_light(Parser *parser, Item *item);
/* A shape or an instance by its name; false, and nothing taken, where the name is neither. */
bool parse_item(Parser *parser, Item *item);

#endif
