/* All pairs: the judge of the other methods. Rows of samples against rows of samples; the weights
 * of a pair of rows depend on the column distance alone and are computed once. */
#include "brute.h"

#include "base/fail.h"
#include "base/parallel.h"
#include "canonical.h"
#include "cone_job.h"

#include <stdlib.h>

/* What one search compares: like hc_exact_pass, without its tree. */
typedef struct brute_pass {
    float step_u, step_v;
    int   sign_u, sign_v; /* 0: all directions */
} brute_pass;

typedef struct brute {
    const hc_cone_job *job;
    hc_brute_rows      rows;
    brute_pass         passes[HC_ANISO_COUNT];
    int                pass_count;
    float             *weights; /* a worker: 2 * width - 1                */
    float             *best;    /* a worker: pass_count rows of steepness */
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

static void set_passes(brute *b)
{
    const hc_cone_job *job = b->job;
    b->pass_count          = job->cones == HC_CONES_QUAD    ? 4
                             : job->cones == HC_CONES_ANISO ? HC_ANISO_COUNT
                                                            : 1;
    for (int i = 0; i < b->pass_count; i++) {
        const float stretch = job->cones == HC_CONES_ANISO ? hc_aniso_elongation[i] : 1.0F;
        b->passes[i] =
            (brute_pass){ .step_u = job->step_u * stretch, .step_v = job->step_v / stretch };
        if (job->cones == HC_CONES_QUAD) {
            b->passes[i].sign_u = i % 2 == 0 ? 1 : -1;
            b->passes[i].sign_v = i / 2 == 0 ? 1 : -1;
        }
    }
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
static void fill_weights(float *weights, const hc_cone_job *job, const brute_pass *pass, int dy)
{
    const int j = nearest(dy, job->height, job->wrap_v, pass->sign_v);
    for (int d = 1 - job->width; d < job->width; d++) {
        const int i = nearest(-d, job->width, job->wrap_u, pass->sign_u);
        float     w = 0.0F;
        if (i >= 0 && j >= 0 && (i > 0 || j > 0)) {
            w = job->cones == HC_CONES_L2 ? hc_weight_l2(i, j, pass->step_u, pass->step_v)
                                          : hc_weight_l1(i, j, pass->step_u, pass->step_v);
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
        for (int i = 0; i < b->pass_count; i++) {
            steepness[i] = best[(size_t)i * width + x];
        }
        if (job->cones == HC_CONES_ANISO) {
            hc_aniso_choose(ratios, steepness);
        } else {
            for (int i = 0; i < b->pass_count; i++) {
                ratios[i] = hc_ratio(steepness[i]);
            }
        }
    }
}

static void bake_row(void *context, int y, int worker)
{
    const brute       *b       = context;
    const hc_cone_job *job     = b->job;
    const size_t       width   = (size_t)job->width;
    float             *weights = b->weights + (size_t)worker * 2 * width;
    float             *best    = b->best + (size_t)worker * (size_t)b->pass_count * width;
    const float       *apexes  = job->heights + (size_t)y * width;
    for (size_t i = 0; i < (size_t)b->pass_count * width; i++) {
        best[i] = 0.0F;
    }
    for (int pass = 0; pass < b->pass_count; pass++) {
        for (int other = 0; other < job->height; other++) {
            fill_weights(weights, job, &b->passes[pass], other - y);
            b->rows(best + (size_t)pass * width, apexes, job->heights + (size_t)other * width,
                    weights, job->width);
        }
    }
    write_row(b, y, best);
}

hc_result hc_cone_brute(const hc_cone_job *job)
{
    brute b = { .job = job, .rows = rows_kernel(job->isa) };
    set_passes(&b);
    const size_t rows = (size_t)job->threads * (size_t)job->width * sizeof(float);
    b.weights         = malloc(rows * 2);
    b.best            = malloc(rows * (size_t)b.pass_count);
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
