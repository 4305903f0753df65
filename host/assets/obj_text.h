// ObjText: the words of OBJ and MTL files one by one, with their places. A line ends in LF, CR LF or CR; a
// backslash right before its end continues the statement, but not a comment. Knows no keyword.
#ifndef CLRT_ASSETS_OBJ_TEXT_H
#define CLRT_ASSETS_OBJ_TEXT_H

#include "scene/diagnostics.h"

typedef struct ObjText {
    const char *cursor, *end; // *end is 0
    const char *line_text;    // the line of the cursor
    u64 line;                 // its number, from 1
    const char *file_name;
    Diagnostics *diagnostics; // NULL: what is reported is only noted below
    bool errors, warnings;    // whether some were reported
} ObjText;

typedef struct ObjWord {
    const char *text;
    size_t length; // bytes; 0: no word, but the place where one could be
    const char *line_text;
    u64 line;
} ObjWord;

enum { OBJ_WORDS_MAX = DIAGNOSTICS_SHOWN_MAX, OBJ_WORD_BYTES = 32 };

// A few different words, of which longer ones are cut.
typedef struct ObjWords {
    u32 count;
    char words[OBJ_WORDS_MAX][OBJ_WORD_BYTES];
} ObjWords;

ObjText obj_text_begin(const char *text, size_t length);

// Stores the next word of the statement; '#' begins a comment. Returns false at the end of the statement.
bool obj_text_word(ObjText *text, ObjWord *word);

// Goes to the next statement, over what is left of this one.
void obj_text_next_statement(ObjText *text);

// An upper bound of the bytes that obj_text_rest stores.
size_t obj_text_rest_bound(const ObjText *text);

// Copies the rest of the statement to `to`, without blanks around it and with a final 0; a name can hold
// blanks and '#'. *place tells where it stands. Returns the number of bytes before the 0.
size_t obj_text_rest(ObjText *text, char *to, ObjWord *place);

bool obj_word_is(const ObjWord *word, const char *name);

// Reads the number that the word is; false, with an error at it, where it is none or out of float's range.
bool obj_text_number(ObjText *text, const ObjWord *word, f64 *value);

// Adds a message about the word.
void obj_text_report(ObjText *text, Severity severity, const ObjWord *word, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// Adds the word; false where it is there already or no more fit.
bool obj_words_add(ObjWords *words, const char *text, size_t length);

#endif
