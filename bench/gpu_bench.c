/* The same methods on the GPU. In this process: drivers do not survive a fork. */
#include "bake_bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { RUNS_MAX = 64, DEFAULT_REPEAT = 5 };

static const double DEFAULT_LIMIT = 15.0;

typedef struct gpu_case {
    const char *name;
    hc_method   method;
    hc_cones    cones;
} gpu_case;

/* Rows of the same cones beside each other: they share the exact ratios. */
static const gpu_case cases[] = {
    { "brute", HC_METHOD_BRUTE, HC_CONES_L2 },
    { "gems", HC_METHOD_GEMS, HC_CONES_L2 },
    { "falling-edge", HC_METHOD_FALLING_EDGE, HC_CONES_L2 },
    { "quick", HC_METHOD_QUICK, HC_CONES_L2 },
    { "quick-improved", HC_METHOD_QUICK_IMPROVED, HC_CONES_L2 },
    { "quick-naive-centre", HC_METHOD_QUICK_NAIVE_CENTRE, HC_CONES_L2 },
    { "quick-centre", HC_METHOD_QUICK_CENTRE, HC_CONES_L2 },
    { "pyramid", HC_METHOD_EXACT, HC_CONES_L2 },
    { "exact", HC_METHOD_EXACT, HC_CONES_L2 },
    { "exact", HC_METHOD_EXACT, HC_CONES_L1 },
    { "exact", HC_METHOD_EXACT, HC_CONES_QUAD },
    { "exact", HC_METHOD_EXACT, HC_CONES_ANISO },
};

enum { CASES = (int)(sizeof cases / sizeof *cases) };

/* The CPU's exact ratios of one field and one kind of cones. */
typedef struct exact_ratios {
    float   *ratios; /* NULL: not baked yet */
    hc_cones cones;
} exact_ratios;

typedef struct gpu_stand {
    const hc_bench_options *options;
    hc_log                 *log;
} gpu_stand;

static bool is_pyramid(const gpu_case *c)
{
    return strcmp(c->name, "pyramid") == 0;
}

static size_t output_floats(const gpu_case *c, int side)
{
    return is_pyramid(c) ? hc_pyramid_size(side, side)
                         : (size_t)side * (size_t)side * (size_t)hc_cones_channels(c->cones);
}

/* ---- runs that take too long ----------------------------------------------------------------- */

typedef struct watch {
    const hc_progress *progress;
    double             limit;
    double             start, first; /* `first` was done at the start: loading is no part of that */
    double             expected;     /* 0: not stopped */
} watch;

static double now(void)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* After a tenth of the limit what was done, if anything was, says how long the rest will take,
 * within a factor of 4. */
static bool go_on(void *user, double fraction)
{
    watch *w = user;
    if (w->progress->report != NULL && !w->progress->report(w->progress->user, fraction)) {
        return false;
    }
    if (w->start == 0.0) {
        w->start = now();
        w->first = fraction;
    }
    const double gone = now() - w->start;
    const double all  = fraction > w->first ? gone / (fraction - w->first) : INFINITY;
    const bool   slow = gone > 0.1 * w->limit && isfinite(all) && all > 4.0 * w->limit;
    if (slow || gone > w->limit) {
        w->expected = all;
    }
    return w->expected == 0.0;
}

/* ---- measuring ------------------------------------------------------------------------------- */

