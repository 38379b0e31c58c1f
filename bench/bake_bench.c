#include "bake_bench.h"

#include "measure.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

enum { DEFAULT_REPEAT = 5, DEFAULT_THREADS = 2 };

/* Slow methods are run less often instead of for hours. */
static const double SECONDS_PER_ROW = 15.0;

/* A row of the table: what is baked, and up to which side unless it was asked for by name. */
typedef struct bench_case bench_case;
struct bench_case {
    const char    *name;
    hc_bench_work *work;
    hc_method      method;
    hc_cones       cones;
    bool           threaded;
    int            channels; /* of the output; 0: those of the cones                              */
    int            side_max; /* about ten seconds for one core                                    */
};

/* What the work in the child sees. */
typedef struct bake_job {
    const bench_case       *c;
    const hc_bench_options *options;
    hc_field                field;
    const float *exact; /* round exact ratios: input of the cells; NULL before they are known */
} bake_job;

typedef struct bake_stand {
    const hc_bench_options *options;
    hc_log                 *log;
} bake_stand;

static int threads_of(const hc_bench_options *options, const bench_case *c)
{
    return !c->threaded ? 1 : options->plan.threads > 0 ? options->plan.threads : DEFAULT_THREADS;
}

static hc_result work_cones(void *context, void *output, hc_log *log)
{
    const bake_job       *job  = context;
    const hc_cone_options cone = { .cones    = job->c->cones,
                                   .method   = job->c->method,
                                   .threads  = threads_of(job->options, job->c),
                                   .isa      = job->options->plan.isa,
                                   .progress = job->options->progress };
    return hc_bake_cone_map(output, &job->field, &cone, log);
}

static hc_result work_cells(void *context, void *output, hc_log *log)
{
    const bake_job *job = context;
    (void)log;
    hc_bake_cell_ratios(output, job->exact, job->field.width, job->field.height, HC_CONES_L2,
                        HC_WRAP_NONE);
    return HC_OK;
}

static hc_result work_gradient(void *context, void *output, hc_log *log)
{
    (void)log;
    hc_bake_gradient(output, &((const bake_job *)context)->field);
    return HC_OK;
}

static hc_result work_bounds(void *context, void *output, hc_log *log)
{
    (void)log;
    hc_bake_bounds(output, &((const bake_job *)context)->field, HC_MAXIMUM);
    return HC_OK;
}

static hc_result work_pyramid(void *context, void *output, hc_log *log)
{
    const bake_job *job = context;
    hc_pyramid      pyramid;
    (void)log;
    hc_bake_pyramid(&pyramid, output, job->field.heights, job->field.width, job->field.height,
                    HC_MAXIMUM);
    return HC_OK;
}

/* Exact comes first in each shape: the others are compared with it. */
static const bench_case cases[] = {
    { "exact", work_cones, HC_METHOD_EXACT, HC_CONES_L2, false, 0, HC_SIDE_MAX },
    { "exact", work_cones, HC_METHOD_EXACT, HC_CONES_L2, true, 0, HC_SIDE_MAX },
    { "quick-improved", work_cones, HC_METHOD_QUICK_IMPROVED, HC_CONES_L2, false, 0, HC_SIDE_MAX },
    { "quick", work_cones, HC_METHOD_QUICK, HC_CONES_L2, false, 0, HC_SIDE_MAX },
    { "quick-centre", work_cones, HC_METHOD_QUICK_CENTRE, HC_CONES_L2, false, 0, HC_SIDE_MAX },
    { "quick-naive-centre", work_cones, HC_METHOD_QUICK_NAIVE_CENTRE, HC_CONES_L2, false, 0,
      HC_SIDE_MAX },
    { "ring", work_cones, HC_METHOD_RING, HC_CONES_L2, false, 0, 1024 },
    { "brute", work_cones, HC_METHOD_BRUTE, HC_CONES_L2, false, 0, 256 },
    { "falling-edge", work_cones, HC_METHOD_FALLING_EDGE, HC_CONES_L2, false, 0, 256 },
    { "gems", work_cones, HC_METHOD_GEMS, HC_CONES_L2, false, 0, 64 },
    { "exact", work_cones, HC_METHOD_EXACT, HC_CONES_L1, false, 0, HC_SIDE_MAX },
    { "exact", work_cones, HC_METHOD_EXACT, HC_CONES_QUAD, false, 0, HC_SIDE_MAX },
    { "exact", work_cones, HC_METHOD_EXACT, HC_CONES_ANISO, false, 0, HC_SIDE_MAX },
    { "cells", work_cells, HC_METHOD_EXACT, HC_CONES_L2, false, 1, HC_SIDE_MAX },
    { "gradient", work_gradient, HC_METHOD_EXACT, HC_CONES_L2, false, 2, HC_SIDE_MAX },
    { "bounds", work_bounds, HC_METHOD_EXACT, HC_CONES_L2, false, 1, HC_SIDE_MAX },
    { "pyramid", work_pyramid, HC_METHOD_EXACT, HC_CONES_L2, false, 0, HC_SIDE_MAX },
};

