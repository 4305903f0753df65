/* MTL files: what the contract makes of their materials. */
#include <stdio.h>
#include <string.h>

#include "lines.h"
#include "mesh.h"

/* Three numbers, or one for all three. */
static Vec color(const Lines *lines)
{
    if (!lines_has_number(lines, 2))
        return grey(lines_number(lines, 1));
    return vec(lines_number(lines, 1), lines_number(lines, 2), lines_number(lines, 3));
}

/* A texture of the defaults with the file that the line names. */
static int file_texture(Scene *scene, const Lines *lines)
{
    size_t count = scene->texture_count;
    Texture texture = {.name = "", .kind = TEXTURE_IMAGE, .scale = {1, 1}, .srgb = true};
    texture.image = image_read(&scene->store, store_beside(&scene->store, lines->path, lines_rest(lines)));
    scene->textures = store_grow(&scene->store, scene->textures, count, sizeof texture);
    scene->textures[count] = texture;
    scene->texture_count = count + 1;
    return (int)count;
}

static void set(Scene *scene, Material *material, const Lines *lines)
{
    const char *key = lines->words[0];
    if (strcmp(key, "Kd") == 0)
        material->ambient.color = material->diffuse.color = color(lines);
    else if (strcmp(key, "Ks") == 0)
        material->specular = color(lines);
    else if (strcmp(key, "Ke") == 0)
        material->emission.color = color(lines);
    else if (strcmp(key, "Ns") == 0)
        material->shininess = lines_number(lines, 1);
    else if (strcmp(key, "Ni") == 0)
        material->ior = lines_number(lines, 1);
    else if (strcmp(key, "d") == 0)
        material->transmit = grey(1 - (real)lines_number(lines, 1));
    else if (strcmp(key, "map_Kd") == 0)
        material->ambient.texture = material->diffuse.texture = file_texture(scene, lines);
    else if (strcmp(key, "map_Bump") == 0 || strcmp(key, "norm") == 0)
        material->normal_map = file_texture(scene, lines);
}

void mtl_read(Scene *scene, const char *path, MtlList *list)
{
    Lines lines;
    Material *material = NULL;
    if (!lines_open(&lines, &scene->store, path)) {
        fprintf(stderr, "clrt-oracle: warning: %s cannot be opened\n", path);
        return;
    }
    while (lines_next(&lines)) {
        if (strcmp(lines.words[0], "newmtl") == 0) {
            size_t count = scene->material_count;
            scene->materials = store_grow(&scene->store, scene->materials, count, sizeof *scene->materials);
            scene->material_count = count + 1;
            /* Without a name, so that the scene's own text does not find it. */
            material = &scene->materials[count];
            *material = material_default("");
            material->ambient = material->diffuse;
            list->entries = store_grow(&scene->store, list->entries, list->count, sizeof *list->entries);
            list->entries[list->count++] = (MtlEntry){lines_rest(&lines), (int)count};
        } else if (material != NULL) {
            set(scene, material, &lines);
        }
    }
}
