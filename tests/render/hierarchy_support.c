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
        const bool textures = f == FEATURE_UV || f == FEATURE_CHECKER || f == FEATURE_CHECKER3D ||
                              f == FEATURE_MESH_UVS;
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

// ---- what rays can meet -----------------------------------------------------------------------

static void list_add(Space *s, i32 met, i32 instance)
{
    if ((s->pair_count & (s->pair_count - 1)) == 0) {
        s->list = realloc(s->list, 2 * (s->pair_count + (size_t)1) * sizeof *s->list);
        assert_non_null(s->list);
    }
    s->list[s->pair_count][0] = met;
    s->list[s->pair_count++][1] = instance;
}

// Shadow rays that look for opaque surfaces leave out what is marked: all that lets light through is.
static void check_mark(const Layout *layout, bool marked, u32 material, i32 instance)
{
    const u32 named = instance < 0 ? NO_INDEX : layout->infos[instance].material;
    const u32 own = material & ~MATERIAL_INHERITED;
    const u32 index = material & MATERIAL_INHERITED && named != NO_INDEX ? named : own;
    assert_true(index < layout->material_count);
    const f32 *transmit = layout->materials[index].transmit;
    assert_true(marked || (transmit[0] == 0 && transmit[1] == 0 && transmit[2] == 0));
}

static u32 face_of(const Layout *layout, i32 met)
{
    const u32 slot = (u32)(met & (FACE - 1));
    return layout->blocks[slot / BLOCK_WIDTH].face[slot % BLOCK_WIDTH];
}

static const MeshRun *run_of(const Layout *layout, u32 face)
{
    u32 run = 0;
    while (run + 1 < layout->mesh_run_count && layout->mesh_runs[run + 1].first <= face)
        run++;
    return &layout->mesh_runs[run];
}

static void list_block(Space *s, u32 index, i32 instance)
{
    const i32 first = FACE | (i32)(index * BLOCK_WIDTH);
    assert_true(index < s->layout->block_count && face_of(s->layout, first) != NO_INDEX);
    list_add(s, first, instance);
    for (i32 k = 0; k < BLOCK_WIDTH; k++) {
        const u32 face = face_of(s->layout, first + k);
        if (face == NO_INDEX)
            continue;
        s->target_count++;
        check_mark(s->layout, face & FACE_TRANSMITS, run_of(s->layout, face & ~FACE_TRANSMITS)->material,
                   instance);
    }
}

static void list_leaves(Space *s, u32 node, i32 instance);

static void list_leaf(Space *s, u32 leaf, i32 instance)
{
    const Layout *layout = s->layout;
    const u32 index = leaf >> 1;
    if (leaf & 1) {
        list_block(s, index, instance);
        return;
    }
    const Primitive *primitive = &layout->primitives[index];
    if ((primitive->kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE) {
        u32 root;
        memcpy(&root, &primitive->p0, sizeof root);
        list_leaves(s, root, (i32)index);
        return;
    }
    check_mark(layout, !(primitive->kind & PRIMITIVE_OPAQUE), layout->infos[index].material, instance);
    list_add(s, (i32)index, instance);
    s->target_count++;
}

// Adds what is in the leaves below node, met through instance.
static void list_leaves(Space *s, u32 node, i32 instance)
{
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const BvhNode *n = &s->layout->nodes[node];
        if (!(n->lower_x[slot] <= n->upper_x[slot]))
            continue;
        if (n->child[slot] >= 0)
            list_leaves(s, (u32)n->child[slot], instance);
        else
            list_leaf(s, ~(u32)n->child[slot], instance);
    }
}

u64 order_of(const Layout *layout, i32 met)
{
    if (!(met & FACE))
        return (u64)layout->infos[met].order_high << 32 | layout->infos[met].order_low;
    const u32 face = face_of(layout, met) & ~FACE_TRANSMITS;
    const MeshRun *run = run_of(layout, face);
    return ((u64)run->order_high << 32 | run->order_low) + (face - run->first);
}

// ---- on the device ----------------------------------------------------------------------------

// Of the data; where there is none, of one record of zeros, since the programs have all features.
static Buffer *filled(Device *device, const char *name, const void *data, u64 count, u64 size)
{
    static const u8 nothing[sizeof(TriangleBlock)] = {0};
    Error error = {0};
    assert_true(size <= sizeof nothing);
    Buffer *buffer = buffer_create(device, name, (count ? count : 1) * size, &error);
    must(buffer != NULL, &error);
    must(buffer_upload(buffer, 0, count ? data : nothing, (count ? count : 1) * size, &error), &error);
    return buffer;
}

Space space_create(Device *device, const char *scene)
{
    Error error = {0};
    Space s = {.layout = layout_of(scene)};
    const Layout *l = s.layout;
    for (u32 i = 0; i < l->plane_count; i++)
        list_add(&s, (i32)i, -1);
    s.target_count = l->plane_count;
    if (l->root != NO_INDEX)
        list_leaves(&s, l->root, -1);
    assert_true(s.pair_count > 0);
    s.pairs = filled(device, "pairs", s.list, s.pair_count, sizeof *s.list);
    s.primitives = filled(device, "primitives", l->primitives, l->primitive_count, sizeof *l->primitives);
    s.infos = filled(device, "infos", l->infos, l->primitive_count, sizeof *l->infos);
    s.nodes = filled(device, "nodes", l->nodes, l->node_count, sizeof *l->nodes);
    s.materials = filled(device, "materials", l->materials, l->material_count, sizeof *l->materials);
    s.extras = filled(device, "extras", l->extras, l->extra_count, sizeof *l->extras);
    s.blocks = filled(device, "blocks", l->blocks, l->block_count, sizeof *l->blocks);
    s.mesh_runs = filled(device, "mesh_runs", l->mesh_runs, l->mesh_run_count, sizeof *l->mesh_runs);
    s.mesh_indices = filled(device, "mesh_indices", l->mesh_indices, l->mesh_index_count,
                            sizeof *l->mesh_indices);
    s.mesh_normals = filled(device, "mesh_normals", l->mesh_normals, l->mesh_normal_count,
                            sizeof *l->mesh_normals);
    s.rays = buffer_create(device, "rays_in", COLUMNS * RAYS * sizeof(f32), &error);
    s.selves = buffer_create(device, "selves", 2 * RAYS * sizeof(i32), &error);
    s.t = buffer_create(device, "t", STEPS * RAYS * sizeof(f32), &error);
    s.found = buffer_create(device, "found", 2 * STEPS * RAYS * sizeof(i32), &error);
    must(s.rays && s.selves && s.t && s.found, &error);
    return s;
}

void space_destroy(Space *s)
{
    Buffer *buffers[] = {s->primitives, s->infos,        s->nodes,        s->materials, s->extras,
                         s->blocks,     s->mesh_runs,    s->mesh_indices, s->mesh_normals,
                         s->pairs,      s->rays,         s->selves,       s->t,         s->found};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        buffer_destroy(buffers[i]);
    free(s->list);
    layout_destroy(s->layout);
}

void space_bind(const Space *s, Kernel *kernel)
{
    Error error = {0};
    must(kernel_set_buffer(kernel, "primitives", s->primitives, &error), &error);
    must(kernel_set_buffer(kernel, "infos", s->infos, &error), &error);
    must(kernel_set_buffer(kernel, "blocks", s->blocks, &error), &error);
    must(kernel_set_buffer(kernel, "mesh_runs", s->mesh_runs, &error), &error);
    must(kernel_set_u32(kernel, "mesh_run_count", s->layout->mesh_run_count, &error), &error);
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
    space_bind(s, k);
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
