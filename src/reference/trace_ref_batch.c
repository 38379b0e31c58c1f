/* Many rays by the reference, on several threads. */
#include <heightcast/ray.h>

#include "base/parallel.h"

/* Rays per item of work: a slow one may cross every cell of a field. */
enum { CHUNK = 1 << 7 };

typedef struct batch {
    hc_hit                     *hits;  /* or NULL */
    double                     *exact; /* or NULL */
    const hc_field             *field;
    const hc_reference_options *options;
    const hc_ray               *rays;
    size_t                      count, chunk;
} batch;

static void trace_chunk(void *context, int item, int worker)
{
    const batch *b    = context;
    const size_t from = (size_t)item * b->chunk;
    const size_t left = b->count - from;
    const size_t end  = from + (left < b->chunk ? left : b->chunk);
    (void)worker;
    for (size_t i = from; i < end; i++) {
        hc_hit       hit;
        const double t = hc_reference_trace(&hit, b->field, b->options, &b->rays[i]);
        if (b->hits != NULL) {
            b->hits[i] = hit;
        }
        if (b->exact != NULL) {
            b->exact[i] = t;
        }
    }
}

hc_result hc_reference_batch(hc_hit *hits, double *exact, const hc_field *field,
                             const hc_reference_options *options, const hc_ray *rays, size_t count,
                             int threads, hc_progress progress, hc_log *log)
{
    const size_t most  = (size_t)1 << 24; /* items: an int counts them */
    const size_t chunk = count / CHUNK < most ? CHUNK : count / most + 1;
    batch        b     = { hits, exact, field, options, rays, count, chunk };
    const int    items = (int)((count + chunk - 1) / chunk);
    return hc_parallel_for(items, hc_threads_resolve(threads), trace_chunk, &b, progress, log);
}
