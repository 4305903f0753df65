#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <png.h>

#include "program.h"

int set_up(void **state)
{
    Fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/clrt-compare-XXXXXX");
    if (!mkdtemp(f->folder) || chdir(f->folder) != 0)
        return -1;
    for (int i = 0; i < VALUES; i++) {
        f->levels[i] = (u8)(i % 200 + 20);
        f->floats[i] = (f32)(i + 1) / 100;
    }
    *state = f;
    return 0;
}

int tear_down(void **state)
{
    Fixture *f = *state;
    DIR *folder = opendir(f->folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (entry->d_name[0] != '.')
            unlink(entry->d_name);
    }
    closedir(folder);
    const int result = chdir("/") || rmdir(f->folder);
    free(f);
    return result;
}

void write_levels(const char *name, const void *levels, u32 format, u32 width, u32 height)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = format};
    assert_true(png_image_write_to_file(&image, name, 0, levels, 0, NULL));
}

void write_rgb(const char *name, const u8 *levels)
{
    write_levels(name, levels, PNG_FORMAT_RGB, WIDTH, HEIGHT);
}

void write_output(const char *name, const f32 *rows, const OutputOptions *options)
{
    Error error;
    Output *output = output_open(name, options, WIDTH, HEIGHT, &error);
    assert_non_null(output);
    assert_true(output_write_rows(output, rows, HEIGHT, &error));
    assert_true(output_commit(output, &error));
}

void write_pfm(const char *name, const f32 *rows)
{
    write_output(name, rows, &(OutputOptions){.bits = 8});
}

void read_text(const char *name, char text[TEXT_BYTES])
{
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t length = fread(text, 1, TEXT_BYTES - 1, file);
    text[length] = 0;
    fclose(file);
}

int run(Fixture *f, const char *arguments)
{
    char command[1024];
    snprintf(command, sizeof command, "\"%s\" %s >out.txt 2>err.txt", CLRT_COMPARE, arguments);
    const int status = system(command);
    assert_true(WIFEXITED(status));
    read_text("out.txt", f->out);
    read_text("err.txt", f->err);
    return WEXITSTATUS(status);
}

void expect_same(Fixture *f, const char *arguments)
{
    if (run(f, arguments) != 0)
        fail_msg("clrt-compare %s: not the same\n%s%s", arguments, f->out, f->err);
    assert_string_equal(f->err, "");
}

void expect_different(Fixture *f, const char *arguments)
{
    if (run(f, arguments) != 1)
        fail_msg("clrt-compare %s: not different\n%s%s", arguments, f->out, f->err);
    assert_string_equal(f->err, "");
}

void expect_trouble(Fixture *f, const char *arguments, const char *says)
{
    if (run(f, arguments) != 2 || !strstr(f->err, says))
        fail_msg("clrt-compare %s: expected \"%s\"\n%s%s", arguments, says, f->out, f->err);
    assert_string_equal(f->out, "");
}

json_t *run_json(Fixture *f, const char *arguments, int status)
{
    char all[512];
    snprintf(all, sizeof all, "--json %s", arguments);
    assert_int_equal(run(f, all), status);
    json_error_t error;
    json_t *root = json_loads(f->out, JSON_REJECT_DUPLICATES, &error);
    assert_non_null(root);
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "clrt-compare/1");
    return root;
}

f64 number(const json_t *root, const char *key)
{
    const json_t *value = json_object_get(root, key);
    if (!json_is_number(value))
        fail_msg("%s is not a number", key);
    return json_number_value(value);
}
