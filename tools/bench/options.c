#include "options.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

void options_print_usage(void)
{
    printf("usage: clrt-bench [options]\n"
           "\n"
           "Traces sets of rays through a scene, with clrt's kernels and with Embree %s\n"
           "in turns, and reports millions of rays a second, ratios and mismatches.\n"
           "\n"
           "      --scene LIST     of the scenes below and paths of meshes; default: all of them\n"
           "      --triangles N    of a scene, about; a scene's own number without it\n"
           "      --rays LIST      of the sets: ",
           embree_version() ? embree_version() : "(not built in)");
    for (int k = 0; k < RAY_KINDS; k++)
        printf("%s%s", k ? "," : "", ray_kind_name(k));
    printf("\n"
           "      --size N         pixels of each side of the image; default 1024\n"
           "      --rounds N       in which each contender has a turn, 1 to %d; default 5\n"
           "      --turn SECONDS   least length of a turn, by repeating a set; default 0.05\n"
           "      --builds N       of the hierarchies, of which the median counts; default 3\n"
           "  -d, --device SPEC    as clrt has it\n"
           "      --threads N      of CPU devices, of Embree and of the builders; default all\n"
           "      --no-embree      clrt alone\n"
           "      --modes LIST     of Embree: 1,8,16,16-coherent,stream,stream-coherent; default all\n"
           "      --flags LIST     of Embree's scenes: robust,fast; default both\n"
           "      --high           Embree builds at RTC_BUILD_QUALITY_HIGH\n"
           "      --no-visits      do not count nodes and leaves, which takes a second program\n"
           "      --check          compare hits with a search of all primitives in double\n"
           "      --scaling        from 10^4 triangles to --triangles (default 10^7): a table as CSV\n"
           "      --markdown       print the tables as Markdown\n"
           "      --json FILE      write all figures\n"
           "  -h, --help           this text\n"
           "      --version        the version\n"
           "\n"
           "Scenes:\n",
           ROUNDS_MAX);
    for (int i = 0; i < SCENE_KINDS; i++)
        printf("  %-12s %s (%u)\n", scene_kinds[i].name, scene_kinds[i].meaning, scene_kinds[i].triangles);
    printf("\n"
           "Exit status: 0 done, 1 a mesh has errors, 2 usage, 3 no device or OpenCL failed, 4 a file\n"
           "could not be written, 5 --check found wrong hits, 6 out of memory.\n");
}

static bool parse_whole(const char *name, const char *text, u32 least, u32 most, u32 *value, Error *error)
{
    const char *end = text_read_whole(text, value);
    if (!end || *end || *value < least || *value > most)
        return error_set(error, ERROR_USAGE, "--%s: '%s' is not a whole number from %u to %u", name, text,
                         least, most);
    return true;
}

static bool parse_seconds(const char *text, f64 *value, Error *error)
{
    if (!text_parse_decimal(text, strlen(text), value) || !(*value >= 0 && *value <= 60))
        return error_set(error, ERROR_USAGE, "--turn: '%s' is not a number of seconds from 0 to 60", text);
    return true;
}

// Takes the next item of a list, cutting it off there; NULL at the end.
static char *next_item(char **list)
{
    char *item = *list;
    if (!item)
        return NULL;
    char *comma = strchr(item, ',');
    if (comma)
        *comma = '\0';
    *list = comma ? comma + 1 : NULL;
    return item;
}

static char *copy_list(const char *text, Error *error)
{
    char *copy = malloc(strlen(text) + 1);
    if (!copy)
        error_set(error, ERROR_MEMORY, "no memory for the options");
    else
        strcpy(copy, text);
    return copy;
}

static bool parse_scenes(const char *text, BenchOptions *options, Error *error)
{
    char *list = copy_list(text, error);
    free(options->scene_list);
    options->scene_list = list;
    if (!list)
        return false;
    options->scene_count = 0;
    for (char *item; (item = next_item(&list)) != NULL;) {
        if (options->scene_count == SCENES_MAX)
            return error_set(error, ERROR_USAGE, "--scene: more than %d scenes", SCENES_MAX);
        options->scenes[options->scene_count++] = item;
    }
    return true;
}

typedef const char *(*NameOf)(u32 index);

static const char *name_of_rays(u32 index)
{
    return ray_kind_name((RayKind)index);
}

static const char *name_of_mode(u32 index)
{
    static const char *const NAMES[EMBREE_MODES] = {"1",           "8",      "16",
                                                    "16-coherent", "stream", "stream-coherent"};
    return NAMES[index];
}

static const char *name_of_flag(u32 index)
{
    return index == 0 ? "robust" : "fast";
}

// Sets chosen[k] for each name of the list; the others are false.
static bool parse_names(const char *option, const char *text, NameOf name_of, u32 count, bool *chosen,
                        Error *error)
{
    char *const copy = copy_list(text, error);
    char *list = copy;
    bool ok = copy != NULL;
    memset(chosen, 0, count * sizeof *chosen);
    for (char *item; ok && (item = next_item(&list)) != NULL;) {
        u32 k = 0;
        while (k < count && strcmp(item, name_of(k)) != 0)
            k++;
        ok = k < count || error_set(error, ERROR_USAGE, "--%s: there is no '%s'", option, item);
        if (ok)
            chosen[k] = true;
    }
    free(copy);
    return ok;
}

