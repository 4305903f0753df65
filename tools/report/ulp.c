#include "ulp.h"

#include "base/types.h"
#include "doc.h"

static bool is_number_or_null(const json_t *value)
{
    return !value || json_is_null(value) || json_is_number(value);
}

static bool is_histogram(const json_t *histogram)
{
    size_t i;
    json_t *bin;
    json_array_foreach (histogram, i, bin)
        if (!is_number_or_null(json_object_get(bin, "ulp")) || !json_is_number(json_object_get(bin, "count")))
            return false;
    return json_is_array(histogram);
}

static bool is_shape(const json_t *shape)
{
    return json_is_string(json_object_get(shape, "name")) &&
           is_number_or_null(json_object_get(shape, "rays")) &&
           is_number_or_null(json_object_get(shape, "max_ulp")) &&
           is_number_or_null(json_object_get(shape, "p99_ulp")) &&
           is_histogram(json_object_get(shape, "histogram"));
}

json_t *ulp_read(const char *path, Error *error)
{
    json_t *document = doc_read(path, error);
    if (!document)
        return NULL;
    const json_t *shapes = json_object_get(document, "shapes");
    bool ok = json_is_array(shapes) || error_set(error, ERROR_IO, "%s: has no array \"shapes\"", path);
    size_t i;
    json_t *shape;
    json_array_foreach (shapes, i, shape)
        if (ok && !is_shape(shape))
            ok = error_set(error, ERROR_IO, "%s: shape %zu is not as clrt-report reads it", path, i + 1);
    if (ok)
        return document;
    json_decref(document);
    return NULL;
}
