#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "device/list.h"

enum { NONE = -1, SEVERAL = -2 };

static bool equals_ignoring_case(const char *a, const char *b, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (tolower((unsigned char)a[i]) != tolower((unsigned char)b[i]))
            return false;
    return true;
}

static bool contains(const char *text, const char *part)
{
    const size_t length = strlen(part);
    for (; strlen(text) >= length; text++)
        if (equals_ignoring_case(text, part, length))
            return true;
    return false;
}

static bool is_text(const char *text, const char *other)
{
    return strlen(text) == strlen(other) && equals_ignoring_case(text, other, strlen(text));
}

static bool name_fits(const DeviceInfo *info, const char *spec, bool whole)
{
    if (whole)
        return is_text(info->name, spec);
    return contains(info->name, spec) || contains(info->platform_name, spec);
}

// The only device whose name fits spec, or NONE or SEVERAL.
static i64 find_name(const DeviceList *list, const char *spec, bool whole)
{
    i64 found = NONE;
    for (u32 i = 0; i < list->count; i++)
        if (name_fits(&list->devices[i], spec, whole))
            found = found == NONE ? (i64)i : SEVERAL;
    return found;
}

static i64 find_usable(const DeviceList *list, DeviceType type)
{
    for (u32 i = 0; i < list->count; i++)
        if (list->devices[i].type == type && !list->devices[i].unusable[0])
            return i;
    return NONE;
}

static i64 find_default(const DeviceList *list)
{
    static const DeviceType ORDER[] = {DEVICE_GPU, DEVICE_CPU, DEVICE_OTHER};
    i64 found = NONE;
    for (size_t i = 0; i < sizeof ORDER / sizeof ORDER[0] && found == NONE; i++)
        found = find_usable(list, ORDER[i]);
    return found;
}

// Understands N and P:D; false where spec is neither. A place without a device gives NONE.
static bool find_place(const DeviceList *list, const char *spec, i64 *found)
{
    u32 first = 0, second = 0;
    const char *rest = text_read_whole(spec, &first);
    if (rest && *rest == '\0') {
        *found = first < list->count ? (i64)first : NONE;
        return true;
    }
    rest = rest && *rest == ':' ? text_read_whole(rest + 1, &second) : NULL;
    if (!rest || *rest != '\0')
        return false;
    *found = NONE;
    for (u32 i = 0; i < list->count; i++)
        if (list->devices[i].platform == first && list->devices[i].device == second)
            *found = i;
    return true;
}

// Writes a line for each device, or for each whose name fits spec where it is given.
static void describe(const DeviceList *list, const char *spec, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (u32 i = 0; i < list->count && used < size; i++) {
        const DeviceInfo *info = &list->devices[i];
        if (spec && !name_fits(info, spec, false))
            continue;
        const int length = snprintf(text + used, size - used, "\n  %u  %u:%u  %s  %s (%s)%s%s", info->index,
                                    info->platform, info->device, device_type_name(info->type), info->name,
                                    info->platform_name, info->unusable[0] ? ": " : "", info->unusable);
        used += length > 0 ? (size_t)length : 0;
    }
}

bool device_choose(const DeviceList *list, const char *spec, u32 *index, Error *error)
{
    char lines[3072];
    i64 found = NONE;
    if (!spec) {
        found = find_default(list);
        if (found == NONE) {
            describe(list, NULL, lines, sizeof lines);
            return error_set(error, ERROR_DEVICE, "no OpenCL device is usable:%s", lines);
        }
    } else if (spec[0] == '\0') {
        return error_set(error, ERROR_USAGE, "the name of a device is empty");
    } else if (is_text(spec, "all")) {
        return error_set(error, ERROR_USAGE, "device 'all': several devices at once are not supported yet");
    } else if (is_text(spec, "cpu") || is_text(spec, "gpu")) {
        found = find_usable(list, is_text(spec, "cpu") ? DEVICE_CPU : DEVICE_GPU);
    } else if (!find_place(list, spec, &found)) {
        found = find_name(list, spec, true);
        if (found < 0)
            found = find_name(list, spec, false);
    }
    if (found == SEVERAL) {
        describe(list, spec, lines, sizeof lines);
        return error_set(error, ERROR_USAGE, "device '%s' is ambiguous; it fits%s", spec, lines);
    }
    if (found == NONE) {
        describe(list, NULL, lines, sizeof lines);
        return error_set(error, ERROR_DEVICE, "there is no device '%s'; there is%s", spec, lines);
    }
    const DeviceInfo *info = &list->devices[found];
    if (info->unusable[0])
        return error_set(error, ERROR_DEVICE, "device %u, %s, cannot be used: %s", info->index, info->name,
                         info->unusable);
    *index = (u32)found;
    return true;
}
