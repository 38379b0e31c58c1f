/* Level arithmetic that pyramids and map files share. Sizes must be 1 .. HC_SIDE_MAX. */
#ifndef HC_MAPS_LEVELS_H
#define HC_MAPS_LEVELS_H

#include <heightcast/maps.h>

static inline bool hc_side_valid(int side)
{
    return side >= 1 && side <= HC_SIDE_MAX;
}

static inline int hc_level_side(int side, int level)
{
    const int halved = side >> level;
    return halved > 1 ? halved : 1;
}

/* Texels of the levels 0 .. levels - 1 together: at most 2^41, whatever size_t can hold. */
uint64_t hc_levels_texels(int width, int height, int levels);

#endif
