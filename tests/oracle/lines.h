/* Text of OBJ and MTL files: lines, joined where a backslash ends one, without comments, cut into words. */
#ifndef ORACLE_LINES_H
#define ORACLE_LINES_H

#include <stdbool.h>

#include "store.h"

typedef struct Lines {
    Store *store;
    const char *path;
    char *at;    /* the text that follows; words are cut out of it */
    int line;    /* number of the line in hand, from 1 */
    char **words;
    size_t count;
} Lines;

/* False where the file cannot be opened. */
bool lines_open(Lines *lines, Store *store, const char *path);
/* Goes on to the next line that has words; false at the end. */
bool lines_next(Lines *lines);
/* The words from the second on with one blank between them: a name that may have blanks. */
char *lines_rest(const Lines *lines);
/* The word at that place as a number. */
double lines_number(const Lines *lines, size_t word);
/* Whether it is one. */
bool lines_has_number(const Lines *lines, size_t word);

#endif
