#include "arguments.h"

#include <ctype.h>
#include <getopt.h>
#include <math.h>
#include <string.h>

#include "base/text.h"

enum {
    SAMPLES_MAX = 1048576,
    RUNS_MAX = 1000,
    QUICK_PIXELS = 19200,
    OPTION_OUT = 256,
    OPTION_CLRT,
    OPTION_MATH,
    OPTION_VARIANT,
    OPTION_AGAINST,
    OPTION_RUNS,
    OPTION_COLD_RUNS,
    OPTION_REFERENCE_SAMPLES,
    OPTION_REFERENCE_SECONDS,
    OPTION_ULP,
    OPTION_PEERS,
    OPTION_FEATURES,
    OPTION_SELF_TEST,
    OPTION_QUICK,
    OPTION_VERSION
};

const char *arguments_usage(void)
{
    return "usage: clrt-report [options] SCENE...\n"
           "\n"
           "Measures how fast clrt renders the scenes and how wrong the pictures are: a table, and a folder "
           "with\n"
           "report.html, report.json, CSV, plots and maps.\n"
           "\n"
           "      --out DIR         the folder; a report that is there is replaced [report]\n"
           "      --clrt PATH       the renderer [beside this program]\n"
           "  -d, --device SPEC     as of clrt\n"
           "  -s, --size WxH        of all pictures [each scene's]\n"
           "  -n, --samples LIST    samples a pixel, such as 1,4,16 [1,4,16,64]\n"
           "      --math LIST       of exact, fast, double [all]\n"
           "      --variant NAME=\"OPTIONS\"\n"
           "                        one more way to render, by options of clrt; may be repeated\n"
           "      --against SCENE   take the converged reference of all scenes from this one\n"
           "      --runs N          warm runs of each kind, and seeds, at least 2 [5]\n"
           "      --cold-runs N     runs with empty kernel caches [as --runs]\n"
           "      --reference-samples N\n"
           "                        of the converged reference [32 times the most of --samples, at least "
           "128]\n"
           "      --reference-seconds S\n"
           "                        render it in double precision if that takes no longer [120]\n"
           "      --features[=LIST] measure the cost of each feature of the language added alone, too\n"
           "      --self-test       run clrt --self-test, too\n"
           "      --ulp FILE.json   embed the histograms of units in the last place, see README.md\n"
           "      --peers FILE.csv  lines name,seconds,rmse: other renderers, drawn beside\n"
           "      --quick           about a minute a scene: 19200 pixels, 1,4,16 samples, 3 runs, 1 cold\n"
           "  -q, --quiet           no progress\n"
           "  -h, --help            this text\n"
           "      --version         the version\n"
           "\n"
           "Exit status: 0 done, 1 a scene has errors, 2 usage, 3 no device or OpenCL failed, 4 a file "
           "could not\n"
           "be read or written, 6 out of memory, 130 interrupted.\n";
}

static const struct option LONG_OPTIONS[] = {
    {"out", required_argument, NULL, OPTION_OUT},
    {"clrt", required_argument, NULL, OPTION_CLRT},
    {"device", required_argument, NULL, 'd'},
    {"size", required_argument, NULL, 's'},
    {"samples", required_argument, NULL, 'n'},
    {"math", required_argument, NULL, OPTION_MATH},
    {"variant", required_argument, NULL, OPTION_VARIANT},
    {"against", required_argument, NULL, OPTION_AGAINST},
    {"runs", required_argument, NULL, OPTION_RUNS},
    {"cold-runs", required_argument, NULL, OPTION_COLD_RUNS},
    {"reference-samples", required_argument, NULL, OPTION_REFERENCE_SAMPLES},
    {"reference-seconds", required_argument, NULL, OPTION_REFERENCE_SECONDS},
    {"features", optional_argument, NULL, OPTION_FEATURES},
    {"self-test", no_argument, NULL, OPTION_SELF_TEST},
    {"ulp", required_argument, NULL, OPTION_ULP},
    {"peers", required_argument, NULL, OPTION_PEERS},
    {"quick", no_argument, NULL, OPTION_QUICK},
    {"quiet", no_argument, NULL, 'q'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "no memory for the command line");
}

static bool parse_whole(const char *name, const char *text, u32 low, u32 high, u32 *value, Error *error)
{
    const char *end = text_read_whole(text, value);
    if (!end || *end || *value < low || *value > high)
        return error_set(error, ERROR_USAGE, "--%s: '%s' is not a whole number from %u to %u", name, text,
                         low, high);
    return true;
}

