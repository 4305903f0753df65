/* Textures, materials and lights. */
#include <string.h>

#include "parse.h"

/* Both colors of a checker: 2 or 6 numbers, or strings mixed with either. */
static void parse_checker_colors(Parser *parser, Vec colors[2])
{
    int numbers = 0;
    int strings = 0;
    for (const Token *t = parser->at; t->kind == TOKEN_NUMBER || t->kind == TOKEN_STRING; t++) {
        numbers += t->kind == TOKEN_NUMBER;
        strings += t->kind == TOKEN_STRING;
    }
    bool triples = numbers == 3 * (2 - strings);
    for (int i = 0; i < 2; i++) {
        if (parser->at->kind == TOKEN_STRING)
            colors[i] = parse_color(parser);
        else
            colors[i] = triples ? parse_vec(parser) : grey(parse_number(parser));
    }
}

void parse_texture(Parser *parser)
{
    Scene *scene = parser->scene;
    Texture texture = {.name = parse_name(parser), .colors = {grey(1), grey(0)}, .scale = {1, 1}};
    texture.srgb = true;
    if (parse_accept(parser, "checker3d"))
        texture.kind = TEXTURE_CHECKER3D;
    else if (parse_accept(parser, "image"))
        texture.kind = TEXTURE_IMAGE;
    else if (!parse_accept(parser, "checker"))
        parse_unknown(parser, "texture");
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "colors")) {
            parse_checker_colors(parser, texture.colors);
        } else if (parse_accept(parser, "scale")) {
            texture.scale[0] = parse_number(parser);
            if (texture.kind != TEXTURE_CHECKER3D)
                texture.scale[1] = parse_number(parser);
        } else if (parse_accept(parser, "file")) {
            texture.image = image_read(&scene->store, parse_path(parser));
        } else if (parse_accept(parser, "filter")) {
            static const char *const NAMES[] = {"bilinear", "nearest"};
            texture.nearest = parse_choice(parser, NAMES, 2) == 1;
        } else if (parse_accept(parser, "color")) {
            static const char *const NAMES[] = {"linear", "srgb"};
            texture.srgb = parse_choice(parser, NAMES, 2) == 1;
        } else {
            parse_unknown(parser, "property");
        }
    }
    scene->textures = store_grow(&scene->store, scene->textures, scene->texture_count, sizeof texture);
    scene->textures[scene->texture_count++] = texture;
}

/* A property of phong and blinn_phong; false where the name is none. */
static bool parse_phong(Parser *parser, Material *material, bool *has_ambient)
{
    if (parse_accept(parser, "ambient")) {
        material->ambient = parse_paint(parser);
        *has_ambient = true;
    } else if (parse_accept(parser, "diffuse")) {
        material->diffuse = parse_paint(parser);
    } else if (parse_accept(parser, "specular")) {
        material->specular = parse_color(parser);
    } else if (parse_accept(parser, "shininess")) {
        material->shininess = parse_number(parser);
    } else if (parse_accept(parser, "reflect")) {
        material->reflect = parse_color(parser);
    } else if (parse_accept(parser, "transmit")) {
        material->transmit = parse_color(parser);
    } else if (parse_accept(parser, "fresnel")) {
        material->fresnel = parse_on_off(parser);
    } else {
        return false;
    }
    return true;
}

static bool parse_pbr(Parser *parser, Material *material)
{
    if (parse_accept(parser, "base_color"))
        material->base_color = parse_paint(parser);
    else if (parse_accept(parser, "metallic"))
        material->metallic = parse_paint(parser);
    else if (parse_accept(parser, "roughness"))
        material->roughness = parse_paint(parser);
    else if (parse_accept(parser, "occlusion"))
        material->occlusion = parse_paint(parser);
    else if (parse_accept(parser, "transmit"))
        material->share_transmitted = parse_number(parser);
    else
        return false;
    return true;
}

