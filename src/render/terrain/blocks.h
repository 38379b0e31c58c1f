/* The ground as triangles: blocks of 32 x 32 cells, each drawn at every 1st, 2nd, 4th ... sample.
 * They are what rays are measured against.
 *
 * After: de Boer. Fast Terrain Rendering Using Geometrical MipMapping. 2000 */
#ifndef HC_RENDER_BLOCKS_H
#define HC_RENDER_BLOCKS_H

#include <heightcast/terrain.h>

#include "../eye.h"

enum { HC_BLOCK_SIDE = 32, HC_BLOCK_LEVELS = 6 };

typedef struct hc_block {
    float low, high;               /* of its samples                                            */
    float errors[HC_BLOCK_LEVELS]; /* largest distance along z of a sample from what is drawn;
                                      grows with the level                                      */
} hc_block;

/* Zero: none. */
typedef struct hc_blocks {
    int       columns, rows;
    hc_block *blocks; /* columns * rows, row-major          */
    int      *levels; /* of each, for the picture; or -1: not seen */
} hc_blocks;

/* hc_blocks_free must follow, whatever the result. */
hc_result hc_blocks_make(hc_blocks *blocks, const hc_terrain *terrain, hc_log *log);
void      hc_blocks_free(hc_blocks *blocks);

/* Where a block begins, in samples, and how far its rim hangs down, in heights, so that there are
 * no gaps beside coarser ones. */
typedef struct hc_block_place {
    float column, row, hem;
} hc_block_place;

/* Blocks that `eye` sees, the finest first: places [out] room for all, counts [out] of each level.
 * lod: each as coarse as it can be drawn without moving a sample by more than a pixel; else all of
 * them are, as fine as the field. */
void hc_blocks_choose(hc_block_place *places, int counts[HC_BLOCK_LEVELS], const hc_blocks *blocks,
                      const hc_terrain *terrain, const hc_eye *eye, bool lod);

#endif
