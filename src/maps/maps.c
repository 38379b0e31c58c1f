/* Names, sizes and invariants of maps. */
#include "levels.h"

#include "base/fail.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static const char *name_at(const char *const *names, size_t count, unsigned index)
{
    return index < count ? names[index] : "unknown";
}

#define NAME_AT(names, value) name_at(names, sizeof(names) / sizeof *(names), (unsigned)(value))

const char *hc_cones_name(hc_cones cones)
{
    static const char *const names[] = { "l2", "l1", "quad", "aniso" };
    return NAME_AT(names, cones);
}

int hc_cones_channels(hc_cones cones)
{
    switch (cones) {
    case HC_CONES_L2:
    case HC_CONES_L1: return 1;
    case HC_CONES_QUAD: return 4;
    case HC_CONES_ANISO: return 3;
    }
    return 0;
}

const char *hc_map_kind_name(hc_map_kind kind)
{
    static const char *const names[] = { "cone", "relaxed", "pyramid", "bounds", "gradient" };
    return NAME_AT(names, kind);
}

const char *hc_layout_name(hc_layout layout)
{
    static const char *const names[] = { "auto",  "dummer", "rg",     "quad",
                                         "aniso", "height", "minmax", "gradient" };
    return NAME_AT(names, layout);
}

int hc_layout_channels(hc_layout layout)
{
    switch (layout) {
    case HC_LAYOUT_AUTO: return 0;
    case HC_LAYOUT_HEIGHT: return 1;
    case HC_LAYOUT_RG:
    case HC_LAYOUT_MINMAX:
    case HC_LAYOUT_GRADIENT: return 2;
    case HC_LAYOUT_DUMMER:
    case HC_LAYOUT_QUAD:
    case HC_LAYOUT_ANISO: return 4;
    }
    return 0;
}

static bool bits_valid(int bits)
{
    return bits == 8 || bits == 16 || bits == 32;
}

size_t hc_map_bytes(const hc_map_info *info)
{
    const int all_levels = hc_pyramid_levels(info->width, info->height);
    if (all_levels == 0 || (info->levels != 1 && info->levels != all_levels) || info->channels < 1
        || info->channels > 4 || !bits_valid(info->bits)) {
        return 0;
    }
    const uint64_t bytes = hc_levels_texels(info->width, info->height, info->levels)
                           * (uint64_t)info->channels * (uint64_t)(info->bits / 8);
    return bytes <= PTRDIFF_MAX ? (size_t)bytes : 0;
}

void *hc_map_level(const hc_map *map, int level, int *level_width, int *level_height)
{
    const hc_map_info *info = &map->info;
    assert(level >= 0 && level < info->levels);
    if (level_width != NULL) {
        *level_width = hc_level_side(info->width, level);
    }
    if (level_height != NULL) {
        *level_height = hc_level_side(info->height, level);
    }
    const uint64_t skipped = hc_levels_texels(info->width, info->height, level);
    return (char *)map->texels + (size_t)skipped * (size_t)(info->channels * (info->bits / 8));
}

static bool has_cones(hc_map_kind kind)
{
    return kind == HC_MAP_CONE || kind == HC_MAP_RELAXED;
}

/* True if `layout` can hold what a map of this kind and these cones is about. */
static bool layout_fits(const hc_map_info *info)
{
    const bool blocks = info->kind == HC_MAP_PYRAMID || info->kind == HC_MAP_BOUNDS;
    switch (info->layout) {
    case HC_LAYOUT_AUTO: return false;
    case HC_LAYOUT_DUMMER:
    case HC_LAYOUT_RG: return has_cones(info->kind) && hc_cones_channels(info->cones) == 1;
    case HC_LAYOUT_QUAD: return info->kind == HC_MAP_CONE && info->cones == HC_CONES_QUAD;
    case HC_LAYOUT_ANISO: return info->kind == HC_MAP_CONE && info->cones == HC_CONES_ANISO;
    case HC_LAYOUT_HEIGHT: return has_cones(info->kind) || blocks;
    case HC_LAYOUT_MINMAX: return blocks;
    case HC_LAYOUT_GRADIENT: return info->kind == HC_MAP_GRADIENT;
    }
    return false;
}

