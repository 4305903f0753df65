// The scene's environment as the arrays of shared/environment.h.
#ifndef CLRT_LAYOUT_ENVIRONMENT_H
#define CLRT_LAYOUT_ENVIRONMENT_H

#include "layout/layout.h"

// lit: some material is lit by it; then there are tables to draw from, or prefiltered maps. Under the path integrator
// (layout->path, set before) the background is an environment, too; the tables leave out its mean (path.sky_floor, set
// here) and an even one has none. A black environment adds nothing. Fails with ERROR_MEMORY.
bool environment_add(Layout *layout, const Scene *scene, bool lit, Error *error);

#endif
