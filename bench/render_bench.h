/* What a frame of relief costs, and how wrong it is, map by map and method by method: the second
 * table of the 2022 paper, with more rows. */
#ifndef HC_BENCH_RENDER_BENCH_H
#define HC_BENCH_RENDER_BENCH_H

#include "plan.h"

#include <heightcast/render.h>

typedef struct hc_bench_render_row {
    const char *field;
    int         side;
    const char *map;    /* "brute", "relaxed", ..., "" where the method needs none  */
    const char *method; /* "quick", ...                                             */
    const char *refine; /* "none", "secant", "binary", "" where there is none       */
    int         steps;  /* at most; 0: the method counts none                       */
    int         runs;
    double      milliseconds; /* of a frame, the fastest */
    double      mean_steps, mean_fetches;
    double      lost, made_up; /* shares of the rays that come to the hull */
    double      unconverged;
} hc_bench_render_row;

/* plan.methods are not looked at: all are measured. */
typedef struct hc_bench_render_options {
    hc_bench_plan plan;
    int           width, height; /* of the frame; 0: 480 x 270 */
    hc_backend    backend;
    void (*row_done)(void *user, const hc_bench_render_row *row);
    void *user;
} hc_bench_render_options;

hc_result hc_bench_render(const hc_bench_render_options *options, hc_log *log);

#endif
