#include "assets/mtl.h"

#include <float.h>
#include <locale.h>
#include <string.h>

#include "assets/obj_text.h"
#include "base/file.h"

enum { QUOTED_BYTES_MAX = 60 };

typedef struct Reader {
    ObjText text;
    Arena *arena;
    MtlFile *mtl;
    ObjWord keyword;
    ObjWords unknown;
    bool has_d, has_norm; // of the last material
    bool told_of_no_material;
    bool no_memory;
} Reader;

typedef struct Property {
    const char *keyword;
    void (*read)(Reader *reader, MtlMaterial *material);
} Property;

static int quoted(const ObjWord *word)
{
    return word->length < QUOTED_BYTES_MAX ? (int)word->length : QUOTED_BYTES_MAX;
}

static char *read_rest(Reader *reader, ObjWord *place)
{
    char *rest = arena_alloc(reader->arena, obj_text_rest_bound(&reader->text), 1);
    if (rest)
        obj_text_rest(&reader->text, rest, place);
    else
        reader->no_memory = true;
    return rest;
}

static void read_newmtl(Reader *reader)
{
    MtlFile *mtl = reader->mtl;
    ObjWord place;
    char *name = read_rest(reader, &place);
    MtlMaterial *materials = arena_grow(reader->arena, mtl->materials, mtl->count, sizeof *materials);
    if (!name || !materials) {
        reader->no_memory = true;
        return;
    }
    if (!*name)
        obj_text_report(&reader->text, SEVERITY_ERROR, &place, "newmtl needs a name");
    const u64 line = reader->keyword.line;
    materials[mtl->count++] =
        (MtlMaterial){ .name = name, .line = line < UINT32_MAX ? (u32)line : UINT32_MAX };
    mtl->materials = materials;
    reader->has_d = reader->has_norm = false;
}

// Goes to where the cursor of ahead is.
static void move_to(ObjText *text, const ObjText *ahead)
{
    text->cursor = ahead->cursor;
    text->line = ahead->line;
    text->line_text = ahead->line_text;
}

// ---- numbers --------------------------------------------------------------------------------

// Reads up to max numbers, all of the statement, and their words. Returns how many, 0 after an error.
static int read_numbers(Reader *reader, f64 *values, ObjWord *words, int max)
{
    ObjText *text = &reader->text;
    ObjWord word;
    int count = 0;
    while (obj_text_word(text, &word)) {
        if (count == max) {
            obj_text_report(text, SEVERITY_ERROR, &word, "unexpected '%.*s' after %.*s", quoted(&word),
                            word.text, quoted(&reader->keyword), reader->keyword.text);
            return 0;
        }
        if (!obj_text_number(text, &word, &values[count]))
            return 0;
        words[count++] = word;
    }
    if (count == 0)
        obj_text_report(text, SEVERITY_ERROR, &word, "%.*s needs a number", quoted(&reader->keyword),
                        reader->keyword.text);
    return count;
}

// The value moved into low .. high, with a warning at its word where it was not there.
static f64 limit(Reader *reader, const ObjWord *word, f64 value, f64 low, f64 high)
{
    const f64 limited = value < low ? low : value > high ? high : value;
    if (limited != value)
        obj_text_report(&reader->text, SEVERITY_WARNING, word, "%.*s %g is taken as %g",
                        quoted(&reader->keyword), reader->keyword.text, value, limited);
    return limited;
}

// Reads "r g b", or "r" for a grey. Returns false where there is none.
static bool read_color(Reader *reader, f64 color[3])
{
    ObjText ahead = reader->text;
    ObjWord word, words[3];
    obj_text_word(&ahead, &word);
    if (obj_word_is(&word, "spectral") || obj_word_is(&word, "xyz")) {
        obj_text_report(&reader->text, SEVERITY_WARNING, &word, "%.*s %.*s is not supported; it is left out",
                        quoted(&reader->keyword), reader->keyword.text, quoted(&word), word.text);
        return false;
    }
    f64 values[3];
    const int count = read_numbers(reader, values, words, 3);
    if (count == 2)
        obj_text_report(&reader->text, SEVERITY_ERROR, &words[1], "%.*s needs 1 or 3 numbers, here are 2",
                        quoted(&reader->keyword), reader->keyword.text);
    if (count == 0 || count == 2)
        return false;
    for (int i = 0; i < 3; ++i)
        color[i] = i < count ? limit(reader, &words[i], values[i], 0, (f64)FLT_MAX) : color[0];
    return true;
}

static void read_kd(Reader *reader, MtlMaterial *material)
{
    if (read_color(reader, material->kd))
        material->given |= MTL_KD;
}

static void read_ks(Reader *reader, MtlMaterial *material)
{
    if (read_color(reader, material->ks))
        material->given |= MTL_KS;
}

