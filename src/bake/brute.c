/* All pairs: the judge of the other methods. Rows of samples against rows of samples; the weights
 * of a pair of rows depend on the column distance alone and are computed once. */
#include "brute.h"

#include "base/fail.h"
#include "base/parallel.h"
#include "canonical.h"
#include "cone_job.h"

#include <stdlib.h>

typedef struct brute {
    const hc_cone_job *job;
    hc_brute_rows      rows;
    hc_cone_search     searches[HC_CONE_SEARCHES_MAX];
    int                search_count;
    float             *weights; /* a worker: 2 * width - 1                */
    float             *best;    /* a worker: search_count rows of steepness */
} brute;

static hc_brute_rows rows_kernel(hc_isa isa)
{
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
    if (isa == HC_ISA_AVX512) {
        return hc_brute_rows_avx512;
    }
    if (isa == HC_ISA_AVX2) {
        return hc_brute_rows_avx2;
    }
#endif
    (void)isa;
    return hc_brute_rows_scalar;
}

/* Least distance from p to any image of q, `d` = q - p samples away along an axis of `count`
 * samples, on the side that `sign` asks for; -1 if there is none. */
static int nearest(int d, int count, bool wrap, int sign)
{
    if (sign == 0) {
        const int direct = abs(d);
        return wrap && count - direct < direct ? count - direct : direct;
    }
    const int forward = d * sign;
    return forward >= 0 ? forward : wrap ? forward + count : -1;
}

/* Weights of a row `dy` rows below, for all column distances p - q. */
static void fill_weights(float *weights, const hc_cone_job *job, const hc_cone_search *search,
                         int dy)
{
    const int j = nearest(dy, job->height, job->wrap_v, search->sign_v);
    for (int d = 1 - job->width; d < job->width; d++) {
        const int i = nearest(-d, job->width, job->wrap_u, search->sign_u);
        float     w = 0.0F;
        if (i >= 0 && j >= 0 && (i > 0 || j > 0)) {
            w = job->cones == HC_CONES_L2 ? hc_weight_l2(i, j, search->step_u, search->step_v)
                                          : hc_weight_l1(i, j, search->step_u, search->step_v);
        }
        weights[job->width - 1 + d] = w;
    }
}

static void write_row(const brute *b, int y, const float *best)
{
    const hc_cone_job *job   = b->job;
    const size_t       width = (size_t)job->width;
    for (size_t x = 0; x < width; x++) {
        float *ratios = job->ratios + ((size_t)y * width + x) * (size_t)job->channels;
        float  steepness[HC_ANISO_COUNT];
        for (int i = 0; i < b->search_count; i++) {
            steepness[i] = best[(size_t)i * width + x];
        }
        hc_write_ratios(ratios, job->cones, steepness);
    }
}

static void bake_row(void *context, int y, int worker)
{
    const brute       *b       = context;
    const hc_cone_job *job     = b->job;
    const size_t       width   = (size_t)job->width;
    float             *weights = b->weights + (size_t)worker * 2 * width;
    float             *best    = b->best + (size_t)worker * (size_t)b->search_count * width;
    const float       *apexes  = job->heights + (size_t)y * width;
    for (size_t i = 0; i < (size_t)b->search_count * width; i++) {
        best[i] = 0.0F;
    }
    for (int i = 0; i < b->search_count; i++) {
        for (int other = 0; other < job->height; other++) {
            fill_weights(weights, job, &b->searches[i], other - y);
            b->rows(best + (size_t)i * width, apexes, job->heights + (size_t)other * width, weights,
                    job->width);
        }
    }
    write_row(b, y, best);
}

hc_result hc_cone_brute(const hc_cone_job *job)
{
    brute b           = { .job = job, .rows = rows_kernel(job->isa) };
    b.search_count    = hc_cone_searches(b.searches, job);
    const size_t rows = (size_t)job->threads * (size_t)job->width * sizeof(float);
    b.weights         = malloc(rows * 2);
    b.best            = malloc(rows * (size_t)b.search_count);
    hc_result result  = HC_ERROR_MEMORY;
    if (b.weights != NULL && b.best != NULL) {
        result = hc_parallel_for(job->height, job->threads, bake_row, &b, job->progress, job->log);
    } else {
        result = hc_fail(job->log, HC_ERROR_MEMORY, "no memory for rows of %d samples", job->width);
    }
    free(b.weights);
    free(b.best);
    return result;
}
