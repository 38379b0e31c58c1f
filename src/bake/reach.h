/* Who is affected when heights change: a quick, one-sided test for whole squares of samples.
 *
 * A changed sample q matters to p only if its steepness, with its old or its new height, beats what
 * p's stored ratio says. For a square of samples, the least of height(p) + slope(p) * distance is a
 * concave function of the distance; `hc_reach` keeps it at powers of two. Double precision
 * throughout, with a margin: "no" is certain, "yes" is not. (docs/algorithms.md, "Update of a
 * rectangle".) */
#ifndef HC_BAKE_REACH_H
#define HC_BAKE_REACH_H

#include "change.h"
#include "exact.h"

#define HC_REACH_ENDS 22 /* 0, and 2^0 .. 2^20 columns: a field is no larger */

typedef struct hc_reach {
    double height[HC_REACH_ENDS]; /* a sample this high, at that distance, may matter */
} hc_reach;

/* The reach of the samples of `rect` for each pass of the plan, from their ratios (at most
 * max_ratio, 0: unlimited). Heights are the tree's. */
void hc_reach_of(hc_reach *reaches, const hc_exact_plan *plan, const float *ratios, float max_ratio,
                 hc_rect rect);

/* Whether the change may matter to samples of `rect` with this reach. */
bool hc_reach_includes(const hc_reach *reach, const hc_exact_pass *pass, hc_rect rect,
                       const hc_change *change);

#endif
