/* Intervals of samples along one axis, and which of them a pyramid's blocks cover. */
#ifndef HC_BAKE_SPAN_H
#define HC_BAKE_SPAN_H

#include "maps/levels.h"

typedef struct hc_span {
    int first, last; /* empty if first > last */
} hc_span;

static inline bool hc_span_empty(hc_span s)
{
    return s.first > s.last;
}

static inline hc_span hc_span_common(hc_span a, hc_span b)
{
    return (hc_span){ a.first > b.first ? a.first : b.first, a.last < b.last ? a.last : b.last };
}

/* Samples below texel `block` of a level; the last texel has what halving leaves over. */
static inline hc_span hc_block_samples(int side, int level, int block)
{
    const bool ends = block == hc_level_side(side, level) - 1;
    return (hc_span){ block << level, (ends ? side : (block + 1) << level) - 1 };
}

/* Texels of level - 1 below texel `block` of `level` >= 1. */
static inline hc_span hc_block_children(int side, int level, int block)
{
    const bool ends = block == hc_level_side(side, level) - 1;
    return (hc_span){ 2 * block, ends ? hc_level_side(side, level - 1) - 1 : 2 * block + 1 };
}

/* Texel of a level above sample `place`. */
static inline int hc_block_above(int side, int level, int place)
{
    const int block = place >> level;
    const int end   = hc_level_side(side, level) - 1;
    return block < end ? block : end;
}

#endif
