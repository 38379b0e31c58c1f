/* Single texels of level 0 as numbers. */
#include "codes.h"

#include <heightcast/maps.h>

#include <assert.h>
#include <math.h>

static size_t element_index(const hc_map_info *info, int x, int y, int channel)
{
    assert(x >= 0 && x < info->width && y >= 0 && y < info->height);
    assert(channel >= 0 && channel < info->channels);
    const size_t texel = (size_t)y * (size_t)info->width + (size_t)x;
    return texel * (size_t)info->channels + (size_t)channel;
}

static int code_at(const hc_map *map, size_t element)
{
    return map->info.bits == 8 ? ((const uint8_t *)map->texels)[element]
                               : ((const uint16_t *)map->texels)[element];
}

float hc_map_height_at(const hc_map *map, int x, int y)
{
    const hc_map_info *info = &map->info;
    if (info->layout == HC_LAYOUT_QUAD || info->layout == HC_LAYOUT_GRADIENT) {
        return NAN;
    }
    const size_t element = element_index(info, x, y, 0);
    return info->bits == 32 ? ((const float *)map->texels)[element]
                            : hc_code_height(code_at(map, element), info->bits);
}

/* Channel of the layout that holds the first ratio, or -1. */
static int first_ratio(hc_layout layout)
{
    switch (layout) {
    case HC_LAYOUT_QUAD: return 0;
    case HC_LAYOUT_DUMMER:
    case HC_LAYOUT_RG:
    case HC_LAYOUT_ANISO: return 1;
    default: return -1;
    }
}

float hc_map_ratio_at(const hc_map *map, int x, int y, int cone)
{
    const hc_map_info *info  = &map->info;
    const int          first = first_ratio(info->layout);
    if (first < 0 || cone < 0 || cone >= hc_cones_channels(info->cones)) {
        return NAN;
    }
    const size_t element = element_index(info, x, y, first + cone);
    if (info->bits == 32) {
        return ((const float *)map->texels)[element];
    }
    /* The paper's shaders square the channel and multiply by nothing, whatever the ratios were
     * cut off at. */
    const float scale = info->layout == HC_LAYOUT_DUMMER ? 1.0F : info->max_ratio;
    return hc_code_ratio(code_at(map, element), info->bits, scale);
}
