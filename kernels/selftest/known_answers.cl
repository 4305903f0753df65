// The arithmetic that renders rest on, as a small program: what a device is asked before its first picture.
#include "base/features.h"

#include "selftest/numbers.h"

kernel void self_test_numbers(global const f32 *numbers_in, global f32 *numbers_out, uint function,
                              uint stride, uint count)
{
    const uint i = (uint)get_global_id(0) * LANES;
    if (i < count)
        store_column3(apply_function(function, numbers_in + i, stride), numbers_out + i, stride);
}
