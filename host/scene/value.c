#include "scene/block.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "scene/statement.h"

typedef struct Limits {
    f64 low, high;
    bool low_open, high_open; // the limit itself is refused
    const char *text;
} Limits;

static const Limits LIMITS[] = {
    [RANGE_ANY] = {-HUGE_VAL, HUGE_VAL, false, false, ""},
    [RANGE_POSITIVE] = {0, HUGE_VAL, true, false, "above 0"},
    [RANGE_NOT_NEGATIVE] = {0, HUGE_VAL, false, false, "0 or more"},
    [RANGE_NOT_ZERO] = {-HUGE_VAL, HUGE_VAL, false, false, "other than 0"},
    [RANGE_UNIT] = {0, 1, false, false, "from 0 to 1"},
    [RANGE_DIRECTION] = {-HUGE_VAL, HUGE_VAL, false, false, ""},
    [RANGE_ATTENUATION] = {0, HUGE_VAL, false, false, "0 or more"},
    [RANGE_FOV] = {0, 180, true, true, "above 0 and below 180"},
    [RANGE_OUTER] = {0, 360, true, false, "above 0 and at most 360"},
    [RANGE_INNER] = {0, 360, false, false, "from 0 to 360"},
    [RANGE_SHININESS] = {0, 1e6, false, false, "from 0 to 1000000"},
    [RANGE_PIXELS] = {1, 65536, false, false, "from 1 to 65536"},
    [RANGE_SAMPLES] = {1, 1048576, false, false, "from 1 to 1048576"},
    [RANGE_DEPTH] = {0, 64, false, false, "from 0 to 64"},
    [RANGE_U32] = {0, 4294967295.0, false, false, "from 0 to 4294967295"},
};

static bool in_range(Range range, f64 number)
{
    const Limits *limits = &LIMITS[range];
    if (range == RANGE_NOT_ZERO && number == 0)
        return false;
    return (limits->low_open ? number > limits->low : number >= limits->low) &&
           (limits->high_open ? number < limits->high : number <= limits->high);
}

static bool takes_color(const Property *property)
{
    return property->kind == VALUE_COLOR || property->kind == VALUE_COLOR_OR_TEXTURE;
}

static const char *const SWITCH_WORDS[] = {"on", "off", NULL};

static const char *const *words_of(const Property *property)
{
    return property->kind == VALUE_SWITCH ? SWITCH_WORDS : property->words;
}

static void list_words(const char *const *words, char text[VALUE_TAKES_MAX])
{
    size_t length = 0;
    text[0] = 0;
    for (u32 i = 0; words[i] && length < VALUE_TAKES_MAX; ++i) {
        const char *separator = i == 0 ? "" : words[i + 1] ? ", " : " or ";
        length +=
            (size_t)snprintf(text + length, VALUE_TAKES_MAX - length, "%s%s", separator, words[i]);
    }
}

const char *value_takes(const Property *property, char text[VALUE_TAKES_MAX])
{
    const u32 count = property->count;
    const char *plural = count == 1 ? "" : "s";
    switch (property->kind) {
    case VALUE_NUMBERS:
        snprintf(text, VALUE_TAKES_MAX, "%s%u number%s", property->one_for_all ? "1 or " : "", count, plural);
        break;
    case VALUE_WHOLE: snprintf(text, VALUE_TAKES_MAX, "%u whole number%s", count, plural); break;
    case VALUE_COLOR: strcpy(text, "a color: 1 or 3 numbers or \"#rrggbb\""); break;
    case VALUE_COLOR_OR_TEXTURE:
        strcpy(text, "a color (1 or 3 numbers or \"#rrggbb\") or a texture");
        break;
    case VALUE_NUMBER_OR_TEXTURE: strcpy(text, "a number or a texture"); break;
    case VALUE_TEXTURE: strcpy(text, "the name of a texture"); break;
    case VALUE_MATERIAL: strcpy(text, "the name of a material"); break;
    case VALUE_SWITCH:
    case VALUE_WORD: list_words(words_of(property), text); break;
    case VALUE_FILE: strcpy(text, "a file name in quotes"); break;
    case VALUE_OTHER: snprintf(text, VALUE_TAKES_MAX, "%s", property->takes); break;
    }
    return text;
}

