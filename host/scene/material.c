// material: three kinds, and `default`, which is there before any is defined.
#include "scene/material.h"

#include "scene/statement.h"

#define IOR {"ior", VALUE_NUMBERS, AT(Material, ior), RANGE_POSITIVE, .count = 1}
#define NORMAL_MAP \
    {"normal_map", VALUE_TEXTURE, AT(Material, normal_map), \
     .position = offsetof(Material, normal_map_at)}
#define INPUT(name, member) {name, VALUE_NUMBER_OR_TEXTURE, AT(Material, member), RANGE_UNIT, .count = 1}

static const Property PHONG_PROPERTIES[] = {
    {"ambient", VALUE_COLOR_OR_TEXTURE, AT(Material, ambient)},
    {"diffuse", VALUE_COLOR_OR_TEXTURE, AT(Material, diffuse)},
    {"specular", VALUE_COLOR, AT(Material, specular)},
    {"shininess", VALUE_NUMBERS, AT(Material, shininess), RANGE_SHININESS, .count = 1},
    {"reflect", VALUE_COLOR, AT(Material, reflect)},
    {"transmit", VALUE_COLOR, AT(Material, transmit)},
    IOR,
    {"fresnel", VALUE_SWITCH, AT(Material, fresnel)},
    {"emission", VALUE_COLOR, AT(Material, emission.color)},
    NORMAL_MAP,
};

static const Property PBR_PROPERTIES[] = {
    {"base_color", VALUE_COLOR_OR_TEXTURE, AT(Material, base_color)},
    INPUT("metallic", metallic),
    INPUT("roughness", roughness),
    {"emission", VALUE_COLOR_OR_TEXTURE, AT(Material, emission)},
    INPUT("occlusion", occlusion),
    NORMAL_MAP,
    {"transmit", VALUE_NUMBERS, AT(Material, pbr_transmit), RANGE_UNIT, .count = 1},
    IOR,
};

static void check_phong(Parser *parser, Block *block)
{
    (void)parser;
    Material *material = block->target;
    if (!block_given(block, "ambient"))
        material->ambient = material->diffuse;
}

static const BlockType MATERIAL_BLOCKS[] = {
    [MATERIAL_PHONG] = BLOCK_TYPE("phong material", PHONG_PROPERTIES, check_phong),
    [MATERIAL_BLINN_PHONG] = BLOCK_TYPE("blinn_phong material", PHONG_PROPERTIES, check_phong),
    [MATERIAL_PBR] = BLOCK_TYPE("pbr material", PBR_PROPERTIES, NULL),
};

static const char *const MATERIAL_KINDS[] = {"phong", "blinn_phong", "pbr", NULL};

Material material_default(void)
{
    const ColorInput grey = {{0.8, 0.8, 0.8}, -1};
    return (Material){
        .kind = MATERIAL_PHONG,
        .at = {0, 1, 1},
        .name = "default",
        .ambient = grey,
        .diffuse = grey,
        .shininess = 32,
        .base_color = grey,
        .metallic = {0, -1},
        .roughness = {0.5, -1},
        .occlusion = {1, -1},
        .ior = 1.5,
        .emission = {{0, 0, 0}, -1},
        .normal_map = -1,
    };
}

// `default` is defined from the start; the first definition in the text takes its place.
static bool define(Parser *parser, const Token *word, const char **name)
{
    const bool is_default = token_is(&parser->token, "default") && parser->default_at.line == 0;
    if (!is_default)
        return parser_define(parser, &parser->materials, "material", name);
    parser->default_at = parser_position(parser, word);
    parser_advance(parser);
    *name = parser->scene->materials[0].name;
    return true;
}

// A definition that is wrong defines its name all the same, so that its uses are not errors too.
void material_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    (void)statement;
    (void)inside;
    Scene *scene = parser->scene;
    Material material = material_default();
    material.at = parser_position(parser, word);
    if (!define(parser, word, &material.name)) {
        parser_skip_statement(parser);
        return;
    }
    u32 kind = MATERIAL_PHONG;
    if (parser_read_word(parser, MATERIAL_KINDS, "kind of material", &kind)) {
        material.kind = (MaterialKind)kind;
        block_parse(parser, &MATERIAL_BLOCKS[kind], word, &material);
    } else {
        parser_skip_statement(parser);
    }
    if (!material.name)
        return;
    if (material.name == scene->materials[0].name) {
        scene->materials[0] = material;
        return;
    }
    Material *materials = parser_grow(parser, scene->materials, scene->material_count, sizeof *materials);
    if (!materials)
        return;
    scene->materials = materials;
    materials[scene->material_count++] = material;
}
