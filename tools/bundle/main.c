// clrt-bundle: one OpenCL C file and all that it includes, flattened.
//
//   clrt-bundle ROOT ENTRY OUT.c SYMBOL   C source of `const char SYMBOL[]` and `const size_t SYMBOL_size`
//   clrt-bundle ROOT ENTRY OUT.cl         the plain text
//
// Include "a/b.h" means ROOT/a/b.h wherever it stands. A file whose include guard is certainly defined by
// then is left out, and so are the branches of #ifdef __OPENCL_C_VERSION__ that are the host's.
// Exit status: 0 done, 1 a file is missing or includes itself, 2 usage.
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bundle/text.h"

enum { FILES_MAX = 512, NESTING_MAX = 64, PATH_LENGTH = 512 };

typedef struct Source {
    char path[PATH_LENGTH]; // below the root
    char *text;
    bool guarded; // opens with #ifndef X, #define X
    bool certain; // has been inlined where no condition but include guards can leave it out
    bool open;    // being inlined
} Source;

typedef struct Bundle {
    const char *root;
    const char *label; // what the root is called in #line
    Source sources[FILES_MAX];
    size_t count;
    FILE *out;
} Bundle;

// The conditions around a line of one file.
typedef struct Conditions {
    bool device_only[NESTING_MAX]; // about __OPENCL_C_VERSION__, so decided here
    bool dead[NESTING_MAX];        // decided, and the present branch is the host's
    size_t depth;
} Conditions;

// Where an include stands, for messages.
typedef struct Place {
    const char *path;
    unsigned line;
} Place;

static bool complain(const Bundle *bundle, Place place, const char *what, const char *name)
{
    if (place.path)
        fprintf(stderr, "%s/%s:%u: ", bundle->label, place.path, place.line);
    fprintf(stderr, "error: %s: %s\n", name, what);
    return false;
}

// The source at path, read when it is first asked for.
static Source *find_source(Bundle *bundle, const char *path, Place place)
{
    for (size_t i = 0; i < bundle->count; i++)
        if (strcmp(bundle->sources[i].path, path) == 0)
            return &bundle->sources[i];
    Source *source = &bundle->sources[bundle->count];
    char full[2 * PATH_LENGTH];
    if (bundle->count == FILES_MAX || strlen(path) >= sizeof source->path ||
        snprintf(full, sizeof full, "%s/%s", bundle->root, path) >= (int)sizeof full) {
        complain(bundle, place, "too many files, or too long a name", path);
        return NULL;
    }
    source->text = text_read(full);
    if (!source->text) {
        complain(bundle, place, strerror(errno), path);
        return NULL;
    }
    strcpy(source->path, path);
    source->guarded = text_is_guarded(source->text);
    bundle->count++;
    return source;
}

static bool is_dead(const Conditions *conditions)
{
    for (size_t i = 0; i < conditions->depth; i++)
        if (conditions->dead[i])
            return true;
    return false;
}

// Conditions that only the compiler can decide, the guard of the file left out.
static size_t open_conditions(const Conditions *conditions, const Source *source)
{
    size_t count = 0;
    for (size_t i = source->guarded ? 1 : 0; i < conditions->depth; i++)
        count += !conditions->device_only[i];
    return count;
}

// Follows #if ... #endif; true where the line itself is decided here and must not reach the compiler.
static bool follow(Conditions *conditions, const Directive *directive)
{
    const bool about_device = strcmp(directive->rest, "__OPENCL_C_VERSION__") == 0;
    const bool by_name = directive_is(directive, "ifdef") || directive_is(directive, "ifndef");
    if (by_name || directive_is(directive, "if")) {
        const bool known = about_device && by_name;
        conditions->device_only[conditions->depth] = known;
        conditions->dead[conditions->depth] = known && directive_is(directive, "ifndef");
        conditions->depth++;
        return known;
    }
    if (conditions->depth == 0)
        return false;
    const size_t top = conditions->depth - 1;
    const bool known = conditions->device_only[top];
    if (known && directive_is(directive, "else"))
        conditions->dead[top] = !conditions->dead[top];
    else if (directive_is(directive, "endif"))
        conditions->depth = top;
    else if (!directive_is(directive, "else"))
        return false;
    return known;
}

