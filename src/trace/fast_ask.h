/* Memory that is asked for ahead of its use.
 *
 * All functions here are always inlined: gcc takes one that does nothing but prefetch for one
 * without effect, and leaves its calls out. */
#ifndef HC_TRACE_FAST_ASK_H
#define HC_TRACE_FAST_ASK_H

#include "fast_look.h"

/* Rays are asked for so many times sixteen before they are needed. */
enum { AHEAD = 4 };

/* Ask for sixteen items; those that are needed `once` leave the second-level cache to the tables.
 * There may be fewer: what lies behind them is fetched in vain. */
static ALWAYS_INLINE void ask_for(const void *items, size_t size, int32_t first, bool once)
{
    const uintptr_t start = (uintptr_t)items + (size_t)first * size;
    for (size_t i = 0; i < HC_LANES * size; i += 64) {
        if (once) {
            __builtin_prefetch((const void *)(start + i), 0, 0);
        } else {
            __builtin_prefetch((const void *)(start + i));
        }
    }
}

/* Ask for the corners of cells, of every so many-th lane. */
static ALWAYS_INLINE void ask_for_corners(const hc_fast *fast, const spot *at, int every)
{
    int32_t    index[HC_LANES];
    const hc_i stride = hc_i_set(fast->stride_heights);
    hc_i_store(index, index_of(at->i, at->j, stride, HC_FAST_HEIGHT_BITS));
    for (int i = 0; i < HC_LANES; i += every) {
        __builtin_prefetch(fast->heights + index[i]);
    }
}

/* Ask for the finest blocks that cells belong to. */
static ALWAYS_INLINE void ask_for_blocks(const hc_fast *fast, const runners *ray, const spot *on)
{
    int32_t    index[HC_LANES];
    const hc_i bits   = hc_i_set(HC_FAST_BASE_BITS);
    const hc_i stride = hc_i_set(fast->stride[0]);
    const hc_i x      = hc_i_right(on->i, bits);
    const hc_i y      = hc_i_right(on->j, bits);
    const hc_i at     = index_of(x, y, stride, HC_FAST_BLOCK_BITS);
    hc_i_store(index, hc_i_add(at, hc_i_load(ray->quadrant)));
    for (int i = 0; i < HC_LANES; i++) {
        __builtin_prefetch(fast->blocks + index[i]);
    }
}

static ALWAYS_INLINE void ask_for_ground(const hc_fast *fast, const runners *ray, hc_v s)
{
    const spot at = find_spot(fast, ray, s);
    ask_for_corners(fast, &at, 1);
    ask_for_blocks(fast, ray, &at);
}

/* Where rays are likely to need the ground: where they begin; those that climb from it also so many
 * cells on, and rays that ask for their nearest hit, or climb, at this share of their way. That is
 * a guess, but what is asked for again and again the cache keeps, although rays and hits stream
 * through it. */
static const float ASK_NEAR = 6.0F;
static const float ASK_FAR  = 0.25F;

static ALWAYS_INLINE void ask_for_way(const hc_fast *fast, const runners *ray, unsigned lanes,
                                      bool any)
{
    if (fast->ask == HC_FAST_ASK_NOTHING || lanes == 0) {
        return;
    }
    const unsigned climbing = find_climbing(fast, ray) & lanes;
    const bool     climb    = any && __builtin_popcount(climbing) > HC_LANES / 2;
    if (fast->ask == HC_FAST_ASK_CLIMBING && !climb) {
        return;
    }
    ask_for_ground(fast, ray, hc_v_set(0.0F));
    if (climb) {
        ask_for_ground(fast, ray, hc_v_set(ASK_NEAR));
    }
    if (climb || !any) {
        ask_for_ground(fast, ray, hc_v_mul(hc_v_load(ray->end), hc_v_set(ASK_FAR)));
    }
}

#endif
