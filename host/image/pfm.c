#include "image/pfm.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_BYTES = 32 };

typedef struct Header {
    u32 width, height, channels;
    bool little_endian;
} Header;

// The next word between white space, and the one white space character after it. False at the end of
// the file and for a word that is too long to be any of the header's.
static bool read_word(FILE *file, char word[WORD_BYTES])
{
    int c = getc(file);
    while (c != EOF && isspace(c))
        c = getc(file);
    size_t length = 0;
    for (; c != EOF && !isspace(c); c = getc(file)) {
        if (length + 1 == WORD_BYTES)
            return false;
        word[length++] = (char)c;
    }
    word[length] = 0;
    return length > 0 && c != EOF;
}

static bool read_size(FILE *file, u32 *size)
{
    char word[WORD_BYTES];
    if (!read_word(file, word) || !isdigit((unsigned char)word[0]))
        return false;
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(word, &end, 10);
    if (*end || errno || value == 0 || value > UINT32_MAX)
        return false;
    *size = (u32)value;
    return true;
}

static bool read_header(FILE *file, Header *header)
{
    char word[WORD_BYTES];
    if (!read_word(file, word))
        return false;
    if (strcmp(word, "PF") == 0)
        header->channels = 3;
    else if (strcmp(word, "Pf") == 0)
        header->channels = 1;
    else
        return false;
    if (!read_size(file, &header->width) || !read_size(file, &header->height) || !read_word(file, word))
        return false;
    char *end;
    const f64 scale = strtod(word, &end);
    if (*end || !isfinite(scale) || scale == 0)
        return false;
    header->little_endian = scale < 0;
    return true;
}

static void decode_values(f32 *values, const u8 *bytes, size_t count, bool little_endian)
{
    for (size_t i = 0; i < count; i++, bytes += 4) {
        const u32 bits = little_endian
                             ? bytes[0] | (u32)bytes[1] << 8 | (u32)bytes[2] << 16 | (u32)bytes[3] << 24
                             : bytes[3] | (u32)bytes[2] << 8 | (u32)bytes[1] << 16 | (u32)bytes[0] << 24;
        memcpy(&values[i], &bits, sizeof bits);
    }
}

// Rows of the file run from the bottom up.
static bool read_rows(FILE *file, const char *path, const Header *header, const Image *image, Error *error)
{
    const size_t count = (size_t)image->width * image->channels;
    u8 *bytes = malloc(count * 4);
    if (!bytes)
        return error_set(error, ERROR_MEMORY, "%s: no memory to read the image", path);
    bool done = true;
    for (u32 y = image->height; y > 0 && done; y--) {
        done = fread(bytes, 4, count, file) == count;
        if (done)
            decode_values(image_row(image, y - 1), bytes, count, header->little_endian);
    }
    free(bytes);
    if (!done)
        return error_set(error, ERROR_IO, "%s: %s", path,
                         ferror(file) ? strerror(errno) : "the file ends too early");
    if (getc(file) != EOF)
        return error_set(error, ERROR_IO, "%s: the file is longer than its header says", path);
    return true;
}

Image *pfm_image_read(const char *path, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
        return NULL;
    }
    Header header;
    Image *image = NULL;
    if (!read_header(file, &header))
        error_set(error, ERROR_IO, "%s: not a PFM file", path);
    else
        image = image_create(header.width, header.height, header.channels, error);
    if (image && !read_rows(file, path, &header, image, error)) {
        image_destroy(image);
        image = NULL;
    }
    fclose(file);
    return image;
}
