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
    if (parse_accept(parser, "checker3d"))
        texture.kind = TEXTURE_CHECKER3D;
    else if (!parse_accept(parser, "checker"))
        parse_unknown(parser, "texture");
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "colors")) {
            parse_checker_colors(parser, texture.colors);
        } else if (parse_accept(parser, "scale")) {
            texture.scale[0] = parse_number(parser);
            if (texture.kind == TEXTURE_CHECKER)
                texture.scale[1] = parse_number(parser);
        } else {
            parse_unknown(parser, "property");
        }
    }
    scene->textures = store_grow(&scene->store, scene->textures, scene->texture_count, sizeof texture);
    scene->textures[scene->texture_count++] = texture;
}

void parse_material(Parser *parser)
{
    Scene *scene = parser->scene;
    Material material = material_default(parse_name(parser));
    bool has_ambient = false;
    if (parse_accept(parser, "blinn_phong"))
        material.blinn = true;
    else if (!parse_accept(parser, "phong"))
        parse_unknown(parser, "material");
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "ambient")) {
            material.ambient = parse_paint(parser);
            has_ambient = true;
        } else if (parse_accept(parser, "diffuse")) {
            material.diffuse = parse_paint(parser);
        } else if (parse_accept(parser, "specular")) {
            material.specular = parse_color(parser);
        } else if (parse_accept(parser, "shininess")) {
            material.shininess = parse_number(parser);
        } else if (parse_accept(parser, "reflect")) {
            material.reflect = parse_color(parser);
        } else if (parse_accept(parser, "transmit")) {
            material.transmit = parse_color(parser);
        } else if (parse_accept(parser, "ior")) {
            material.ior = parse_number(parser);
        } else if (parse_accept(parser, "fresnel")) {
            material.fresnel = parse_on_off(parser);
        } else if (parse_accept(parser, "emission")) {
            material.emission = parse_color(parser);
        } else {
            parse_unknown(parser, "property");
        }
    }
    if (!has_ambient)
        material.ambient = material.diffuse;
    scene->materials = store_grow(&scene->store, scene->materials, scene->material_count, sizeof material);
    scene->materials[scene->material_count++] = material;
}

void parse_light(Parser *parser)
{
    Scene *scene = parser->scene;
    Light light = {.intensity = grey(1), .attenuation = {1, 0, 0}};
    real outer = 45;
    real inner = -1;
    Vec look_at = vec(0, 0, 0);
    if (parse_accept(parser, "directional"))
        light.kind = LIGHT_DIRECTIONAL;
    else if (parse_accept(parser, "spot"))
        light.kind = LIGHT_SPOT;
    else if (!parse_accept(parser, "point"))
        parse_unknown(parser, "light");
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_accept(parser, "position")) {
            light.position = parse_vec(parser);
        } else if (parse_accept(parser, "direction")) {
            light.direction = normalized(parse_vec(parser));
        } else if (parse_accept(parser, "look_at")) {
            look_at = parse_vec(parser);
        } else if (parse_accept(parser, "intensity")) {
            light.intensity = parse_color(parser);
        } else if (parse_accept(parser, "attenuation")) {
            for (int i = 0; i < 3; i++)
                light.attenuation[i] = parse_number(parser);
        } else if (parse_accept(parser, "inner")) {
            inner = parse_number(parser);
        } else if (parse_accept(parser, "outer")) {
            outer = parse_number(parser);
        } else {
            parse_unknown(parser, "property");
        }
    }
    if (light.kind == LIGHT_SPOT) {
        light.direction = normalized(sub(look_at, light.position));
        light.cos_outer = cosl(outer * PI / 360);
        light.cos_inner = cosl((inner < 0 ? outer : inner) * PI / 360);
    }
    scene->lights = store_grow(&scene->store, scene->lights, scene->light_count, sizeof light);
    scene->lights[scene->light_count++] = light;
}