static bool parse_size(const char *text, Arguments *arguments, Error *error)
{
    const char *at = text_read_whole(text, &arguments->width);
    at = at && *at == 'x' ? text_read_whole(at + 1, &arguments->height) : NULL;
    if (!at || *at || !arguments->width || !arguments->height || arguments->width > 65536 ||
        arguments->height > 65536)
        return error_set(error, ERROR_USAGE, "--size: '%s' is not WxH, each from 1 to 65536", text);
    return true;
}

static bool parse_samples(const char *text, Arguments *arguments, Error *error)
{
    arguments->sample_count = 0;
    for (const char *at = text; at; at++) {
        u32 value, before = arguments->sample_count ? arguments->samples[arguments->sample_count - 1] : 0;
        at = text_read_whole(at, &value);
        if (!at || (*at && *at != ',') || value <= before || value > SAMPLES_MAX ||
            arguments->sample_count == SAMPLE_COUNTS_MAX)
            return error_set(error, ERROR_USAGE,
                             "--samples: '%s' is not a list of up to %d rising numbers from 1 to %d", text,
                             SAMPLE_COUNTS_MAX, SAMPLES_MAX);
        arguments->samples[arguments->sample_count++] = value;
        if (!*at)
            break;
    }
    return true;
}

static bool add_mode(Arguments *arguments, Mode mode, Error *error)
{
    for (u32 i = 0; i < arguments->mode_count; i++)
        if (strcmp(arguments->modes[i].name, mode.name) == 0)
            return error_set(error, ERROR_USAGE, "there are two modes of the name '%s'", mode.name);
    if (arguments->mode_count == MODES_MAX)
        return error_set(error, ERROR_USAGE, "more than %d modes", MODES_MAX);
    arguments->modes[arguments->mode_count++] = mode;
    return true;
}

static bool parse_math(const char *text, Arguments *arguments, Error *error)
{
    static const char *const NAMES[] = {"exact", "fast", "double"};
    for (const char *at = text;;) {
        const size_t length = strcspn(at, ",");
        const char *name = NULL;
        for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++)
            if (strlen(NAMES[i]) == length && strncmp(NAMES[i], at, length) == 0)
                name = NAMES[i];
        if (!name)
            return error_set(error, ERROR_USAGE, "--math: '%s' is not a list of exact, fast, double", text);
        if (!add_mode(arguments, (Mode){.name = name, .math = name, .text = ""}, error))
            return false;
        if (!at[length])
            return true;
        at += length + 1;
    }
}

// Words between white space; options of clrt need no quotes.
static bool split_words(Arena *arena, Mode *mode, Error *error)
{
    const char **words = NULL;
    for (const char *at = mode->text; *at;) {
        const size_t length = strcspn(at, " \t");
        if (length > 0) {
            words = arena_grow(arena, words, mode->word_count, sizeof *words);
            if (!words || !(words[mode->word_count++] = arena_copy_text(arena, at, length)))
                return no_memory(error);
        }
        at += length + (at[length] != 0);
    }
    mode->words = words;
    return true;
}

// The last of the mode's words that sets --math.
static bool find_math(Mode *mode, Error *error)
{
    for (u32 i = 0; i < mode->word_count; i++) {
        const char *word = mode->words[i];
        if (strncmp(word, "--math=", 7) == 0)
            mode->math = word + 7;
        else if (strcmp(word, "--math") == 0 && i + 1 < mode->word_count)
            mode->math = mode->words[i + 1];
    }
    if (strcmp(mode->math, "exact") == 0 || strcmp(mode->math, "fast") == 0 ||
        strcmp(mode->math, "double") == 0)
        return true;
    return error_set(error, ERROR_USAGE, "--variant: there is no --math %s", mode->math);
}

static bool parse_variant(const char *text, Arena *arena, Arguments *arguments, Error *error)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return error_set(error, ERROR_USAGE, "--variant: '%s' is not NAME=\"OPTIONS\"", text);
    for (const char *c = text; c < equals; c++)
        if (!isalnum((unsigned char)*c) && !strchr("-_", *c))
            return error_set(error, ERROR_USAGE,
                             "--variant: a name is of letters, digits, - and _, not '%.*s'",
                             (int)(equals - text), text);
    Mode mode = {
        .name = arena_copy_text(arena, text, (size_t)(equals - text)), .math = "exact", .text = equals + 1};
    if (!mode.name)
        return no_memory(error);
    return split_words(arena, &mode, error) && find_math(&mode, error) && add_mode(arguments, mode, error);
}