static void read_ke(Reader *reader, MtlMaterial *material)
{
    if (read_color(reader, material->ke))
        material->given |= MTL_KE;
}

static void read_ns(Reader *reader, MtlMaterial *material)
{
    ObjWord word;
    f64 value;
    if (read_numbers(reader, &value, &word, 1) == 0)
        return;
    material->ns = limit(reader, &word, value, 0, MTL_NS_MAX);
    material->given |= MTL_NS;
}

static void read_ni(Reader *reader, MtlMaterial *material)
{
    ObjWord word;
    f64 value;
    if (read_numbers(reader, &value, &word, 1) == 0)
        return;
    if (value > 0) {
        material->ni = value;
        material->given |= MTL_NI;
    } else {
        obj_text_report(&reader->text, SEVERITY_WARNING, &word, "Ni %g is not above 0; it is left out",
                        value);
    }
}

static void read_d(Reader *reader, MtlMaterial *material)
{
    ObjText ahead = reader->text;
    ObjWord word;
    if (obj_text_word(&ahead, &word) && obj_word_is(&word, "-halo")) {
        obj_text_report(&reader->text, SEVERITY_WARNING, &word, "-halo is not supported; it is left out");
        move_to(&reader->text, &ahead);
    }
    f64 value;
    if (read_numbers(reader, &value, &word, 1) == 0)
        return;
    material->d = limit(reader, &word, value, 0, 1);
    material->given |= MTL_D;
    reader->has_d = true;
}

// Transparency; files that give it beside d do not agree on what it means, so d counts.
static void read_tr(Reader *reader, MtlMaterial *material)
{
    ObjWord word;
    f64 value;
    if (read_numbers(reader, &value, &word, 1) == 0)
        return;
    value = limit(reader, &word, value, 0, 1);
    if (!reader->has_d) {
        material->d = 1 - value;
        material->given |= MTL_D;
    }
}

// ---- maps -----------------------------------------------------------------------------------

// An option of a map: up to max words behind it. Where they are numbers other than neutral, the map would
// look different from what the renderer makes of it.
typedef struct MapOption {
    const char *name;
    int max;
    bool matters;
    f64 neutral[3];
} MapOption;

static const MapOption map_options[] = {
    { "-blendu", 1, false, { 0 } },   { "-blendv", 1, false, { 0 } }, { "-boost", 1, false, { 0 } },
    { "-cc", 1, false, { 0 } },       { "-clamp", 1, false, { 0 } },  { "-texres", 1, false, { 0 } },
    { "-imfchan", 1, false, { 0 } },  { "-type", 1, false, { 0 } },   { "-bm", 1, true, { 1 } },
    { "-mm", 2, true, { 0, 1 } },     { "-o", 3, true, { 0, 0, 0 } }, { "-s", 3, true, { 1, 1, 1 } },
    { "-t", 3, true, { 0, 0, 0 } },
};

static const MapOption *find_option(const ObjWord *word)
{
    for (size_t i = 0; i < sizeof map_options / sizeof *map_options; ++i) {
        if (obj_word_is(word, map_options[i].name))
            return &map_options[i];
    }
    return NULL;
}

// Goes over the options in front of a file's name.
static void skip_options(Reader *reader)
{
    ObjText *text = &reader->text;
    for (;;) {
        ObjText ahead = *text;
        ObjWord word;
        const MapOption *option = obj_text_word(&ahead, &word) ? find_option(&word) : NULL;
        if (!option)
            return;
        bool neutral = true;
        move_to(text, &ahead);
        ahead.diagnostics = NULL; // what is no number is no fault, but the name
        for (int i = 0; i < option->max; ++i) {
            ObjWord argument;
            f64 value = 0;
            if (!obj_text_word(&ahead, &argument) ||
                (option->matters && !obj_text_number(&ahead, &argument, &value)))
                break;
            neutral &= !option->matters || value == option->neutral[i];
            move_to(text, &ahead);
        }
        if (!neutral)
            obj_text_report(text, SEVERITY_WARNING, &word, "option %s is not supported; it is left out",
                            option->name);
    }
}

// Reads the name of a map's file, with its line; NULL, with a warning, where it is missing.
static char *read_map(Reader *reader, u32 *line)
{
    skip_options(reader);
    ObjWord place;
    char *name = read_rest(reader, &place);
    if (!name)
        return NULL;
    if (!*name) {
        obj_text_report(&reader->text, SEVERITY_WARNING, &place, "%.*s names no file",
                        quoted(&reader->keyword), reader->keyword.text);
        return NULL;
    }
    *line = place.line < UINT32_MAX ? (u32)place.line : UINT32_MAX;
    return name;
}