enum {
    OPTION_SCENE = 256,
    OPTION_TRIANGLES,
    OPTION_RAYS,
    OPTION_SIZE,
    OPTION_ROUNDS,
    OPTION_TURN,
    OPTION_BUILDS,
    OPTION_THREADS,
    OPTION_NO_EMBREE,
    OPTION_MODES,
    OPTION_FLAGS,
    OPTION_HIGH,
    OPTION_NO_VISITS,
    OPTION_CHECK,
    OPTION_SCALING,
    OPTION_MARKDOWN,
    OPTION_JSON,
    OPTION_VERSION
};

static const struct option LONG_OPTIONS[] = {
    {"scene", required_argument, NULL, OPTION_SCENE},
    {"triangles", required_argument, NULL, OPTION_TRIANGLES},
    {"rays", required_argument, NULL, OPTION_RAYS},
    {"size", required_argument, NULL, OPTION_SIZE},
    {"rounds", required_argument, NULL, OPTION_ROUNDS},
    {"turn", required_argument, NULL, OPTION_TURN},
    {"builds", required_argument, NULL, OPTION_BUILDS},
    {"device", required_argument, NULL, 'd'},
    {"threads", required_argument, NULL, OPTION_THREADS},
    {"no-embree", no_argument, NULL, OPTION_NO_EMBREE},
    {"modes", required_argument, NULL, OPTION_MODES},
    {"flags", required_argument, NULL, OPTION_FLAGS},
    {"high", no_argument, NULL, OPTION_HIGH},
    {"no-visits", no_argument, NULL, OPTION_NO_VISITS},
    {"check", no_argument, NULL, OPTION_CHECK},
    {"scaling", no_argument, NULL, OPTION_SCALING},
    {"markdown", no_argument, NULL, OPTION_MARKDOWN},
    {"json", required_argument, NULL, OPTION_JSON},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};

static bool take_list(int option, const char *text, BenchOptions *o, Error *error)
{
    if (option == OPTION_SCENE)
        return parse_scenes(text, o, error);
    if (option == OPTION_RAYS)
        return parse_names("rays", text, name_of_rays, RAY_KINDS, o->rays, error);
    if (option == OPTION_MODES)
        return parse_names("modes", text, name_of_mode, EMBREE_MODES, o->modes, error);
    bool flags[2];
    if (!parse_names("flags", text, name_of_flag, 2, flags, error))
        return false;
    o->robust = flags[0];
    o->fast = flags[1];
    return true;
}

static bool take_option(int option, const char *argument, BenchOptions *o, Error *error)
{
    switch (option) {
    case OPTION_TRIANGLES:
        return parse_whole("triangles", argument, 1, 1u << 30, &o->triangles, error);
    case OPTION_SIZE:
        return parse_whole("size", argument, 1, 8192, &o->size, error);
    case OPTION_ROUNDS:
        return parse_whole("rounds", argument, 1, ROUNDS_MAX, &o->rounds, error);
    case OPTION_TURN:
        return parse_seconds(argument, &o->turn_seconds, error);
    case OPTION_BUILDS:
        return parse_whole("builds", argument, 1, ROUNDS_MAX, &o->builds, error);
    case OPTION_THREADS:
        return parse_whole("threads", argument, 1, 4096, &o->threads, error);
    case 'd':
        o->device = argument;
        break;
    case OPTION_NO_EMBREE:
        o->embree = false;
        break;
    case OPTION_HIGH:
        o->high = true;
        break;
    case OPTION_NO_VISITS:
        o->visits = false;
        break;
    case OPTION_CHECK:
        o->check = true;
        break;
    case OPTION_SCALING:
        o->action = ACTION_SCALING;
        break;
    case OPTION_MARKDOWN:
        o->markdown = true;
        break;
    case OPTION_JSON:
        o->json = argument;
        break;
    case 'h':
        o->action = ACTION_HELP;
        break;
    case OPTION_VERSION:
        o->action = ACTION_VERSION;
        break;
    default:
        return take_list(option, argument, o, error);
    }
    return true;
}

static void set_defaults(BenchOptions *o)
{
    *o = (BenchOptions){.size = 1024, .rounds = 5, .turn_seconds = 0.05, .builds = 3, .robust = true,
                        .fast = true, .visits = true, .embree = embree_version() != NULL};
    for (int k = 0; k < RAY_KINDS; k++)
        o->rays[k] = true;
    for (int k = 0; k < EMBREE_MODES; k++)
        o->modes[k] = true;
    for (u32 i = 0; i < SCENE_KINDS; i++)
        o->scenes[o->scene_count++] = scene_kinds[i].name;
}

bool options_parse(int argc, char **argv, BenchOptions *options, Error *error)
{
    set_defaults(options);
    opterr = 0;
    for (;;) {
        // The colon tells a missing argument from an unknown option.
        const int option = getopt_long(argc, argv, ":hd:", LONG_OPTIONS, NULL);
        if (option == -1)
            break;
        if (option == ':')
            return error_set(error, ERROR_USAGE, "%s: an argument is missing", argv[optind - 1]);
        if (option == '?')
            return error_set(error, ERROR_USAGE, "%s: not an option of clrt-bench", argv[optind - 1]);
        if (!take_option(option, optarg, options, error))
            return false;
        if (options->action == ACTION_HELP || options->action == ACTION_VERSION)
            return true;
    }
    if (optind < argc)
        return error_set(error, ERROR_USAGE, "%s: not an option of clrt-bench", argv[optind]);
    for (int k = 0; k < EMBREE_MODES; k++)
        options->modes[k] = options->modes[k] && options->embree && embree_has_mode((EmbreeMode)k);
    return true;
}

void options_destroy(BenchOptions *options)
{
    free(options->scene_list);
}
