/* How fast fields are baked, how much memory that takes, and how good the cones are. */
#ifndef HC_BENCH_BAKE_BENCH_H
#define HC_BENCH_BAKE_BENCH_H

#include "plan.h"

#include <heightcast/gpu.h>

typedef struct hc_bench_row {
    const char *field;
    int         side;   /* of the square field */
    const char *method; /* or "pyramid", "bounds", "gradient", "cells"                     */
    const char *cones;  /* NULL if it makes none                                           */
    int         threads;
    int         runs; /* 0: it would take too long, and there are no seconds               */
    double      processor_seconds;         /* of one run, all threads; the median          */
    double      seconds, fastest, slowest; /* of one run; `seconds` is the median          */
    double      expected;   /* of a run that was stopped, by what was done; INFINITY: nothing was;
                             0: none was stopped                                           */
    double      peak_bytes; /* input + output + work; 0: not known                      */
    double      memory_factor; /* peak / (input + output); 0: not known                    */
    /* Of ratios; NAN: not known, or of no meaning. Both ratios at most 1, since they are infinite
     * where nothing is higher. */
    double mean_kept;   /* mean of ratio / exact ratio         */
    double mean_ratio;  /* mean of the ratio                   */
    double wider;       /* texels * channels wider than exact  */
    double wider_share; /* of all of them                      */
} hc_bench_row;

typedef struct hc_bench_options {
    hc_bench_plan plan;     /* repeat 0: 5; threads 0: 2, of the row that uses several */
    hc_gpu       *gpu;      /* hc_bench_gpu: what bakes */
    double        limit;    /* hc_bench_gpu: a run that would take longer is stopped  [s]  0: 15 */
    hc_progress   progress; /* of each bake; called in the process that measures it */
    void (*row_done)(void *user, const hc_bench_row *row);
    void *user;
} hc_bench_options;

/* Names that plan.methods may hold, NULL beyond the last. Static. Those asked for are measured at
 * every size, else all, the slow ones at small sizes. */
const char *hc_bench_method(int index);

/* Measure everything; each row is handed to row_done, valid during the call only. */
hc_result hc_bench_bake(const hc_bench_options *options, hc_log *log);

/* The same for options->gpu: seconds are hc_gpu_seconds, threads 0, memory and the processor's time
 * not known; the exact ratios that others are compared with are the CPU's. */
const char *hc_bench_gpu_method(int index);
hc_result   hc_bench_gpu(const hc_bench_options *options, hc_log *log);

/* A row with nothing known. */
hc_bench_row hc_bench_row_of(const char *field, int side, const char *method, const char *cones);

/* Hand over a row; of ratios with what of the exact ones they keep. ratios, exact: may be NULL. */
void hc_bench_row_done(const hc_bench_options *options, hc_bench_row *row, const float *ratios,
                       const float *exact, size_t count);

#endif
