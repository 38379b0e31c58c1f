/* Where the levels of a pyramid lie. */
#include "levels.h"

#include <assert.h>

uint64_t hc_levels_texels(int width, int height, int levels)
{
    uint64_t texels = 0;
    for (int level = 0; level < levels; level++) {
        texels += (uint64_t)hc_level_side(width, level) * (uint64_t)hc_level_side(height, level);
    }
    return texels;
}

int hc_pyramid_levels(int width, int height)
{
    if (!hc_side_valid(width) || !hc_side_valid(height)) {
        return 0;
    }
    int levels = 1;
    for (int side = width > height ? width : height; side > 1; side >>= 1) {
        levels++;
    }
    return levels;
}

size_t hc_pyramid_size(int width, int height)
{
    const uint64_t texels = hc_levels_texels(width, height, hc_pyramid_levels(width, height));
    /* Objects beyond PTRDIFF_MAX bytes cannot be indexed, so a 32-bit build has to say no here. */
    return texels <= PTRDIFF_MAX / sizeof(float) ? (size_t)texels : 0;
}

float *hc_pyramid_level(const hc_pyramid *pyramid, int level, int *level_width, int *level_height)
{
    assert(level >= 0 && level < pyramid->levels);
    if (level_width != NULL) {
        *level_width = hc_level_side(pyramid->width, level);
    }
    if (level_height != NULL) {
        *level_height = hc_level_side(pyramid->height, level);
    }
    return pyramid->values + (size_t)hc_levels_texels(pyramid->width, pyramid->height, level);
}
