/* Embree 3: two triangles a cell, or grids; single rays, packets of sixteen, the same told that
 * they are coherent, streams. Without its robust flag, which makes it faster and lets a ray in 10^5
 * or so through the edges of triangles. */
#include "peers.h"
#include "trace_rays.h"

#include <embree3/rtcore.h>

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { SINGLE, PACKETS, COHERENT, STREAMS, WIDTH = 16, STREAM = 256, GRID_MAX = 32767 };

typedef struct scene {
    RTCDevice    device;
    RTCScene     scene;
    atomic_llong bytes;
} scene;

static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    (void)post;
    (void)atomic_fetch_add(&((scene *)user)->bytes, bytes);
    return true;
}

static void fill_vertices(float *to, const hc_field *field)
{
    for (int y = 0; y < field->height; y++) {
        for (int x = 0; x < field->width; x++) {
            *to++ = ((float)x + 0.5F) / (float)field->width;
            *to++ = ((float)y + 0.5F) / (float)field->height;
            *to++ = (float)HC_RAYS_RELIEF
                    * field->heights[(size_t)y * (size_t)field->width + (size_t)x];
        }
    }
}

static void fill_triangles(unsigned *to, const hc_field *field)
{
    const unsigned width = (unsigned)field->width;
    for (unsigned y = 0; y + 1 < (unsigned)field->height; y++) {
        for (unsigned x = 0; x + 1 < width; x++) {
            const unsigned first     = y * width + x;
            const unsigned corner[6] = { first,     first + 1,         first + width,
                                         first + 1, first + width + 1, first + width };
            for (int k = 0; k < 6; k++) {
                *to++ = corner[k];
            }
        }
    }
}

static void destroy(void *state)
{
    scene *s = state;
    rtcReleaseScene(s->scene);
    rtcReleaseDevice(s->device);
    free(s);
}

static scene *create(const hc_field *field, enum RTCGeometryType type)
{
    scene *s = calloc(1, sizeof *s);
    if (s == NULL) {
        return NULL;
    }
    const size_t count = (size_t)field->width * (size_t)field->height;
    s->device          = rtcNewDevice("threads=1,set_affinity=0");
    rtcSetDeviceMemoryMonitorFunction(s->device, count_bytes, s);
    s->scene             = rtcNewScene(s->device);
    RTCGeometry geometry = rtcNewGeometry(s->device, type);
    fill_vertices(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                          3 * sizeof(float), count),
                  field);
    if (type == RTC_GEOMETRY_TYPE_TRIANGLE) {
        const size_t cells = (size_t)(field->width - 1) * (size_t)(field->height - 1);
        fill_triangles(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                               3 * sizeof(unsigned), 2 * cells),
                       field);
    } else {
        struct RTCGrid *grid = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0,
                                                       RTC_FORMAT_GRID, sizeof *grid, 1);
        *grid                = (struct RTCGrid){ .stride = (unsigned)field->width,
                                                 .width  = (unsigned short)field->width,
                                                 .height = (unsigned short)field->height };
    }
    rtcCommitGeometry(geometry);
    (void)rtcAttachGeometry(s->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(s->scene);
    return s;
}

static void *create_triangles(const hc_field *field, hc_isa isa)
{
    (void)isa;
    return create(field, RTC_GEOMETRY_TYPE_TRIANGLE);
}

static void *create_grids(const hc_field *field, hc_isa isa)
{
    (void)isa;
    return field->width > GRID_MAX || field->height > GRID_MAX
               ? NULL
               : create(field, RTC_GEOMETRY_TYPE_GRID);
}

static double bytes(const void *state)
{
    return (double)atomic_load(&((scene *)(uintptr_t)state)->bytes);
}

static struct RTCRay ray_of(const hc_ray *ray)
{
    return (struct RTCRay){ .org_x = ray->origin[0],
                            .org_y = ray->origin[1],
                            .org_z = ray->origin[2],
                            .tnear = ray->tmin,
                            .dir_x = ray->direction[0],
                            .dir_y = ray->direction[1],
                            .dir_z = ray->direction[2],
                            .tfar  = ray->tmax,
                            .mask  = UINT32_MAX };
}

static void load_packet(struct RTCRay16 *packet, int *valid, const hc_ray *rays, size_t count)
{
    for (size_t i = 0; i < WIDTH; i++) {
        const hc_ray *ray = &rays[i < count ? i : 0];
        valid[i]          = i < count ? -1 : 0;
        packet->org_x[i]  = ray->origin[0];
        packet->org_y[i]  = ray->origin[1];
        packet->org_z[i]  = ray->origin[2];
        packet->tnear[i]  = ray->tmin;
        packet->dir_x[i]  = ray->direction[0];
        packet->dir_y[i]  = ray->direction[1];
        packet->dir_z[i]  = ray->direction[2];
        packet->tfar[i]   = ray->tmax;
        packet->time[i]   = 0.0F;
        packet->mask[i]   = UINT32_MAX;
        packet->id[i]     = 0;
        packet->flags[i]  = 0;
    }
}

static void put(hc_hit *hit, float t, unsigned geometry, unsigned cell, float u, float v)
{
    const bool found = geometry != RTC_INVALID_GEOMETRY_ID;
    *hit             = (hc_hit){ .t = found ? t : INFINITY, .u = u, .v = v, .cell_x = (int)cell };
}

static struct RTCIntersectContext context_of(bool coherent)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

