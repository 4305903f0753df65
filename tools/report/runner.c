#include "runner.h"

#include <stdio.h>
#include <string.h>

#include "child.h"
#include "doc.h"
#include "folder.h"

enum { WORDS_MAX = 64 };

typedef struct Command {
    const char *words[WORDS_MAX + 1];
    u32 count;
} Command;

static void add(Command *command, const char *word)
{
    if (command->count < WORDS_MAX)
        command->words[command->count++] = word;
}

static void add_value(Command *command, const char *option, const char *value)
{
    if (!value)
        return;
    add(command, option);
    add(command, value);
}

// A failed run as an error with clrt's own words.
static bool fail(const Runner *runner, int status, const char *talk, Error *error)
{
    const ErrorCode code = status > 0 && status <= ERROR_TIME ? (ErrorCode)status
                           : status == ERROR_INTERRUPTED      ? ERROR_INTERRUPTED
                                                              : ERROR_IO;
    return error_set(error, code, "%s ended with status %d%s%s", runner->clrt, status, *talk ? ":\n" : "",
                     talk);
}

static Command command_of(const Runner *runner, const Shot *shot, const char *stats_option,
                          char numbers[3][32])
{
    Command command = {.count = 0};
    const char *math = shot->math ? shot->math : shot->mode ? shot->mode->math : "exact";
    snprintf(numbers[0], sizeof numbers[0], "%ux%u", shot->width, shot->height);
    snprintf(numbers[1], sizeof numbers[1], "%u", shot->samples);
    snprintf(numbers[2], sizeof numbers[2], "%u", shot->seed);
    add(&command, runner->clrt);
    add(&command, "--quiet");
    add(&command, "--force-device"); // known answers of a device's first use are not what is measured
    add_value(&command, "--device", runner->device);
    add(&command, stats_option);
    add_value(&command, "--size", shot->width ? numbers[0] : NULL);
    add_value(&command, "--samples", shot->samples ? numbers[1] : NULL);
    add_value(&command, "--seed", shot->seed_given ? numbers[2] : NULL);
    add_value(&command, "--crop", shot->crop);
    add_value(&command, "--aov", shot->aov);
    for (u32 i = 0; shot->mode && i < shot->mode->word_count; i++)
        add(&command, shot->mode->words[i]);
    if (strcmp(math, "exact") != 0) // the default, which any clrt has
        add_value(&command, "--math", math);
    add(&command, "--");
    add(&command, shot->scene);
    add(&command, shot->image);
    return command;
}

// Where the drivers that are known keep compiled kernels, in a folder that is empty; NULL when memory is
// exhausted.
static const char **empty_caches(Runner *runner, const char **folder)
{
    static const char *const NAMES[] = {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "CUDA_CACHE_PATH",
                                        "NEO_CACHE_DIR", "AMD_COMGR_CACHE_DIR"};
    enum { NAME_COUNT = sizeof NAMES / sizeof NAMES[0] };
    const char **environment = arena_alloc(runner->arena, NAME_COUNT + 1, sizeof *environment);
    *folder = text_format(runner->arena, "%s/cache-%u", runner->folder, runner->cold_count++);
    for (u32 i = 0; environment && *folder && i < NAME_COUNT; i++)
        if (!(environment[i] = text_format(runner->arena, "%s=%s", NAMES[i], *folder)))
            return NULL;
    return *folder ? environment : NULL;
}

bool runner_try(Runner *runner, const Shot *shot, Shown *shown, Error *error)
{
    const char *stats = text_format(runner->arena, "%s/stats.json", runner->folder);
    const char *talk = text_format(runner->arena, "%s/talk", runner->folder);
    const char *stats_option = stats ? text_format(runner->arena, "--stats=%s", stats) : NULL;
    const char *caches = NULL;
    const char **environment = shot->cold ? empty_caches(runner, &caches) : NULL;
    if (!talk || !stats_option || (shot->cold && !environment))
        return error_set(error, ERROR_MEMORY, "no memory for a command line");
    if (caches && !folder_make(caches, error))
        return false;
    char numbers[3][32];
    const Command command = command_of(runner, shot, stats_option, numbers);
    const Child child = {.argv = command.words, .environment = environment, .talk_path = talk};
    ChildEnd end;
    const bool ran = child_run(&child, &end, error);
    if (caches)
        folder_remove(caches);
    if (!ran)
        return false;
    *shown = (Shown){.wall_seconds = end.seconds, .status = end.status};
    snprintf(shown->talk, sizeof shown->talk, "%.*s", (int)sizeof shown->talk - 1, end.talk);
    if (end.status == 0)
        shown->stats = doc_read(stats, error);
    remove(stats);
    return end.status != 0 || shown->stats;
}

bool runner_render(Runner *runner, const Shot *shot, Shown *shown, Error *error)
{
    return runner_try(runner, shot, shown, error) &&
           (shown->status == 0 || fail(runner, shown->status, shown->talk, error));
}

static bool run_plain(Runner *runner, const char *const *argv, ChildEnd *end, Error *error)
{
    const char *talk = text_format(runner->arena, "%s/talk", runner->folder);
    if (!talk)
        return error_set(error, ERROR_MEMORY, "no memory for a command line");
    const Child child = {.argv = argv, .talk_path = talk};
    return child_run(&child, end, error);
}

bool runner_check(Runner *runner, const char *scene, Error *error)
{
    const char *const argv[] = {runner->clrt, "--quiet", "--check", "--", scene, NULL};
    ChildEnd end;
    return run_plain(runner, argv, &end, error) &&
           (end.status == 0 || fail(runner, end.status, end.talk, error));
}

json_t *runner_self_test(Runner *runner, Error *error)
{
    const char *path = text_format(runner->arena, "%s/self_test.json", runner->folder);
    const char *option = path ? text_format(runner->arena, "--self-test=%s", path) : NULL;
    const char *const argv[] = {runner->clrt, option, runner->device ? "--device" : NULL, runner->device,
                                NULL};
    ChildEnd end;
    if (!option)
        error_set(error, ERROR_MEMORY, "no memory for a command line");
    else if (run_plain(runner, argv, &end, error)) {
        if (end.status == 0 || end.status == ERROR_SELF_TEST)
            return doc_read(path, error);
        fail(runner, end.status, end.talk, error);
    }
    return NULL;
}
