// In place of embree.c where the library is not installed.
#include "embree.h"

const char *embree_version(void)
{
    return NULL;
}

const char *embree_mode_name(EmbreeMode mode)
{
    (void)mode;
    return "";
}

bool embree_has_mode(EmbreeMode mode)
{
    (void)mode;
    return false;
}

EmbreeScene *embree_scene_create(const BenchScene *scene, EmbreeBuild build, Error *error)
{
    (void)scene;
    (void)build;
    error_set(error, ERROR_DEVICE, "built without Embree");
    return NULL;
}

void embree_scene_destroy(EmbreeScene *scene)
{
    (void)scene;
}

f64 embree_build_seconds(const EmbreeScene *scene)
{
    (void)scene;
    return 0;
}

i64 embree_bytes(const EmbreeScene *scene)
{
    (void)scene;
    return 0;
}

i64 embree_bytes_peak(const EmbreeScene *scene)
{
    (void)scene;
    return 0;
}

void embree_trace(const EmbreeScene *scene, Pool *pool, EmbreeMode mode, const RaySet *rays, RayHits *hits)
{
    (void)scene;
    (void)pool;
    (void)mode;
    (void)rays;
    (void)hits;
}