void parse_material(Parser *parser)
{
    static const char *const NAMES[] = {"phong", "blinn_phong", "pbr"};
    Scene *scene = parser->scene;
    Material material = material_default(parse_name(parser));
    bool has_ambient = false;
    int model = parse_choice(parser, NAMES, 3);
    material.blinn = model == 1;
    material.pbr = model == 2;
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "ior"))
            material.ior = parse_number(parser);
        else if (parse_accept(parser, "emission"))
            material.emission = parse_paint(parser);
        else if (parse_accept(parser, "normal_map"))
            material.normal_map = parse_texture_name(parser);
        else if (material.pbr ? !parse_pbr(parser, &material) : !parse_phong(parser, &material, &has_ambient))
            parse_unknown(parser, "property");
    }
    if (!has_ambient)
        material.ambient = material.diffuse;
    scene->materials = store_grow(&scene->store, scene->materials, scene->material_count, sizeof material);
    scene->materials[scene->material_count++] = material;
}

/* What only a light's block says on the way to a Light. */
typedef struct LightText {
    Vec look_at;
    real inner, outer;
} LightText;

static bool parse_punctual(Parser *parser, Light *light, LightText *text)
{
    if (parse_accept(parser, "position")) {
        light->position = parse_vec(parser);
    } else if (parse_accept(parser, "direction")) {
        light->direction = normalized(parse_vec(parser));
    } else if (parse_accept(parser, "look_at")) {
        text->look_at = parse_vec(parser);
    } else if (parse_accept(parser, "intensity")) {
        light->intensity = parse_color(parser);
    } else if (parse_accept(parser, "attenuation")) {
        for (int i = 0; i < 3; i++)
            light->attenuation[i] = parse_number(parser);
    } else if (parse_accept(parser, "inner")) {
        text->inner = parse_number(parser);
    } else if (parse_accept(parser, "outer")) {
        text->outer = parse_number(parser);
    } else {
        return false;
    }
    return true;
}

static bool parse_area(Parser *parser, Light *light)
{
    if (parse_accept(parser, "center") || parse_accept(parser, "corner"))
        light->position = parse_vec(parser);
    else if (parse_accept(parser, "radius"))
        light->radius = parse_number(parser);
    else if (parse_accept(parser, "edge1"))
        light->edges[0] = parse_vec(parser);
    else if (parse_accept(parser, "edge2"))
        light->edges[1] = parse_vec(parser);
    else if (parse_accept(parser, "radiance"))
        light->intensity = parse_color(parser);
    else if (parse_accept(parser, "samples"))
        parse_number(parser);
    else
        return false;
    return true;
}

static Item light_surface(const Light *light, int index)
{
    Item item = {.material = MATERIAL_DEFAULT, .light = index, .placed = transform_identity()};
    item.shape.kind = light->kind == LIGHT_SPHERE ? SHAPE_SPHERE : SHAPE_PARALLELOGRAM;
    item.shape.center = light->position;
    item.shape.radius = light->radius;
    item.shape.vertices[0] = light->position;
    item.shape.vertices[1] = add(light->position, light->edges[0]);
    item.shape.vertices[2] = add(light->position, light->edges[1]);
    return item;
}

bool parse_light(Parser *parser, Item *item)
{
    static const char *const NAMES[] = {"point", "directional", "spot", "sphere", "rectangle"};
    Scene *scene = parser->scene;
    Light light = {.intensity = grey(1), .attenuation = {1, 0, 0}};
    LightText text = {.inner = -1, .outer = 45};
    light.kind = (LightKind)parse_choice(parser, NAMES, 5);
    bool area = light.kind == LIGHT_SPHERE || light.kind == LIGHT_RECTANGLE;
    parse_open(parser);
    while (!parse_closed(parser))
        if (!(area ? parse_area(parser, &light) : parse_punctual(parser, &light, &text)))
            parse_unknown(parser, "property");
    if (light.kind == LIGHT_SPOT) {
        light.direction = normalized(sub(text.look_at, light.position));
        light.cos_outer = cosl(text.outer * PI / 360);
        light.cos_inner = cosl((text.inner < 0 ? text.outer : text.inner) * PI / 360);
    }
    if (area)
        *item = light_surface(&light, (int)scene->light_count);
    scene->lights = store_grow(&scene->store, scene->lights, scene->light_count, sizeof light);
    scene->lights[scene->light_count++] = light;
    return area;
}
