/* What a frame of relief costs, and how wrong it is, map by map and method by method: the second
 * table of the 2022 paper, with more rows. */
#ifndef HC_BENCH_RENDER_BENCH_H
#define HC_BENCH_RENDER_BENCH_H

#include "ground.h"

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

typedef struct hc_bench_render_options {
    const hc_bench_ground *fields;
    int                    field_count;
    const int             *sides;
    int                    side_count;
    int                    width, height; /* of the frame; 0: 480 x 270 */
    hc_backend             backend;
    uint64_t               seed;
    int                    repeat;  /* 0: 3 */
    int                    threads; /* 0: one per core */
    bool (*stop)(void);
    void (*row_done)(void *user, const hc_bench_render_row *row);
    void *user;
} hc_bench_render_options;

hc_result hc_bench_render(const hc_bench_render_options *options, hc_log *log);

#endif
