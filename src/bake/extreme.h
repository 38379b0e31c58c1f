/* The larger or the smaller of two values, as one select that compilers turn into vector code. */
#ifndef HC_BAKE_EXTREME_H
#define HC_BAKE_EXTREME_H

#include <heightcast/bake.h>

static inline float hc_extreme_of(float a, float b, hc_extreme extreme)
{
    return extreme == HC_MAXIMUM ? (a > b ? a : b) : (a < b ? a : b);
}

#endif
