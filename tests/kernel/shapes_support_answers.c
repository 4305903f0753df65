#include "shapes_support.h"

#include <math.h>

Primitive bake_at(const Shape *shape, Vec3 shift)
{
    Primitive p = {.kind = 0};
    BakedBounds bounds;
    Error error;
    const Affine map = affine_translate(shift);
    assert_true(bake_shape(shape, &map, &p, &bounds, &error));
    return p;
}

void ray_table_add_next(RayTable *table, Vec3 o, Vec3 d)
{
    ray_table_add(table, (int)table->count, (float[3]){(float)o.x, (float)o.y, (float)o.z},
                  (float[3]){(float)d.x, (float)d.y, (float)d.z});
}

void expect_answers(KernelDevice *device, int kind, RayTable *table, const Primitive *primitives,
                    const Answer *answers)
{
    for (int lanes = shapes_long_run() ? 1 : 8; lanes <= 8; lanes *= 8) {
        KernelProgram *program = shapes_program(device, kind, lanes);
        shapes_run(program, lanes, table, primitives, table->count);
        kernel_program_destroy(program);
        for (size_t i = 0; i < table->count; ++i) {
            const float t = hit_number(table, i, HIT_T);
            const Answer *a = &answers[i];
            const double off = isinf(a->exact) ? (isinf(t) ? 0 : INFINITY) : ulps_between(a->exact, t);
            const bool again = i > 0 && a->name == a[-1].name;
            if (lanes == 8 && !again)
                print_message("  %-44s t %-14.10g %.2f ulp\n", a->name, t, off);
            assert_true(off <= a->ulps);
        }
    }
}
