/* How many steps rays take, and how that grows with the field. Counts: the same on every run. */
#ifndef HC_BENCH_STEPS_BENCH_H
#define HC_BENCH_STEPS_BENCH_H

#include "plan.h"

#include <heightcast/trace.h>

typedef struct hc_bench_steps_row {
    const char *field;
    int         side;
    const char *rays;   /* the set                      */
    const char *method; /* "fast", "safe", "maxmip"     */
    size_t      count;  /* rays                         */
    double      hits;   /* share of rays that hit       */
    double      mean;   /* steps of a ray               */
    double      most99; /* 99 of 100 rays take no more  */
    double      worst;  /* of all                       */
} hc_bench_steps_row;

/* Counts do not depend on plan.threads. */
typedef struct hc_bench_steps_options {
    hc_bench_plan plan;
    size_t        rays; /* in a set; 0: 65536 */
    void (*row_done)(void *user, const hc_bench_steps_row *row);
    void *user;
} hc_bench_steps_options;

/* Methods that lose no first hit, NULL beyond the last. */
const char *hc_bench_steps_method(int index);

/* Sets of rays one after another, sides within a field, methods within a set. `safe` has round
 * diamonds, one cone a sample. */
hc_result hc_bench_steps(const hc_bench_steps_options *options, hc_log *log);

#endif