static void read_map_kd(Reader *reader, MtlMaterial *material)
{
    char *name = read_map(reader, &material->map_kd_line);
    if (name)
        material->map_kd = name;
}

static void read_map_bump(Reader *reader, MtlMaterial *material)
{
    u32 line = 0;
    char *name = read_map(reader, &line);
    if (name && !reader->has_norm) {
        material->map_bump = name;
        material->map_bump_line = line;
    }
}

static void read_norm(Reader *reader, MtlMaterial *material)
{
    char *name = read_map(reader, &material->map_bump_line);
    if (name) {
        material->map_bump = name;
        reader->has_norm = true;
    }
}

// ---- statements -----------------------------------------------------------------------------

static const Property properties[] = {
    { "Kd", read_kd },
    { "Ks", read_ks },
    { "Ke", read_ke },
    { "Ns", read_ns },
    { "Ni", read_ni },
    { "d", read_d },
    { "Tr", read_tr },
    { "map_Kd", read_map_kd },
    { "map_kd", read_map_kd },
    { "map_Bump", read_map_bump },
    { "map_bump", read_map_bump },
    { "bump", read_map_bump },
    { "norm", read_norm },
};

static const Property *find_property(const ObjWord *keyword)
{
    for (size_t i = 0; i < sizeof properties / sizeof *properties; ++i) {
        if (obj_word_is(keyword, properties[i].keyword))
            return &properties[i];
    }
    return NULL;
}

// Whether the keyword is one of the format, or of what it has been extended by, that the renderer has no use
// for.
static bool is_ignored(const ObjWord *keyword)
{
    static const char *const ignored[] = {
        "Ka", "Tf", "Km", "illum", "sharpness", "map_Ka", "map_ka", "map_Ks", "map_ks", "map_Ke", "map_ke",
        "map_Ns", "map_ns", "map_d", "map_D", "map_Tr", "map_tr", "map_aat", "map_refl", "refl", "disp",
        "map_disp", "decal", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor", "map_Pr", "map_Pm", "map_Ps",
        "map_Pc", "map_Pcr"
    };
    for (size_t i = 0; i < sizeof ignored / sizeof *ignored; ++i) {
        if (obj_word_is(keyword, ignored[i]))
            return true;
    }
    return false;
}

static void read_statement(Reader *reader)
{
    ObjText *text = &reader->text;
    const ObjWord *keyword = &reader->keyword;
    if (!obj_text_word(text, &reader->keyword))
        return;
    const Property *property = find_property(keyword);
    if (obj_word_is(keyword, "newmtl")) {
        read_newmtl(reader);
    } else if (property && reader->mtl->count > 0) {
        property->read(reader, &reader->mtl->materials[reader->mtl->count - 1]);
    } else if (property) {
        if (!reader->told_of_no_material)
            obj_text_report(text, SEVERITY_WARNING, keyword, "'%.*s' before the first newmtl; it is left out",
                            quoted(keyword), keyword->text);
        reader->told_of_no_material = true;
    } else if (!is_ignored(keyword) && obj_words_add(&reader->unknown, keyword->text, keyword->length)) {
        obj_text_report(text, SEVERITY_WARNING, keyword, "'%.*s' is not known; it is skipped",
                        quoted(keyword), keyword->text);
    }
}

static bool read_all(Reader *reader)
{
    ObjText *text = &reader->text;
    while (text->cursor < text->end && !reader->no_memory) {
        read_statement(reader);
        obj_text_next_statement(text);
    }
    return !reader->no_memory;
}

bool mtl_read(const char *path, Diagnostics *diagnostics, MtlFile *mtl, Error *error)
{
    *mtl = (MtlFile){ .arena = arena_create() };
    Arena *scratch = arena_create();
    const locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    FileContent content;
    bool done = mtl->arena && scratch && c_locale;
    if (!done)
        error_set(error, ERROR_MEMORY, "out of memory");
    done = done && file_read(path, true, scratch, &content, error);
    if (done) {
        const size_t mark = strncmp(content.text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
        Reader reader = { .arena = mtl->arena, .mtl = mtl };
        reader.text = obj_text_begin(content.text + mark, content.length - mark);
        reader.text.file_name = path;
        reader.text.diagnostics = diagnostics;
        const locale_t before = uselocale(c_locale);
        done = read_all(&reader) || error_set(error, ERROR_MEMORY, "out of memory");
        uselocale(before);
    }
    if (c_locale)
        freelocale(c_locale);
    arena_destroy(scratch);
    if (!done)
        mtl_destroy(mtl);
    return done;
}

void mtl_destroy(MtlFile *mtl)
{
    arena_destroy(mtl->arena);
    *mtl = (MtlFile){ 0 };
}
