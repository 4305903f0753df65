#include "embree_internal.h"

#include <math.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

enum {
    CHUNK = 4096, // rays that a thread takes at a time
    STREAM = 1024 // rays of one stream: their records fit into the second cache
};

// One pass over a ray set.
typedef struct Pass {
    const EmbreeScene *scene;
    const RaySet *rays;
    RayHits *hits;
    EmbreeMode mode;
} Pass;

static const f32 *column(const Pass *pass, size_t c)
{
    return pass->rays->columns + c * pass->rays->stride;
}

static struct RTCRay ray_record(const Pass *pass, u32 i)
{
    return (struct RTCRay){
        .org_x = column(pass, RAY_ORG)[i],
        .org_y = column(pass, RAY_ORG + 1)[i],
        .org_z = column(pass, RAY_ORG + 2)[i],
        .dir_x = column(pass, RAY_DIR)[i],
        .dir_y = column(pass, RAY_DIR + 1)[i],
        .dir_z = column(pass, RAY_DIR + 2)[i],
        .tfar = column(pass, RAY_FAR)[i],
        .mask = 0xffffffffu,
    };
}

static void store_hit(const Pass *pass, u32 i, const struct RTCRayHit *record)
{
    const RayHits *hits = pass->hits;
    hits->t[i] = record->ray.tfar;
    hits->u[i] = record->hit.u;
    hits->v[i] = record->hit.v;
    hits->primitive[i] = record->hit.primID;
    hits->instance[i] = record->hit.instID[0];
}

static void trace_single(const Pass *pass, Query *query, u32 begin, u32 end)
{
    for (u32 i = begin; i < end; i++) {
        struct RTCRayHit record = {.ray = ray_record(pass, i)};
        if (pass->rays->any_hit) {
            query_occluded1(pass->scene->scene, query, &record.ray);
            pass->hits->primitive[i] = record.ray.tfar < 0 ? 0 : NO_PRIMITIVE;
            continue;
        }
        record.hit.geomID = record.hit.primID = record.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        query_intersect1(pass->scene->scene, query, &record);
        store_hit(pass, i, &record);
    }
}