// Whether the current token begins something else, so that a value is missing before it.
static bool value_is_missing(const Parser *parser)
{
    const Token *token = &parser->token;
    if (token->kind == TOKEN_NAME)
        return (parser->block && block_has_property(parser->block->type, token)) || statement_begins(parser);
    return token->kind == TOKEN_CLOSE || token->kind == TOKEN_END;
}

bool value_refuse(Parser *parser, const Property *property, const Token *name, u32 found)
{
    char takes[VALUE_TAKES_MAX], shown[TOKEN_SHOWN_MAX];
    value_takes(property, takes);
    const bool missing = value_is_missing(parser);
    if (found > 0 && (missing || parser->token.kind == TOKEN_NUMBER)) {
        parser_error(parser, name, "'%s' takes %s, found %u", property->name, takes, found);
    } else if (missing) {
        parser_error(parser, name, "'%s' takes %s", property->name, takes);
    } else {
        parser_error(parser, &parser->token, "'%s' takes %s, not %s", property->name, takes,
                     parser_show(&parser->token, shown));
        if (parser->token.kind != TOKEN_OPEN)
            parser_advance(parser);
    }
    return false;
}

bool value_accept_number(Parser *parser, const Property *property, f64 *number)
{
    const Token token = parser->token;
    parser_advance(parser);
    if (token.fault != FAULT_NONE)
        return false;
    *number = token.number;
    const Range range = takes_color(property) ? RANGE_NOT_NEGATIVE : property->range;
    if (property->kind == VALUE_WHOLE && floor(token.number) != token.number) {
        parser_error(parser, &token, "'%s' must be a whole number", property->name);
        return false;
    }
    if (!in_range(range, token.number)) {
        parser_error(parser, &token, "'%s' must be %s", property->name, LIMITS[range].text);
        return false;
    }
    return true;
}

// What a range asks of the numbers together.
static bool check_together(Parser *parser, const Property *property, const Token *first, const f64 *numbers)
{
    const u32 step = 3;
    const bool any_zero = property->range == RANGE_DIRECTION || property->range == RANGE_ATTENUATION;
    for (u32 i = 0; any_zero && i + step <= property->count; i += step) {
        if (numbers[i] == 0 && numbers[i + 1] == 0 && numbers[i + 2] == 0) {
            parser_error(parser, first, "'%s' must not be zero", property->name);
            return false;
        }
    }
    return true;
}

bool value_read_numbers(Parser *parser, const Property *property, const Token *name, f64 *numbers)
{
    const Token first = parser->token;
    const u32 count = takes_color(property) ? 3 : property->count;
    const bool one_for_all = property->one_for_all || takes_color(property);
    u32 found = 0;
    bool good = true;
    while (found < count && parser->token.kind == TOKEN_NUMBER)
        good &= value_accept_number(parser, property, &numbers[found++]);
    if (!good)
        return false;
    if (one_for_all && found == 1) {
        for (; found < count; ++found)
            numbers[found] = numbers[0];
    }
    return found == count ? check_together(parser, property, &first, numbers)
                          : value_refuse(parser, property, name, found);
}

static i32 hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

