#include "steps_bench.h"

#include "trace_rays.h"

#include <heightcast/bake.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_RAYS = 1 << 16 };

static const hc_trace_method methods[] = { HC_TRACE_FAST, HC_TRACE_SAFE, HC_TRACE_MAXMIP };
enum { METHODS = sizeof methods / sizeof *methods };

typedef struct course {
    const hc_bench_steps_options *options;
    const char                   *name;
    hc_field                      field;
    float                        *ratios; /* of cells, for safe */
    hc_tracer                    *tracers[METHODS];
    hc_ray                       *rays;
    hc_hit                       *hits;
    size_t                        count;
} course;

const char *hc_bench_steps_method(int index)
{
    return index >= 0 && index < METHODS ? hc_trace_method_name(methods[index]) : NULL;
}

static bool keep_on(void *user, double fraction)
{
    (void)fraction;
    return !hc_bench_stopped(user);
}

static hc_progress progress_of(course *c)
{
    return (hc_progress){ keep_on, (void *)(uintptr_t)&c->options->plan };
}

/* ---- casters --------------------------------------------------------------------------------- */

static hc_result bake(course *c, hc_log *log)
{
    const hc_cone_options options = { .cones    = HC_CONES_L1,
                                      .threads  = c->options->plan.threads,
                                      .isa      = c->options->plan.isa,
                                      .progress = progress_of(c) };
    return hc_bench_bake_ratios(&c->ratios, &c->field, &options, true, log);
}

static hc_result make_tracer(course *c, int method, hc_log *log)
{
    const bool cones  = hc_trace_method_needs(methods[method]) == HC_NEEDS_CELL_RATIOS;
    hc_result  result = cones ? bake(c, log) : HC_OK;
    if (result != HC_OK) {
        return result;
    }
    const hc_trace_options options = { .method    = methods[method],
                                       .placement = hc_bench_placement(&c->field),
                                       .ratios    = cones ? c->ratios : NULL,
                                       .cones     = HC_CONES_L1,
                                       .isa       = c->options->plan.isa,
                                       .threads   = c->options->plan.threads };
    return hc_tracer_create(&c->tracers[method], &c->field, &options, log);
}

static hc_result make_tracers(course *c, hc_log *log)
{
    hc_result result = HC_OK;
    for (int i = 0; i < METHODS && result == HC_OK; i++) {
        if (hc_bench_chosen(&c->options->plan, hc_bench_steps_method(i))) {
            result = make_tracer(c, i, log);
        }
    }
    return result;
}

/* ---- counts ---------------------------------------------------------------------------------- */

static int by_steps(const void *a, const void *b)
{
    const uint32_t x = ((const hc_hit *)a)->steps;
    const uint32_t y = ((const hc_hit *)b)->steps;
    return (x > y) - (x < y);
}

static void report(course *c, int set, int method)
{
    double             sum  = 0.0;
    double             hits = 0.0;
    const size_t       last = (c->count * 99 + 99) / 100 - 1;
    hc_bench_steps_row row  = { .field  = c->name,
                                .side   = c->field.width,
                                .rays   = hc_bench_rays_name(set),
                                .method = hc_bench_steps_method(method),
                                .count  = c->count };
    for (size_t i = 0; i < c->count; i++) {
        sum += (double)c->hits[i].steps;
        hits += c->hits[i].t < INFINITY ? 1.0 : 0.0;
    }
    qsort(c->hits, c->count, sizeof *c->hits, by_steps);
    row.hits   = hits / (double)c->count;
    row.mean   = sum / (double)c->count;
    row.most99 = (double)c->hits[last].steps;
    row.worst  = (double)c->hits[c->count - 1].steps;
    c->options->row_done(c->options->user, &row);
}

static hc_result cast_sets(course *c, hc_log *log)
{
    hc_result result = HC_OK;
    for (int set = 0; set < HC_RAYS_SETS && result == HC_OK; set++) {
        hc_bench_fill_rays(c->rays, c->count, (hc_bench_rays)set, &c->field);
        for (int i = 0; i < METHODS && result == HC_OK; i++) {
            if (c->tracers[i] != NULL) {
                result = hc_trace_batch(c->tracers[i], c->hits, c->rays, c->count,
                                        c->options->plan.threads, progress_of(c), log);
            }
            if (c->tracers[i] != NULL && result == HC_OK) {
                report(c, set, i);
            }
        }
    }
    return result;
}

/* ---- fields ---------------------------------------------------------------------------------- */

typedef struct job {
    const hc_bench_steps_options *options;
    hc_log                       *log;
} job;

static hc_result run_field(void *context, const char *name, const hc_field *field)
{
    const job *j      = context;
    course     c      = { .options = j->options,
                          .name    = name,
                          .field   = *field,
                          .count   = j->options->rays > 0 ? j->options->rays : DEFAULT_RAYS };
    hc_result  result = HC_ERROR_MEMORY;
    c.rays            = malloc(c.count * sizeof *c.rays);
    c.hits            = malloc(c.count * sizeof *c.hits);
    if (c.rays != NULL && c.hits != NULL) {
        result = make_tracers(&c, j->log);
        result = result == HC_OK ? cast_sets(&c, j->log) : result;
    }
    for (int i = 0; i < METHODS; i++) {
        hc_tracer_destroy(c.tracers[i]);
    }
    free(c.ratios);
    free(c.hits);
    free(c.rays);
    return result;
}

hc_result hc_bench_steps(const hc_bench_steps_options *options, hc_log *log)
{
    job j = { options, log };
    return hc_bench_each_field(&options->plan, run_field, &j, log);
}