enum { CASES = (int)(sizeof cases / sizeof *cases) };

const char *hc_bench_method(int index)
{
    for (int i = 0; i < CASES; i++) {
        bool repeated = false;
        for (int j = 0; j < i; j++) {
            repeated = repeated || strcmp(cases[i].name, cases[j].name) == 0;
        }
        if (!repeated && index-- == 0) {
            return cases[i].name;
        }
    }
    return NULL;
}

static bool is_wanted(const hc_bench_options *options, const bench_case *c, int side)
{
    return hc_bench_chosen(&options->plan, c->name)
           && (options->plan.method_count > 0 || side <= c->side_max);
}

static size_t output_floats(const bench_case *c, int side)
{
    if (c->work == work_pyramid) {
        return hc_pyramid_size(side, side);
    }
    const int channels = c->channels > 0 ? c->channels : hc_cones_channels(c->cones);
    return (size_t)side * (size_t)side * (size_t)channels;
}

static hc_bench_row row_of(const bake_job *job, const char *field, const hc_bench_time *time,
                           const hc_bench_limits *limits)
{
    const double both     = (double)(limits->input_bytes + limits->output_bytes);
    const char  *cones    = job->c->work == work_cones ? hc_cones_name(job->c->cones) : NULL;
    hc_bench_row row      = hc_bench_row_of(field, job->field.width, job->c->name, cones);
    row.threads           = threads_of(job->options, job->c);
    row.runs              = time->runs;
    row.processor_seconds = time->processor;
    row.seconds           = time->median;
    row.fastest           = time->fastest;
    row.slowest           = time->slowest;
    row.peak_bytes        = time->peak_bytes;
    row.memory_factor     = time->peak_bytes / both;
    return row;
}

/* Measure one case. The first exact round ratios stay in job->exact. */
static hc_result run_case(bake_job *job, const char *field, float **exact, hc_log *log)
{
    const hc_bench_options *options = job->options;
    const size_t            floats  = output_floats(job->c, job->field.width);
    const size_t            texels  = (size_t)job->field.width * (size_t)job->field.height;
    const hc_bench_limits   limits  = { .repeat  = options->plan.repeat > 0 ? options->plan.repeat
                                                                            : DEFAULT_REPEAT,
                                        .seconds = SECONDS_PER_ROW,
                                        .input_bytes  = texels * sizeof(float),
                                        .output_bytes = floats * sizeof(float),
                                        .stop         = options->plan.stop };
    hc_bench_time           time;
    float                  *output = malloc(limits.output_bytes);
    if (output == NULL) {
        return HC_ERROR_MEMORY;
    }
    job->exact             = *exact;
    const hc_result result = hc_bench_measure(&time, output, job->c->work, job, &limits, log);
    if (result == HC_OK) {
        hc_bench_row row   = row_of(job, field, &time, &limits);
        const bool   round = job->c->work == work_cones && job->c->cones == HC_CONES_L2;
        if (round && *exact == NULL && job->c->method == HC_METHOD_EXACT) {
            *exact = output;
        }
        hc_bench_row_done(options, &row, round ? output : NULL, *exact, floats);
    }
    if (output != *exact) {
        free(output);
    }
    return result;
}

static hc_result run_field(void *user, const char *name, const hc_field *field)
{
    const bake_stand       *stand   = user;
    const hc_bench_options *options = stand->options;
    bake_job                job     = { .options = options, .field = *field };
    float                  *exact   = NULL;
    hc_result               result  = HC_OK;
    for (int i = 0; i < CASES && result == HC_OK; i++) {
        job.c = &cases[i];
        if (!is_wanted(options, job.c, field->width)
            || (job.c->work == work_cells && exact == NULL)) {
            continue;
        }
        result = run_case(&job, name, &exact, stand->log);
    }
    free(exact);
    return result;
}

hc_result hc_bench_bake(const hc_bench_options *options, hc_log *log)
{
    bake_stand stand = { options, log };
#if defined(__GLIBC__)
    /* Large blocks go back to the system when they are freed, as in a process that has freed none:
     * else a child could work in memory that was resident before it was measured. */
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 17);
#endif
    return hc_bench_each_field(&options->plan, run_field, &stand, log);
}
