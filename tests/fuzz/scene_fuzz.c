// The parser under a fuzzer: any bytes give a scene or messages. Built with -fsanitize=fuzzer it is a
// libFuzzer target; without (no CLRT_FUZZ) it is a program that runs the files it is given.
#include <stdio.h>
#include <stdlib.h>

#include "scene/parse.h"

int LLVMFuzzerTestOneInput(const u8 *data, size_t size);

static void check_scene(const Scene *scene)
{
    // What whoever holds a scene relies on.
    for (u32 i = 0; i < scene->shape_count; ++i) {
        if (scene->shapes[i].material >= (i32)scene->material_count)
            abort();
    }
    for (u32 i = 0; i < scene->instance_count; ++i) {
        if (scene->instances[i].object >= scene->object_count)
            abort();
    }
    for (u32 i = 0; i < scene->material_count; ++i) {
        const i32 count = (i32)scene->texture_count;
        const Material *m = &scene->materials[i];
        if (!m->name || m->ambient.texture >= count || m->diffuse.texture >= count)
            abort();
    }
}

int LLVMFuzzerTestOneInput(const u8 *data, size_t size)
{
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    char *text = NULL;
    size_t printed = 0;
    FILE *stream = open_memstream(&text, &printed);
    if (!arena || !diagnostics || !stream)
        abort();
    Error error;
    const Scene *scene = scene_parse_text("fuzz", (const char *)data, size, arena, diagnostics, &error);
    if (!scene)
        abort();
    diagnostics_print(diagnostics, stream);
    fclose(stream);
    if ((diagnostics_error_count(diagnostics) > 0) != (printed > 0))
        abort();
    if (diagnostics_error_count(diagnostics) == 0)
        check_scene(scene);
    free(text);
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return 0;
}

#include "fuzz_main.h"
