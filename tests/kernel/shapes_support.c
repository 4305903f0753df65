#include "shapes_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char source[] =
    "#include \"shapes/shapes.h\"\n"
    "static v3 load3(global const float *p, uint n)\n"
    "{\n"
    "    return v3_make(VF_LOAD(p), VF_LOAD(p + n), VF_LOAD(p + 2 * n));\n"
    "}\n"
    "static void store3(v3 a, global float *p, uint n)\n"
    "{\n"
    "    VF_STORE(a.x, p);\n"
    "    VF_STORE(a.y, p + n);\n"
    "    VF_STORE(a.z, p + 2 * n);\n"
    "}\n"
    "static v3 gather3(global const float *p, vi at)\n"
    "{\n"
    "    return v3_make(vf_gather(p, at), vf_gather(p, at + 1), vf_gather(p, at + 2));\n"
    "}\n"
    "kernel void trace(global const float *primitives, global const int *index, global const float *rays,\n"
    "                  global float *hits, uint n)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const vi at = VI_LOAD(index + i) * 16;\n"
    "    PrimitiveLanes p;\n"
    "    p.row0 = gather3(primitives, at);\n"
    "    p.row1 = gather3(primitives, at + 4);\n"
    "    p.row2 = gather3(primitives, at + 8);\n"
    "    p.c = v3_make(vf_gather(primitives, at + 3), vf_gather(primitives, at + 7),\n"
    "                  vf_gather(primitives, at + 11));\n"
    "    p.p0 = vf_gather(primitives, at + 12);\n"
    "    p.p1 = vf_gather(primitives, at + 13);\n"
    "    p.p2 = vf_gather(primitives, at + 15);\n"
    "    const vi kind = VF_AS_VI(vf_gather(primitives, at + 14));\n"
    "    RayLanes ray;\n"
    "    ray.org = load3(rays + i, n);\n"
    "    ray.dir = load3(rays + 3 * n + i, n);\n"
    "    ray.tmin = VF_LOAD(rays + 6 * n + i);\n"
    "    ray.self = VF_LOAD(rays + 7 * n + i) > (vf)(0.0f);\n"
    "    ray.inward = VF_LOAD(rays + 8 * n + i) > (vf)(0.0f);\n"
    "    vf t = (vf)(INFINITY);\n"
    "#if SHAPE_KINDS == 1\n"
    "    t = intersect_primitive(0, &p, &ray);\n"
    "#else\n"
    "    for (uint k = 0; k < PRIMITIVE_KIND_COUNT; k++) {\n"
    "        const vm mine = kind == (vi)((int)k);\n"
    "        if (vm_any(mine))\n"
    "            t = mine ? intersect_primitive(k, &p, &ray) : t;\n"
    "    }\n"
    "#endif\n"
    "    SurfaceLanes s;\n"
    "    surface_primitive(kind, &p, &ray, t, &s);\n"
    "    VF_STORE(t, hits + i);\n"
    "    store3(s.p, hits + n + i, n);\n"
    "    store3(s.error, hits + 4 * n + i, n);\n"
    "    store3(s.ng, hits + 7 * n + i, n);\n"
    "    VF_STORE(s.u, hits + 10 * n + i); VF_STORE(s.v, hits + 11 * n + i);\n"
    "    VF_STORE(s.u_whole, hits + 12 * n + i); VF_STORE(s.v_whole, hits + 13 * n + i);\n"
    "#if HAS_TRIANGLE\n"
    "    VF_STORE(s.b1, hits + 14 * n + i); VF_STORE(s.b2, hits + 15 * n + i);\n"
    "#endif\n"
    "}\n"
    // Where rays in direction rays[3..5] that leave the surface points `hits` start.
    "kernel void leave(global const float *hits, global const float *rays, global float *origins, uint n)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const v3 p = load3(hits + 1 * n + i, n);\n"
    "    const v3 e = load3(hits + 4 * n + i, n);\n"
    "    const v3 g = load3(hits + 7 * n + i, n);\n"
    "    const v3 d = load3(rays + 3 * n + i, n);\n"
    "    const v3 o = offset_origin(p, e, g, d);\n"
    "    store3(o, origins + i, n);\n"
    "}\n"
    // How many of the primitives each ray meets.
    "kernel void crossings(global const float *primitives, uint count, global const float *rays,\n"
    "                      global float *met, uint n)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    RayLanes ray;\n"
    "    ray.org = load3(rays + i, n);\n"
    "    ray.dir = load3(rays + 3 * n + i, n);\n"
    "    ray.tmin = (vf)(0.0f);\n"
    "    ray.self = ray.inward = (vm)(0);\n"
    "    vf sum = (vf)(0.0f);\n"
    "    for (uint k = 0; k < count; k++) {\n"
    "        global const float *r = primitives + 16 * k;\n"
    "        PrimitiveLanes p;\n"
    "        p.row0 = v3_make((vf)(r[0]), (vf)(r[1]), (vf)(r[2]));\n"
    "        p.row1 = v3_make((vf)(r[4]), (vf)(r[5]), (vf)(r[6]));\n"
    "        p.row2 = v3_make((vf)(r[8]), (vf)(r[9]), (vf)(r[10]));\n"
    "        p.c = v3_make((vf)(r[3]), (vf)(r[7]), (vf)(r[11]));\n"
    "        p.p0 = (vf)(r[12]);\n"
    "        p.p1 = (vf)(r[13]);\n"
    "        p.p2 = (vf)(r[15]);\n"
    "        const vf t = intersect_primitive(as_uint(r[14]), &p, &ray);\n"
    "        sum += t < (vf)(INFINITY) ? (vf)(1.0f) : (vf)(0.0f);\n"
    "    }\n"
    "    VF_STORE(sum, met + i);\n"
    "}\n";