static bool parse_seconds(const char *text, f64 *value, Error *error)
{
    if (!text_parse_decimal(text, strlen(text), value) || !(*value >= 0) || isinf(*value))
        return error_set(error, ERROR_USAGE, "--reference-seconds: '%s' is not a number of at least 0", text);
    return true;
}

static bool take(int option, const char *value, Arena *arena, Arguments *a, Error *error)
{
    switch (option) {
    case OPTION_OUT: a->out = value; return *value || error_set(error, ERROR_USAGE, "--out: no name");
    case OPTION_CLRT: a->clrt = value; return true;
    case 'd': a->device = value; return true;
    case 's': return parse_size(value, a, error);
    case 'n': return parse_samples(value, a, error);
    case OPTION_MATH: return parse_math(value, a, error);
    case OPTION_VARIANT: return parse_variant(value, arena, a, error);
    case OPTION_AGAINST: a->against = value; return true;
    case OPTION_RUNS: return parse_whole("runs", value, 2, RUNS_MAX, &a->runs, error);
    case OPTION_COLD_RUNS: return parse_whole("cold-runs", value, 1, RUNS_MAX, &a->cold_runs, error);
    case OPTION_REFERENCE_SAMPLES:
        return parse_whole("reference-samples", value, 16, SAMPLES_MAX, &a->reference_samples, error);
    case OPTION_REFERENCE_SECONDS: return parse_seconds(value, &a->reference_seconds, error);
    case OPTION_ULP: a->ulp = value; return true;
    case OPTION_PEERS: a->peers = value; return true;
    case OPTION_FEATURES:
        a->features = true;
        a->feature_list = value;
        return true;
    case OPTION_SELF_TEST: a->self_test = true; return true;
    case OPTION_QUICK: a->quick = true; return true;
    case 'q': a->quiet = true; return true;
    case 'h': a->errand = ERRAND_HELP; return true;
    case OPTION_VERSION: a->errand = ERRAND_VERSION; return true;
    default: return false;
    }
}

// What was not given; --math before variants.
static bool add_defaults(Arguments *a, bool math_given, Error *error)
{
    Arguments sorted = {.mode_count = 0};
    if (!math_given && !parse_math("exact,fast,double", &sorted, error))
        return false;
    // Before the variants, which a table compares with them.
    for (int variants = 0; variants < 2; variants++)
        for (u32 i = 0; i < a->mode_count; i++)
            if ((strcmp(a->modes[i].name, a->modes[i].math) != 0) == variants &&
                !add_mode(&sorted, a->modes[i], error))
                return false;
    memcpy(a->modes, sorted.modes, sizeof a->modes);
    a->mode_count = sorted.mode_count;
    if (a->sample_count == 0 && !parse_samples(a->quick ? "1,4,16" : "1,4,16,64", a, error))
        return false;
    a->out = a->out ? a->out : "report";
    a->pixels_max = a->quick && !a->width ? QUICK_PIXELS : 0;
    a->runs = a->runs ? a->runs : a->quick ? 3 : 5;
    a->cold_runs = a->cold_runs ? a->cold_runs : a->quick ? 1 : a->runs;
    if (a->reference_seconds < 0)
        a->reference_seconds = a->quick ? 8 : 120;
    return true;
}

bool arguments_parse(int argc, char **argv, Arena *arena, Arguments *arguments, Error *error)
{
    *arguments = (Arguments){.reference_seconds = -1};
    bool math_given = false;
    optind = 1;
    opterr = 0;
    for (;;) {
        const int at = optind;
        const int option = getopt_long(argc, argv, ":d:s:n:qh", LONG_OPTIONS, NULL);
        if (option == -1)
            break;
        if (option == ':')
            return error_set(error, ERROR_USAGE, "%s: an argument is missing", argv[at]);
        if (option == '?')
            return error_set(error, ERROR_USAGE, "'%s' is not an option", argv[at]);
        math_given = math_given || option == OPTION_MATH;
        if (!take(option, optarg, arena, arguments, error))
            return false;
    }
    if (arguments->errand != ERRAND_REPORT)
        return true;
    arguments->scenes = (const char *const *)(argv + optind);
    arguments->scene_count = (u32)(argc - optind);
    if (arguments->scene_count == 0 && !arguments->features)
        return error_set(error, ERROR_USAGE, "no scene");
    return add_defaults(arguments, math_given, error);
}
