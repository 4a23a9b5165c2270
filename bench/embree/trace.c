// Calls each of Embree's interfaces for tracing rays. See tile.h.
#include "embree/tile.h"

// Copies to or from one half of an array of sixteen.
#define COPY_HALF(to, from) memcpy((to), (from), 8 * sizeof *(from))

static void trace_one_by_one(RTCScene scene, struct RTCIntersectContext *context,
                             struct RTCRayHit16 *p)
{
    for (int i = 0; i < LANES; i++) {
        if (!(p->ray.tnear[i] <= p->ray.tfar[i])) {
            continue;
        }
        struct RTCRayHit one = {
            .ray = {.org_x = p->ray.org_x[i],
                    .org_y = p->ray.org_y[i],
                    .org_z = p->ray.org_z[i],
                    .tnear = p->ray.tnear[i],
                    .dir_x = p->ray.dir_x[i],
                    .dir_y = p->ray.dir_y[i],
                    .dir_z = p->ray.dir_z[i],
                    .tfar = p->ray.tfar[i],
                    .mask = UINT32_MAX},
            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID, .instID = {RTC_INVALID_GEOMETRY_ID}},
        };
        rtcIntersect1(scene, context, &one);
        if (one.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
            p->ray.tfar[i] = one.ray.tfar;
            p->hit.Ng_x[i] = one.hit.Ng_x;
            p->hit.Ng_y[i] = one.hit.Ng_y;
            p->hit.Ng_z[i] = one.hit.Ng_z;
            p->hit.u[i] = one.hit.u;
            p->hit.v[i] = one.hit.v;
            p->hit.primID[i] = one.hit.primID;
            p->hit.geomID[i] = one.hit.geomID;
        }
    }
}

static void trace_half(RTCScene scene, struct RTCIntersectContext *context, const int *valid,
                       struct RTCRayHit16 *p, int first)
{
    struct RTCRayHit8 half;
    COPY_HALF(half.ray.org_x, p->ray.org_x + first);
    COPY_HALF(half.ray.org_y, p->ray.org_y + first);
    COPY_HALF(half.ray.org_z, p->ray.org_z + first);
    COPY_HALF(half.ray.tnear, p->ray.tnear + first);
    COPY_HALF(half.ray.dir_x, p->ray.dir_x + first);
    COPY_HALF(half.ray.dir_y, p->ray.dir_y + first);
    COPY_HALF(half.ray.dir_z, p->ray.dir_z + first);
    COPY_HALF(half.ray.time, p->ray.time + first);
    COPY_HALF(half.ray.tfar, p->ray.tfar + first);
    COPY_HALF(half.ray.mask, p->ray.mask + first);
    COPY_HALF(half.ray.flags, p->ray.flags + first);
    COPY_HALF(half.hit.geomID, p->hit.geomID + first);
    COPY_HALF(half.hit.instID[0], p->hit.instID[0] + first);
    rtcIntersect8(valid + first, scene, context, &half);
    COPY_HALF(p->ray.tfar + first, half.ray.tfar);
    COPY_HALF(p->hit.Ng_x + first, half.hit.Ng_x);
    COPY_HALF(p->hit.Ng_y + first, half.hit.Ng_y);
    COPY_HALF(p->hit.Ng_z + first, half.hit.Ng_z);
    COPY_HALF(p->hit.u + first, half.hit.u);
    COPY_HALF(p->hit.v + first, half.hit.v);
    COPY_HALF(p->hit.primID + first, half.hit.primID);
    COPY_HALF(p->hit.geomID + first, half.hit.geomID);
}

static void trace_packet(RTCScene scene, embree_call call, struct RTCIntersectContext *context,
                         struct RTCRayHit16 *p)
{
    _Alignas(64) ints valid = load(p->ray.tnear) <= load(p->ray.tfar);
    const int *flags = (const int *)&valid;
    switch (call) {
    case EMBREE_INTERSECT_1:
        trace_one_by_one(scene, context, p);
        break;
    case EMBREE_INTERSECT_8:
        trace_half(scene, context, flags, p, 0);
        trace_half(scene, context, flags, p, 8);
        break;
    case EMBREE_INTERSECT_16:
        rtcIntersect16(flags, scene, context, p);
        break;
    default:
        rtcIntersectNM(scene, context, (struct RTCRayHitN *)p, LANES, 1, sizeof *p);
        break;
    }
}

void embree_trace(RTCScene scene, embree_query query, struct RTCRayHit16 *packets, int count)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = query.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                   : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    if (query.call == EMBREE_STREAM_16_16) {
        rtcIntersectNM(scene, &context, (struct RTCRayHitN *)packets, LANES, (unsigned)count,
                       sizeof *packets);
        return;
    }
    for (int i = 0; i < count; i++) {
        trace_packet(scene, query.call, &context, packets + i);
    }
}
