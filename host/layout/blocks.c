// The blocks of triangles in the leaves.
#include "layout/faces.h"

#include <math.h>

// The run of the level that holds the face; both count through the layout. `guess`: that of a face close by.
static u32 run_of(const Layout *layout, const Level *level, u32 face, u32 guess)
{
    const MeshRun *runs = layout->mesh_runs;
    const u32 end = level->first_run + level->run_count;
    if (runs[guess].first <= face && (guess + 1 == end || face < runs[guess + 1].first))
        return guess;
    u32 low = level->first_run, high = end; // runs[low].first <= face < runs[high].first
    while (high - low > 1) {
        const u32 middle = low + (high - low) / 2;
        if (runs[middle].first <= face)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void clear_lane(TriangleBlock *block, u32 lane)
{
    for (int corner = 0; corner < 3; corner++)
        for (int axis = 0; axis < 3; axis++)
            block->vertex[corner][axis][lane] = NAN;
    block->face[lane] = NO_INDEX;
}

void faces_fill_blocks(const Layout *layout, const Level *level, const u32 *order, u32 count,
                       TriangleBlock *blocks)
{
    const u32 singles = level->list.count;
    u32 run = level->first_run;
#pragma omp parallel for if (count >= MESH_PARALLEL / BLOCK_WIDTH) firstprivate(run)
    for (u32 b = 0; b < count; b++) {
        TriangleBlock *block = &blocks[b];
        for (u32 lane = 0; lane < BLOCK_WIDTH; lane++) {
            const u32 index = order[(size_t)b * BLOCK_WIDTH + lane];
            if (index == NO_INDEX) {
                clear_lane(block, lane);
                continue;
            }
            const u32 in_level = index - singles, face = level->first_face + in_level;
            run = run_of(layout, level, face, run);
            const FaceSource source = level->sources[run - level->first_run];
            const PlacedMesh *mesh = &level->meshes.meshes[source.mesh];
            const u32 *corners = mesh->shape->as.mesh.mesh->faces[in_level - mesh->first_face];
            for (int corner = 0; corner < 3; corner++) {
                const f32 *vertex = mesh->vertices[corners[corner]];
                for (int axis = 0; axis < 3; axis++)
                    block->vertex[corner][axis][lane] = vertex[axis];
            }
            block->face[lane] = face | source.bits;
        }
    }
}
