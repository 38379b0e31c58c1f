/* The exact search as bakers use it: a plan that holds the tree and the tables, and tiles to
 * search. */
#ifndef HC_BAKE_EXACT_H
#define HC_BAKE_EXACT_H

#include "cone_job.h"
#include "exact_search.h"

typedef struct hc_exact_plan {
    hc_block_tree     tree;
    hc_exact_pass     passes[HC_ANISO_COUNT];
    int               count;
    hc_cones          cones;
    float             max_ratio; /* ratios are cut at it; 0: not */
    hc_near_table    *tables;    /* one a pass                  */
    hc_exact_scratch *scratch;   /* one a worker and pass       */
    size_t            scratch_count;
    hc_exact_tile     kernel;
} hc_exact_plan;

/* Passes point into the plan: it must stay where it is. Finish accepts a plan that is all zero. */
hc_result hc_exact_plan_init(hc_exact_plan *plan, const hc_cone_job *job);
void      hc_exact_plan_finish(hc_exact_plan *plan);

/* Drop first guesses: heights have changed. */
void hc_exact_plan_forget(hc_exact_plan *plan);

/* Search the whole field, or one tile of HC_TILE_SIDE^2 samples, and write the ratios. */
hc_result hc_exact_plan_run(const hc_exact_plan *plan, const hc_cone_job *job);
void      hc_exact_search_tile(const hc_exact_plan *plan, float *ratios, int tile_x, int tile_y,
                               int worker);

#endif