static hc_result run_once(const hc_bench_options *options, const gpu_case *c, watch *w,
                          float *output, const hc_field *field, hc_log *log)
{
    const hc_cone_options cone = { .cones    = c->cones,
                                   .method   = c->method,
                                   .progress = { .report = go_on, .user = w } };
    hc_pyramid            pyramid;
    w->start = 0.0;
    return is_pyramid(c) ? hc_gpu_bake_pyramid(options->gpu, &pyramid, output, field->heights,
                                               field->width, field->height, HC_MAXIMUM, log)
                         : hc_gpu_bake_cone_map(options->gpu, output, field, &cone, log);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void take_times(hc_bench_row *row, double *seconds)
{
    qsort(seconds, (size_t)row->runs, sizeof *seconds, by_value);
    row->seconds = seconds[row->runs / 2];
    row->fastest = seconds[0];
    row->slowest = seconds[row->runs - 1];
}

/* Runs until there are enough, or they have taken long. */
static hc_result measure(const hc_bench_options *options, const gpu_case *c, hc_bench_row *row,
                         float *output, const hc_field *field, hc_log *log)
{
    const int wanted = options->plan.repeat > 0 ? options->plan.repeat : DEFAULT_REPEAT;
    watch     w      = { .progress = &options->progress,
                         .limit    = options->limit > 0.0 ? options->limit : DEFAULT_LIMIT };
    double    seconds[RUNS_MAX];
    double    sum    = 0.0;
    hc_result result = HC_OK;
    while (row->runs < wanted && row->runs < RUNS_MAX && sum < w.limit && result == HC_OK) {
        result = run_once(options, c, &w, output, field, log);
        if (result == HC_OK) {
            seconds[row->runs] = hc_gpu_seconds(options->gpu);
            sum += seconds[row->runs++];
        }
    }
    if (row->runs > 0) {
        take_times(row, seconds);
    }
    if (result == HC_ERROR_CANCELLED && w.expected > 0.0) {
        row->expected = row->runs > 0 ? 0.0 : w.expected;
        return HC_OK;
    }
    return result;
}

/* Elongated diamonds may be of another elongation where the driver does not round. */
static bool is_comparable(const hc_bench_options *options, const gpu_case *c)
{
    return !is_pyramid(c) && (c->cones != HC_CONES_ANISO || hc_gpu_rounds(options->gpu));
}

static hc_result know_exact(exact_ratios *exact, const hc_bench_options *options, const gpu_case *c,
                            const hc_field *field, hc_log *log)
{
    const hc_cone_options cone = { .cones   = c->cones,
                                   .threads = options->plan.threads,
                                   .isa     = options->plan.isa };
    if (exact->ratios != NULL && exact->cones == c->cones) {
        return HC_OK;
    }
    free(exact->ratios);
    exact->cones = c->cones;
    return hc_bench_bake_ratios(&exact->ratios, field, &cone, false, log);
}

static hc_result run_case(const gpu_stand *stand, const gpu_case *c, const char *name,
                          const hc_field *field, exact_ratios *exact)
{
    const hc_bench_options *options = stand->options;
    const size_t            floats  = output_floats(c, field->width);
    const bool              judged  = is_comparable(options, c);
    float                  *output  = malloc(floats * sizeof *output);
    hc_bench_row            row     = hc_bench_row_of(name, field->width, c->name,
                                       is_pyramid(c) ? NULL : hc_cones_name(c->cones));
    hc_result               result  = HC_ERROR_MEMORY;
    if (output != NULL) {
        result = measure(options, c, &row, output, field, stand->log);
    }
    if (result == HC_OK && row.runs > 0 && judged) {
        result = know_exact(exact, options, c, field, stand->log);
    }
    if (result == HC_OK) {
        hc_bench_row_done(options, &row, row.runs > 0 && judged ? output : NULL, exact->ratios,
                          floats);
    }
    free(output);
    return result;
}

static hc_result run_field(void *user, const char *name, const hc_field *field)
{
    const gpu_stand *stand  = user;
    exact_ratios     exact  = { .ratios = NULL };
    hc_result        result = HC_OK;
    for (int i = 0; i < CASES && result == HC_OK; i++) {
        if (hc_bench_chosen(&stand->options->plan, cases[i].name)) {
            result = run_case(stand, &cases[i], name, field, &exact);
        }
    }
    free(exact.ratios);
    return result;
}

const char *hc_bench_gpu_method(int index)
{
    for (int i = 0; i < CASES; i++) {
        const bool again = i > 0 && strcmp(cases[i].name, cases[i - 1].name) == 0;
        if (!again && index-- == 0) {
            return cases[i].name;
        }
    }
    return NULL;
}

hc_result hc_bench_gpu(const hc_bench_options *options, hc_log *log)
{
    gpu_stand stand = { options, log };
    return hc_bench_each_field(&options->plan, run_field, &stand, log);
}
