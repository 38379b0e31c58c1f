/* Pruned search of the samples in one quadrant of a texel: for methods that judge a sample by more
 * than its height, but never make it count for more than its canonical l2 steepness. */
#ifndef HC_BAKE_QUADRANT_SEARCH_H
#define HC_BAKE_QUADRANT_SEARCH_H

#include "cone_job.h"
#include "highest.h"
#include "steeper.h"

/* Sample `column` to the right of and `row` below the texel (negative: left, above), nearest image
 * within the limits. Returns the steeper of `best` and what the sample counts for. */
typedef hc_steepest (*hc_judge)(const void *context, int x, int y, int column, int row,
                                hc_steepest best);

typedef struct hc_quadrant_search {
    const hc_cone_job *job;
    hc_highest         highest;  /* maxima of the samples that count, by their height */
    int                limit[4]; /* largest offset rightwards, leftwards, downwards, upwards */
    hc_judge           judge;
    const void        *context;
} hc_quadrant_search;

/* Quadrants as in HC_CONES_QUAD: bit 0 leftwards, bit 1 upwards; the axes belong to both sides.
 * A sample is judged unless it is surely no steeper than `best`; near blocks go first. */
hc_steepest hc_search_quadrant(const hc_quadrant_search *search, int x, int y, int quadrant,
                               hc_steepest best);

#endif
