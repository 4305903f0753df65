// Output: what stands in the files, and what stays of an older file when something goes wrong.
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "image/pfm.h"
#include "image/png.h"
#include "output/output.h"
#include "output/quantize.h"

enum { WIDTH = 13, HEIGHT = 7, ROW = WIDTH * 3 };

typedef struct Fixture {
    char folder[64];
    char path[128];
    f32 rows[HEIGHT * ROW];
} Fixture;

static int set_up(void **state)
{
    Fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/clrt-output-XXXXXX");
    if (!mkdtemp(f->folder))
        return -1;
    for (int i = 0; i < HEIGHT * ROW; i++)
        f->rows[i] = (f32)i / (HEIGHT * ROW - 30);
    f->rows[5] = NAN;
    f->rows[6] = INFINITY;
    f->rows[7] = -1;
    *state = f;
    return 0;
}

static int count_files(const Fixture *f)
{
    DIR *folder = opendir(f->folder);
    assert_non_null(folder);
    int count = 0;
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return count;
}

static int tear_down(void **state)
{
    Fixture *f = *state;
    DIR *folder = opendir(f->folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", f->folder, entry->d_name);
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            unlink(path);
    }
    closedir(folder);
    const int result = rmdir(f->folder);
    free(f);
    return result;
}

static const char *path_of(Fixture *f, const char *name)
{
    snprintf(f->path, sizeof f->path, "%s/%s", f->folder, name);
    return f->path;
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static size_t read_bytes(const char *path, u8 *bytes, size_t capacity)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t length = fread(bytes, 1, capacity, file);
    fclose(file);
    return length;
}

static bool find_bytes(const u8 *bytes, size_t length, const char *part, size_t part_length)
{
    for (size_t i = 0; i + part_length <= length; i++) {
        if (memcmp(bytes + i, part, part_length) == 0)
            return true;
    }
    return false;
}

// In blocks of 1, 2, 3, ... rows.
static bool write_picture(const Fixture *f, const char *path, const OutputOptions *options, Error *error)
{
    Output *output = output_open(path, options, WIDTH, HEIGHT, error);
    if (!output)
        return false;
    u32 done = 0;
    for (u32 block = 1; done < HEIGHT; block++) {
        const u32 count = block < HEIGHT - done ? block : HEIGHT - done;
        if (!output_write_rows(output, f->rows + done * ROW, count, error)) {
            output_abort(output);
            return false;
        }
        done += count;
    }
    return output_commit(output, error);
}

static void test_png_levels(void **state)
{
    Fixture *f = *state;
    for (int i = 0; i < 8; i++) {
        const OutputOptions options = {.settings = {.exposure = i & 4 ? -0.7 : 0,
                                                    .tone_map = i & 4 ? TONE_MAP_HABLE : TONE_MAP_NONE,
                                                    .encoding = i & 1 ? ENCODING_LINEAR : ENCODING_SRGB},
                                       .bits = i & 2 ? 16 : 8};
        Error error;
        const char *path = path_of(f, "picture.PNG");
        assert_true(write_picture(f, path, &options, &error));
        assert_int_equal(count_files(f), 1);
        PngInfo info;
        Image *image = png_image_read(path, &info, &error);
        assert_non_null(image);
        assert_int_equal(image->width, WIDTH);
        assert_int_equal(image->height, HEIGHT);
        assert_int_equal(image->channels, 3);
        assert_int_equal(info.bits, options.bits);
        assert_int_equal(info.linear, i & 1);
        for (int k = 0; k < HEIGHT * ROW; k++)
            assert_true(image->values[k] == (f32)quantize_exact(&options.settings, options.bits, f->rows[k]));
        image_destroy(image);
    }
}

static void test_png_chunks(void **state)
{
    Fixture *f = *state;
    const OutputText texts[] = {{"Software", "clrt 1.2"}, {"Scene", "caf\xc3\xa9.txt"}};
    OutputOptions options = {.bits = 8, .texts = texts, .text_count = 2};
    Error error;
    u8 bytes[4096];
    const char *path = path_of(f, "a.png");
    assert_true(write_picture(f, path, &options, &error));
    size_t length = read_bytes(path, bytes, sizeof bytes);
    assert_true(find_bytes(bytes, length, "sRGB\0", 5));
    assert_false(find_bytes(bytes, length, "gAMA", 4));
    assert_true(find_bytes(bytes, length, "tEXtSoftware\0clrt 1.2", 21));
    assert_true(find_bytes(bytes, length, "iTXtScene\0\0\0\0\0caf\xc3\xa9.txt", 23));

    // What is known after the last row follows it; what was before is there once.
    const OutputText late[] = {{"Comment", "after the rows"}, {"Warning", "caf\xc3\xa9"}};
    Output *output = output_open(path, &options, WIDTH, HEIGHT, &error);
    assert_non_null(output);
    assert_true(output_write_rows(output, f->rows, HEIGHT, &error));
    assert_true(output_add_texts(output, late, 2, &error));
    assert_true(output_commit(output, &error));
    const size_t longer = read_bytes(path, bytes, sizeof bytes);
    const char closing[] = "tEXtComment\0after the rows", image[] = "IDAT";
    assert_true(find_bytes(bytes, longer, closing, sizeof closing - 1));
    assert_true(find_bytes(bytes, longer, "iTXtWarning\0\0\0\0\0caf\xc3\xa9", 21));
    const size_t two_chunks = 2 * 12 + (sizeof closing - 1 - 4) + 17;
    assert_int_equal(longer, length + two_chunks);
    assert_true(find_bytes(bytes, longer - two_chunks, image, 4));
    assert_false(find_bytes(bytes, longer - two_chunks - 12, closing, sizeof closing - 1));

    options = (OutputOptions){.bits = 8, .settings.encoding = ENCODING_LINEAR};
    assert_true(write_picture(f, path, &options, &error));
    length = read_bytes(path, bytes, sizeof bytes);
    assert_true(find_bytes(bytes, length, "gAMA\0\x01\x86\xa0", 8));
    assert_false(find_bytes(bytes, length, "sRGB", 4));
    assert_false(find_bytes(bytes, length, "tEXt", 4));
}

