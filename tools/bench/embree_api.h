// What differs between Embree 3 and 4: how a query says whether its rays are coherent, and streams. Private
// to embree*.c; CLRT_EMBREE is 3 or 4.
#ifndef CLRT_BENCH_EMBREE_API_H
#define CLRT_BENCH_EMBREE_API_H

#if CLRT_EMBREE == 3
#include <embree3/rtcore.h>

typedef struct Query {
    struct RTCIntersectContext context;
} Query;

static inline Query query_make(bool coherent)
{
    Query query;
    rtcInitIntersectContext(&query.context);
    query.context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return query;
}

static inline void query_intersect1(RTCScene scene, Query *query, struct RTCRayHit *ray)
{
    rtcIntersect1(scene, &query->context, ray);
}

static inline void query_occluded1(RTCScene scene, Query *query, struct RTCRay *ray)
{
    rtcOccluded1(scene, &query->context, ray);
}

static inline void query_intersect8(const int *valid, RTCScene scene, Query *query, struct RTCRayHit8 *rays)
{
    rtcIntersect8(valid, scene, &query->context, rays);
}

static inline void query_occluded8(const int *valid, RTCScene scene, Query *query, struct RTCRay8 *rays)
{
    rtcOccluded8(valid, scene, &query->context, rays);
}

static inline void query_intersect16(const int *valid, RTCScene scene, Query *query, struct RTCRayHit16 *rays)
{
    rtcIntersect16(valid, scene, &query->context, rays);
}

static inline void query_occluded16(const int *valid, RTCScene scene, Query *query, struct RTCRay16 *rays)
{
    rtcOccluded16(valid, scene, &query->context, rays);
}

static inline void query_intersect_stream(RTCScene scene, Query *query, struct RTCRayHit *rays, u32 count)
{
    rtcIntersect1M(scene, &query->context, rays, count, sizeof *rays);
}

static inline void query_occluded_stream(RTCScene scene, Query *query, struct RTCRay *rays, u32 count)
{
    rtcOccluded1M(scene, &query->context, rays, count, sizeof *rays);
}
#else
#include <embree4/rtcore.h>

typedef struct Query {
    struct RTCIntersectArguments intersect;
    struct RTCOccludedArguments occluded;
} Query;

static inline Query query_make(bool coherent)
{
    Query query;
    rtcInitIntersectArguments(&query.intersect);
    rtcInitOccludedArguments(&query.occluded);
    query.intersect.flags = query.occluded.flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    return query;
}

static inline void query_intersect1(RTCScene scene, Query *query, struct RTCRayHit *ray)
{
    rtcIntersect1(scene, ray, &query->intersect);
}

static inline void query_occluded1(RTCScene scene, Query *query, struct RTCRay *ray)
{
    rtcOccluded1(scene, ray, &query->occluded);
}

static inline void query_intersect8(const int *valid, RTCScene scene, Query *query, struct RTCRayHit8 *rays)
{
    rtcIntersect8(valid, scene, rays, &query->intersect);
}

static inline void query_occluded8(const int *valid, RTCScene scene, Query *query, struct RTCRay8 *rays)
{
    rtcOccluded8(valid, scene, rays, &query->occluded);
}

static inline void query_intersect16(const int *valid, RTCScene scene, Query *query, struct RTCRayHit16 *rays)
{
    rtcIntersect16(valid, scene, rays, &query->intersect);
}

static inline void query_occluded16(const int *valid, RTCScene scene, Query *query, struct RTCRay16 *rays)
{
    rtcOccluded16(valid, scene, rays, &query->occluded);
}

// There are no streams any more: one ray after the other.
static inline void query_intersect_stream(RTCScene scene, Query *query, struct RTCRayHit *rays, u32 count)
{
    for (u32 i = 0; i < count; i++)
        query_intersect1(scene, query, &rays[i]);
}

static inline void query_occluded_stream(RTCScene scene, Query *query, struct RTCRay *rays, u32 count)
{
    for (u32 i = 0; i < count; i++)
        query_occluded1(scene, query, &rays[i]);
}
#endif

#endif
