// The kernels as one text in the binary, made by clrt-bundle at build time: no file is read at run time.
#ifndef CLRT_TOOLS_BUNDLE_H
#define CLRT_TOOLS_BUNDLE_H

#include <stddef.h>

// kernels/program.cl with its includes in their places and #line directives that name our files.
extern const char clrt_kernel_source[];
extern const size_t clrt_kernel_source_size; // bytes without the final 0

#endif
