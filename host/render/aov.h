// Aov: properties of first hits that a render gives in place of radiance (shared/aov.h). Each is a render of
// its own whose program holds no more than finding hits and that property.
#ifndef CLRT_RENDER_AOV_H
#define CLRT_RENDER_AOV_H

#include "base/types.h"
#include "layout/layout.h"
#include "shared/aov.h"

// "depth"; aov is AOV_DEPTH or one of those that follow it.
const char *aov_name(u32 aov);

// The AOV_X of the name that length characters of text are; AOV_NONE where there is none.
u32 aov_find(const char *text, size_t length);

// Leaves of the layout what the program that gives aov needs: features, and one sample for what has no mean
// (depth, position, id), which is that of the pixel's centre. The layout may be a copy that owns nothing.
void aov_reduce(Layout *layout, u32 aov);

#endif
