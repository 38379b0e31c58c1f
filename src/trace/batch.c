/* One ray, many rays, many threads. */
#include "tracer.h"

#include "base/parallel.h"

#include <math.h>

/* Rays per item of work: enough to outweigh handing it out. */
enum { CHUNK = 1 << 12 };

bool hc_trace_nearest(const hc_tracer *tracer, hc_hit *hit, const hc_ray *ray)
{
    if (tracer->fast == NULL) {
        return hc_trace_path(tracer, hit, ray);
    }
    hc_fast_nearest(tracer->fast, hit, ray, 1);
    return hit->t < INFINITY;
}

bool hc_trace_any(const hc_tracer *tracer, const hc_ray *ray)
{
    uint8_t any = 0;
    hc_trace_any_many(tracer, &any, ray, 1);
    return any != 0;
}

void hc_trace_nearest_many(const hc_tracer *tracer, hc_hit *hits, const hc_ray *rays, size_t count)
{
    if (tracer->fast != NULL) {
        hc_fast_nearest(tracer->fast, hits, rays, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        (void)hc_trace_path(tracer, &hits[i], &rays[i]);
    }
}

void hc_trace_any_many(const hc_tracer *tracer, uint8_t *any, const hc_ray *rays, size_t count)
{
    if (tracer->fast != NULL) {
        hc_fast_any(tracer->fast, any, rays, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        hc_hit hit;
        any[i] = hc_trace_path(tracer, &hit, &rays[i]) ? 1 : 0;
    }
}

typedef struct batch {
    const hc_tracer *tracer;
    hc_hit          *hits; /* or NULL */
    uint8_t         *any;
    const hc_ray    *rays;
    size_t           count, chunk;
} batch;

static void trace_chunk(void *context, int item, int worker)
{
    const batch *b    = context;
    const size_t from = (size_t)item * b->chunk;
    const size_t left = b->count - from < b->chunk ? b->count - from : b->chunk;
    (void)worker;
    if (b->hits != NULL) {
        hc_trace_nearest_many(b->tracer, b->hits + from, b->rays + from, left);
    } else {
        hc_trace_any_many(b->tracer, b->any + from, b->rays + from, left);
    }
}

static hc_result run(batch *b, int threads, hc_progress progress, hc_log *log)
{
    const size_t most = (size_t)1 << 24; /* items: an int counts them */
    b->chunk          = b->count / CHUNK < most ? CHUNK : b->count / most + 1;
    const int items   = (int)((b->count + b->chunk - 1) / b->chunk);
    return hc_parallel_for(items, hc_threads_resolve(threads), trace_chunk, b, progress, log);
}

hc_result hc_trace_batch(const hc_tracer *tracer, hc_hit *hits, const hc_ray *rays, size_t count,
                         int threads, hc_progress progress, hc_log *log)
{
    batch b = { .tracer = tracer, .hits = hits, .rays = rays, .count = count };
    return run(&b, threads, progress, log);
}

hc_result hc_trace_any_batch(const hc_tracer *tracer, uint8_t *any, const hc_ray *rays,
                             size_t count, int threads, hc_progress progress, hc_log *log)
{
    batch b = { .tracer = tracer, .any = any, .rays = rays, .count = count };
    return run(&b, threads, progress, log);
}
