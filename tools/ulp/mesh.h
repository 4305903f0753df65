// A single triangle as a mesh of one face, laid out as those of files are.
#ifndef CLRT_ULP_MESH_H
#define CLRT_ULP_MESH_H

#include "layout/layout.h"
#include "reference/placed.h"

// The layout of a scene of the triangle alone. NULL with ERROR_MEMORY or ERROR_SCENE; the caller's to
// destroy.
Layout *mesh_layout(const Placed *triangle, Error *error);

#endif
