/* What all parts of the exact search share: the tile that is being searched. Part of
 * exact_kernel.h. */
#ifndef HC_BAKE_EXACT_TILE_H
#define HC_BAKE_EXACT_TILE_H

#include "base/simd.h"
#include "canonical.h"
#include "exact_search.h"

/* Relative margin of all bounds: their own rounding is below 2^-20 of the values compared. */
#define LOWER (1.0F - 0x1p-18F)

/* The lower envelopes are piecewise linear in the distance, with pieces that end at powers of two.
 * Distances are measured in columns (one unit: step_u). */
enum { PIECE_SHIFT = 23, PIECE_FIRST = 126 };

static const float COLUMN[16] = { 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3 };
static const float ROW[16]    = { 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3 };

static const int32_t LANE_INDEX[16]   = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
static const int32_t COLUMN_INDEX[16] = { 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3 };
static const int32_t ROW_INDEX[16]    = { 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3 };

/* Ends of the pieces [columns]. The last one is open: it ends farther away than any field is
 * large. */
static const float PIECE_ENDS[17] = { 0x0p0F,  0x1p0F,  0x1p1F,  0x1p2F,  0x1p3F, 0x1p4F,
                                      0x1p5F,  0x1p6F,  0x1p7F,  0x1p8F,  0x1p9F, 0x1p10F,
                                      0x1p11F, 0x1p12F, 0x1p13F, 0x1p14F, 0x1p40F };

/* A lower bound of height(p) + T(p) * distance for all p of a set of samples: piecewise linear for
 * those with T > 0, and `level`, the lowest of those with T = 0, which is exact: as high is not
 * higher. */
typedef struct envelope {
    hc_v  offsets, slopes;
    float level;
} envelope;

typedef struct tile {
    const hc_exact_pass *pass;
    hc_exact_scratch    *scratch;
    float                aspect; /* step_v / step_u                                            */
    int                  x, y;   /* first sample, as seen from the image being searched        */
    bool     home_image;         /* searching the field itself, not one of its periodic images */
    bool     stale;              /* thresholds rose since `hull` was drawn                     */
    envelope hull;               /* of all parts                                               */
    hc_v     height[HC_TILE_PARTS];
    hc_v     lifted[HC_TILE_PARTS]; /* height - tree->base, to compare with maxima      */
    hc_v     S[HC_TILE_PARTS];
    hc_v     T[HC_TILE_PARTS];
} tile;

/* From a tile's first sample to its middle. */
#define MIDDLE (0.5F * (HC_TILE_SIDE - 1))

/* Samples outside the field count as higher than all: nothing limits them. */
#define ABOVE_ALL 4.0F

/* The kind of search; constant where the kernel is compiled, so that its branches vanish. */
typedef struct kind {
    bool diamond, quadrant;
    bool together; /* all parts look at distant blocks together, from the tile's middle */
} kind;

#ifndef INLINE
#define INLINE static inline __attribute__((always_inline))
#endif

/* Offsets in columns and rows (rows scaled to columns) to what T is compared on: the square of the
 * distance for round cones, the distance for diamonds. */
INLINE hc_v measure(kind k, hc_v across, hc_v down)
{
    return k.diamond ? hc_v_add(across, down)
                     : hc_v_about_muladd(across, across, hc_v_mul(down, down));
}

/* What S has become lets T rise. */
INLINE void raise_threshold(tile *t, int part)
{
    t->T[part] = hc_v_max(hc_v_mul(t->S[part], hc_v_set(LOWER)), t->T[part]);
}

/* Columns and rows of sixteen nodes. */
INLINE hc_v columns_of(const tile *t, const int32_t *places)
{
    const hc_i mask = hc_i_set((int32_t)((1U << t->pass->tree->row_shift) - 1));
    return hc_v_from_i(hc_i_and(hc_i_load(places), mask));
}

INLINE hc_v rows_of(const tile *t, const int32_t *places)
{
    return hc_v_from_i(hc_i_right(hc_i_load(places), hc_i_set(t->pass->tree->row_shift)));
}

INLINE hc_v part_columns(const tile *t, int part)
{
    return hc_v_add(hc_v_load(COLUMN), hc_v_set((float)(t->x + 4 * (part & 1))));
}

INLINE hc_v part_rows(const tile *t, int part)
{
    return hc_v_add(hc_v_load(ROW), hc_v_set((float)(t->y + 4 * (part >> 1))));
}

#endif
