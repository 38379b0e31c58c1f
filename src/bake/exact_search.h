/* What the exact search of one kind of cone needs, and its kernels. docs/algorithms.md explains the
 * search; exact_kernel.h is its code, compiled once for each instruction set. */
#ifndef HC_BAKE_EXACT_SEARCH_H
#define HC_BAKE_EXACT_SEARCH_H

#include "block_tree.h"

/* The search works on tiles of 8 x 8 samples: four parts, each of the sixteen samples of a
 * block. */
#define HC_TILE_SIDE 8
#define HC_TILE_PARTS 4

/* Blocks whose corner lies up to this many samples from a part's corner take their weights from a
 * table; beyond, weights are computed when needed. A multiple of 4. */
#define HC_NEAR_REACH 28
#define HC_NEAR_SIDE (2 * HC_NEAR_REACH + 4)
#define HC_NEAR_GROUPS (HC_NEAR_SIDE + 3)

/* All samples up to this many columns and rows away are looked at before anything else. */
#define HC_AROUND_REACH 7

typedef struct hc_near_table {
    /* Weights of a sample c columns and r rows from a part's first sample, seen from its sixteen
     * samples: the weight for a sample in row l of the part depends on r - l only, so that the
     * sixteen weights of neighbouring r overlap in all but one row. [c + HC_NEAR_REACH] holds rows
     * of four for falling r - l, and hc_near_weights finds the first of the sixteen. 0 for the
     * sample itself and outside the quadrant. */
    _Alignas(64) float sample[HC_NEAR_SIDE][HC_NEAR_GROUPS][4];
    float around[HC_AROUND_REACH + 1][HC_AROUND_REACH + 1]; /* [rows][columns] */
} hc_near_table;

static inline const float *hc_near_weights(const hc_near_table *table, int column, int row)
{
    return table->sample[column + HC_NEAR_REACH][HC_NEAR_REACH + 3 - row];
}

/* One search: a metric, and all directions or one quadrant. */
typedef struct hc_exact_pass {
    const hc_block_tree *tree;
    const hc_near_table *near;
    float                step_u, step_v;
    bool                 diamond;
    int  sign_u, sign_v; /* 0: all directions; +1, -1: that side only (always both) */
    bool wrap_u, wrap_v;
} hc_exact_pass;

#define HC_RECENT 32
/* Nodes of one level that wait; when full, the levels below are searched first. */
#define HC_LIST 240
#define HC_LIST_ROOM (HC_LIST + 32) /* one more node's children, and what packing them writes */

typedef struct hc_node_list {
    _Alignas(64) int32_t place[HC_LIST_ROOM];
    float top[HC_LIST_ROOM]; /* highest sample below the node, minus base */
    int   count;
} hc_node_list;

/* Some nodes of a list, by their numbers. */
typedef struct hc_choice {
    _Alignas(64) int32_t number[HC_LIST_ROOM];
    int count;
} hc_choice;

/* For every node of a list a plane over its entries that they must rise above to matter:
 * start + rise_u * column + rise_v * row. */
typedef struct hc_planes {
    _Alignas(64) float start[HC_LIST_ROOM];
    float rise_u[HC_LIST_ROOM], rise_v[HC_LIST_ROOM];
} hc_planes;

/* Samples near one part, and where their weights begin in the table. */
typedef struct hc_near_samples {
    _Alignas(64) int32_t weights[16 * HC_LIST + 32];
    float heights[16 * HC_LIST + 32];
    int   count;
} hc_near_samples;

_Static_assert((2 * HC_NEAR_REACH / 4 + 1) * (2 * HC_NEAR_REACH / 4 + 1) <= HC_LIST,
               "near blocks must fit a list");

/* The steepest samples around those of two tiles side by side, part by part: both are done at once
 * and most tiles come after their neighbour. */
typedef struct hc_around {
    _Alignas(64) float steepness[2][HC_TILE_PARTS][16];
    int  pair_x, tile_y;
    bool known;
} hc_around;

/* Distant samples that limited cones a moment ago: first guesses for the next tile, which its
 * result does not depend on. */
typedef struct hc_recent {
    _Alignas(64) float x[HC_RECENT];
    float    y[HC_RECENT], height[HC_RECENT];
    unsigned next;
    unsigned useful; /* bit i: number i raised thresholds of the last tile */
} hc_recent;

/* Memory of one worker. */
typedef struct hc_exact_scratch {
    hc_node_list    lists[HC_TREE_LEVELS_MAX]; /* [0]: blocks that are not near */
    hc_node_list    near;
    hc_node_list    sifted; /* lists[0], as far as a part needs it */
    hc_near_samples wanted[HC_TILE_PARTS];
    hc_around       around;
    hc_recent       recent;
} hc_exact_scratch;

/* Search one tile: the largest steepness of each sample into `steepness` (HC_TILE_SIDE rows of
 * HC_TILE_SIDE, unspecified outside the field). */
typedef void (*hc_exact_tile)(float *steepness, const hc_exact_pass *pass, int tile_x, int tile_y,
                              hc_exact_scratch *scratch);

void hc_exact_tile_scalar(float *steepness, const hc_exact_pass *pass, int tile_x, int tile_y,
                          hc_exact_scratch *scratch);
void hc_exact_tile_avx2(float *steepness, const hc_exact_pass *pass, int tile_x, int tile_y,
                        hc_exact_scratch *scratch);
void hc_exact_tile_avx512(float *steepness, const hc_exact_pass *pass, int tile_x, int tile_y,
                          hc_exact_scratch *scratch);

#endif