static hc_result check_enums(const hc_map_info *info, hc_log *log)
{
    if ((unsigned)info->kind > HC_MAP_GRADIENT) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map kind is %d; known are 0 .. %d", (int)info->kind,
                       (int)HC_MAP_GRADIENT);
    }
    if (hc_cones_channels(info->cones) == 0) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map cones are %d; known are 0 .. %d",
                       (int)info->cones, (int)HC_CONES_ANISO);
    }
    if (hc_layout_channels(info->layout) == 0) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map layout is %d; a baked map has one of 1 .. %d",
                       (int)info->layout, (int)HC_LAYOUT_GRADIENT);
    }
    if ((unsigned)info->wrap > HC_WRAP_UV) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map wrap is %d; known are 0 .. %d", (int)info->wrap,
                       (int)HC_WRAP_UV);
    }
    if ((unsigned)info->registration > HC_GRID) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map registration is %d; known are 0 .. %d",
                       (int)info->registration, (int)HC_GRID);
    }
    return HC_OK;
}

static hc_result check_layout(const hc_map_info *info, hc_log *log)
{
    const char *layout = hc_layout_name(info->layout);
    if (!layout_fits(info)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "layout %s cannot hold a %s map%s%s", layout,
                       hc_map_kind_name(info->kind), has_cones(info->kind) ? " with cones " : "",
                       has_cones(info->kind) ? hc_cones_name(info->cones) : "");
    }
    if (info->kind == HC_MAP_RELAXED && info->cones != HC_CONES_L2) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "relaxed cones are l2, not %s",
                       hc_cones_name(info->cones));
    }
    if (info->channels != hc_layout_channels(info->layout)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map has %d channels; layout %s has %d",
                       info->channels, layout, hc_layout_channels(info->layout));
    }
    if (!bits_valid(info->bits) || (info->layout == HC_LAYOUT_DUMMER && info->bits != 8)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map has %d bits; layout %s has %s", info->bits,
                       layout, info->layout == HC_LAYOUT_DUMMER ? "8" : "8, 16 or 32");
    }
    if (info->compat2006 && (info->layout != HC_LAYOUT_DUMMER || info->kind != HC_MAP_CONE)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "compat2006 needs a cone map in layout dummer");
    }
    return HC_OK;
}

static hc_result check_sizes(const hc_map_info *info, hc_log *log)
{
    if (!hc_side_valid(info->width) || !hc_side_valid(info->height)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map size is %d x %d; sides are 1 .. %d",
                       info->width, info->height, HC_SIDE_MAX);
    }
    const bool levelled   = info->kind == HC_MAP_PYRAMID || info->kind == HC_MAP_BOUNDS;
    const int  all_levels = hc_pyramid_levels(info->width, info->height);
    if (info->levels != 1 && !levelled) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s map has %d levels; it must have 1",
                       hc_map_kind_name(info->kind), info->levels);
    }
    if (info->levels != 1 && info->levels != all_levels) {
        return hc_fail(
            log, HC_ERROR_ARGUMENT, "%s map of %d x %d has %d levels; it must have 1 or %d",
            hc_map_kind_name(info->kind), info->width, info->height, info->levels, all_levels);
    }
    if (hc_map_bytes(info) == 0) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map of %d x %d does not fit this machine's memory",
                       info->width, info->height);
    }
    return HC_OK;
}

static hc_result check_max_ratio(const hc_map_info *info, hc_log *log)
{
    const float limit = info->max_ratio;
    if (!(limit >= 0.0F) || !isfinite(limit)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "max_ratio is %g; it must be finite and >= 0",
                       (double)limit);
    }
    const bool coded_ratios =
        has_cones(info->kind) && info->layout != HC_LAYOUT_HEIGHT && info->bits < 32;
    if (coded_ratios && limit == 0.0F) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "max_ratio is 0 (no limit); ratios in %d bits need a limit", info->bits);
    }
    if (info->layout == HC_LAYOUT_DUMMER && limit > 1.0F) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "max_ratio is %g; layout dummer holds at most 1",
                       (double)limit);
    }
    return HC_OK;
}

static hc_result check_texts(const hc_map_info *info, hc_log *log)
{
    if (memchr(info->method, '\0', sizeof info->method) == NULL
        || memchr(info->elevation.unit, '\0', sizeof info->elevation.unit) == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map method or unit is not terminated");
    }
    return HC_OK;
}

hc_result hc_map_info_check(const hc_map_info *info, hc_log *log)
{
    if (info == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map info is NULL");
    }
    hc_result (*const checks[])(const hc_map_info *, hc_log *) = { check_enums, check_layout,
                                                                   check_sizes, check_max_ratio,
                                                                   check_texts };
    hc_result result                                           = HC_OK;
    for (size_t i = 0; result == HC_OK && i < sizeof checks / sizeof *checks; i++) {
        result = checks[i](info, log);
    }
    return result;
}
