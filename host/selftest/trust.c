#include "selftest/trust.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "selftest/selftest.h"

enum { PATH_BYTES = 4096, LINE_BYTES = 1024, LINES_KEPT = 32 };

// The file's path; false where the user has no cache or its name is too long.
static bool file_path(const char *folder, char path[PATH_BYTES])
{
    const char *cache = folder ? folder : getenv("XDG_CACHE_HOME");
    int length = -1;
    if (cache && cache[0] == '/')
        length = snprintf(path, PATH_BYTES, "%s/clrt/devices", cache);
    else if (getenv("HOME") && getenv("HOME")[0] == '/')
        length = snprintf(path, PATH_BYTES, "%s/.cache/clrt/devices", getenv("HOME"));
    return length > 0 && length < PATH_BYTES;
}

// What tells a device, its driver and this program from all others, as a line.
static void line_of(const DeviceInfo *info, char line[LINE_BYTES])
{
    snprintf(line, LINE_BYTES - 1, "%s\t%s\t%s\t%s", CLRT_VERSION, info->platform_name, info->name,
             info->driver);
    for (char *c = line; *c; c++)
        if (*c == '\n' || *c == '\r')
            *c = ' ';
    strcat(line, "\n");
}

// The lines of the file but the one given, at most the last LINES_KEPT - 1 of them; returns whether that was
// among them. lines may be NULL.
static bool read_lines(const char *path, const char *line, char lines[LINES_KEPT][LINE_BYTES], u32 *count)
{
    FILE *file = fopen(path, "r");
    char next[LINE_BYTES];
    bool found = false;
    *count = 0;
    while (file && fgets(next, sizeof next, file)) {
        if (strcmp(next, line) == 0)
            found = true;
        else if (lines && strchr(next, '\n')) {
            if (*count == LINES_KEPT - 1)
                memmove(lines[0], lines[1], --*count * sizeof lines[0]);
            strcpy(lines[(*count)++], next);
        }
    }
    if (file)
        fclose(file);
    return found;
}

bool trust_remembers(const char *folder, const DeviceInfo *info)
{
    char path[PATH_BYTES], line[LINE_BYTES];
    u32 count;
    line_of(info, line);
    return file_path(folder, path) && read_lines(path, line, NULL, &count);
}

// Makes the folders above the file; those above the cache itself must be there.
static void make_folders(char *path)
{
    char *last = strrchr(path, '/');
    *last = '\0';
    char *above = strrchr(path, '/');
    *above = '\0';
    mkdir(path, 0700);
    *above = '/';
    mkdir(path, 0700);
    *last = '/';
}

static bool write_lines(const char *path, char lines[LINES_KEPT][LINE_BYTES], u32 count)
{
    char temporary[PATH_BYTES + 16];
    snprintf(temporary, sizeof temporary, "%s.XXXXXX", path);
    const int descriptor = mkstemp(temporary);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
    if (!file) {
        if (descriptor >= 0)
            close(descriptor);
        return false;
    }
    for (u32 i = 0; i < count; i++)
        fputs(lines[i], file);
    const bool sound = !ferror(file);
    const bool ok = fclose(file) == 0 && sound && rename(temporary, path) == 0;
    if (!ok)
        unlink(temporary);
    return ok;
}

bool trust_remember(const char *folder, const DeviceInfo *info)
{
    char path[PATH_BYTES];
    if (!file_path(folder, path))
        return false;
    char(*lines)[LINE_BYTES] = malloc(LINES_KEPT * sizeof *lines);
    if (!lines)
        return false;
    char line[LINE_BYTES];
    u32 count;
    line_of(info, line);
    make_folders(path);
    read_lines(path, line, lines, &count);
    strcpy(lines[count++], line);
    const bool ok = write_lines(path, lines, count);
    free(lines);
    return ok;
}

bool trust_device(Device *device, bool *asked, Error *error)
{
    const DeviceInfo *info = device_info(device);
    const bool known = trust_remembers(NULL, info);
    SelfTestReport report;
    Error reason;
    if (asked)
        *asked = !known;
    if (known)
        return true;
    if (!selftest_run_short(device, &report, error))
        return false;
    if (!selftest_verdict(&report, &reason))
        return error_set(error, reason.code,
                         "%s gives wrong answers: %s\n"
                         "clrt --self-test says more, --force-device renders all the same",
                         info->name, reason.text);
    trust_remember(NULL, info);
    return true;
}
