#include "cli/options.h"

#include <stdarg.h>
#include <string.h>

#include "cli/table.h"
#include "scene/suggest.h"

// The arguments as they are read.
typedef struct Reader {
    char **arguments;
    int count, at;
    Options *options;
    size_t operands;
    size_t mistakes;
    char text[sizeof ((Error *)0)->text]; // a line a mistake
} Reader;

static void mistake(Reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void mistake(Reader *reader, const char *format, ...)
{
    const size_t used = strlen(reader->text);
    const size_t room = sizeof reader->text - used;
    const int start = snprintf(reader->text + used, room, "%s", reader->mistakes++ ? "\n" : "");
    if ((size_t)start >= room)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reader->text + used + start, room - (size_t)start, format, arguments);
    va_end(arguments);
}

static const Option *find_name(const char *name, size_t length)
{
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (strlen(OPTIONS[i].name) == length && memcmp(OPTIONS[i].name, name, length) == 0)
            return &OPTIONS[i];
    return NULL;
}

static const Option *find_letter(char letter)
{
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if (OPTIONS[i].letter == letter)
            return &OPTIONS[i];
    return NULL;
}

// shown: the option as written. value: NULL where there is none.
static void take(Reader *reader, const Option *option, const char *shown, int shown_length, const char *value)
{
    if (option->group == GROUP_LATER) {
        mistake(reader, "%.*s is not supported yet", shown_length, shown);
        return;
    }
    const char *wanted = option->take(reader->options, value);
    if (wanted)
        mistake(reader, "%.*s '%s': must be %s", shown_length, shown, value, wanted);
}

// The next argument as the value of an option; NULL, with a mistake, where there is none. What begins with
// two dashes is an option that follows where a value was forgotten.
static const char *next_value(Reader *reader, const Option *option, const char *shown, int shown_length)
{
    const char *next = reader->at < reader->count ? reader->arguments[reader->at] : NULL;
    if (next && strncmp(next, "--", 2) != 0) {
        reader->at++;
        return next;
    }
    if (option->group == GROUP_LATER)
        mistake(reader, "%.*s is not supported yet", shown_length, shown);
    else
        mistake(reader, "%.*s needs a value: %s", shown_length, shown, option->value_name);
    return NULL;
}

static void read_long(Reader *reader, const char *argument)
{
    const char *name = argument + 2;
    const size_t length = strcspn(name, "=");
    const int shown = (int)length + 2;
    const char *value = name[length] ? name + length + 1 : NULL;
    const Option *option = find_name(name, length);
    if (!option) {
        Suggestion suggestion = suggest_begin(name, length);
        for (size_t i = 0; i < OPTION_COUNT; i++)
            if (OPTIONS[i].group != GROUP_LATER)
                suggest_offer(&suggestion, OPTIONS[i].name, strlen(OPTIONS[i].name));
        if (suggestion.best)
            mistake(reader, "unknown option '%.*s'; did you mean '--%.*s'?", shown, argument,
                    (int)suggestion.best_length, suggestion.best);
        else
            mistake(reader, "unknown option '%.*s'", shown, argument);
        return;
    }
    if (value && option->value == VALUE_NONE) {
        mistake(reader, "%.*s takes no value", shown, argument);
        return;
    }
    if (!value && option->value == VALUE_REQUIRED) {
        value = next_value(reader, option, argument, shown);
        if (!value)
            return;
    }
    take(reader, option, argument, shown, value);
}

// Letters after one dash; the value of one that takes it is the rest or the next argument.
static void read_letters(Reader *reader, const char *argument)
{
    for (const char *letter = argument + 1; *letter; letter++) {
        const Option *option = find_letter(*letter);
        const char shown[] = {'-', *letter, '\0'};
        if (!option) {
            mistake(reader, "unknown option '%s'", shown);
            return;
        }
        if (option->value == VALUE_NONE) {
            take(reader, option, shown, 2, NULL);
            continue;
        }
        const char *value = letter[1] ? letter + 1 : next_value(reader, option, shown, 2);
        if (value)
            take(reader, option, shown, 2, value);
        return;
    }
}

static void read_operand(Reader *reader, const char *argument)
{
    if (reader->operands == 0)
        reader->options->scene = argument;
    else if (reader->operands == 1)
        reader->options->out = argument;
    else
        mistake(reader, "one SCENE and one OUT, not also '%s'", argument);
    reader->operands++;
}

