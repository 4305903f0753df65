// The MTL reader under a fuzzer: any bytes give materials within their ranges, with messages or without.
// Built with -fsanitize=fuzzer it is a libFuzzer target; without (no CLRT_FUZZ) it is a program that runs the
// files it is given.
#include "fuzz_file.h"

#include <float.h>

#include "assets/mtl.h"

static void check_color(const f64 color[3])
{
    for (int i = 0; i < 3; ++i) {
        if (!(color[i] >= 0 && color[i] <= (f64)FLT_MAX))
            abort();
    }
}

// What whoever holds the materials relies on.
static void check_material(const MtlMaterial *material)
{
    check_color(material->kd);
    check_color(material->ks);
    check_color(material->ke);
    if (!material->name || material->line == 0)
        abort();
    if (!(material->ns >= 0 && material->ns <= MTL_NS_MAX && material->d >= 0 && material->d <= 1))
        abort();
    if ((material->given & MTL_NI) && !(material->ni > 0 && material->ni <= (f64)FLT_MAX))
        abort();
    if ((material->map_kd && (!*material->map_kd || material->map_kd_line == 0)) ||
        (material->map_bump && (!*material->map_bump || material->map_bump_line == 0)))
        abort();
}

int LLVMFuzzerTestOneInput(const u8 *data, size_t size)
{
    FuzzFile file = fuzz_file_begin(data, size);
    Diagnostics *diagnostics = diagnostics_create();
    MtlFile mtl;
    Error error;
    if (!diagnostics || !mtl_read(file.path, diagnostics, &mtl, &error))
        abort();
    for (u32 i = 0; i < mtl.count; ++i)
        check_material(&mtl.materials[i]);
    free(fuzz_print(diagnostics));
    mtl_destroy(&mtl);
    diagnostics_destroy(diagnostics);
    fuzz_file_end(&file);
    return 0;
}

#include "fuzz_main.h"
