// The scene's environment as the arrays of shared/environment.h.
#ifndef CLRT_LAYOUT_ENVIRONMENT_H
#define CLRT_LAYOUT_ENVIRONMENT_H

#include "layout/layout.h"

// lit: some material is lit by it; then there are tables to draw from, or prefiltered maps. A black environment adds
// nothing. Fails with ERROR_MEMORY.
bool environment_add(Layout *layout, const Scene *scene, bool lit, Error *error);

#endif
