/* Section 1 of the contract: text to tokens. Assumes a valid file and checks only what it must to go on. */
#ifndef ORACLE_TOKEN_H
#define ORACLE_TOKEN_H

#include "store.h"

typedef enum TokenKind {
    TOKEN_END,
    TOKEN_NUMBER,
    TOKEN_NAME,
    TOKEN_STRING,
    TOKEN_OPEN,
    TOKEN_CLOSE
} TokenKind;

typedef struct Token {
    TokenKind kind;
    double number;    /* of TOKEN_NUMBER */
    const char *text; /* of TOKEN_NAME and, unescaped, TOKEN_STRING; else NULL */
    int line;         /* from 1 */
} Token;

/* All tokens of a file, the last one TOKEN_END; memory from the store. */
Token *tokens_read(Store *store, const char *path);
/* The same from text of `size` bytes; `path` serves messages. */
Token *tokens_from_text(Store *store, const char *path, const char *text, size_t size);

#endif
