/* Texels in 8, 16 and 32 bits. */
#include "texels.h"

#include "maps/codes.h"
#include "quantise.h"
#include "slope.h"

static void put_code(const hc_map *map, size_t element, int code)
{
    if (map->info.bits == 8) {
        ((uint8_t *)map->texels)[element] = (uint8_t)code;
    } else {
        ((uint16_t *)map->texels)[element] = (uint16_t)code;
    }
}

static void put_height(const hc_map *map, size_t element, float height)
{
    if (map->info.bits == 32) {
        ((float *)map->texels)[element] = height;
    } else {
        put_code(map, element, hc_height_code(height, map->info.bits));
    }
}

static void put_ratio(const hc_map *map, size_t element, float ratio)
{
    if (map->info.bits == 32) {
        ((float *)map->texels)[element] = ratio;
    } else {
        /* the limit has been applied; shaders of layout dummer square the channel and no more */
        const float scale = map->info.layout == HC_LAYOUT_DUMMER ? 1.0F : map->info.max_ratio;
        put_code(map, element, hc_ratio_code(ratio, map->info.bits, scale));
    }
}

static size_t row_start(const hc_map_info *info, int y)
{
    return (size_t)y * (size_t)info->width;
}

void hc_put_cone_row(const hc_map *map, int y, const float *heights, const float *ratios)
{
    const hc_map_info *info     = &map->info;
    const size_t       cones    = (size_t)hc_cones_channels(info->cones);
    const size_t       channels = (size_t)info->channels;
    const size_t       first    = info->layout == HC_LAYOUT_QUAD ? 0 : 1;
    const size_t       start    = row_start(info, y);
    for (size_t texel = start; texel < start + (size_t)info->width; texel++) {
        if (first > 0) {
            put_height(map, texel * channels, heights[texel]);
        }
        for (size_t cone = 0; cone < cones && info->layout != HC_LAYOUT_HEIGHT; cone++) {
            put_ratio(map, texel * channels + first + cone, ratios[texel * cones + cone]);
        }
    }
}

static int dummer_height(const hc_map *map, int x, int y)
{
    return ((const uint8_t *)map->texels)[4 * (row_start(&map->info, y) + (size_t)x)];
}

static double per_step(double difference, int steps)
{
    return steps > 0 ? difference / steps : 0.0;
}

void hc_put_dummer_slopes(const hc_map *map, int y)
{
    const hc_map_info  *info   = &map->info;
    const bool          wrap_u = ((unsigned)info->wrap & HC_WRAP_U) != 0;
    const bool          wrap_v = ((unsigned)info->wrap & HC_WRAP_V) != 0;
    const hc_slope_pair v      = hc_slope_pair_at(y, info->height, wrap_v);
    for (int x = 0; x < info->width; x++) {
        const hc_slope_pair u      = hc_slope_pair_at(x, info->width, wrap_u);
        const size_t        texel  = 4 * (row_start(info, y) + (size_t)x);
        const int           rise_u = dummer_height(map, u.high, y) - dummer_height(map, u.low, y);
        const int           rise_v = dummer_height(map, x, v.high) - dummer_height(map, x, v.low);
        put_code(map, texel + 2, hc_slope_code(per_step(rise_u, u.steps), 8));
        put_code(map, texel + 3, hc_slope_code(-per_step(rise_v, v.steps), 8));
    }
}

void hc_put_slope_row(const hc_map *map, int y, const hc_field *field)
{
    const hc_map_info  *info   = &map->info;
    const bool          wrap_u = ((unsigned)info->wrap & HC_WRAP_U) != 0;
    const bool          wrap_v = ((unsigned)info->wrap & HC_WRAP_V) != 0;
    const double        codes  = hc_code_max(info->bits);
    const hc_slope_pair v      = hc_slope_pair_at(y, info->height, wrap_v);
    const float        *row    = field->heights + row_start(info, y);
    const float        *low    = field->heights + row_start(info, v.low);
    const float        *high   = field->heights + row_start(info, v.high);
    for (int x = 0; x < info->width; x++) {
        const hc_slope_pair u      = hc_slope_pair_at(x, info->width, wrap_u);
        const size_t        texel  = 2 * (row_start(info, y) + (size_t)x);
        const double        rise_u = (double)row[u.high] - (double)row[u.low];
        const double        rise_v = (double)high[x] - (double)low[x];
        put_code(map, texel, hc_slope_code(per_step(rise_u, u.steps) * codes, info->bits));
        put_code(map, texel + 1, hc_slope_code(per_step(rise_v, v.steps) * codes, info->bits));
    }
}

void hc_put_extremes(const hc_map *map, int level, int channel, const float *values,
                     hc_extreme extreme)
{
    const int    bits = map->info.bits;
    int          width, height;
    const hc_map part     = { map->info, hc_map_level(map, level, &width, &height) };
    const size_t channels = (size_t)map->info.channels;
    const size_t count    = (size_t)width * (size_t)height;
    for (size_t texel = 0; texel < count; texel++) {
        const size_t element = texel * channels + (size_t)channel;
        if (bits == 32) {
            ((float *)part.texels)[element] = values[texel];
        } else {
            put_code(&part, element,
                     extreme == HC_MAXIMUM ? hc_height_code_up(values[texel], bits)
                                           : hc_height_code_down(values[texel], bits));
        }
    }
}
