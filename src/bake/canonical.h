/* The canonical formula of hc_bake_cone_map, in one place: every method that promises "the same
 * bits" goes through these functions. Each operation rounds to nearest; nothing is fused. */
#ifndef HC_BAKE_CANONICAL_H
#define HC_BAKE_CANONICAL_H

#include <math.h>

/* Outweighs the rounding of the formula (below 10 units of 2^-24), so that a
 * stored ratio is never wider than the real number: docs/algorithms.md, "Rounding". */
#define HC_RATIO_SAFETY (1.0F - 0x1p-20F)

/* Wider cones than this are no limit to anything: at this ratio even a whole field of
 * HC_SIDE_MAX wrapped periods rises by less than 2^-40. */
#define HC_RATIO_UNLIMITED 0x1p60F

/* Weight of a rise towards a sample i columns and j rows away (not both 0): one over the distance
 * in texture units. Falls monotonically, rounding included, in i and in j: pruning relies on it. */
static inline float hc_weight_l2(int i, int j, float step_u, float step_v)
{
    const float x = (float)i * step_u;
    const float y = (float)j * step_v;
    return 1.0F / sqrtf(x * x + y * y);
}

static inline float hc_weight_l1(int i, int j, float step_u, float step_v)
{
    const float x = (float)i * step_u;
    const float y = (float)j * step_v;
    return 1.0F / (x + y);
}

/* From the largest steepness (rise * weight) to the stored ratio; 0 means that nothing is
 * higher. */
static inline float hc_ratio(float steepness)
{
    const float ratio = 1.0F / steepness;
    return ratio > HC_RATIO_UNLIMITED ? INFINITY : ratio * HC_RATIO_SAFETY;
}

#endif