static const struct {
    const char *macro;
    int kind;
} kinds[] = {
    {"HAS_SPHERE", PRIMITIVE_SPHERE},
    {"HAS_GIANT_SPHERE", PRIMITIVE_GIANT_SPHERE},
    {"HAS_ELLIPSOID", PRIMITIVE_ELLIPSOID},
    {"HAS_PLANE", PRIMITIVE_PLANE},
    {"HAS_BOX", PRIMITIVE_BOX},
    {"HAS_TETRAHEDRON", PRIMITIVE_TETRAHEDRON},
    {"HAS_DISK", PRIMITIVE_DISK},
    {"HAS_CYLINDER", PRIMITIVE_CYLINDER},
    {"HAS_CONE", PRIMITIVE_CONE},
    {"HAS_TORUS", PRIMITIVE_TORUS},
    {"HAS_TRIANGLE", PRIMITIVE_TRIANGLE},
    {"HAS_RECTANGLE", PRIMITIVE_RECTANGLE},
};

bool shapes_long_run(void)
{
    const char *text = getenv("CLRT_TEST_LONG");
    return text && *text && strcmp(text, "0") != 0;
}

KernelProgram *shapes_program_of(KernelDevice *device, const char *text, int kind, int lanes)
{
    char options[1024] = "-Werror -DHAS_UV=1";
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
        const size_t used = strlen(options);
        snprintf(options + used, sizeof options - used, " -D%s=%d", kinds[i].macro,
                 kind < 0 || kind == kinds[i].kind);
    }
    return kernel_program_create_with(device, text, lanes, options);
}

KernelProgram *shapes_program(KernelDevice *device, int kind, int lanes)
{
    return shapes_program_of(device, source, shapes_long_run() ? kind : -1, lanes);
}

KernelProgram *shapes_program_alone(KernelDevice *device, int kind, int lanes)
{
    return shapes_program_of(device, source, kind, lanes);
}

void shapes_run(KernelProgram *program, int lanes, RayTable *table, const Primitive *primitives, size_t count)
{
    const uint32_t n = (uint32_t)table->capacity;
    // Places that no ray was put in repeat the first one.
    for (size_t i = table->count; i < table->capacity; ++i) {
        for (size_t k = 0; k < RAY_COLUMNS; ++k)
            table->rays[k * n + i] = table->rays[k * n];
        table->index[i] = table->index[0];
    }
    memset(table->hits, 0xff, HIT_COLUMNS * n * sizeof(float));
    kernel_run(program, "trace", n / (size_t)lanes,
               (KernelArg[]){
                   kernel_in(primitives, count * sizeof *primitives),
                   kernel_in(table->index, n * sizeof(int)),
                   kernel_in(table->rays, RAY_COLUMNS * n * sizeof(float)),
                   kernel_out(table->hits, HIT_COLUMNS * n * sizeof(float)),
                   kernel_value(&n, sizeof n),
               },
               5);
}

