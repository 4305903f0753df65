// Level: what one hierarchy is built over, the world's or an object's: primitives, then the triangles of
// meshes, each in the order of definition.
#ifndef CLRT_LAYOUT_LEVEL_H
#define CLRT_LAYOUT_LEVEL_H

#include "layout/mesh.h"
#include "layout/primitives.h"

// What the faces of a run come from; see MeshRun.
typedef struct FaceSource {
    u32 mesh; // of the level
    u32 bits; // FACE_TRANSMITS or 0
} FaceSource;

typedef struct Level {
    PrimitiveList list;
    MeshList meshes;
    bool transmits_named; // some instance names a material that transmits
    bool unnamed;         // some instance names none
    // Once the level is complete:
    Box *boxes; // of the primitives, then of the triangles; NULL again once the hierarchy is there
    u32 count;  // of the boxes
    Box bounds;
    // Once it is part of a layout:
    u32 root;                    // node
    u32 first_single;            // primitive
    u32 first_face, first_run;   // in the numbering of the layout
    u32 run_count;
    FaceSource *sources; // of the runs
} Level;

// Carries the meshes and gathers the boxes; nothing may be added afterwards. A level without anything gets no
// boxes. Fails with ERROR_MEMORY, and with ERROR_SCENE and the place of the mesh where a number leaves the
// range of float.
bool level_complete(Level *level, const Scene *scene, Error *error);
void level_drop_boxes(Level *level);
void level_destroy(Level *level);

// Adds the place of what went wrong, unless memory did. Returns false.
bool error_locate(const Scene *scene, SourcePos at, Error *error);

#endif
