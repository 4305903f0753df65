// texture: three kinds.
#include "scene/statement.h"

static const char *const FILTERS[] = {"bilinear", "nearest", NULL};
static const char *const ENCODINGS[] = {"srgb", "linear", NULL};

// Two colors: 2 or 6 numbers, or strings for one or both. Four numbers would be a color and a grey, or
// a grey and a color: nobody can tell.
static bool read_colors(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const Property channel = {"colors", VALUE_NUMBERS, 0, RANGE_NOT_NEGATIVE, .count = 1};
    Vec3 *colors = value;
    f64 numbers[6];
    u32 count = 0;       // of numbers
    u32 strings = 0;
    u32 before = 0;      // numbers before the first string
    bool good = true;
    for (;;) {
        const TokenKind kind = parser->token.kind;
        if (kind == TOKEN_STRING && strings < 2) {
            if (strings++ == 0)
                before = count;
            good &= value_accept_color_text(parser, &colors[strings == 2 || before > 0 ? 1 : 0]);
        } else if (kind == TOKEN_NUMBER && count < 6) {
            good &= value_accept_number(parser, &channel, &numbers[count++]);
        } else {
            break;
        }
    }
    if (!good)
        return false;
    const bool one_side = before == 0 || before == count; // of the string
    if (strings == 0 ? count != 2 && count != 6
                     : strings == 1 ? !one_side || (count != 1 && count != 3) : count != 0)
        return value_refuse(parser, property, name, count);
    const u32 each = strings == 0 ? count / 2 : count;
    Vec3 *target = &colors[strings == 1 && before == 0 ? 1 : 0];
    for (u32 i = 0; i < count; i += each)
        *target++ = each == 1 ? (Vec3){numbers[i], numbers[i], numbers[i]}
                              : (Vec3){numbers[i], numbers[i + 1], numbers[i + 2]};
    return true;
}

#define COLORS {"colors", VALUE_OTHER, AT(Texture, colors), .read = read_colors, \
                .takes = "2 colors: 2 or 6 numbers, or \"#rrggbb\" for one or both"}
#define SCALE(numbers) {"scale", VALUE_NUMBERS, AT(Texture, scale), RANGE_NOT_ZERO, .count = numbers}

static const Property CHECKER_PROPERTIES[] = {COLORS, SCALE(2)};
static const Property CHECKER3D_PROPERTIES[] = {COLORS, SCALE(1)};
static const Property IMAGE_PROPERTIES[] = {
    {"file", VALUE_FILE, AT(Texture, file), .required = true,
     .position = offsetof(Texture, file_at)},
    SCALE(2),
    {"filter", VALUE_WORD, AT(Texture, filter), .words = FILTERS},
    {"color", VALUE_WORD, AT(Texture, encoding), .words = ENCODINGS},
};

static const BlockType TEXTURE_BLOCKS[] = {
    [TEXTURE_CHECKER] = BLOCK_TYPE("checker texture", CHECKER_PROPERTIES, NULL),
    [TEXTURE_CHECKER3D] = BLOCK_TYPE("checker3d texture", CHECKER3D_PROPERTIES, NULL),
    [TEXTURE_IMAGE] = BLOCK_TYPE("image texture", IMAGE_PROPERTIES, NULL),
};

static const char *const TEXTURE_KINDS[] = {"checker", "checker3d", "image", NULL};

// A definition that is wrong defines its name all the same, so that its uses are not errors too.
void texture_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)statement;
    (void)inside;
    Scene *scene = parser->scene;
    Texture texture = {.at = parser_position(parser, word),
                       .colors = {{1, 1, 1}, {0, 0, 0}},
                       .scale = {1, 1}};
    if (!parser_define(parser, &parser->textures, "texture", &texture.name)) {
        parser_skip_statement(parser);
        return;
    }
    u32 kind = TEXTURE_CHECKER;
    if (parser_read_word(parser, TEXTURE_KINDS, "kind of texture", &kind)) {
        texture.kind = (TextureKind)kind;
        block_parse(parser, &TEXTURE_BLOCKS[kind], word, &texture);
    } else {
        parser_skip_statement(parser);
    }
    if (!texture.name)
        return;
    Texture *textures = parser_grow(parser, scene->textures, scene->texture_count, sizeof *textures);
    if (!textures)
        return;
    scene->textures = textures;
    textures[scene->texture_count++] = texture;
}