// IEC 61966-2-1.
static f64 srgb_to_linear(i32 level)
{
    const f64 c = level / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

bool value_accept_color_text(Parser *parser, Vec3 *color)
{
    const Token token = parser->token;
    parser_advance(parser);
    f64 channels[3];
    bool good = token.length == 9 && token.text[1] == '#';
    for (u32 i = 0; good && i < 3; ++i) {
        const i32 high = hex_digit(token.text[2 + 2 * i]), low = hex_digit(token.text[3 + 2 * i]);
        good = high >= 0 && low >= 0;
        channels[i] = good ? srgb_to_linear(16 * high + low) : 0;
    }
    if (good && token.fault == FAULT_NONE) {
        *color = (Vec3){channels[0], channels[1], channels[2]};
        return true;
    }
    char shown[TOKEN_SHOWN_MAX];
    parser_error(parser, &token, "%s is not a color like \"#ff8000\"", parser_show(&token, shown));
    return false;
}

static bool read_color(Parser *parser, const Property *property, const Token *name, Vec3 *color)
{
    if (parser->token.kind == TOKEN_STRING)
        return value_accept_color_text(parser, color);
    f64 numbers[3];
    if (!value_read_numbers(parser, property, name, numbers))
        return false;
    *color = (Vec3){numbers[0], numbers[1], numbers[2]};
    return true;
}

// The name of something defined; a name that is not, but begins the next property, is not taken.
static bool read_defined(Parser *parser, const Property *property, const Token *name, i32 *index)
{
    const bool material = property->kind == VALUE_MATERIAL;
    const Names *names = material ? &parser->materials : &parser->textures;
    const Token *token = &parser->token;
    if (token->kind != TOKEN_NAME ||
        (names_find(names, token->text, token->length) < 0 && value_is_missing(parser)))
        return value_refuse(parser, property, name, 0);
    return parser_find_defined(parser, names, material ? "material" : "texture", index);
}

static bool read_word(Parser *parser, const Property *property, const Token *name, u32 *index)
{
    const char *const *words = words_of(property);
    const Token word = parser->token;
    const i32 found = parser_find_word(&word, words);
    if (found >= 0) {
        parser_advance(parser);
        *index = (u32)found;
        return true;
    }
    if (word.kind != TOKEN_NAME || value_is_missing(parser))
        return value_refuse(parser, property, name, 0);
    char takes[VALUE_TAKES_MAX], shown[TOKEN_SHOWN_MAX], hint[SUGGEST_TEXT_MAX];
    Suggestion suggestion = suggest_begin(word.text, word.length);
    for (u32 i = 0; words[i]; ++i)
        suggest_offer(&suggestion, words[i], strlen(words[i]));
    parser_error(parser, &word, "'%s' takes %s, not %s%s", property->name, value_takes(property, takes),
                 parser_show(&word, shown), suggest_text(&suggestion, hint));
    parser_advance(parser);
    return false;
}

bool value_read_file(Parser *parser, const Property *property, const Token *name, const char **path)
{
    const Token token = parser->token;
    if (token.kind != TOKEN_STRING)
        return value_refuse(parser, property, name, 0);
    parser_advance(parser);
    if (token.fault != FAULT_NONE)
        return false;
    char *written = parser_alloc(parser, token.length, 1);
    if (!written)
        return false;
    if (token_unescape(&token, written) == 0) {
        parser_error(parser, &token, "the file name is empty");
        return false;
    }
    *path = path_beside(parser->arena, parser->scene->files[parser->input->file], written);
    parser->out_of_memory |= !*path;
    return *path != NULL;
}

static bool read_whole(Parser *parser, const Property *property, const Token *name, u32 *whole)
{
    f64 numbers[PROPERTY_NUMBERS_MAX];
    if (!value_read_numbers(parser, property, name, numbers))
        return false;
    for (u32 i = 0; i < property->count; ++i)
        whole[i] = (u32)numbers[i];
    return true;
}

bool value_read(Parser *parser, const Property *property, const Token *name, void *value)
{
    const bool is_name = parser->token.kind == TOKEN_NAME;
    u32 word;
    switch (property->kind) {
    case VALUE_NUMBERS: return value_read_numbers(parser, property, name, value);
    case VALUE_WHOLE: return read_whole(parser, property, name, value);
    case VALUE_COLOR: return read_color(parser, property, name, value);
    case VALUE_COLOR_OR_TEXTURE: {
        ColorInput *input = value;
        input->texture = -1;
        if (!is_name)
            return read_color(parser, property, name, &input->color);
        input->color = (Vec3){1, 1, 1};
        return read_defined(parser, property, name, &input->texture);
    }
    case VALUE_NUMBER_OR_TEXTURE: {
        NumberInput *input = value;
        input->texture = -1;
        if (!is_name)
            return value_read_numbers(parser, property, name, &input->value);
        input->value = 1;
        return read_defined(parser, property, name, &input->texture);
    }
    case VALUE_TEXTURE:
    case VALUE_MATERIAL: return read_defined(parser, property, name, value);
    case VALUE_SWITCH:
        if (!read_word(parser, property, name, &word))
            return false;
        *(bool *)value = word == 0;
        return true;
    case VALUE_WORD:
        if (!read_word(parser, property, name, &word))
            return false;
        memcpy(value, &word, sizeof word);
        return true;
    case VALUE_FILE: return value_read_file(parser, property, name, value);
    case VALUE_OTHER: return property->read(parser, property, name, value);
    }
    return false;
}
