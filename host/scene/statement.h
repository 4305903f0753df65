// Statements: the table of what may stand outside of blocks.
#ifndef CLRT_SCENE_STATEMENT_H
#define CLRT_SCENE_STATEMENT_H

#include "scene/block.h"
#include "scene/parser.h"

// What follows the word of a statement, by which one is told from a property of the same name.
typedef enum StatementForm {
    FORM_BLOCK,           // {
    FORM_NAME_BLOCK,      // name {
    FORM_NAME_NAME_BLOCK, // name name {
    FORM_VALUE,           // a number or a string
    FORM_STRING
} StatementForm;

typedef struct Statement Statement;
struct Statement {
    const char *name;
    StatementForm form;
    // Reads the rest of the statement, the current token being the one behind its word. `inside` is the
    // group that takes what the statement places.
    void (*parse)(Parser *parser, const Statement *statement, const Token *word, Group *inside);
    bool in_object;         // may stand in an object
    u32 kind;               // ShapeKind or OnceStatement
    const BlockType *block; // of a statement that sets a struct of the scene
    size_t offset;          // of that struct, or of the value
};

// NULL where the token is no word of a statement.
const Statement *statement_find(const Token *word);

// Whether a statement begins at the current token.
bool statement_begins(const Parser *parser);

// Reads the statement at the current token; reports a word that begins none.
void statement_parse(Parser *parser, Group *inside);

// The same in an object. Returns false where the object must have ended before the current token.
bool statement_parse_in_object(Parser *parser, Group *inside);

// ---- in their own files ---------------------------------------------------------------------

extern const BlockType IMAGE_BLOCK, CAMERA_BLOCK, RENDER_BLOCK, OUTPUT_BLOCK, ENVIRONMENT_BLOCK;

void settings_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void value_statement_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void light_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void texture_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void material_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void shape_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void object_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void instance_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);
void include_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside);

// Adds one thing to the group; false when memory is exhausted.
bool group_add(Parser *parser, Group *group, ItemKind kind, u32 index);

#endif
