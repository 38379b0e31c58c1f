/* The samples around each one. Part of exact_kernel.h. */
#ifndef HC_BAKE_EXACT_AROUND_H
#define HC_BAKE_EXACT_AROUND_H

#include "exact_tile.h"

/* Two tiles side by side, sixteen columns, and the blocks around them as far as they are looked
 * at. */
enum {
    PATCH_EDGE   = 8, /* HC_AROUND_REACH, in whole blocks */
    PATCH_ROWS   = HC_TILE_SIDE + 2 * PATCH_EDGE,
    PATCH_WIDTH  = HC_LANES + 2 * PATCH_EDGE,
    AROUND_SIDE  = HC_AROUND_REACH + 1,
    AROUND_FIRST = PATCH_EDGE - HC_AROUND_REACH /* first row that is looked at */
};

typedef struct patch {
    _Alignas(64) float sample[PATCH_ROWS][PATCH_WIDTH];
} patch;

/* For each row of the patch and sixteen samples of it: the higher one of the two that lie `dx` to
 * the left and to the right. In a quadrant the only one. */
typedef struct patch_pairs {
    _Alignas(64) float high[PATCH_ROWS][AROUND_SIDE][HC_LANES];
} patch_pairs;

static void cut_patch(patch *p, const hc_tree_level *blocks, int pair_x, int tile_y)
{
    float outside[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        outside[i] = HC_TREE_OUTSIDE;
    }
    for (int i = 0; i < PATCH_ROWS / 4; i++) {
        for (int j = 0; j < PATCH_WIDTH / 4; j++) {
            const int    x      = (pair_x * HC_LANES - PATCH_EDGE) / 4 + j;
            const int    y      = (tile_y * HC_TILE_SIDE - PATCH_EDGE) / 4 + i;
            const bool   inside = x >= 0 && y >= 0 && x < blocks->columns && y < blocks->rows;
            const float *from   = inside ? hc_tree_node(blocks, x, y) : outside;
            for (int r = 0; r < 4; r++) {
                memcpy(&p->sample[4 * i + r][4 * j], from + 4 * r, 4 * sizeof *from);
            }
        }
    }
}

INLINE void pair_columns(kind k, const hc_exact_pass *pass, patch_pairs *pairs, const patch *p)
{
    for (int row = AROUND_FIRST; row < PATCH_ROWS - AROUND_FIRST; row++) {
        const float *middle = &p->sample[row][PATCH_EDGE];
        for (int dx = 0; dx <= HC_AROUND_REACH; dx++) {
            const hc_v high = k.quadrant ? hc_v_load(middle + pass->sign_u * dx)
                                         : hc_v_max(hc_v_load(middle - dx), hc_v_load(middle + dx));
            hc_v_store(pairs->high[row][dx], high);
        }
    }
}

/* The highest of the samples that lie `dx` columns and `dy` rows from those of a row. */
INLINE hc_v highest_at(kind k, const hc_exact_pass *pass, const patch_pairs *pairs, int row, int dx,
                       int dy)
{
    if (k.quadrant) {
        return hc_v_load(pairs->high[row + pass->sign_v * dy][dx]);
    }
    return hc_v_max(hc_v_load(pairs->high[row - dy][dx]), hc_v_load(pairs->high[row + dy][dx]));
}

INLINE hc_v steepest_of(hc_v S, hc_v high, hc_v height, float weight)
{
    return hc_v_max(hc_v_mul(hc_v_sub(high, height), hc_v_set(weight)), S);
}

/* Offsets that swap columns and rows have the same weight where both are equally far apart: one
 * rise will do for both. */
INLINE hc_v steepest_around(kind k, const hc_exact_pass *pass, const patch_pairs *pairs, int row,
                            hc_v height, bool square)
{
    hc_v S[2] = { hc_v_set(0.0F), hc_v_set(0.0F) };
    for (int far = 1; far <= HC_AROUND_REACH; far++) {
        for (int close = 0; close <= far; close++) {
            const hc_v  one    = highest_at(k, pass, pairs, row, close, far);
            const hc_v  other  = highest_at(k, pass, pairs, row, far, close);
            const float weight = pass->near->around[far][close];
            if (square) {
                S[0] = steepest_of(S[0], hc_v_max(one, other), height, weight);
            } else {
                S[0] = steepest_of(S[0], one, height, weight);
                S[1] = steepest_of(S[1], other, height, pass->near->around[close][far]);
            }
        }
    }
    return hc_v_max(S[0], S[1]);
}

/* Rows of both tiles to the blocks that parts are. */
static void keep_around(hc_around *around, int row, hc_v S)
{
    float lanes[HC_LANES];
    hc_v_store(lanes, S);
    for (int block = 0; block < HC_LANES / 4; block++) {
        const int part = (block & 1) + 2 * (row / 4);
        memcpy(&around->steepness[block / 2][part][4 * (row % 4)], lanes + 4 * block,
               4 * sizeof(float));
    }
}

INLINE void look_around(kind k, const hc_exact_pass *pass, hc_around *around, int pair_x,
                        int tile_y)
{
    const bool  square = pass->step_u == pass->step_v;
    patch       p;
    patch_pairs pairs;
    cut_patch(&p, &pass->tree->levels[0], pair_x, tile_y);
    pair_columns(k, pass, &pairs, &p);
    for (int row = 0; row < HC_TILE_SIDE; row++) {
        const hc_v height = hc_v_load(&p.sample[PATCH_EDGE + row][PATCH_EDGE]);
        const hc_v S = square ? steepest_around(k, pass, &pairs, PATCH_EDGE + row, height, true)
                              : steepest_around(k, pass, &pairs, PATCH_EDGE + row, height, false);
        keep_around(around, row, S);
    }
    around->pair_x = pair_x;
    around->tile_y = tile_y;
    around->known  = true;
}

#endif