static void check_together(Reader *reader)
{
    const Options *options = reader->options;
    if (options->json && options->action != ACTION_LIST_DEVICES)
        mistake(reader, "--json goes with --list-devices");
    if (options->quiet && options->verbose)
        mistake(reader, "--quiet and --verbose exclude each other");
    if (options->action == ACTION_LIST_DEVICES && options->scene)
        mistake(reader, "--list-devices takes no SCENE");
    if (options->action == ACTION_SELF_TEST && options->scene)
        mistake(reader, "--self-test takes no SCENE");
    if (options->action != ACTION_RENDER && options->action != ACTION_CHECK)
        return;
    if (!options->scene)
        mistake(reader, options->action == ACTION_CHECK ? "SCENE is missing" : "SCENE and OUT are missing");
    else if (!options->out && options->action == ACTION_RENDER)
        mistake(reader, "OUT is missing");
    else if (options->aovs && options->out && strcmp(options->out, "-") == 0)
        mistake(reader, "--aov needs a file's name for OUT");
}

bool options_parse(int argc, char **argv, Options *options, Error *error)
{
    *options = (Options){.bits = 8};
    Reader reader = {.arguments = argv, .count = argc, .at = 1, .options = options};
    bool only_operands = false;
    while (reader.at < argc) {
        const char *argument = argv[reader.at++];
        if (only_operands || argument[0] != '-' || argument[1] == '\0')
            read_operand(&reader, argument);
        else if (strcmp(argument, "--") == 0)
            only_operands = true;
        else if (argument[1] == '-')
            read_long(&reader, argument);
        else
            read_letters(&reader, argument);
        if (reader.mistakes == 0 && (options->action == ACTION_HELP || options->action == ACTION_VERSION))
            return true;
    }
    check_together(&reader);
    if (reader.mistakes)
        return error_set(error, ERROR_USAGE, "%s", reader.text);
    return true;
}

bool options_override(const Options *options, Scene *scene, Error *error)
{
    ImageSettings *image = &scene->image;
    if (options->size_given) {
        image->width = options->width;
        image->height = options->height;
    }
    if (options->samples_given)
        image->samples = options->samples;
    if (options->seed_given)
        image->seed = options->seed;
    if (options->depth_given)
        scene->render.max_depth = options->depth;
    if (options->environment_lighting_given)
        scene->render.environment_lighting = options->environment_lighting;
    if (options->integrator_given)
        scene->render.integrator = options->integrator;
    scene->render.light_sampling = options->light_sampling;
    if (options->exposure_given) {
        scene->output.exposure = options->exposure;
        scene->output.exposure_given = true;
    }
    if (options->tone_map_given) {
        scene->output.tone_map = options->tone_map;
        scene->output.white = options->white;
        scene->output.tone_map_given = true;
    }
    const u32 right = options->crop_x + options->crop_width, bottom = options->crop_y + options->crop_height;
    if (options->crop_given && (right > image->width || bottom > image->height))
        return error_set(error, ERROR_USAGE, "--crop %u,%u,%u,%u is not within the image of %u x %u pixels",
                         options->crop_x, options->crop_y, options->crop_width, options->crop_height,
                         image->width, image->height);
    return true;
}

void options_print_usage(FILE *stream)
{
    static const char *const TITLES[GROUP_LATER] = {
        [GROUP_DEVICE] = "Device", [GROUP_IMAGE] = "Image (in place of what the scene says)",
        [GROUP_OUTPUT] = "Output", [GROUP_RUN] = "Run"};
    fputs("Usage: clrt [options] SCENE OUT\n"
          "       clrt --check SCENE\n"
          "       clrt --list-devices [--json]\n"
          "       clrt --self-test[=FILE.json]\n"
          "\n"
          "Renders the scene file SCENE on an OpenCL device into the picture OUT, .png,\n"
          ".exr, .hdr or .pfm.\n"
          "SCENE - is standard input, OUT - a PNG on standard output.\n",
          stream);
    for (int group = 0; group < GROUP_LATER; group++) {
        fprintf(stream, "\n%s:\n", TITLES[group]);
        for (size_t i = 0; i < OPTION_COUNT; i++) {
            const Option *option = &OPTIONS[i];
            if ((int)option->group != group)
                continue;
            char left[64];
            const char letter[] = {option->letter ? '-' : ' ', option->letter ? option->letter : ' ',
                                   option->letter ? ',' : ' ', '\0'};
            const char *mark = option->value == VALUE_OPTIONAL ? "[=" : option->value_name ? " " : "";
            snprintf(left, sizeof left, "%s --%s%s%s%s", letter, option->name, mark,
                     option->value_name ? option->value_name : "",
                     option->value == VALUE_OPTIONAL ? "]" : "");
            fprintf(stream, "  %-26s %s\n", left, option->help);
        }
    }
    fputs("\n"
          "Exit status: 0 done, 1 the scene, a mesh or an image has errors, 2 usage, 3 no device or OpenCL failed,\n"
          "4 SCENE or OUT could not be read or written, 5 the self-test failed, 6 out of memory,\n"
          "130 interrupted.\n",
          stream);
}