static void nearest_single(const scene *s, hc_hit *hits, const hc_ray *rays, size_t count)
{
    struct RTCIntersectContext context = context_of(false);
    for (size_t i = 0; i < count; i++) {
        struct RTCRayHit r = { .ray = ray_of(&rays[i]), .hit.geomID = RTC_INVALID_GEOMETRY_ID };
        rtcIntersect1(s->scene, &context, &r);
        put(&hits[i], r.ray.tfar, r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v);
    }
}

static void nearest_packets(const scene *s, bool coherent, hc_hit *hits, const hc_ray *rays,
                            size_t count)
{
    struct RTCIntersectContext context = context_of(coherent);
    for (size_t i = 0; i < count; i += WIDTH) {
        _Alignas(64) struct RTCRayHit16 r;
        _Alignas(64) int                valid[WIDTH];
        const size_t                    n = count - i < WIDTH ? count - i : WIDTH;
        load_packet(&r.ray, valid, rays + i, n);
        for (int k = 0; k < WIDTH; k++) {
            r.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, s->scene, &context, &r);
        for (size_t k = 0; k < n; k++) {
            put(&hits[i + k], r.ray.tfar[k], r.hit.geomID[k], r.hit.primID[k], r.hit.u[k],
                r.hit.v[k]);
        }
    }
}

static void nearest_streams(const scene *s, hc_hit *hits, const hc_ray *rays, size_t count)
{
    struct RTCRayHit           r[STREAM];
    struct RTCIntersectContext context = context_of(false);
    for (size_t i = 0; i < count; i += STREAM) {
        const size_t n = count - i < STREAM ? count - i : STREAM;
        for (size_t k = 0; k < n; k++) {
            r[k] = (struct RTCRayHit){ .ray        = ray_of(&rays[i + k]),
                                       .hit.geomID = RTC_INVALID_GEOMETRY_ID };
        }
        rtcIntersect1M(s->scene, &context, r, (unsigned)n, sizeof *r);
        for (size_t k = 0; k < n; k++) {
            put(&hits[i + k], r[k].ray.tfar, r[k].hit.geomID, r[k].hit.primID, r[k].hit.u,
                r[k].hit.v);
        }
    }
}

static void nearest(const void *state, int mode, hc_hit *hits, const hc_ray *rays, size_t count)
{
    if (mode == SINGLE) {
        nearest_single(state, hits, rays, count);
    } else if (mode == PACKETS || mode == COHERENT) {
        nearest_packets(state, mode == COHERENT, hits, rays, count);
    } else {
        nearest_streams(state, hits, rays, count);
    }
}

static void any_single(const scene *s, uint8_t *hit, const hc_ray *rays, size_t count)
{
    struct RTCIntersectContext context = context_of(false);
    for (size_t i = 0; i < count; i++) {
        struct RTCRay r = ray_of(&rays[i]);
        rtcOccluded1(s->scene, &context, &r);
        hit[i] = r.tfar < 0.0F;
    }
}

static void any_packets(const scene *s, bool coherent, uint8_t *hit, const hc_ray *rays,
                        size_t count)
{
    struct RTCIntersectContext context = context_of(coherent);
    for (size_t i = 0; i < count; i += WIDTH) {
        _Alignas(64) struct RTCRay16 r;
        _Alignas(64) int             valid[WIDTH];
        const size_t                 n = count - i < WIDTH ? count - i : WIDTH;
        load_packet(&r, valid, rays + i, n);
        rtcOccluded16(valid, s->scene, &context, &r);
        for (size_t k = 0; k < n; k++) {
            hit[i + k] = r.tfar[k] < 0.0F;
        }
    }
}

static void any_streams(const scene *s, uint8_t *hit, const hc_ray *rays, size_t count)
{
    struct RTCRay              r[STREAM];
    struct RTCIntersectContext context = context_of(false);
    for (size_t i = 0; i < count; i += STREAM) {
        const size_t n = count - i < STREAM ? count - i : STREAM;
        for (size_t k = 0; k < n; k++) {
            r[k] = ray_of(&rays[i + k]);
        }
        rtcOccluded1M(s->scene, &context, r, (unsigned)n, sizeof *r);
        for (size_t k = 0; k < n; k++) {
            hit[i + k] = r[k].tfar < 0.0F;
        }
    }
}

static void any(const void *state, int mode, uint8_t *hit, const hc_ray *rays, size_t count)
{
    if (mode == SINGLE) {
        any_single(state, hit, rays, count);
    } else if (mode == PACKETS || mode == COHERENT) {
        any_packets(state, mode == COHERENT, hit, rays, count);
    } else {
        any_streams(state, hit, rays, count);
    }
}

const hc_bench_peer hc_peer_embree_triangles = { .name    = "embree-triangles",
                                                 .modes   = { "single", "packets", "coherent",
                                                              "streams" },
                                                 .share   = 1,
                                                 .create  = create_triangles,
                                                 .destroy = destroy,
                                                 .bytes   = bytes,
                                                 .nearest = nearest,
                                                 .any     = any };
const hc_bench_peer hc_peer_embree_grids     = { .name    = "embree-grids",
                                                 .modes   = { "single", "packets", "coherent",
                                                              "streams" },
                                                 .share   = 1,
                                                 .create  = create_grids,
                                                 .destroy = destroy,
                                                 .bytes   = bytes,
                                                 .nearest = nearest,
                                                 .any     = any };
