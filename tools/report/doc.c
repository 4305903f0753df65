#include "doc.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

enum { KEY_BYTES = 128 };

// The first key of a path into key; what follows its dot, or NULL where it is the last.
static const char *split(const char *path, char key[KEY_BYTES])
{
    const size_t length = strcspn(path, ".");
    snprintf(key, KEY_BYTES, "%.*s", (int)length, path);
    return path[length] ? path + length + 1 : NULL;
}

json_t *doc_at(const json_t *from, const char *path)
{
    json_t *at = NULL;
    while (from && path) {
        char key[KEY_BYTES];
        path = split(path, key);
        u32 index;
        const char *rest = json_is_array(from) ? text_read_whole(key, &index) : NULL;
        at = rest ? json_array_get(from, index) : json_object_get(from, key);
        from = at;
    }
    return path ? NULL : at;
}

f64 doc_number(const json_t *from, const char *path)
{
    const json_t *at = doc_at(from, path);
    return json_is_number(at) ? json_number_value(at) : (f64)NAN;
}

const char *doc_text(const json_t *from, const char *path)
{
    return json_string_value(doc_at(from, path));
}

json_t *doc_real(f64 value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *doc_whole(u64 value)
{
    return json_integer((json_int_t)value);
}

json_t *doc_string(const char *text)
{
    json_t *string = text ? json_string(text) : NULL;
    return string ? string : json_null();
}

void doc_set(json_t *into, const char *path, json_t *value)
{
    char key[KEY_BYTES];
    const char *rest = split(path, key);
    for (; rest && into; rest = split(rest, key))
        into = json_object_get(into, key);
    json_object_set_new(into, key, value ? value : json_null());
}

json_t *doc_spread(const f64 *values, size_t count)
{
    return json_pack("{s:o, s:o}", "median", doc_real(statistics_median(values, count)), "mad",
                     doc_real(count > 1 ? statistics_mad(values, count) : (f64)NAN));
}

void doc_set_estimate(json_t *into, const char *path, Estimate estimate)
{
    char name[KEY_BYTES];
    doc_set(into, path, doc_real(estimate.value));
    snprintf(name, sizeof name, "%s_low", path);
    doc_set(into, name, doc_real(estimate.low));
    snprintf(name, sizeof name, "%s_high", path);
    doc_set(into, name, doc_real(estimate.high));
}

json_t *doc_read(const char *path, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
        return NULL;
    }
    json_error_t at;
    json_t *document = json_loadf(file, JSON_REJECT_DUPLICATES, &at);
    fclose(file);
    if (!document)
        error_set(error, ERROR_IO, "%s:%d:%d: %s", path, at.line, at.column, at.text);
    return document;
}

bool doc_write(const json_t *document, bool lines, const char *path, Error *error)
{
    const size_t digits = JSON_REAL_PRECISION(17);
    FILE *file = fopen(path, "wb");
    if (!file)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    bool ok = true;
    if (lines) {
        size_t i;
        json_t *one;
        json_array_foreach (document, i, one)
            ok = ok && json_dumpf(one, file, JSON_COMPACT | digits) == 0 && fputc('\n', file) != EOF;
    } else {
        ok = json_dumpf(document, file, JSON_INDENT(2) | digits) == 0 && fputc('\n', file) != EOF;
    }
    ok = fclose(file) == 0 && ok;
    return ok || error_set(error, ERROR_IO, "%s: cannot be written", path);
}
