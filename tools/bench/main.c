// clrt-bench: rays a second of clrt's traversal and of Embree's, on generated scenes and meshes of files.
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "report.h"

enum { FIRST_SIZE = 10000, LAST_SIZE = 10000000 };

static Device *open_device(const BenchOptions *options, Error *error)
{
    const char *spec = options->device ? options->device : getenv("CLRT_DEVICE");
    DeviceList *list = device_list_create(error);
    u32 index;
    Device *device = NULL;
    if (list && device_choose(list, spec, &index, error))
        device = device_open(&list->devices[index], &(DeviceOptions){.threads = options->threads}, error);
    device_list_destroy(list);
    return device;
}

// Sizes 1, 2, 5, 10, ... times the first, up to the last.
static u32 next_size(u32 size, u32 last)
{
    u32 decade = 1;
    while (decade <= size / 10)
        decade *= 10;
    const u32 next = size / decade == 1 ? 2 * decade : size / decade == 2 ? 5 * decade : 10 * decade;
    return size == last ? last + 1 : next > last ? last : next;
}

static bool measure_sizes(const Bench *bench, SceneResult *results, u32 *count, Error *error)
{
    const u32 last = bench->options->triangles ? bench->options->triangles : LAST_SIZE;
    const u32 first = last < FIRST_SIZE ? last : FIRST_SIZE;
    for (u32 size = first; size <= last && *count < SCENES_MAX; size = next_size(size, last), ++*count)
        if (!measure_scene(bench, bench->options->scenes[0], size, &results[*count], error))
            return false;
    return true;
}

static bool measure_all(const Bench *bench, SceneResult *results, u32 *count, Error *error)
{
    const BenchOptions *options = bench->options;
    if (options->action == ACTION_SCALING)
        return measure_sizes(bench, results, count, error);
    for (; *count < options->scene_count; ++*count)
        if (!measure_scene(bench, options->scenes[*count], options->triangles, &results[*count], error))
            return false;
    return true;
}

static bool report(const Bench *bench, const SceneResult *results, u32 count, Error *error)
{
    const BenchOptions *options = bench->options;
    const DeviceInfo *info = device_info(bench->device);
    const Setting setting = {info->name, info->driver, bench->threads};
    if (options->action == ACTION_SCALING)
        report_scaling(results, count);
    else
        report_text(results, count, options, &setting);
    if (fflush(stdout) != 0 || ferror(stdout))
        return error_set(error, ERROR_IO, "standard output: %s", strerror(errno));
    if (options->json && !report_json(results, count, options, &setting, error))
        return false;
    u32 wrong = 0;
    for (u32 i = 0; i < count; i++)
        for (u32 k = 0; k < results[i].set_count; k++)
            wrong += results[i].sets[k].verdict.wrong;
    return wrong == 0 || error_set(error, ERROR_SELF_TEST, "%u hits are wrong", wrong);
}

static bool run(const BenchOptions *options, Error *error)
{
    Bench bench = {.options = options, .device = open_device(options, error)};
    if (!bench.device)
        return false;
    // Embree has the threads of the device where that is this processor, else all.
    const DeviceInfo *info = device_info(bench.device);
    bench.threads = options->threads ? options->threads : info->type == DEVICE_CPU ? info->compute_units : 0;
#ifdef _OPENMP
    bench.threads = bench.threads ? bench.threads : (u32)omp_get_num_procs();
    omp_set_num_threads((int)bench.threads);
#endif
    bench.threads = bench.threads ? bench.threads : 1;
    u32 count = 0;
    SceneResult *results = calloc(SCENES_MAX, sizeof *results);
    bench.pool = pool_create(bench.threads, error);
    bool ok = bench.pool && (results || error_set(error, ERROR_MEMORY, "no memory for the results"));
    ok = ok && measure_all(&bench, results, &count, error) && report(&bench, results, count, error);
    free(results);
    pool_destroy(bench.pool);
    device_close(bench.device);
    return ok;
}

int main(int argc, char **argv)
{
    BenchOptions options;
    Error error = {.code = ERROR_NONE};
    bool ok = options_parse(argc, argv, &options, &error);
    if (ok && options.action == ACTION_HELP)
        options_print_usage();
    else if (ok && options.action == ACTION_VERSION)
        puts("clrt-bench " CLRT_VERSION);
    else if (ok)
        ok = run(&options, &error);
    options_destroy(&options);
    if (ok && (fflush(stdout) != 0 || ferror(stdout)))
        ok = error_set(&error, ERROR_IO, "standard output: %s", strerror(errno));
    if (ok)
        return 0;
    fprintf(stderr, "clrt-bench: %s\n", error.text);
    if (error.code == ERROR_USAGE)
        fputs("clrt-bench --help shows the options\n", stderr);
    return (int)error.code;
}