static void test_pfm_layout(void **state)
{
    Fixture *f = *state;
    // None of these may touch the radiance.
    const OutputOptions options = {
        .settings = {.exposure = 3, .tone_map = TONE_MAP_ACES, .encoding = ENCODING_LINEAR}, .bits = 16};
    Error error;
    u8 bytes[4096];
    const char *path = path_of(f, "a.pfm");
    assert_true(write_picture(f, path, &options, &error));
    const size_t length = read_bytes(path, bytes, sizeof bytes);
    const char header[] = "PF\n13 7\n-1.0\n";
    const size_t start = sizeof header - 1;
    assert_int_equal(length, start + sizeof f->rows);
    assert_memory_equal(bytes, header, start);
    for (u32 y = 0; y < HEIGHT; y++) {
        for (u32 i = 0; i < ROW; i++) {
            u32 bits;
            memcpy(&bits, &f->rows[y * ROW + i], sizeof bits);
            const u8 *at = bytes + start + ((HEIGHT - 1 - y) * ROW + i) * 4;
            assert_int_equal(at[0] | (u32)at[1] << 8 | (u32)at[2] << 16 | (u32)at[3] << 24, bits);
        }
    }
    Image *image = pfm_image_read(path, &error);
    assert_non_null(image);
    assert_memory_equal(image->values, f->rows, sizeof f->rows);
    image_destroy(image);
}

