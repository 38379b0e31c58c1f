/* How fast rays are cast, ours and others' on the same rays, run by run in turn. */
#ifndef HC_BENCH_TRACE_BENCH_H
#define HC_BENCH_TRACE_BENCH_H

#include "plan.h"

#include <heightcast/trace.h>

typedef struct hc_bench_trace_row {
    const char *field;
    int         side;
    const char *rays;   /* the set                                                            */
    const char *caster; /* "fast", "embree-triangles", ...                                    */
    const char *mode;   /* "single": call by call; "batch", "packets", ...; "": it has one     */
    int         threads;
    size_t      count; /* rays of one run                                            */
    int         runs;
    double      seconds; /* of one run, the fastest; processor time on one thread      */
    double      rays_per_second;
    double      hits;          /* share of rays that hit                                     */
    double      build_seconds; /* processor time                                             */
    double      bytes;         /* held; 0: not known                                         */
} hc_bench_trace_row;

/* plan.threads: beside one thread; 0: 2, 1: one alone. plan.methods: casters, all in this build. */
typedef struct hc_bench_trace_options {
    hc_bench_plan plan;
    size_t        rays; /* in a set; 0: 1920 * 1080 */
    void (*row_done)(void *user, const hc_bench_trace_row *row);
    void *user;
} hc_bench_trace_options;

/* Names of casters in this build, NULL beyond the last. */
const char *hc_bench_caster(int index);

hc_result hc_bench_trace(const hc_bench_trace_options *options, hc_log *log);

#endif
