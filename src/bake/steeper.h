/* The steepest sample so far, and asking whether another can be steeper without root or division.
 *
 * The canonical steepness is s = fl(rise * weight), the weight one over the distance (canonical.h).
 * Here an offset comes as its `reach`: the squared distance for l2, the distance for l1, formed
 * like the canonical weight's. s > known (a float) implies rise * weight > known before rounding,
 * and the weight is off by a few 2^-24, so
 *   l2: rise^2 > known^2 * reach * (1 - 2^-21),   l1: rise > known * reach * (1 - 2^-21).
 * `edge` is known^2 (known) times 1 - 2^-18, which outweighs the rounding of the products, so that
 * power >= edge * reach holds for each sample that is steeper.
 *
 * Underflow: no two samples are nearer than 2^-20, so rises below 2^-60 cannot exceed a known of
 * 2^-40; for larger rises every product above is a normal number. Below 2^-40 the edge is 0, and
 * each sample's steepness is computed. */
#ifndef HC_BAKE_STEEPER_H
#define HC_BAKE_STEEPER_H

#include "canonical.h"

#include <stdbool.h>

typedef struct hc_steepest {
    float value; /* 0: nothing is higher */
    float edge;
} hc_steepest;

/* Share of one axis in the reach: i samples, `step` texture units each. */
static inline float hc_reach(bool l2, int i, float step)
{
    const float x = (float)i * step;
    return l2 ? x * x : x;
}

/* hc_weight_l2 and hc_weight_l1 from the sum of both axes' reaches. */
static inline float hc_reach_weight(bool l2, float reach)
{
    return 1.0F / (l2 ? sqrtf(reach) : reach);
}

/* What a rise counts for beside a reach. It keeps the sign: which way a pair of samples slopes is
 * as good as random, and one comparison that mostly fails costs less than a branch on it. */
static inline float hc_power(bool l2, float rise)
{
    return l2 ? rise * fabsf(rise) : rise;
}

static inline hc_steepest hc_steepest_of(bool l2, float value)
{
    const float edge = hc_power(l2, value) * (1.0F - 0x1p-18F);
    return (hc_steepest){ value, value >= 0x1p-40F ? edge : 0.0F };
}

/* False only if no rise up to `rise` >= 0 at no less than `reach` > 0 is steeper than `best`.
 * False for an infinite reach too, however flat `best` is. */
static inline bool hc_may_be_steeper(bool l2, float rise, float reach, hc_steepest best)
{
    return hc_power(l2, rise) >= best.edge * reach;
}

/* The steeper of `best` and a sample; rises <= 0 do not count. */
static inline hc_steepest hc_steeper(bool l2, float rise, float reach, hc_steepest best)
{
    if (hc_may_be_steeper(l2, rise, reach, best) && rise > 0.0F) {
        const float steepness = rise * hc_reach_weight(l2, reach);
        return steepness > best.value ? hc_steepest_of(l2, steepness) : best;
    }
    return best;
}

#endif
