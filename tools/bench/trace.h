// Tracer: clrt's side of the bench: the traversal of renders on an OpenCL device, fed from ray sets by the
// kernels of rays.cl.
#ifndef CLRT_BENCH_TRACE_H
#define CLRT_BENCH_TRACE_H

#include "device/device.h"
#include "layout/layout.h"
#include "rays.h"

typedef struct Tracer Tracer;

// Nodes and leaves that the rays of the last run reached, each counted once for each ray.
typedef struct Visits {
    u64 nodes, leaves;
} Visits;

// count_visits: a program that also counts them, slower. The layout must outlive the tracer. Fails with
// ERROR_DEVICE (the build log in the message) or ERROR_MEMORY.
Tracer *tracer_create(Device *device, const Layout *layout, bool count_visits, Error *error);
void tracer_destroy(Tracer *tracer);

f64 tracer_compile_seconds(const Tracer *tracer);

// Puts the rays of the runs to come on the device.
bool tracer_load(Tracer *tracer, const RaySet *rays, Error *error);
// Traces them once and waits for the end.
bool tracer_run(Tracer *tracer, Error *error);
// What the last run has found, for as many rays as were loaded.
bool tracer_read(Tracer *tracer, RayHits *hits, Error *error);
bool tracer_visits(Tracer *tracer, Visits *visits, Error *error);

#endif
