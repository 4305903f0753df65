#include "hierarchy_support.h"

#include <unistd.h>

void must(bool done, const Error *error)
{
    if (!done)
        fail_msg("%s", error->text);
}

Search search_create(Device *device, u32 lanes, u32 batch)
{
    Search search = {.device = device, .batch = batch, .lanes = lanes};
    Error error = {0};
    search.source = text_of_file(CLRT_SOURCE "/tests/render/hierarchy.cl");
    // Drivers split options at spaces, which the path may have.
    assert_int_equal(chdir(CLRT_SOURCE "/kernels"), 0);
    char *options = text_of("-w -I . -DLANES=%u -DBATCH=%u -DGROUP=1", lanes, batch);
    if (device_info(device)->exact_divide)
        text_append(&options, " -cl-fp32-correctly-rounded-divide-sqrt");
    for (Feature f = 0; f < FEATURE_COUNT; f++) {
        const bool textures = f == FEATURE_UV || f == FEATURE_CHECKER || f == FEATURE_CHECKER3D;
        text_append(&options, " -DHAS_%s=%d", feature_name(f), !textures);
    }
    search.program = program_create(device, search.source, strlen(search.source), options, &error);
    if (!search.program)
        fail_msg("%s", error.text);
    search.search = kernel_create(search.program, "search", &error);
    search.bounce = kernel_create(search.program, "bounce", &error);
    assert_true(search.search && search.bounce);
    free(options);
    return search;
}

void search_destroy(Search *search)
{
    kernel_destroy(search->search);
    kernel_destroy(search->bounce);
    program_destroy(search->program);
    free(search->source);
}

// Adds the primitives of the leaves below node, met through instance.
static void list_leaves(const Layout *layout, u32 node, i32 instance, i32 *pairs, u32 *count)
{
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const BvhNode *n = &layout->nodes[node];
        if (!(n->lower_x[slot] <= n->upper_x[slot]))
            continue;
        if (n->child[slot] >= 0) {
            list_leaves(layout, (u32)n->child[slot], instance, pairs, count);
            continue;
        }
        const u32 leaf = ~(u32)n->child[slot];
        for (u32 i = leaf >> 4; i < (leaf >> 4) + (leaf & 15u); i++) {
            const Primitive *primitive = &layout->primitives[i];
            if ((primitive->kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE) {
                u32 root;
                memcpy(&root, &primitive->p0, sizeof root);
                list_leaves(layout, root, (i32)i, pairs, count);
                continue;
            }
            assert_true(*count < 4096);
            pairs[2 * *count] = (i32)i;
            pairs[2 * (*count)++ + 1] = instance;
        }
    }
}

static Buffer *filled(Device *device, const char *name, const void *data, u64 bytes)
{
    Error error = {0};
    Buffer *buffer = buffer_create(device, name, bytes, &error);
    must(buffer != NULL, &error);
    if (bytes)
        must(buffer_upload(buffer, 0, data, bytes, &error), &error);
    return buffer;
}

Space space_create(Device *device, const char *scene)
{
    Error error = {0};
    Space s = {.layout = layout_of(scene)};
    const Layout *l = s.layout;
    i32 *pairs = malloc(2 * 4096 * sizeof *pairs);
    assert_non_null(pairs);
    for (u32 i = 0; i < l->plane_count; i++) {
        pairs[2 * s.pair_count] = (i32)i;
        pairs[2 * s.pair_count++ + 1] = -1;
    }
    if (l->root != NO_INDEX)
        list_leaves(l, l->root, -1, pairs, &s.pair_count);
    assert_true(s.pair_count > 0);
    s.pairs = filled(device, "pairs", pairs, 2 * s.pair_count * sizeof *pairs);
    free(pairs);
    s.primitives = filled(device, "primitives", l->primitives, l->primitive_count * sizeof *l->primitives);
    s.infos = filled(device, "infos", l->infos, l->primitive_count * sizeof *l->infos);
    s.nodes = filled(device, "nodes", l->nodes, l->node_count * sizeof *l->nodes);
    s.materials = filled(device, "materials", l->materials, l->material_count * sizeof *l->materials);
    s.extras = filled(device, "extras", l->extras, l->extra_count * sizeof *l->extras);
    s.rays = buffer_create(device, "rays_in", COLUMNS * RAYS * sizeof(f32), &error);
    s.selves = buffer_create(device, "selves", 2 * RAYS * sizeof(i32), &error);
    s.t = buffer_create(device, "t", STEPS * RAYS * sizeof(f32), &error);
    s.found = buffer_create(device, "found", 2 * STEPS * RAYS * sizeof(i32), &error);
    must(s.rays && s.selves && s.t && s.found, &error);
    return s;
}

void space_destroy(Space *s)
{
    Buffer *buffers[] = {s->primitives, s->infos, s->nodes, s->materials, s->extras,
                         s->pairs,      s->rays,  s->selves, s->t,        s->found};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        buffer_destroy(buffers[i]);
    layout_destroy(s->layout);
}

Answer answer_create(void)
{
    Answer answer = {malloc(STEPS * RAYS * sizeof(f32)), malloc(2 * STEPS * RAYS * sizeof(i32))};
    assert_true(answer.t && answer.found);
    return answer;
}

void answer_destroy(Answer *answer)
{
    free(answer->t);
    free(answer->found);
}

void search_run(const Search *search, const Space *s, bool all, bool any_hit, bool opaque_only, u32 steps,
                Answer *answer)
{
    Error error = {0};
    Kernel *k = search->search;
    // What the kernel leaves alone (steps after the last hit) is the same everywhere.
    memset(answer->t, 0, STEPS * RAYS * sizeof(f32));
    memset(answer->found, 0, 2 * STEPS * RAYS * sizeof(i32));
    must(buffer_upload(s->t, 0, answer->t, STEPS * RAYS * sizeof(f32), &error), &error);
    must(buffer_upload(s->found, 0, answer->found, 2 * STEPS * RAYS * sizeof(i32), &error), &error);
    must(kernel_set_buffer(k, "primitives", s->primitives, &error), &error);
    must(kernel_set_buffer(k, "infos", s->infos, &error), &error);
    must(kernel_set_buffer(k, "nodes", s->nodes, &error), &error);
    must(kernel_set_u32(k, "plane_count", s->layout->plane_count, &error), &error);
    must(kernel_set_u32(k, "root", s->layout->root, &error), &error);
    must(kernel_set_buffer(k, "pairs", s->pairs, &error), &error);
    must(kernel_set_u32(k, "pair_count", all ? s->pair_count : 0, &error), &error);
    must(kernel_set_buffer(k, "rays_in", s->rays, &error), &error);
    must(kernel_set_buffer(k, "selves", s->selves, &error), &error);
    must(kernel_set_u32(k, "n", RAYS, &error), &error);
    must(kernel_set_u32(k, "steps", steps, &error), &error);
    must(kernel_set_u32(k, "any_hit", any_hit, &error), &error);
    must(kernel_set_u32(k, "opaque_only", opaque_only, &error), &error);
    must(kernel_set_buffer(k, "t", s->t, &error), &error);
    must(kernel_set_buffer(k, "found", s->found, &error), &error);
    must(kernel_launch(k, RAYS / search->batch, 1, &error), &error);
    must(buffer_download(s->t, 0, answer->t, STEPS * RAYS * sizeof(f32), &error), &error);
    must(buffer_download(s->found, 0, answer->found, 2 * STEPS * RAYS * sizeof(i32), &error), &error);
}