static void trace_stream(const Pass *pass, Query *query, u32 begin, u32 end)
{
    struct RTCRayHit records[STREAM];
    const u32 count = end - begin;
    for (u32 i = 0; i < count; i++) {
        records[i].ray = ray_record(pass, begin + i);
        records[i].hit.geomID = records[i].hit.primID = records[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    query_intersect_stream(pass->scene->scene, query, records, count);
    for (u32 i = 0; i < count; i++)
        store_hit(pass, begin + i, &records[i]);
}

static void trace_occluded_stream(const Pass *pass, Query *query, u32 begin, u32 end)
{
    struct RTCRay records[STREAM];
    const u32 count = end - begin;
    for (u32 i = 0; i < count; i++)
        records[i] = ray_record(pass, begin + i);
    query_occluded_stream(pass->scene->scene, query, records, count);
    for (u32 i = 0; i < count; i++)
        pass->hits->primitive[begin + i] = records[i].tfar < 0 ? 0 : NO_PRIMITIVE;
}

// A packet of 8 or 16 is rows of so many 4-byte numbers, in the order of RTCRayHit8 and RTCRayHit16.
enum { ROW_ORG, ROW_NEAR = 3, ROW_DIR, ROW_TIME = 7, ROW_FAR, ROW_MASK, ROW_U = 15, ROW_V, ROW_PRIMITIVE,
       ROW_GEOMETRY, ROW_INSTANCE };
_Static_assert(offsetof(struct RTCRayHit8, ray.tfar) == ROW_FAR * 32, "rows of a packet");
_Static_assert(offsetof(struct RTCRayHit8, hit.u) == ROW_U * 32, "rows of a packet");
_Static_assert(offsetof(struct RTCRayHit8, hit.instID) == ROW_INSTANCE * 32, "rows of a packet");
_Static_assert(offsetof(struct RTCRayHit16, ray.mask) == ROW_MASK * 64, "rows of a packet");
_Static_assert(offsetof(struct RTCRayHit16, hit.primID) == ROW_PRIMITIVE * 64, "rows of a packet");

static void fill_packet(const Pass *pass, void *packet, size_t width, u32 begin)
{
    static const int ROWS[RAY_COLUMNS] = {ROW_ORG, ROW_ORG + 1, ROW_ORG + 2, ROW_DIR,
                                          ROW_DIR + 1, ROW_DIR + 2, ROW_FAR};
    unsigned char *bytes = packet;
    const size_t row = width * 4;
    for (size_t c = 0; c < RAY_COLUMNS; c++)
        memcpy(bytes + (size_t)ROWS[c] * row, column(pass, c) + begin, row);
    memset(bytes + ROW_NEAR * row, 0, row);
    memset(bytes + ROW_TIME * row, 0, row);
    memset(bytes + ROW_MASK * row, 0xff, row);
}

static void invalidate_hits(void *packet, size_t width)
{
    unsigned char *bytes = packet;
    memset(bytes + ROW_PRIMITIVE * width * 4, 0xff, (ROW_INSTANCE + 1 - ROW_PRIMITIVE) * width * 4);
}

// Columns are padded, so whole rows can be stored.
static void store_packet(const Pass *pass, const void *packet, size_t width, u32 begin)
{
    const unsigned char *bytes = packet;
    const RayHits *hits = pass->hits;
    const size_t row = width * 4;
    memcpy(hits->t + begin, bytes + ROW_FAR * row, row);
    memcpy(hits->u + begin, bytes + ROW_U * row, row);
    memcpy(hits->v + begin, bytes + ROW_V * row, row);
    memcpy(hits->primitive + begin, bytes + ROW_PRIMITIVE * row, row);
    memcpy(hits->instance + begin, bytes + ROW_INSTANCE * row, row);
}

static void store_occluded(const Pass *pass, const f32 *tfar, u32 width, u32 begin)
{
    for (u32 k = 0; k < width; k++)
        pass->hits->primitive[begin + k] = tfar[k] < 0 ? 0 : NO_PRIMITIVE;
}

static void make_valid(int *valid, u32 width, u32 left)
{
    for (u32 k = 0; k < width; k++)
        valid[k] = k < left ? -1 : 0;
}

static void trace_packets8(const Pass *pass, Query *query, u32 begin, u32 end)
{
    _Alignas(32) int valid[8];
    struct RTCRayHit8 packet;
    for (u32 i = begin; i < end; i += 8) {
        make_valid(valid, 8, end - i);
        fill_packet(pass, &packet, 8, i);
        if (pass->rays->any_hit) {
            query_occluded8(valid, pass->scene->scene, query, &packet.ray);
            store_occluded(pass, packet.ray.tfar, 8, i);
        } else {
            invalidate_hits(&packet, 8);
            query_intersect8(valid, pass->scene->scene, query, &packet);
            store_packet(pass, &packet, 8, i);
        }
    }
}

static void trace_packets16(const Pass *pass, Query *query, u32 begin, u32 end)
{
    _Alignas(64) int valid[16];
    struct RTCRayHit16 packet;
    for (u32 i = begin; i < end; i += 16) {
        make_valid(valid, 16, end - i);
        fill_packet(pass, &packet, 16, i);
        if (pass->rays->any_hit) {
            query_occluded16(valid, pass->scene->scene, query, &packet.ray);
            store_occluded(pass, packet.ray.tfar, 16, i);
        } else {
            invalidate_hits(&packet, 16);
            query_intersect16(valid, pass->scene->scene, query, &packet);
            store_packet(pass, &packet, 16, i);
        }
    }
}

static void trace_chunk(void *context, u32 begin, u32 end)
{
    const Pass *pass = context;
    Query query = query_make(pass->mode == EMBREE_16_COHERENT || pass->mode == EMBREE_STREAM_COHERENT);
#ifdef __SSE__
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8040); // flush to zero, denormals are zero
#endif
    switch (pass->mode) {
    case EMBREE_1:
        trace_single(pass, &query, begin, end);
        break;
    case EMBREE_8:
        trace_packets8(pass, &query, begin, end);
        break;
    case EMBREE_16:
    case EMBREE_16_COHERENT:
        trace_packets16(pass, &query, begin, end);
        break;
    default:
        for (u32 i = begin; i < end; i += STREAM) {
            const u32 stop = end - i < STREAM ? end : i + STREAM;
            if (pass->rays->any_hit)
                trace_occluded_stream(pass, &query, i, stop);
            else
                trace_stream(pass, &query, i, stop);
        }
        break;
    }
#ifdef __SSE__
    _mm_setcsr(before);
#endif
}

void embree_trace(const EmbreeScene *scene, Pool *pool, EmbreeMode mode, const RaySet *rays, RayHits *hits)
{
    Pass pass = {scene, rays, hits, mode};
    pool_run(pool, trace_chunk, &pass, rays->count, CHUNK);
}
