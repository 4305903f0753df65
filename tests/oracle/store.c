#include "store.h"

#include <stdarg.h>
#include <stdalign.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct StoreBlock {
    StoreBlock *next;
    alignas(max_align_t) unsigned char bytes[];
};

void *store_alloc(Store *store, size_t size)
{
    StoreBlock *block = calloc(1, sizeof *block + size);
    if (block == NULL)
        die("out of memory");
    block->next = store->blocks;
    store->blocks = block;
    return block->bytes;
}

void *store_grow(Store *store, void *items, size_t count, size_t item_size)
{
    /* Capacity is the next power of two, so only a full array moves. */
    if (count != 0 && (count & (count - 1)) != 0)
        return items;
    void *grown = store_alloc(store, (count == 0 ? 1 : 2 * count) * item_size);
    if (count != 0)
        memcpy(grown, items, count * item_size);
    return grown;
}

char *store_text(Store *store, const char *text, size_t length)
{
    char *copy = store_alloc(store, length + 1);
    memcpy(copy, text, length);
    return copy;
}

char *store_file(Store *store, const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return NULL;
    char *text = NULL;
    *size = 0;
    for (;;) {
        text = store_grow(store, text, *size, 1);
        int byte = getc(file);
        if (byte == EOF)
            break;
        text[(*size)++] = (char)byte;
    }
    if (ferror(file))
        die("%s: cannot be read", path);
    fclose(file);
    text[*size] = '\0';
    return text;
}

char *store_beside(Store *store, const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    size_t folder = slash == NULL || name[0] == '/' ? 0 : (size_t)(slash - path) + 1;
    char *beside = store_alloc(store, folder + strlen(name) + 1);
    memcpy(beside, path, folder);
    strcpy(beside + folder, name);
    return beside;
}

void store_free(Store *store)
{
    while (store->blocks != NULL) {
        StoreBlock *block = store->blocks;
        store->blocks = block->next;
        free(block);
    }
}

void die(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("clrt-oracle: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(2);
}
