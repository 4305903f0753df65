#include "base_support.h"

#include <stdlib.h>

const int widths[WIDTHS] = { 1, 4, 8, 16 };

const char *const function_names[FUNCTIONS] = {
    "sin", "cos", "acos", "atan2", "exp", "exp2", "log", "log2", "pow",
};

static const char source[] =
    "#include \"base/math.h\"\n"
    "kernel void apply(uint function, global const float *xs, global const float *ys,\n"
    "                  global float *results)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const vf x = VF_LOAD(xs + i);\n"
    "    const vf y = VF_LOAD(ys + i);\n"
    "    vf r = (vf)(0.0f);\n"
    "    switch (function) {\n"
    "    case 0: r = vf_sin(x); break;\n"
    "    case 1: r = vf_cos(x); break;\n"
    "    case 2: r = vf_acos(x); break;\n"
    "    case 3: r = vf_atan2(y, x); break;\n"
    "    case 4: r = vf_exp(x); break;\n"
    "    case 5: r = vf_exp2(x); break;\n"
    "    case 6: r = vf_log(x); break;\n"
    "    case 7: r = vf_log2(x); break;\n"
    "    case 8: r = vf_pow(x, y); break;\n"
    "    }\n"
    "    VF_STORE(r, results + i);\n"
    "}\n";

Batch *batch_create(void)
{
    Batch *batch = calloc(1, sizeof *batch);
    assert_non_null(batch);
    return batch;
}

KernelProgram *functions_create(KernelDevice *device, int lanes, const char *options)
{
    return kernel_program_create_with(device, source, lanes, options);
}

double functions_apply(KernelProgram *program, Function function, int lanes, Batch *batch)
{
    const uint32_t number = (uint32_t)function;
    const KernelArg args[] = {
        kernel_value(&number, sizeof number), kernel_in(batch->x, sizeof batch->x),
        kernel_in(batch->y, sizeof batch->y), kernel_out(batch->result, sizeof batch->result),
    };
    return kernel_run(program, "apply", BATCH / (size_t)lanes, args, 4);
}
