#include "scene/suggest.h"

#include <stdio.h>

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static u32 smaller(u32 a, u32 b)
{
    return a < b ? a : b;
}

// Optimal string alignment distance of two words of at most SUGGEST_WORD_MAX bytes.
static u32 distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    u32 rows[3][SUGGEST_WORD_MAX + 1];
    for (size_t j = 0; j <= b_length; ++j)
        rows[0][j] = (u32)j;
    for (size_t i = 1; i <= a_length; ++i) {
        u32 *row = rows[i % 3];
        const u32 *above = rows[(i + 2) % 3], *above2 = rows[(i + 1) % 3];
        row[0] = (u32)i;
        for (size_t j = 1; j <= b_length; ++j) {
            const char x = lower(a[i - 1]), y = lower(b[j - 1]);
            row[j] = smaller(smaller(above[j], row[j - 1]) + 1, above[j - 1] + (x != y));
            if (i > 1 && j > 1 && x == lower(b[j - 2]) && lower(a[i - 2]) == y)
                row[j] = smaller(row[j], above2[j - 2] + 1);
        }
    }
    return rows[a_length % 3][b_length];
}

Suggestion suggest_begin(const char *word, size_t length)
{
    return (Suggestion){.word = word, .word_length = length};
}

void suggest_offer(Suggestion *suggestion, const char *candidate, size_t length)
{
    const size_t word = suggestion->word_length;
    const size_t longer = word > length ? word : length;
    const u32 allowed = (u32)(longer + 2) / 4; // one from two letters, two from six
    const size_t difference = word > length ? word - length : length - word;
    if (longer > SUGGEST_WORD_MAX || word < 2 || difference > allowed)
        return;
    const u32 steps = distance(suggestion->word, word, candidate, length);
    if (steps > allowed || steps >= length || (suggestion->best && steps >= suggestion->best_distance))
        return;
    suggestion->best = candidate;
    suggestion->best_length = length;
    suggestion->best_distance = steps;
}

const char *suggest_text(const Suggestion *suggestion, char text[SUGGEST_TEXT_MAX])
{
    text[0] = 0;
    if (suggestion->best)
        snprintf(text, SUGGEST_TEXT_MAX, "; did you mean '%.*s'?", (int)suggestion->best_length,
                 suggestion->best);
    return text;
}
