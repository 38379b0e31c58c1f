/* Which two samples a gradient is taken from. */
#ifndef HC_BAKE_SLOPE_H
#define HC_BAKE_SLOPE_H

#include <stdbool.h>

/* Neighbours on one axis: both sides inside and across a wrapped border, one-sided at an open
 * one. */
typedef struct hc_slope_pair {
    int low, high;
    int steps; /* sample distances between them; 0 on an open axis of one sample */
} hc_slope_pair;

static inline hc_slope_pair hc_slope_pair_at(int place, int side, bool wraps)
{
    const int before = place > 0 ? place - 1 : wraps ? side - 1 : 0;
    const int after  = place < side - 1 ? place + 1 : wraps ? 0 : side - 1;
    return (hc_slope_pair){ before, after, wraps ? 2 : after - before };
}

#endif