static bool flatten(Bundle *bundle, Source *source, bool conditional);

// Puts what an include names in its place. conditional: the include itself may be left out by the compiler.
static bool include(Bundle *bundle, const Directive *directive, Place place, bool conditional)
{
    char path[PATH_LENGTH];
    if (!directive_include_path(directive, path, sizeof path))
        return complain(bundle, place, "only \"...\" can be included", directive->rest);
    Source *source = find_source(bundle, path, place);
    if (!source)
        return false;
    if (source->guarded && source->certain) {
        fputc('\n', bundle->out);
        return true;
    }
    if (source->open)
        return complain(bundle, place, "includes itself", path);
    if (!flatten(bundle, source, conditional))
        return false;
    fprintf(bundle->out, "#line %u \"%s/%s\"\n", place.line + 1, bundle->label, place.path);
    return true;
}

static bool flatten(Bundle *bundle, Source *source, bool conditional)
{
    Conditions conditions = {.depth = 0};
    source->open = true;
    source->certain = source->certain || !conditional;
    fprintf(bundle->out, "#line 1 \"%s/%s\"\n", bundle->label, source->path);
    unsigned line = 1;
    for (const char *at = source->text; *at; at += strcspn(at, "\n") + 1, line++) {
        const size_t length = strcspn(at, "\n");
        const Place place = {source->path, line};
        Directive directive;
        const bool is_directive = directive_read(&directive, at, length);
        if (conditions.depth == NESTING_MAX)
            return complain(bundle, place, "too many conditions", source->path);
        if ((is_directive && follow(&conditions, &directive)) || is_dead(&conditions)) {
            fputc('\n', bundle->out);
        } else if (is_directive && directive_is(&directive, "include")) {
            const bool maybe = conditional || open_conditions(&conditions, source) > 0;
            if (!include(bundle, &directive, place, maybe))
                return false;
        } else {
            fprintf(bundle->out, "%.*s\n", (int)length, at);
        }
        if (at[length] == '\0')
            break;
    }
    source->open = false;
    return true;
}

// The text of the bundle, NULL with a message where it cannot be made.
static char *make_bundle(const char *root, const char *entry)
{
    char *text = NULL;
    size_t size = 0;
    Bundle *bundle = calloc(1, sizeof *bundle);
    if (!bundle)
        return NULL;
    const char *slash = strrchr(root, '/');
    bundle->root = root;
    bundle->label = slash ? slash + 1 : root;
    bundle->out = open_memstream(&text, &size);
    Source *source = bundle->out ? find_source(bundle, entry, (Place){NULL, 0}) : NULL;
    const bool ok = source && flatten(bundle, source, false);
    if (bundle->out)
        fclose(bundle->out);
    for (size_t i = 0; i < bundle->count; i++)
        free(bundle->sources[i].text);
    free(bundle);
    if (!ok) {
        free(text);
        text = NULL;
    }
    return text;
}

int main(int argc, char **argv)
{
    if (argc != 4 && argc != 5) {
        fprintf(stderr, "usage: clrt-bundle ROOT ENTRY OUT [SYMBOL]\n");
        return 2;
    }
    char *text = make_bundle(argv[1], argv[2]);
    if (!text)
        return 1;
    FILE *out = fopen(argv[3], "w");
    if (out && argc == 5)
        text_write_c(text, argv[4], out);
    else if (out)
        fputs(text, out);
    free(text);
    if (!out || fclose(out) != 0) {
        fprintf(stderr, "error: %s: %s\n", argv[3], strerror(errno));
        remove(argv[3]);
        return 1;
    }
    return 0;
}
