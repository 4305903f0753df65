#include "render/math_mode.h"

#include <string.h>

static const char *const NAMES[MATH_MODES] = {
    [MATH_EXACT] = "exact", [MATH_FAST] = "fast", [MATH_DOUBLE] = "double"};

const char *math_mode_name(MathMode math)
{
    return NAMES[math];
}

MathMode math_mode_find(const char *name)
{
    MathMode math = 0;
    while (math < MATH_MODES && strcmp(NAMES[math], name) != 0)
        math++;
    return math;
}

bool math_mode_check(MathMode math, const DeviceInfo *info, Error *error)
{
    if (math != MATH_DOUBLE || info->fp64)
        return true;
    return error_set(error, ERROR_DEVICE, "%s has no 64-bit floating point, which double arithmetic needs",
                     info->name);
}
