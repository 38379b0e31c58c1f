/* Memory that is asked for ahead of its use.
 *
 * All functions here are always inlined: gcc takes one that does nothing but prefetch for one
 * without effect, and leaves its calls out. */
#ifndef HC_TRACE_FAST_ASK_H
#define HC_TRACE_FAST_ASK_H

#include "fast_march.h"

#define ALWAYS_INLINE inline __attribute__((always_inline))

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

/* Ask for the corner and the finest block that rays are over at s. */
static ALWAYS_INLINE void ask_for_ground(const hc_fast *fast, const runners *ray, hc_v s)
{
    int32_t    corners_at[HC_LANES];
    int32_t    blocks_at[HC_LANES];
    const spot at  = find_spot(fast, ray, s);
    const hc_i bit = hc_i_set(HC_FAST_BASE_BITS);
    hc_i_store(corners_at,
               index_of(at.i, at.j, hc_i_set(fast->stride_heights), HC_FAST_HEIGHT_BITS));
    hc_i_store(blocks_at, index_of(hc_i_right(at.i, bit), hc_i_right(at.j, bit),
                                   hc_i_set(fast->stride[0]), HC_FAST_BLOCK_BITS));
    for (int i = 0; i < HC_LANES; i++) {
        __builtin_prefetch(fast->heights + corners_at[i]);
        __builtin_prefetch(fast->blocks + blocks_at[i]);
    }
}

/* Ask for the corners under a group at s: under every fifth ray, as those beside it need the same
 * lines. */
static ALWAYS_INLINE void ask_for_corners(const hc_fast *fast, const runners *ray, hc_v s)
{
    enum { EVERY = 5 };
    int32_t    corners_at[HC_LANES];
    const spot at = find_spot(fast, ray, s);
    hc_i_store(corners_at,
               index_of(at.i, at.j, hc_i_set(fast->stride_heights), HC_FAST_HEIGHT_BITS));
    for (int i = 0; i < HC_LANES; i += EVERY) {
        __builtin_prefetch(fast->heights + corners_at[i]);
    }
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
    const unsigned climbing = find_climbing(fast, ray) & lanes;
    const bool     climb    = any && __builtin_popcount(climbing) > HC_LANES / 2;
    if (fast->ask == HC_FAST_ASK_NOTHING || (fast->ask == HC_FAST_ASK_CLIMBING && !climb)) {
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
