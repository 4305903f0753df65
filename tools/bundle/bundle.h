// The kernels as one text in the binary, made by clrt-bundle at build time: no file is read at run time.
#ifndef CLRT_TOOLS_BUNDLE_H
#define CLRT_TOOLS_BUNDLE_H

#include <stddef.h>

// kernels/program.cl with its includes in their places and #line directives that name our files. Sizes are in
// bytes, without the final 0.
extern const char clrt_kernel_source[];
extern const size_t clrt_kernel_source_size;

// kernels/selftest/self_test.cl and known_answers.cl, in the same way.
extern const char clrt_self_test_source[];
extern const size_t clrt_self_test_source_size;
extern const char clrt_known_answers_source[];
extern const size_t clrt_known_answers_source_size;

#endif
