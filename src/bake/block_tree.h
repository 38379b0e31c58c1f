/* A max pyramid with sixteen children a node, laid out for searching: the children of a node lie
 * side by side in one cache line.
 *
 * Level 0 nodes are blocks of 4 x 4 samples and hold the samples themselves; a node of level k
 * stands for a square of 4^(k+1) samples and holds the maxima of its 4 x 4 children. Entry i of a
 * node is column i % 4, row i / 4. The root is the only node of the last level. Places outside the
 * field hold HC_TREE_OUTSIDE, lower than any height.
 *
 * Maxima are kept minus `base`, so that comparing them keeps its precision when all heights of a
 * field lie close together. Subtracting it is always exact. */
#ifndef HC_BAKE_BLOCK_TREE_H
#define HC_BAKE_BLOCK_TREE_H

#include <heightcast/bake.h>

#define HC_TREE_LEVELS_MAX 11 /* 4^(10+1) > 2 * HC_SIDE_MAX */
#define HC_TREE_OUTSIDE (-4.0F)

typedef struct hc_tree_level {
    float *entries; /* 16 * columns * rows */
    int    columns, rows;
} hc_tree_level;

typedef struct hc_block_tree {
    hc_tree_level levels[HC_TREE_LEVELS_MAX];
    int           count;
    int           width, height;
    int           row_shift;    /* the place of node (x, y) of any level is x + (y << row_shift) */
    int32_t       children[16]; /* places of a node's children, less 4 * its own                 */
    float base, range; /* heights lie in base .. base + range; 0 and 1 unless all lie close */
    void *store;
} hc_block_tree;

/* Entries of node (x, y). */
static inline float *hc_tree_node(const hc_tree_level *level, int x, int y)
{
    return level->entries + ((size_t)y * (size_t)level->columns + (size_t)x) * 16;
}

/* Column and row of the node at a place. */
static inline int hc_place_x(const hc_block_tree *tree, int32_t place)
{
    return (int)((uint32_t)place & ((1U << tree->row_shift) - 1));
}

static inline int hc_place_y(const hc_block_tree *tree, int32_t place)
{
    return (int)((uint32_t)place >> tree->row_shift);
}

/* Build the tree over `heights`. Free with hc_tree_free. HC_ERROR_MEMORY, for more than about 2^35
 * samples too, whose places take more than 32 bits; else HC_OK. */
hc_result hc_tree_build(hc_block_tree *tree, const float *heights, int width, int height,
                        int threads, hc_log *log);
void      hc_tree_free(hc_block_tree *tree);

/* Take over changed heights of a rectangle. False if they leave base .. base + range: build anew
 * then; the samples of level 0 are up to date in both cases. */
bool hc_tree_update(hc_block_tree *tree, const float *heights, hc_rect changed);

#endif
