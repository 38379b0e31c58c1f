/* How many steps rays take, and how that grows with the field. Counts: the same on every run. */
#ifndef HC_BENCH_STEPS_BENCH_H
#define HC_BENCH_STEPS_BENCH_H

#include "ground.h"

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

typedef struct hc_bench_steps_options {
    const hc_bench_ground *fields;
    int                    field_count;
    const int             *sides;
    int                    side_count;
    const char *const     *methods; /* all, if there are none */
    int                    method_count;
    uint64_t               seed;
    int                    threads; /* 0: one per core; counts do not depend on it */
    size_t                 rays;    /* in a set; 0: 65536                          */
    hc_isa                 isa;
    bool (*stop)(void);
    void (*row_done)(void *user, const hc_bench_steps_row *row);
    void *user;
} hc_bench_steps_options;

/* Methods that lose no first hit, NULL beyond the last. */
const char *hc_bench_steps_method(int index);

/* Sets of rays one after another, sides within a field, methods within a set. `safe` has round
 * diamonds, one cone a sample. */
hc_result hc_bench_steps(const hc_bench_steps_options *options, hc_log *log);

#endif
