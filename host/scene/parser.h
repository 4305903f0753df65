// Parser: the token being looked at, errors with their place, recovery. What a statement or a property
// means is not known here.
#ifndef CLRT_SCENE_PARSER_H
#define CLRT_SCENE_PARSER_H

#include "base/arena.h"
#include "scene/diagnostics.h"
#include "scene/lexer.h"
#include "scene/names.h"
#include "scene/scene.h"

typedef struct Block Block;

// A file that is being read, innermost include first.
typedef struct Input Input;
struct Input {
    Input *outer;
    Lexer lexer; // behind Parser.token
    u32 file;    // index into Scene.files
};

// What tells files apart, and where one was included first.
typedef struct FileIdentity {
    u64 device, inode;
    bool known; // false for text that is no file
    bool open;  // still being read
    SourcePos included_at;
} FileIdentity;

typedef enum OnceStatement {
    ONCE_IMAGE,
    ONCE_CAMERA,
    ONCE_RENDER,
    ONCE_OUTPUT,
    ONCE_BACKGROUND,
    ONCE_AMBIENT,
    ONCE_ENVIRONMENT,
    ONCE_COUNT
} OnceStatement;

typedef struct Parser {
    Arena *arena;
    Diagnostics *diagnostics;
    Scene *scene;
    Input *input;
    Token token; // the next one, not consumed; never TOKEN_JUNK
    const Block *block; // the block of properties being read, NULL outside
    Names materials, textures, objects; // the index is that into the array of the scene
    FileIdentity *identities; // one a file of the scene
    SourcePos once[ONCE_COUNT]; // where it stands, line 0: nowhere
    SourcePos default_at; // the definition of the material `default`, line 0: none
    bool stray_close_expected; // a block was closed early; its own brace may follow
    bool out_of_memory; // ends the parsing
    u64 placed; // instances in the world so far, nested ones counted for every placement
} Parser;

// Consumes the token; what is wrong with the next one is reported, and junk left out.
void parser_advance(Parser *parser);

// Adds an error at a token of the current file. A token with a fault has its error already: nothing is
// added there.
void parser_error(Parser *parser, const Token *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// "'abc'", a string as it is written, or "the end of the file"; long text is cut.
enum { TOKEN_SHOWN_MAX = 48 };
const char *parser_show(const Token *token, char shown[TOKEN_SHOWN_MAX]);

// "line 3", or "parts/trees.txt:3" where that is another file than the current one.
enum { PLACE_SHOWN_MAX = 256 };
const char *parser_show_place(const Parser *parser, SourcePos place, char shown[PLACE_SHOWN_MAX]);

SourcePos parser_position(const Parser *parser, const Token *token);

// NULL and out_of_memory where there is no memory.
void *parser_alloc(Parser *parser, size_t count, size_t size);
char *parser_copy_name(Parser *parser, const Token *token);
// arena_grow; sets out_of_memory.
void *parser_grow(Parser *parser, void *array, u32 count, size_t size);

// Consumes a name and defines it; its index is the count of names before. *copy becomes the name in the
// arena. Reports a name that is missing, and then returns false, or defined already: then *copy is
// NULL, and what follows is to be read and thrown away.
bool parser_define(Parser *parser, Names *names, const char *what, const char **copy);

// Consumes one of the words and sets *index. Reports another one as an unknown `what` ("kind of light").
bool parser_read_word(Parser *parser, const char *const *words, const char *what, u32 *index);

// Index of the token among words, which end with NULL; -1 where it is none of them.
i32 parser_find_word(const Token *token, const char *const *words);

// Consumes the name of something in names. Reports one that is not defined, with what ("texture").
bool parser_find_defined(Parser *parser, const Names *names, const char *what, i32 *index);

// Consumes `{`; reports where another token stands.
bool parser_expect_open(Parser *parser);

// Consumes `{` and everything up to the `}` that closes it.
void parser_skip_braces(Parser *parser);

// Consumes numbers, strings and braces with what is between them.
void parser_skip_values(Parser *parser);

// After an error at a statement: goes on to where the next statement begins, the block is over or the
// file ends.
void parser_skip_statement(Parser *parser);

#endif
