#include "cli/devices.h"

#include <errno.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

void devices_print(const DeviceList *list, FILE *stream)
{
    for (u32 i = 0; i < list->count; i++) {
        const DeviceInfo *info = &list->devices[i];
        fprintf(stream, "%u  %u:%u  %s  %s\n", info->index, info->platform, info->device,
                device_type_name(info->type), info->name);
        fprintf(stream, "     %s, driver %s\n", info->platform_name, info->driver);
        fprintf(stream, "     %u compute units, %.0f MiB of memory, at most %.0f MiB a buffer, %s divide%s\n",
                info->compute_units, (f64)info->memory / 1048576.0, (f64)info->allocation_max / 1048576.0,
                info->exact_divide ? "exact" : "inexact", info->fp64 ? ", fp64" : "");
        if (info->unusable[0])
            fprintf(stream, "     cannot be used: %s\n", info->unusable);
    }
    for (u32 i = 0; i < list->platform_count; i++)
        if (list->platforms[i].problem[0])
            fprintf(stream, "platform %u, %s: %s\n", i, list->platforms[i].name, list->platforms[i].problem);
}

// Names of drivers need not be UTF-8; what is not is left out.
static json_t *text_of(const char *text)
{
    json_t *string = json_string(text);
    return string ? string : json_string("?");
}

static json_t *device_to_json(const DeviceInfo *info)
{
    return json_pack("{s:i, s:i, s:i, s:o, s:o, s:o, s:o, s:I, s:I, s:i, s:i, s:b, s:b, s:o?}", "index",
                     (int)info->index, "platform", (int)info->platform, "device", (int)info->device, "name",
                     text_of(info->name), "platform_name", text_of(info->platform_name), "type",
                     text_of(device_type_name(info->type)), "driver", text_of(info->driver), "memory_bytes",
                     (json_int_t)info->memory, "allocation_max_bytes", (json_int_t)info->allocation_max,
                     "compute_units", (int)info->compute_units, "float_width", (int)info->float_width, "fp64",
                     (int)info->fp64, "exact_divide", (int)info->exact_divide, "unusable",
                     info->unusable[0] ? text_of(info->unusable) : NULL);
}

static json_t *platform_to_json(const PlatformInfo *platform)
{
    return json_pack("{s:o, s:o, s:i, s:o?}", "name", text_of(platform->name), "version",
                     text_of(platform->version), "device_count", (int)platform->device_count, "problem",
                     platform->problem[0] ? text_of(platform->problem) : NULL);
}

bool devices_print_json(const DeviceList *list, FILE *stream, Error *error)
{
    json_t *devices = json_array(), *platforms = json_array();
    bool ok = devices && platforms;
    for (u32 i = 0; i < list->count && ok; i++)
        ok = json_array_append_new(devices, device_to_json(&list->devices[i])) == 0;
    for (u32 i = 0; i < list->platform_count && ok; i++)
        ok = json_array_append_new(platforms, platform_to_json(&list->platforms[i])) == 0;
    json_t *all = ok ? json_pack("{s:O, s:O}", "devices", devices, "platforms", platforms) : NULL;
    ok = all && json_dumpf(all, stream, JSON_INDENT(2)) == 0;
    if (ok)
        fputc('\n', stream);
    json_decref(all);
    json_decref(devices);
    json_decref(platforms);
    if (!ok && ferror(stream))
        return error_set(error, ERROR_IO, "standard output: %s", strerror(errno));
    return ok || error_set(error, ERROR_MEMORY, "no memory for the list of devices");
}

bool devices_choose(const DeviceList *list, const char *spec, u32 *index, Error *error)
{
    const char *environment = getenv("CLRT_DEVICE");
    if (spec || !environment || !environment[0])
        return device_choose(list, spec, index, error);
    Error reason;
    return device_choose(list, environment, index, &reason) ||
           error_set(error, reason.code, "CLRT_DEVICE: %s", reason.text);
}
