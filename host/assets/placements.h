// Placements: the meshes of an imported file where its nodes put them.
#ifndef CLRT_ASSETS_PLACEMENTS_H
#define CLRT_ASSETS_PLACEMENTS_H

#include "assets/assimp.h"
#include "base/vec.h"

#ifdef CLRT_ASSIMP

// A mesh of the library under a node.
typedef struct Placement {
    const struct aiMesh *mesh;
    Affine map; // to the file's space
} Placement;

typedef struct Placements {
    Placement *list;
    u32 count;
} Placements;

// Lists them in the order of the tree; *placements is zeroed before. Fails with ERROR_SCENE or ERROR_MEMORY,
// and leaves something to free then, too.
bool placements_make(const struct aiScene *scene, Placements *placements, Error *error);
void placements_free(Placements *placements);

#endif
#endif
