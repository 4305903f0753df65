// Sizes of a slot's state, so that the host can allocate what the kernels' enums name (stages/state.h).
// Arguments are 0 or 1 but for lights (of a pass) and pending (parked rays).
#ifndef CLRT_SHARED_STATE_FIELDS_H
#define CLRT_SHARED_STATE_FIELDS_H

#define PENDING_REALS 9
#define STATE_REALS(shadows, lights) (13 + (shadows) * (3 + 7 * (lights)))
#define PENDING_INTS(instances, random) (2 + (instances) + (random))
#define STATE_INTS(shadows, branching, instances, random) \
    (6 + (shadows) + (branching) + 2 * (instances) + (random))

// Of a tile under the path integrator: a slot has the fields of a scene with one light and more; beside them are
// those of camera rays that wait for a slot, and the radiance of PATH_ROUNDS rounds of samples.
#define PATH_ROUNDS 8
#define PATH_SLOT_REALS(shadows) (STATE_REALS(shadows, shadows) + 1)
#define PATH_SLOT_INTS(shadows, instances) (STATE_INTS(shadows, 0, instances, 1) + 4)
#define PATH_REALS(shadows) (PATH_SLOT_REALS(shadows) + STATE_REALS(0, 0) + 3 * PATH_ROUNDS)
#define PATH_INTS(shadows, instances) (PATH_SLOT_INTS(shadows, instances) + STATE_INTS(shadows, 0, instances, 1))

// Lights whose shadow rays a slot can hold at once; a bit of FLAGS each.
#define LIGHTS_PER_PASS_MAX 16

// Rays are counted by kind; every work-item counts what it starts.
#define RAYS_CAMERA 0
#define RAYS_SHADOW 1
#define RAYS_REFLECTED 2
#define RAYS_TRANSMITTED 3
#define RAYS_KINDS 4
// Beside them under the path integrator: lanes that had a ray or could have had one.
#define RAYS_LANES 4
#define PATH_RAYS_KINDS 5

#endif
