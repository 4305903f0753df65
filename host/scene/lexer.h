// Lexer: text to tokens. It reports nothing itself: a token says what is wrong with it.
#ifndef CLRT_SCENE_LEXER_H
#define CLRT_SCENE_LEXER_H

#include "base/types.h"

typedef enum TokenKind {
    TOKEN_END,
    TOKEN_NUMBER,
    TOKEN_NAME,
    TOKEN_STRING,
    TOKEN_OPEN,  // {
    TOKEN_CLOSE, // }
    TOKEN_JUNK   // nothing of the language
} TokenKind;

typedef enum TokenFault {
    FAULT_NONE,
    FAULT_NUMBER,   // begins like a number and is none
    FAULT_LARGE,    // a number above FLT_MAX
    FAULT_NAME,     // begins like a name and is none
    FAULT_JUNK,
    FAULT_UNCLOSED, // a string that does not end on its line
    FAULT_ESCAPE,   // a backslash in a string before something else than " and backslash
    FAULT_CONTROL   // a control character in a string
} TokenFault;

typedef struct Token {
    TokenKind kind;
    TokenFault fault;
    const char *text; // length bytes, a string with its quotes
    u32 length;
    u32 width;             // characters
    f64 number;            // TOKEN_NUMBER without fault
    const char *line_text; // where its line begins
    u32 line, column;      // from 1
} Token;

typedef struct Lexer {
    const char *cursor, *end; // *end is 0
    const char *line_text;
    const char *origin; // a position's column is its distance from here, in bytes, plus 1
    u32 line;
} Lexer;

// text[length] must be 0, length at most FILE_BYTES_MAX; a leading byte-order mark is skipped.
Lexer lexer_begin(const char *text, size_t length);

// Stores the next token; TOKEN_END at the end, again and again.
void lexer_next(Lexer *lexer, Token *token);

bool token_is(const Token *token, const char *name);

// Copies what is inside the quotes of a string without fault, escapes resolved, and a 0 to text,
// which has room for token->length bytes. Returns the number of bytes before the 0.
size_t token_unescape(const Token *token, char *text);

#endif
