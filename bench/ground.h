/* Fields to cast rays at. */
#ifndef HC_BENCH_GROUND_H
#define HC_BENCH_GROUND_H

#include <heightcast/field.h>

/* A field: a made one, or samples that are repeated, mirrored, to any size. */
typedef struct hc_bench_ground {
    const char     *name;
    const hc_field *tile; /* NULL: made */
} hc_bench_ground;

/* Fill side * side heights. Errors: hc_synth's. */
hc_result hc_bench_fill_ground(float *heights, int side, const hc_bench_ground *ground,
                               uint64_t seed, hc_log *log);

#endif