static void test_suffixes(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    const struct {
        const char *name, *says;
    } refused[] = {
        {"a.jpg", ".png, .exr, .hdr or .pfm"},  {"a", ".png, .exr, .hdr or .pfm"},
        {"png", ".png, .exr, .hdr or .pfm"},    {"a.png/b", ".png, .exr, .hdr or .pfm"},
        {"a.pngx", ".png, .exr, .hdr or .pfm"}, {"a.pn", ".png, .exr, .hdr or .pfm"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        Error error;
        const char *path = path_of(f, refused[i].name);
        assert_null(output_open(path, &options, WIDTH, HEIGHT, &error));
        assert_int_equal(error.code, ERROR_USAGE);
        assert_non_null(strstr(error.text, path));
        assert_non_null(strstr(error.text, refused[i].says));
        assert_int_equal(count_files(f), 0);
    }
    assert_true(output_ignores_display_settings("x/a.PFM"));
    assert_true(output_ignores_display_settings("a.hdr"));
    assert_true(output_ignores_display_settings("a.Exr"));
    assert_false(output_ignores_display_settings("x.pfm/a.png"));
    assert_false(output_ignores_display_settings("-"));
}

static void expect_old_picture(const Fixture *f, const char *path)
{
    u8 bytes[16];
    assert_int_equal(read_bytes(path, bytes, sizeof bytes), 3);
    assert_memory_equal(bytes, "old", 3);
    assert_int_equal(count_files(f), 1);
}

static void test_abort_keeps_the_old_picture(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    const char *const names[] = {"a.png", "a.pfm"};
    for (int i = 0; i < 2; i++) {
        Error error;
        const char *path = path_of(f, names[i]);
        write_text(path, "old");
        Output *output = output_open(path, &options, WIDTH, HEIGHT, &error);
        assert_non_null(output);
        const char *temporary = output_temporary_path(output);
        assert_non_null(temporary);
        assert_memory_equal(temporary, f->folder, strlen(f->folder));
        assert_int_equal(access(temporary, F_OK), 0);
        assert_true(output_write_rows(output, f->rows, HEIGHT - 1, &error));
        output_abort(output);
        expect_old_picture(f, path);
        unlink(path);
        output_abort(NULL);
    }
}

// An interrupt handler may have taken the temporary file away.
static void test_commit_without_the_temporary_file(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    Error error;
    const char *path = path_of(f, "a.png");
    write_text(path, "old");
    Output *output = output_open(path, &options, WIDTH, HEIGHT, &error);
    assert_non_null(output);
    assert_true(output_write_rows(output, f->rows, HEIGHT, &error));
    assert_int_equal(unlink(output_temporary_path(output)), 0);
    assert_false(output_commit(output, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_non_null(strstr(error.text, path));
    expect_old_picture(f, path);
}

static void test_full_disk(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 16};
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_IGN);
    const char *const names[] = {"a.png", "a.pfm"};
    for (int i = 0; i < 2; i++) {
        Error error = {.code = ERROR_NONE};
        const char *path = path_of(f, names[i]);
        write_text(path, "old");
        const struct rlimit limit = {.rlim_cur = 300, .rlim_max = before.rlim_max};
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        // Noise, so that a PNG is larger than the limit, too.
        for (int k = 0; k < HEIGHT * ROW; k++)
            f->rows[k] = (f32)(k * 7919 % 1000) / 1000;
        const bool done = write_picture(f, path, &options, &error);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
        assert_false(done);
        assert_int_equal(error.code, ERROR_IO);
        assert_non_null(strstr(error.text, path));
        assert_non_null(strstr(error.text, "File too large"));
        expect_old_picture(f, path);
        unlink(path);
    }
}

static void test_devices(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    Error error;
    assert_true(write_picture(f, "/dev/null", &options, &error));
    struct stat null;
    assert_int_equal(stat("/dev/null", &null), 0);
    assert_true(S_ISCHR(null.st_mode));
    assert_false(write_picture(f, "/dev/full", &options, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_string_equal(error.text, "/dev/full: No space left on device");
    // Links keep their names: what they point to is written. A spool serves what cannot seek.
    const char *path = path_of(f, "full.pfm");
    assert_int_equal(symlink("/dev/full", path), 0);
    assert_false(write_picture(f, path, &options, &error));
    assert_non_null(strstr(error.text, "No space left on device"));
    path = path_of(f, "null.pfm");
    assert_int_equal(symlink("/dev/null", path), 0);
    assert_true(write_picture(f, path, &options, &error));
    assert_int_equal(count_files(f), 2);
    assert_null(output_open(path_of(f, "missing/a.png"), &options, WIDTH, HEIGHT, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_non_null(strstr(error.text, "No such file or directory"));
}

static void test_pfm_through_a_pipe(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    const char *path = path_of(f, "pipe.pfm");
    assert_int_equal(mkfifo(path, 0600), 0);
    // A reader that is there first, so that nobody waits; the picture is smaller than the pipe.
    const int reader = open(path, O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    Error error;
    assert_true(write_picture(f, path, &options, &error));
    u8 bytes[4096];
    const ssize_t length = read(reader, bytes, sizeof bytes);
    close(reader);
    const size_t start = strlen("PF\n13 7\n-1.0\n");
    assert_int_equal(length, start + sizeof f->rows);
    assert_memory_equal(bytes + start, f->rows + (HEIGHT - 1) * ROW, ROW * sizeof(f32));
}

static void test_standard_output(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    char file[128];
    snprintf(file, sizeof file, "%s", path_of(f, "redirected"));
    fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    const int target = open(file, O_WRONLY | O_CREAT, 0600);
    assert_true(saved >= 0 && target >= 0);
    dup2(target, STDOUT_FILENO);
    Error error;
    const bool done = write_picture(f, "-", &options, &error);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    close(target);
    assert_true(done);
    PngInfo info;
    Image *image = png_image_read(file, &info, &error);
    assert_non_null(image);
    image_destroy(image);
    assert_int_equal(count_files(f), 1);
}

static void test_modes_and_links(void **state)
{
    Fixture *f = *state;
    const OutputOptions options = {.bits = 8};
    Error error;
    struct stat file;
    const mode_t mask = umask(027);
    const char *path = path_of(f, "a.png");
    assert_true(write_picture(f, path, &options, &error));
    umask(mask);
    assert_int_equal(stat(path, &file), 0);
    assert_int_equal(file.st_mode & 0777, 0640);
    // An older file's mode stays, and a link to it stays a link.
    assert_int_equal(chmod(path, 0604), 0);
    char link[128];
    snprintf(link, sizeof link, "%s/link.png", f->folder);
    assert_int_equal(symlink("a.png", link), 0);
    const ino_t inode = file.st_ino;
    assert_true(write_picture(f, link, &options, &error));
    assert_int_equal(lstat(link, &file), 0);
    assert_true(S_ISLNK(file.st_mode));
    assert_int_equal(stat(path, &file), 0);
    assert_int_equal(file.st_mode & 0777, 0604);
    assert_true(file.st_ino != inode);
    assert_int_equal(count_files(f), 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_png_levels, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_png_chunks, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_pfm_layout, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_suffixes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_abort_keeps_the_old_picture, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_commit_without_the_temporary_file, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_full_disk, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_devices, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_pfm_through_a_pipe, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_standard_output, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_modes_and_links, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
