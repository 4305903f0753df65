#include "support.h"

#include <math.h>

#include "assets/assets.h"
#include "device/list.h"
#include "image/color.h"

Device *test_device_open(u32 threads)
{
    Error error = {0};
    DeviceList *list = device_list_create(&error);
    const char *wish = getenv("CLRT_DEVICE");
    u32 index;
    Device *device = NULL;
    if (list && device_choose(list, wish && wish[0] ? wish : NULL, &index, &error)) {
        const DeviceOptions options = {.threads = threads};
        device = device_open(&list->devices[index], &options, &error);
    }
    device_list_destroy(list);
    if (!device)
        printf("skipped: %s\n", error.text);
    return device;
}

Layout *layout_of(const char *text) { return layout_by(text, LIGHT_SAMPLING_BOTH); }

Layout *layout_by(const char *text, LightSampling sampling)
{
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    Error error = {0};
    Scene *scene = scene_parse_text(CLRT_SOURCE "/tests/render/meshes/scene", text, strlen(text), arena,
                                    diagnostics, &error);
    const bool loaded = scene && diagnostics_error_count(diagnostics) == 0 &&
                        assets_load(scene, arena, diagnostics, &error);
    if (!loaded || diagnostics_error_count(diagnostics)) {
        diagnostics_print(diagnostics, stdout);
        fail_msg("the scene of the test has errors: %s", error.text);
    }
    scene->render.light_sampling = sampling;
    Layout *layout = layout_create(scene, &error);
    if (!layout)
        fail_msg("%s", error.text);
    assets_release(scene);
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return layout;
}

static void take_rows(Render *render, Picture *picture)
{
    u32 done = 0;
    Error error = {0};
    while (!render_finished(render)) {
        RenderRows rows;
        if (!render_step(render, &rows, &error))
            fail_msg("%s", error.text);
        assert_true(done + rows.count <= picture->height);
        if (rows.count)
            memcpy(picture->rgb + (size_t)done * picture->width * 3, rows.rgb,
                   (size_t)rows.count * picture->width * 3 * sizeof(f32));
        if (rows.count && rows.clamped)
            memcpy(picture->clamped + (size_t)done * picture->width * 4, rows.clamped,
                   (size_t)rows.count * picture->width * 4 * sizeof(f32));
        done += rows.count;
    }
    assert_int_equal(done, picture->height);
    picture->stats = *render_stats(render);
}

Picture render_layout(Device *device, const Layout *layout, const RenderHow *how)
{
    const RenderHow plain = {0};
    how = how ? how : &plain;
    const bool crop = how->width > 0;
    Picture picture = {.width = crop ? how->width : layout->params.width,
                       .height = crop ? how->height : layout->params.height};
    const RenderJob job = {.layout = layout, .device = device, .left = how->left, .top = how->top,
                           .width = picture.width, .height = picture.height, .memory_limit = how->memory,
                           .math = how->math, .clamp = how->clamp};
    Error error = {0};
    picture.rgb = calloc((size_t)picture.width * picture.height * 3, sizeof(f32));
    assert_non_null(picture.rgb);
    picture.clamped = how->clamp > 0 ? calloc((size_t)picture.width * picture.height * 4, sizeof(f32)) : NULL;
    if (how->shape)
        setenv("CLRT_SHAPE", how->shape, 1);
    Render *render = render_create(&job, &error);
    if (how->shape)
        unsetenv("CLRT_SHAPE");
    if (!render)
        fail_msg("%s", error.text);
    take_rows(render, &picture);
    render_destroy(render);
    return picture;
}

f32 *render_with_seeds(Device *device, const Layout *layout, u32 first, u32 count)
{
    const RenderJob job = {.layout = layout, .device = device, .width = layout->params.width,
                           .height = layout->params.height};
    const size_t values = 3 * (size_t)job.width * job.height;
    f32 *rgb = calloc(values * count, sizeof *rgb);
    Error error = {0};
    Render *render = render_create(&job, &error);
    assert_non_null(rgb);
    for (u32 k = 0; k < count; k++) {
        if (!render || !render_restart(render, first + k, &error))
            fail_msg("%s", error.text);
        Picture picture = {.width = job.width, .height = job.height, .rgb = rgb + values * k};
        take_rows(render, &picture);
    }
    render_destroy(render);
    return rgb;
}

Picture render_text(Device *device, const char *text, const RenderHow *how)
{
    Layout *layout = layout_of(text);
    Picture picture = render_layout(device, layout, how);
    layout_destroy(layout);
    return picture;
}

void picture_destroy(Picture *picture)
{
    free(picture->rgb);
    free(picture->clamped);
    memset(picture, 0, sizeof *picture);
}

const f32 *pixel_at(const Picture *picture, u32 x, u32 y)
{
    assert_true(x < picture->width && y < picture->height);
    return picture->rgb + 3 * ((size_t)y * picture->width + x);
}

void assert_same_picture(const Picture *a, const Picture *b, const char *what)
{
    assert_true(a->width == b->width && a->height == b->height);
    size_t different = 0, first = 0;
    for (size_t i = 3 * (size_t)a->width * a->height; i-- > 0;) {
        if (memcmp(&a->rgb[i], &b->rgb[i], sizeof(f32)) != 0) {
            different++;
            first = i;
        }
    }
    if (different)
        fail_msg("%s: %zu of %zu values differ; the first at pixel (%zu, %zu): %.9g and %.9g", what,
                 different, 3 * (size_t)a->width * a->height, first / 3 % a->width, first / 3 / a->width,
                 (f64)a->rgb[first], (f64)b->rgb[first]);
}

static f64 level(f32 x)
{
    const f64 c = x > 0 ? (x < 1 ? (f64)x : 1.0) : 0.0;
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055);
}

u32 levels_apart(const Picture *a, const Picture *b, f64 tolerance)
{
    assert_true(a->width == b->width && a->height == b->height);
    u32 apart = 0;
    for (size_t i = 0; i < 3 * (size_t)a->width * a->height; i++)
        apart += !(fabs(level(a->rgb[i]) - level(b->rgb[i])) <= tolerance);
    return apart;
}

static char *text_of_list(const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    assert_true(length >= 0);
    char *text = malloc((size_t)length + 1);
    assert_non_null(text);
    vsnprintf(text, (size_t)length + 1, format, arguments);
    return text;
}

char *text_of(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_of_list(format, arguments);
    va_end(arguments);
    return text;
}

void text_append(char **text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *more = text_of_list(format, arguments);
    va_end(arguments);
    const size_t used = *text ? strlen(*text) : 0;
    *text = realloc(*text, used + strlen(more) + 1);
    assert_non_null(*text);
    memcpy(*text + used, more, strlen(more) + 1);
    free(more);
}

char *text_of_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot open %s", path);
    char *text = NULL;
    char line[4096];
    while (fgets(line, sizeof line, file))
        text_append(&text, "%s", line);
    fclose(file);
    assert_non_null(text);
    return text;
}

f64 random_unit(u64 *state)
{
    *state += 0x9e3779b97f4a7c15u;
    u64 x = *state;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (f64)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

f64 random_in(u64 *state, f64 low, f64 high)
{
    return low + (high - low) * random_unit(state);
}
