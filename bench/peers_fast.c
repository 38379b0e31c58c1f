/* Our own caster behind the common door. */
#include "peers.h"
#include "trace_rays.h"

#include <stdlib.h>

enum { BATCH, SINGLE };

typedef struct scene {
    hc_tracer *tracer;
    double     bytes;
} scene;

static void destroy(void *state)
{
    scene *s = state;
    hc_tracer_destroy(s->tracer);
    free(s);
}

static void *create(const hc_field *field, hc_isa isa)
{
    const hc_trace_options options = { .placement = hc_bench_placement(field),
                                       .isa       = isa,
                                       .threads   = 1 };
    scene                 *s       = calloc(1, sizeof *s);
    if (s != NULL && hc_tracer_create(&s->tracer, field, &options, NULL) != HC_OK) {
        free(s);
        return NULL;
    }
    if (s != NULL) {
        s->bytes = (double)hc_tracer_bytes(field, &options);
    }
    return s;
}

static double bytes(const void *state)
{
    return ((const scene *)state)->bytes;
}

static void nearest(const void *state, int mode, hc_hit *hits, const hc_ray *rays, size_t count)
{
    const hc_tracer *tracer = ((const scene *)state)->tracer;
    if (mode == BATCH) {
        hc_trace_nearest_many(tracer, hits, rays, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        (void)hc_trace_nearest(tracer, &hits[i], &rays[i]);
    }
}

static void any(const void *state, int mode, uint8_t *hit, const hc_ray *rays, size_t count)
{
    const hc_tracer *tracer = ((const scene *)state)->tracer;
    if (mode == BATCH) {
        hc_trace_any_many(tracer, hit, rays, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        hit[i] = hc_trace_any(tracer, &rays[i]) ? 1 : 0;
    }
}

const hc_bench_peer hc_peer_fast = { .name    = "fast",
                                     .modes   = { [BATCH] = "batch", [SINGLE] = "single" },
                                     .share   = 1,
                                     .create  = create,
                                     .destroy = destroy,
                                     .bytes   = bytes,
                                     .nearest = nearest,
                                     .any     = any };
