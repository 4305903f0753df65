/* Memory that lives as long as the scene, and the one way to give up. The oracle is a tool for valid scenes:
 * whatever goes wrong ends it with a line on stderr. */
#ifndef ORACLE_STORE_H
#define ORACLE_STORE_H

#include <stddef.h>

typedef struct StoreBlock StoreBlock;

/* A list of allocations that are freed together; a zeroed Store is empty. */
typedef struct Store {
    StoreBlock *blocks;
} Store;

/* Zeroed memory, freed by store_free. */
void *store_alloc(Store *store, size_t size);
/* Array growth: returns room for one more item than `count`, with the old items copied. */
void *store_grow(Store *store, void *items, size_t count, size_t item_size);
char *store_text(Store *store, const char *text, size_t length);
/* The bytes of a file and a zero behind them; NULL where it cannot be opened. */
char *store_file(Store *store, const char *path, size_t *size);
/* The path of a file that another file names, relative to that one. */
char *store_beside(Store *store, const char *path, const char *name);
void store_free(Store *store);

/* Prints `clrt-oracle: ` and the message, and ends the program with status 2. */
__attribute__((noreturn, format(printf, 1, 2))) void die(const char *format, ...);

#endif
