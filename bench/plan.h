/* What measurements on fields of several sizes have in common. */
#ifndef HC_BENCH_PLAN_H
#define HC_BENCH_PLAN_H

#include <heightcast/bake.h>

/* A field: a made one, or samples that are repeated, mirrored, to any size. */
typedef struct hc_bench_ground {
    const char     *name;
    const hc_field *tile; /* NULL: made */
} hc_bench_ground;

/* What all are told; what else one is told, and where its rows go, stands beside. */
typedef struct hc_bench_plan {
    const hc_bench_ground *fields;
    int                    field_count;
    const int             *sides;
    int                    side_count;
    const char *const     *methods; /* none: all, or those that the measurement says */
    int                    method_count;
    uint64_t               seed;
    int                    repeat;  /* 0: HC_BENCH_REPEAT */
    int                    threads; /* 0: one per core    */
    hc_isa                 isa;
    bool (*stop)(void); /* or NULL */
} hc_bench_plan;

enum { HC_BENCH_REPEAT = 3 };

int  hc_bench_repeat(const hc_bench_plan *plan);
bool hc_bench_stopped(const hc_bench_plan *plan);
/* True for methods asked for by name, and for all if none was. */
bool hc_bench_chosen(const hc_bench_plan *plan, const char *method);

/* Measure one field, which is there during the call. */
typedef hc_result hc_bench_body(void *job, const char *name, const hc_field *field);

/* Sides one after another within a field. Ends with the first error, HC_ERROR_MEMORY and hc_synth's
 * among them. */
hc_result hc_bench_each_field(const hc_bench_plan *plan, hc_bench_body *body, void *job,
                              hc_log *log);

/* Bake *ratios, which belong to the caller whatever the result; `cells`: those of cells. */
hc_result hc_bench_bake_ratios(float **ratios, const hc_field *field,
                               const hc_cone_options *options, bool cells, hc_log *log);

#endif
