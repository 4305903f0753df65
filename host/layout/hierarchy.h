// The hierarchies of a layout, one a level, with the arrays that they refer to.
#ifndef CLRT_LAYOUT_HIERARCHY_H
#define CLRT_LAYOUT_HIERARCHY_H

#include "layout/layout.h"
#include "layout/place.h"

// Builds the hierarchies of all levels of the placer, gives INSTANCE primitives their roots, and fills the
// layout's primitives with what stands beside them, nodes, blocks, and the arrays of meshes. layout->features
// must be known. The levels are used up. Fails with ERROR_MEMORY.
bool hierarchies_add(Layout *layout, Placer *placer, Error *error);

#endif
