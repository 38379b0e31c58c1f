/* Tracers that own their heights: those of a baked map. */
#include "tracer.h"

#include "base/fail.h"

#include <math.h>
#include <stdlib.h>

static hc_result check_map(const hc_map *map, hc_log *log)
{
    if (map == NULL || map->texels == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s is NULL", map == NULL ? "map" : "map.texels");
    }
    const hc_result result = hc_map_info_check(&map->info, log);
    if (result == HC_OK && isnan(hc_map_height_at(map, 0, 0))) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "map.info.layout is %s, which holds no heights; trace a map that does",
                       hc_layout_name(map->info.layout));
    }
    /* Maxima over cells are not the samples of any surface. */
    if (result == HC_OK && map->info.kind == HC_MAP_BOUNDS) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "map.info.kind is bounds, which holds no samples; trace a map that does");
    }
    return result;
}

/* Does the map hold what this method needs? */
static bool has_ratios(const hc_map_info *info, hc_trace_needs needs)
{
    const bool stored = hc_layout_channels(info->layout) > 1;
    switch (needs) {
    case HC_NEEDS_CELL_RATIOS:
        return stored && info->kind == HC_MAP_CONE && info->cones == HC_CONES_L1;
    case HC_NEEDS_RATIOS: return stored && info->kind == HC_MAP_CONE && info->cones == HC_CONES_L2;
    case HC_NEEDS_RELAXED: return stored && info->kind == HC_MAP_RELAXED;
    default: return false;
    }
}

/* Sample ratios as they are; for cells, the least of the corners: docs/algorithms.md, section 6. */
static float decoded_ratio(const hc_map *map, hc_trace_needs needs, int x, int y)
{
    const hc_map_info *info  = &map->info;
    const int          ahead = needs == HC_NEEDS_CELL_RATIOS ? 1 : 0;
    float              least = INFINITY;
    for (int j = 0; j <= ahead; j++) {
        for (int i = 0; i <= ahead; i++) {
            const bool u     = ((unsigned)info->wrap & HC_WRAP_U) != 0;
            const bool v     = ((unsigned)info->wrap & HC_WRAP_V) != 0;
            const int  right = x + i < info->width ? x + i : u ? 0 : x;
            const int  below = y + j < info->height ? y + j : v ? 0 : y;
            least            = fminf(least, hc_map_ratio_at(map, right, below, 0));
        }
    }
    return least;
}

static void decode(float *heights, float *ratios, const hc_map *map, hc_trace_needs needs)
{
    for (int y = 0; y < map->info.height; y++) {
        for (int x = 0; x < map->info.width; x++) {
            *heights++ = hc_map_height_at(map, x, y);
            if (ratios != NULL) {
                *ratios++ = decoded_ratio(map, needs, x, y);
            }
        }
    }
}

hc_result hc_tracer_create_from_map(hc_tracer **tracer, const hc_map *map,
                                    const hc_trace_options *options, hc_log *log)
{
    hc_trace_options own   = options != NULL ? *options : (hc_trace_options){ .steps = 0 };
    const hc_result  valid = check_map(map, log);
    if (valid != HC_OK) {
        return valid;
    }
    const hc_map_info   *info  = &map->info;
    const hc_trace_needs needs = hc_trace_method_needs(own.method);
    const bool           takes = own.ratios == NULL && has_ratios(info, needs);
    const size_t         count = (size_t)info->width * (size_t)info->height;
    float               *owned = malloc(count * (takes ? 2 : 1) * sizeof *owned);
    if (owned == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the heights of a map of %d x %d",
                       info->width, info->height);
    }
    decode(owned, takes ? owned + count : NULL, map, needs);
    if (takes) {
        own.ratios = owned + count;
        own.cones  = info->cones;
    }
    const hc_field  field  = { .heights      = owned,
                               .width        = info->width,
                               .height       = info->height,
                               .wrap         = info->wrap,
                               .registration = info->registration };
    const hc_result result = hc_tracer_create(tracer, &field, &own, log);
    if (result != HC_OK) {
        free(owned);
        return result;
    }
    (*tracer)->owned = owned;
    return HC_OK;
}