void shapes_leave(KernelProgram *program, int lanes, RayTable *table)
{
    const uint32_t n = (uint32_t)table->capacity;
    const size_t bytes = 3 * n * sizeof(float);
    float *origins = malloc(bytes);
    assert_non_null(origins);
    memset(origins, 0, bytes);
    kernel_run(program, "leave", n / (size_t)lanes,
               (KernelArg[]){
                   kernel_in(table->hits, HIT_COLUMNS * n * sizeof(float)),
                   kernel_in(table->rays, RAY_COLUMNS * n * sizeof(float)),
                   kernel_out(origins, bytes),
                   kernel_value(&n, sizeof n),
               },
               4);
    memcpy(table->rays, origins, bytes);
    free(origins);
}

void shapes_crossings(KernelProgram *program, int lanes, const RayTable *table, const Primitive *primitives,
                      size_t count, float *met)
{
    const uint32_t n = (uint32_t)table->capacity, primitive_count = (uint32_t)count;
    memset(met, 0xff, n * sizeof *met);
    kernel_run(program, "crossings", n / (size_t)lanes,
               (KernelArg[]){
                   kernel_in(primitives, count * sizeof *primitives),
                   kernel_value(&primitive_count, sizeof primitive_count),
                   kernel_in(table->rays, RAY_COLUMNS * n * sizeof(float)),
                   kernel_out(met, n * sizeof *met),
                   kernel_value(&n, sizeof n),
               },
               5);
}

RayTable ray_table_create(size_t count)
{
    const size_t n = (count + 15) / 16 * 16;
    RayTable table = {.capacity = n};
    table.rays = calloc(RAY_COLUMNS * n, sizeof(float));
    table.index = calloc(n, sizeof(int));
    table.hits = calloc(HIT_COLUMNS * n, sizeof(float));
    assert_true(table.rays && table.index && table.hits);
    return table;
}

void ray_table_destroy(RayTable *table)
{
    free(table->rays);
    free(table->index);
    free(table->hits);
    *table = (RayTable){0};
}

void ray_table_clear(RayTable *table) { table->count = 0; }

bool ray_table_add(RayTable *table, int primitive, const float org[3], const float dir[3])
{
    if (table->count == table->capacity)
        return false;
    const size_t i = table->count++, n = table->capacity;
    for (size_t k = 0; k < 3; ++k) {
        table->rays[(RAY_ORG + k) * n + i] = org[k];
        table->rays[(RAY_DIR + k) * n + i] = dir[k];
        table->rays[(RAY_TMIN + k) * n + i] = 0;
    }
    table->index[i] = primitive;
    return true;
}

void ray_table_add_random(RayTable *table, int primitive, const Placed *p, uint64_t *state)
{
    float org[3], dir[3];
    random_ray(p, RAY_ANY, state, org, dir);
    ray_table_add(table, primitive, org, dir);
}

void ray_table_add_self(RayTable *table, int primitive, const float org[3], const float dir[3], bool inward)
{
    if (!ray_table_add(table, primitive, org, dir))
        return;
    table->rays[RAY_SELF * table->capacity + table->count - 1] = 1;
    table->rays[RAY_INWARD * table->capacity + table->count - 1] = inward ? 1 : 0;
}

float ray_number(const RayTable *table, size_t i, int column)
{
    return table->rays[(size_t)column * table->capacity + i];
}

float hit_number(const RayTable *table, size_t i, int column)
{
    return table->hits[(size_t)column * table->capacity + i];
}

double random_unit(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15u;
    uint64_t x = *state;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

double random_in(uint64_t *state, double low, double high) { return low + (high - low) * random_unit(state); }

double random_scale(uint64_t *state, double low, double high) { return pow(10, random_in(state, low, high)); }

void random_direction(uint64_t *state, double d[3])
{
    const double z = random_in(state, -1, 1), angle = random_in(state, 0, 2 * acos(-1));
    const double s = sqrt(1 - z * z);
    d[0] = s * cos(angle);
    d[1] = s * sin(angle);
    d[2] = z;
}

double ulp_of(double x)
{
    const float f = (float)fabs(x);
    return (double)nextafterf(f, INFINITY) - (double)f;
}

double ulps_between(double exact, float x) { return fabs((double)x - exact) / ulp_of(exact); }
