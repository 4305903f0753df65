// Statements one after the other, through all files, to a Scene.
#include "scene/parse.h"

#include <locale.h>
#include <string.h>

#include "base/file.h"
#include "base/text.h"
#include "scene/material.h"
#include "scene/statement.h"

// ---- files ----------------------------------------------------------------------------------

// Reports what makes a file no text, at its place. Returns false where reading on is in vain.
static bool check_text(Parser *parser, const char *text, size_t length)
{
    const char *zero = memchr(text, 0, length);
    const size_t end = zero ? (size_t)(zero - text) : length;
    const size_t invalid = text_find_invalid_utf8(text, end);
    const size_t at = invalid < end ? invalid : end;
    if (at == length)
        return true;
    Lexer lexer = lexer_begin(text, length);
    Token place = {.line_text = lexer.line_text, .line = 1, .width = 1};
    for (const char *feed; (feed = memchr(place.line_text, '\n', (size_t)(text + at - place.line_text)));) {
        place.line_text = feed + 1;
        ++place.line;
    }
    place.column = 1 + (u32)text_count_characters(place.line_text, (size_t)(text + at - place.line_text));
    if (at == invalid && invalid < end)
        parser_error(parser, &place, "the file is not UTF-8 from here");
    else
        parser_error(parser, &place, "the file is not text: a byte is 0");
    return !zero;
}

// Begins to read text that is in the arena and ends in 0.
static bool push_input(Parser *parser, const char *name, const char *text, size_t length,
                       FileIdentity identity)
{
    Scene *scene = parser->scene;
    const u32 count = scene->file_count;
    const char **files = parser_grow(parser, scene->files, count, sizeof *files);
    const char **texts = parser_grow(parser, scene->file_texts, count, sizeof *texts);
    FileIdentity *identities = parser_grow(parser, parser->identities, count, sizeof *identities);
    Input *input = parser_alloc(parser, 1, sizeof *input);
    if (!files || !texts || !identities || !input)
        return false;
    scene->files = files;
    scene->file_texts = texts;
    parser->identities = identities;
    input->lexer = lexer_begin(text, length);
    files[count] = name;
    texts[count] = input->lexer.line_text; // behind a byte-order mark
    identities[count] = identity;
    ++scene->file_count;
    input->file = count;
    input->outer = parser->input;
    parser->input = input;
    if (!check_text(parser, text, length))
        input->lexer.cursor = input->lexer.end;
    parser_advance(parser);
    return true;
}

// Goes on behind the include that named the file just ended; false where it was the scene's own.
static bool pop_input(Parser *parser)
{
    parser->identities[parser->input->file].open = false;
    parser->input = parser->input->outer;
    if (!parser->input)
        return false;
    parser_advance(parser);
    return true;
}

static bool read_already(Parser *parser, const FileContent *content, const Token *name)
{
    for (u32 i = 0; i < parser->scene->file_count; ++i) {
        const FileIdentity *other = &parser->identities[i];
        if (!other->known || other->device != content->device || other->inode != content->inode)
            continue;
        char place[PLACE_SHOWN_MAX];
        if (other->open)
            parser_error(parser, name, "the file includes itself, directly or through others");
        else
            parser_error(parser, name, "the file is included already, at %s",
                         parser_show_place(parser, other->included_at, place));
        return true;
    }
    return false;
}

void include_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)inside;
    const Property property = {.name = statement->name, .kind = VALUE_FILE};
    const Token name = parser->token;
    const Lexer behind = parser->input->lexer;
    const char *path;
    if (!value_read(parser, &property, word, &path)) {
        parser_skip_values(parser);
        return;
    }
    FileContent content;
    Error error;
    if (!file_read(path, true, parser->arena, &content, &error)) {
        parser->out_of_memory |= error.code == ERROR_MEMORY;
        char shown[TOKEN_SHOWN_MAX];
        parser_error(parser, &name, "cannot read %s: %s", parser_show(&name, shown), error.text);
        return;
    }
    if (read_already(parser, &content, &name))
        return;
    // The token behind the name is read again when the file has ended.
    parser->input->lexer = behind;
    const FileIdentity identity = {.device = content.device, .inode = content.inode, .known = true,
                                   .open = true, .included_at = parser_position(parser, &name)};
    push_input(parser, path, content.text, content.length, identity);
}

