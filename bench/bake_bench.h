/* How fast fields are baked, how much memory that takes, and how good the cones are. */
#ifndef HC_BENCH_BAKE_BENCH_H
#define HC_BENCH_BAKE_BENCH_H

#include <heightcast/gpu.h>

typedef struct hc_bench_row {
    const char *field;
    int         side;   /* of the square field */
    const char *method; /* or "pyramid", "bounds", "gradient", "cells"                     */
    const char *cones;  /* NULL if it makes none                                           */
    int         threads;
    int         runs;
    double      processor_seconds;         /* of one run, all threads; the median          */
    double      seconds, fastest, slowest; /* of one run; `seconds` is the median          */
    double      peak_bytes;                /* input + output + work; 0: not known          */
    double      memory_factor;             /* peak / (input + output); 0: not known        */
    double      mean_kept; /* mean of ratio / exact ratio, both at most 1; NAN: not known  */
    double      wider;     /* texels * channels wider than exact; NAN: not known           */
} hc_bench_row;

typedef struct hc_bench_options {
    const char *const *fields; /* names of made fields */
    int                field_count;
    const int         *sides;
    int                side_count;
    const char *const *methods; /* rows to measure, at every size; none: all, the slow ones small */
    int                method_count;
    uint64_t           seed;
    int                repeat;  /* 0: 5                                  */
    int                threads; /* of the row that uses several; 0: 2    */
    hc_isa             isa;
    hc_gpu            *gpu;      /* hc_bench_gpu: what bakes */
    hc_progress        progress; /* of each bake; called in the process that measures it */
    bool (*stop)(void);          /* asked while waiting for that; may be NULL */
    void (*row_done)(void *user, const hc_bench_row *row);
    void *user;
} hc_bench_options;

/* Names that options->methods may hold, NULL beyond the last. Static. */
const char *hc_bench_method(int index);

/* The same for options->gpu: seconds are hc_gpu_seconds, threads 0, memory and the processor's time
 * not known. */
const char *hc_bench_gpu_method(int index);
hc_result   hc_bench_gpu(const hc_bench_options *options, hc_log *log);

/* True for rows that were asked for by name, and for all up to side_max if none was. */
bool hc_bench_wanted(const hc_bench_options *options, const char *name, int side, int side_max);

/* Fill in mean_kept and wider. */
void hc_bench_compare(hc_bench_row *row, const float *ratios, const float *exact, size_t count);

/* Measure everything; each row is handed to row_done, valid during the call only. */
hc_result hc_bench_bake(const hc_bench_options *options, hc_log *log);

#endif
