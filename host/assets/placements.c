#include "assets/placements.h"

#ifdef CLRT_ASSIMP

#include <stdlib.h>

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "out of memory");
}

// A node that is still to be placed.
typedef struct Frame {
    const struct aiNode *node;
    Affine map; // of the node itself
} Frame;

typedef struct Frames {
    Frame *frames;
    size_t count, capacity;
} Frames;

static Affine affine_of(const struct aiMatrix4x4 *m)
{
    return (Affine){
        .row = {{(f64)m->a1, (f64)m->a2, (f64)m->a3},
                {(f64)m->b1, (f64)m->b2, (f64)m->b3},
                {(f64)m->c1, (f64)m->c2, (f64)m->c3}},
        .translation = {(f64)m->a4, (f64)m->b4, (f64)m->c4},
    };
}

static bool push(Frames *frames, const struct aiNode *node, Affine parent)
{
    if (frames->count == frames->capacity) {
        const size_t capacity = frames->capacity ? 2 * frames->capacity : 64;
        Frame *more = realloc(frames->frames, capacity * sizeof *more);
        if (!more)
            return false;
        frames->frames = more;
        frames->capacity = capacity;
    }
    const Affine map = affine_compose(parent, affine_of(&node->mTransformation));
    frames->frames[frames->count++] = (Frame){node, map};
    return true;
}

static bool add(Placements *placements, const struct aiMesh *mesh, Affine map)
{
    const u32 count = placements->count;
    if ((count & (count - 1)) == 0) { // a power of two, and full
        Placement *more = realloc(placements->list, (count ? 2 * (size_t)count : 1) * sizeof *more);
        if (!more)
            return false;
        placements->list = more;
    }
    placements->list[placements->count++] = (Placement){mesh, map};
    return true;
}

// Takes a node off the stack, places its meshes and puts its children there, the first one on top.
static bool place_node(const struct aiScene *scene, Frames *frames, Placements *placements, Error *error)
{
    const Frame frame = frames->frames[--frames->count];
    const struct aiNode *node = frame.node;
    for (u32 i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] >= scene->mNumMeshes)
            return error_set(error, ERROR_SCENE, "a node names a mesh that is not there");
        if (!add(placements, scene->mMeshes[node->mMeshes[i]], frame.map))
            return no_memory(error);
    }
    for (u32 i = node->mNumChildren; i-- > 0;) {
        if (!push(frames, node->mChildren[i], frame.map))
            return no_memory(error);
    }
    return true;
}

// Without recursion, whose depth the file would decide.
bool placements_make(const struct aiScene *scene, Placements *placements, Error *error)
{
    Frames frames = {0};
    bool ok = !scene->mRootNode || push(&frames, scene->mRootNode, affine_identity()) || no_memory(error);
    while (ok && frames.count > 0)
        ok = place_node(scene, &frames, placements, error);
    free(frames.frames);
    return ok;
}

void placements_free(Placements *placements)
{
    free(placements->list);
    *placements = (Placements){0};
}

#endif
