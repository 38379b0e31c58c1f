/* Table 1 of the 2009 paper: seconds until a landscape can be drawn, and frames of it per second,
 * for fields of growing size and method by method. */
#ifndef HC_BENCH_TERRAIN_BENCH_H
#define HC_BENCH_TERRAIN_BENCH_H

#include "plan.h"

#include <heightcast/terrain.h>

/* Of the frames of one tour. */
typedef struct hc_bench_tour {
    int    frames;            /* drawn in a run; 0: the limit came before the first one  */
    double frames_per_second; /* in the fastest run over the tour                        */
    double mean_crossings;    /* moves from node to node, of rays that come to the box   */
    int    judged;            /* frames beside those of the exact caster                 */
    double lost, made_up;     /* shares of their rays                                    */
} hc_bench_tour;

typedef struct hc_bench_terrain_row {
    const char   *field;
    int           side;
    const char   *method;
    int           runs;
    double        seconds; /* from heights in memory until the first frame can be drawn, or until
                              it was stopped */
    double        bytes;   /* held then, heights and ratios included                   */
    hc_bench_tour fly, walk;
    hc_result     stopped; /* HC_OK, or why there are no frames, or none that are judged:
                              HC_ERROR_CANCELLED, the limit; HC_ERROR_MEMORY; HC_ERROR_LIMIT */
} hc_bench_terrain_row;

/* plan.methods: without them fast, maxmip, pdm, safe, cone-loop, qdm, mesh and lod (gl). */
typedef struct hc_bench_terrain_options {
    hc_bench_plan plan;
    int           width, height; /* of the frame; 0: 480 x 270 */
    hc_backend    backend;
    double        limit; /* [s] after it a method gets ready no longer, and but for the first ones
                            of each tour no frame is drawn; again for those that are judged;
                            0: 60 */
    void (*row_done)(void *user, const hc_bench_terrain_row *row);
    void *user;
} hc_bench_terrain_options;

/* Names for options.methods; NULL beyond the last. */
const char *hc_bench_terrain_method(int index);

/* Safe gets quadrant cones, as hc_trace_method_needs says of the others. Frames have one ray per
 * pixel and no shadows. */
hc_result hc_bench_terrain(const hc_bench_terrain_options *options, hc_log *log);

#endif
