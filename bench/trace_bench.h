/* How fast rays are cast, ours and others' on the same rays, one after another. */
#ifndef HC_BENCH_TRACE_BENCH_H
#define HC_BENCH_TRACE_BENCH_H

#include "ground.h"

#include <heightcast/trace.h>

typedef struct hc_bench_trace_row {
    const char *field;
    int         side;
    const char *rays;   /* the set                                                            */
    const char *caster; /* "fast", "embree-triangles", ...                                    */
    const char *mode;   /* "" or "single", "packets", "streams"                               */
    int         threads;
    size_t      count; /* rays of one run                                            */
    int         runs;
    double      seconds; /* of one run, the fastest; processor time on one thread      */
    double      rays_per_second;
    double      hits;          /* share of rays that hit                                     */
    double      build_seconds; /* processor time                                             */
    double      bytes;         /* held; 0: not known                                         */
} hc_bench_trace_row;

typedef struct hc_bench_trace_options {
    const hc_bench_ground *fields;
    int                    field_count;
    const int             *sides;
    int                    side_count;
    const char *const     *casters; /* all that were built, if there are none */
    int                    caster_count;
    uint64_t               seed;
    int                    repeat;  /* 0: 3                            */
    int                    threads; /* beside one; 0: 2; 1: one alone  */
    size_t                 rays;    /* in a set; 0: 1920 * 1080        */
    hc_isa                 isa;
    bool (*stop)(void);
    void (*row_done)(void *user, const hc_bench_trace_row *row);
    void *user;
} hc_bench_trace_options;

/* Names of casters in this build, NULL beyond the last. */
const char *hc_bench_caster(int index);

hc_result hc_bench_trace(const hc_bench_trace_options *options, hc_log *log);

#endif
