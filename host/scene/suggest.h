// Suggest: the known word that a mistyped one was probably meant to be.
#ifndef CLRT_SCENE_SUGGEST_H
#define CLRT_SCENE_SUGGEST_H

#include "base/types.h"

enum { SUGGEST_WORD_MAX = 40, SUGGEST_TEXT_MAX = SUGGEST_WORD_MAX + 24 };

typedef struct Suggestion {
    const char *word; // as written, word_length bytes
    size_t word_length;
    const char *best; // NULL: none is close; not terminated by 0
    size_t best_length;
    u32 best_distance;
} Suggestion;

Suggestion suggest_begin(const char *word, size_t length);

// Takes candidate as the answer where it is close to the word and closer than all before it. Case
// does not count; an exchange of two neighbours is one step. Keeps the pointer.
void suggest_offer(Suggestion *suggestion, const char *candidate, size_t length);

// "; did you mean 'radius'?", or nothing where no word was close.
const char *suggest_text(const Suggestion *suggestion, char text[SUGGEST_TEXT_MAX]);

#endif