// ---- the scene ------------------------------------------------------------------------------

static bool set_defaults(Parser *parser)
{
    Scene *scene = parser->scene;
    scene->image = (ImageSettings){.width = 800, .height = 600, .samples = 1};
    scene->camera =
        (Camera){.look_at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 60, .height = 1, .focus_distance = 1};
    scene->render = (RenderSettings){
        .max_depth = 5, .min_weight = 0.001, .environment_samples = 1, .shadows = true};
    scene->output = (OutputSettings){.white = 1};
    scene->ambient = (Vec3){0.1, 0.1, 0.1};
    scene->environment = (Environment){.intensity = {1, 1, 1}};
    scene->materials = parser_grow(parser, NULL, 0, sizeof *scene->materials);
    if (!scene->materials)
        return false;
    scene->materials[scene->material_count++] = material_default();
    parser->out_of_memory |= !names_add(&parser->materials, parser->arena, "default", strlen("default"));
    return !parser->out_of_memory;
}

static void parse_statements(Parser *parser)
{
    while (!parser->out_of_memory) {
        if (parser->token.kind == TOKEN_END) {
            if (!pop_input(parser))
                return;
        } else if (parser->token.kind == TOKEN_CLOSE) {
            if (!parser->stray_close_expected)
                parser_error(parser, &parser->token, "unexpected '}'");
            parser->stray_close_expected = false;
            parser_advance(parser);
        } else {
            statement_parse(parser, &parser->scene->world);
        }
    }
}

// content is in the arena.
static Scene *parse(const char *name, const FileContent *content, bool known, Arena *arena,
                    Diagnostics *diagnostics, Error *error)
{
    Parser parser = {.arena = arena, .diagnostics = diagnostics};
    parser.scene = parser_alloc(&parser, 1, sizeof *parser.scene);
    const char *name_copy = arena_copy_text(arena, name, strlen(name));
    const locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (parser.scene && name_copy && c_locale) {
        // Numbers have a point whatever the locale of the program.
        const locale_t before = uselocale(c_locale);
        const FileIdentity identity = {
            .device = content->device, .inode = content->inode, .known = known, .open = true};
        if (set_defaults(&parser) && push_input(&parser, name_copy, content->text, content->length, identity))
            parse_statements(&parser);
        uselocale(before);
    }
    if (c_locale)
        freelocale(c_locale);
    if (!parser.scene || !name_copy || !c_locale || parser.out_of_memory) {
        error_set(error, ERROR_MEMORY, "%s: out of memory", name);
        return NULL;
    }
    return parser.scene;
}

Scene *scene_parse_file(const char *path, Arena *arena, Diagnostics *diagnostics, Error *error)
{
    const char *name = strcmp(path, "-") == 0 ? "<stdin>" : path;
    FileContent content;
    Error reason;
    if (!file_read(path, false, arena, &content, &reason)) {
        error_set(error, reason.code, "%s: %s", name, reason.text);
        return NULL;
    }
    return parse(name, &content, true, arena, diagnostics, error);
}

Scene *scene_parse_text(const char *name, const char *text, size_t length, Arena *arena,
                        Diagnostics *diagnostics, Error *error)
{
    FileContent content = {.text = NULL, .length = length};
    if (length <= FILE_BYTES_MAX)
        content.text = arena_copy_text(arena, text, length);
    if (!content.text) {
        error_set(error, ERROR_MEMORY, "%s: out of memory", name);
        return NULL;
    }
    return parse(name, &content, false, arena, diagnostics, error);
}
