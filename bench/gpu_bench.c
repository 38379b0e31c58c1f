/* The same methods on the GPU. In this process: drivers do not survive a fork. */
#include "bake_bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS_MAX = 64, DEFAULT_REPEAT = 5 };

static const double SECONDS_PER_ROW = 15.0;

typedef struct gpu_case {
    const char *name;
    hc_method   method;
    hc_cones    cones;
    int         side_max; /* unless it was asked for by name */
} gpu_case;

/* Exact comes first: round cones are compared with it. */
static const gpu_case cases[] = {
    { "exact", HC_METHOD_EXACT, HC_CONES_L2, HC_SIDE_MAX },
    { "quick-improved", HC_METHOD_QUICK_IMPROVED, HC_CONES_L2, HC_SIDE_MAX },
    { "quick", HC_METHOD_QUICK, HC_CONES_L2, HC_SIDE_MAX },
    { "quick-centre", HC_METHOD_QUICK_CENTRE, HC_CONES_L2, HC_SIDE_MAX },
    { "quick-naive-centre", HC_METHOD_QUICK_NAIVE_CENTRE, HC_CONES_L2, HC_SIDE_MAX },
    { "brute", HC_METHOD_BRUTE, HC_CONES_L2, 128 },
    { "falling-edge", HC_METHOD_FALLING_EDGE, HC_CONES_L2, 1024 },
    { "gems", HC_METHOD_GEMS, HC_CONES_L2, 64 },
    { "exact", HC_METHOD_EXACT, HC_CONES_L1, HC_SIDE_MAX },
    { "exact", HC_METHOD_EXACT, HC_CONES_QUAD, HC_SIDE_MAX },
    { "exact", HC_METHOD_EXACT, HC_CONES_ANISO, HC_SIDE_MAX },
    { "pyramid", HC_METHOD_EXACT, HC_CONES_L2, HC_SIDE_MAX },
};

enum { CASES = (int)(sizeof cases / sizeof *cases) };

static bool is_pyramid(const gpu_case *c)
{
    return strcmp(c->name, "pyramid") == 0;
}

static size_t output_floats(const gpu_case *c, int side)
{
    return is_pyramid(c) ? hc_pyramid_size(side, side)
                         : (size_t)side * (size_t)side * (size_t)hc_cones_channels(c->cones);
}

static hc_result run_once(const hc_bench_options *options, const gpu_case *c, float *output,
                          const hc_field *field, hc_log *log)
{
    const hc_cone_options cone = { .cones    = c->cones,
                                   .method   = c->method,
                                   .progress = options->progress };
    hc_pyramid            pyramid;
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

/* Runs until there are enough, or they have taken long. */
static hc_result measure(const hc_bench_options *options, const gpu_case *c, hc_bench_row *row,
                         float *output, const hc_field *field, hc_log *log)
{
    const int wanted = options->repeat > 0 ? options->repeat : DEFAULT_REPEAT;
    double    seconds[RUNS_MAX];
    double    sum    = 0.0;
    hc_result result = HC_OK;
    while (row->runs < wanted && row->runs < RUNS_MAX && sum < SECONDS_PER_ROW && result == HC_OK) {
        result             = run_once(options, c, output, field, log);
        seconds[row->runs] = hc_gpu_seconds(options->gpu);
        sum += seconds[row->runs++];
    }
    qsort(seconds, (size_t)row->runs, sizeof *seconds, by_value);
    row->seconds = seconds[row->runs / 2];
    row->fastest = seconds[0];
    row->slowest = seconds[row->runs - 1];
    return result;
}

/* The first exact round ratios stay in *exact. */
static hc_result run_case(const hc_bench_options *options, const gpu_case *c, const char *name,
                          const hc_field *field, float **exact, hc_log *log)
{
    const size_t floats = output_floats(c, field->width);
    const bool   round  = !is_pyramid(c) && c->cones == HC_CONES_L2;
    float       *output = malloc(floats * sizeof *output);
    hc_bench_row row    = { .field     = name,
                            .side      = field->width,
                            .method    = c->name,
                            .cones     = is_pyramid(c) ? NULL : hc_cones_name(c->cones),
                            .mean_kept = NAN,
                            .wider     = NAN };
    if (output == NULL) {
        return HC_ERROR_MEMORY;
    }
    const hc_result result = measure(options, c, &row, output, field, log);
    if (result == HC_OK) {
        if (round && *exact == NULL && c->method == HC_METHOD_EXACT) {
            *exact = output;
        }
        if (round && *exact != NULL) {
            hc_bench_compare(&row, output, *exact, floats);
        }
        options->row_done(options->user, &row);
    }
    if (output != *exact) {
        free(output);
    }
    return result;
}

static hc_result run_field(const hc_bench_options *options, const char *name, int side, hc_log *log)
{
    float    *heights = malloc((size_t)side * (size_t)side * sizeof *heights);
    float    *exact   = NULL;
    hc_result result  = heights != NULL ? HC_OK : HC_ERROR_MEMORY;
    if (result == HC_OK) {
        result = hc_synth(heights, side, side, name, options->seed, log);
    }
    const hc_field field = { .heights = heights, .width = side, .height = side };
    for (int i = 0; i < CASES && result == HC_OK; i++) {
        if (hc_bench_wanted(options, cases[i].name, side, cases[i].side_max)) {
            result = run_case(options, &cases[i], name, &field, &exact, log);
        }
    }
    free(exact);
    free(heights);
    return result;
}

const char *hc_bench_gpu_method(int index)
{
    for (int i = 0; i < CASES; i++) {
        const bool again = i > 0 && strcmp(cases[i].name, "exact") == 0;
        if (!again && index-- == 0) {
            return cases[i].name;
        }
    }
    return NULL;
}

hc_result hc_bench_gpu(const hc_bench_options *options, hc_log *log)
{
    hc_result result = HC_OK;
    for (int i = 0; i < options->field_count; i++) {
        for (int j = 0; j < options->side_count && result == HC_OK; j++) {
            result = run_field(options, options->fields[i], options->sides[j], log);
        }
    }
    return result;
}
