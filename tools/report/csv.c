#include "csv.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "base/types.h"
#include "doc.h"

enum { NAME_BYTES = 256, LINE_BYTES = 512 };

static bool close_file(FILE *file, const char *path, Error *error)
{
    const bool broken = ferror(file);
    return (fclose(file) == 0 && !broken) || error_set(error, ERROR_IO, "%s: cannot be written", path);
}

static FILE *open_file(const char *path, Error *error)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    return file;
}

// RFC 4180.
static void put_text(FILE *file, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, file);
        return;
    }
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

static void put_words(FILE *file, const json_t *array)
{
    size_t i;
    json_t *word;
    json_array_foreach (array, i, word)
        fprintf(file, "%s%s", i ? " " : "", json_is_string(word) ? json_string_value(word) : "");
}

static void put_value(FILE *file, const json_t *value)
{
    if (json_is_string(value))
        put_text(file, json_string_value(value));
    else if (json_is_integer(value))
        fprintf(file, "%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        fprintf(file, "%.17g", json_real_value(value));
    else if (json_is_boolean(value))
        fputs(json_is_true(value) ? "true" : "false", file);
    else if (json_is_array(value))
        put_words(file, value);
}

static bool is_column(const json_t *value)
{
    return !json_is_array(value) || json_array_size(value) == 0 || json_is_string(json_array_get(value, 0));
}

// The columns of what `shape` has: their names, prefix before them, or the values of `from`, which may lack
// some.
static void put_columns(FILE *file, const json_t *shape, bool names, const json_t *from, const char *prefix,
                        bool *first)
{
    const char *key;
    json_t *value;
    json_object_foreach ((json_t *)(uintptr_t)shape, key, value) {
        char name[NAME_BYTES];
        snprintf(name, sizeof name, "%s%s%s", prefix, *prefix ? "." : "", key);
        if (json_is_object(value)) {
            put_columns(file, value, names, json_object_get(from, key), name, first);
        } else if (is_column(value) && strcmp(key, "convergence") != 0) {
            fputs(*first ? "" : ",", file);
            *first = false;
            if (names)
                put_text(file, name);
            else
                put_value(file, json_object_get(from, key));
        }
    }
}

// Every key of any of the rows, in groups as they have them: rows whose mode could not be run have fewer.
static json_t *shape_of(const json_t *rows)
{
    json_t *shape = json_object();
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        json_t *copy = json_deep_copy(row); // the groups of a row must not become those of the shape
        json_object_update_recursive(shape, copy);
        json_decref(copy);
    }
    return shape;
}

bool csv_write_rows(const json_t *rows, const char *path, Error *error)
{
    FILE *file = open_file(path, error);
    if (!file)
        return false;
    json_t *shape = shape_of(rows);
    bool first = true;
    put_columns(file, shape, true, NULL, "", &first);
    fputs("\n", file);
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        first = true;
        put_columns(file, shape, false, row, "", &first);
        fputs("\n", file);
    }
    json_decref(shape);
    return close_file(file, path, error);
}

bool csv_write_convergence(const json_t *rows, const char *path, Error *error)
{
    static const char *const COLUMNS[] = {
        "spp",          "runs",      "rays",         "wall_s.median",  "wall_s.mad", "kernel_s.median",
        "kernel_s.mad", "mse",       "mse_low",      "mse_high",       "rmse",       "rmse_low",
        "rmse_high",    "relmse",    "psnr_db",      "flip_mean",      "ssim_mean",  "bias",
        "bias_low",     "bias_high", "per_mse_wall", "per_mse_kernel", "reason"};
    enum { COLUMN_COUNT = sizeof COLUMNS / sizeof COLUMNS[0] };
    FILE *file = open_file(path, error);
    if (!file)
        return false;
    fputs("scene,device,mode", file);
    for (size_t c = 0; c < COLUMN_COUNT; c++)
        fprintf(file, ",%s", COLUMNS[c]);
    fputs("\n", file);
    size_t i, k;
    json_t *row, *point;
    json_array_foreach (rows, i, row) {
        json_array_foreach (json_object_get(row, "convergence"), k, point) {
            put_value(file, doc_at(row, "run.scene"));
            fputc(',', file);
            put_value(file, doc_at(row, "run.device"));
            fputc(',', file);
            put_value(file, doc_at(row, "run.mode"));
            for (size_t c = 0; c < COLUMN_COUNT; c++) {
                fputc(',', file);
                put_value(file, doc_at(point, COLUMNS[c]));
            }
            fputs("\n", file);
        }
    }
    return close_file(file, path, error);
}

// ---- peers ----------------------------------------------------------------------------------

static bool read_number(const char *text, size_t length, f64 *value)
{
    return text_parse_decimal(text, length, value) && *value > 0 && *value < 1e300;
}

static bool read_peer(const char *line, Peer *peer)
{
    const size_t name = strcspn(line, ",");
    if (name == 0 || name >= sizeof peer->name || !line[name])
        return false;
    memcpy(peer->name, line, name);
    peer->name[name] = 0;
    const char *seconds = line + name + 1;
    const size_t length = strcspn(seconds, ",");
    return seconds[length] && read_number(seconds, length, &peer->seconds) &&
           read_number(seconds + length + 1, strlen(seconds + length + 1), &peer->rmse);
}

bool csv_read_peers(const char *path, Peer peers[PEERS_MAX], size_t *count, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    char line[LINE_BYTES];
    bool ok = true;
    *count = 0;
    for (unsigned number = 1; ok && fgets(line, sizeof line, file); number++) {
        line[strcspn(line, "\r\n")] = 0;
        if (!*line || *line == '#' || (number == 1 && strcmp(line, "name,seconds,rmse") == 0))
            continue;
        ok = *count < PEERS_MAX && read_peer(line, &peers[*count]);
        if (!ok)
            error_set(error, ERROR_IO,
                      "%s:%u: not a line name,seconds,rmse with numbers above 0, or more than %d", path,
                      number, PEERS_MAX);
        (*count)++;
    }
    fclose(file);
    return ok;
}
