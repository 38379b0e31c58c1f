/* The canonical formula of hc_bake_cone_map, in one place: every method that promises "the same
 * bits" goes through these functions. Each operation rounds to nearest; nothing is fused. */
#ifndef HC_BAKE_CANONICAL_H
#define HC_BAKE_CANONICAL_H

#include <math.h>

/* Outweighs the rounding of the formula (below 11 units of 2^-24 before the root), so that a
 * stored ratio is never wider than the real number: docs/algorithms.md, "Rounding". */
#define HC_RATIO_SAFETY (1.0F - 0x1p-20F)

/* Wider cones than this are no limit to anything: at this ratio even a whole field of
 * HC_SIDE_MAX wrapped periods rises by less than 2^-40. */
#define HC_RATIO_UNLIMITED 0x1p60F

/* Addend of one axis to the distance measure: i samples apart, `step` texture units each. */
static inline float hc_reach_l2(int i, float step)
{
    const float x = (float)i * step;
    return x * x;
}

static inline float hc_reach_l1(int i, float step)
{
    return (float)i * step;
}

/* Steepness towards a sample `rise` > 0 higher: squared slope for l2, slope for l1. */
static inline float hc_steepness_l2(float rise, float reach_u, float reach_v)
{
    return rise * rise / (reach_u + reach_v);
}

static inline float hc_steepness_l1(float rise, float reach_u, float reach_v)
{
    return rise / (reach_u + reach_v);
}

static inline float hc_limited_ratio(float ratio)
{
    return ratio > HC_RATIO_UNLIMITED ? INFINITY : ratio * HC_RATIO_SAFETY;
}

/* From the largest steepness to the stored ratio; 0 means that nothing is higher. */
static inline float hc_ratio_l2(float steepness)
{
    return hc_limited_ratio(sqrtf(1.0F / steepness));
}

static inline float hc_ratio_l1(float steepness)
{
    return hc_limited_ratio(1.0F / steepness);
}

#endif
