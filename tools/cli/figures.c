#include "figures.h"

#include <stdio.h>
#include <string.h>

void hc_cli_show_size(hc_cli *cli, int width, int height)
{
    (void)cJSON_AddNumberToObject(cli->group, "width", width);
    (void)cJSON_AddNumberToObject(cli->group, "height", height);
    hc_cli_say(cli, "%-16s %d x %d\n", "size", width, height);
}

static void show_pair(hc_cli *cli, const char *name, double x, double y)
{
    char key[32];
    (void)snprintf(key, sizeof key, "%s_x", name);
    (void)cJSON_AddNumberToObject(cli->group, key, x);
    (void)snprintf(key, sizeof key, "%s_y", name);
    (void)cJSON_AddNumberToObject(cli->group, key, y);
    hc_cli_say(cli, "%-16s %.10g, %.10g\n", name, x, y);
}

void hc_cli_show_elevation(hc_cli *cli, const hc_elevation *elevation)
{
    const char *unit = elevation->unit[0] != '\0' ? elevation->unit : NULL;
    if (elevation->low != elevation->high) {
        hc_cli_number(cli, "low", elevation->low, unit);
        hc_cli_number(cli, "high", elevation->high, unit);
    }
    if (unit != NULL) {
        (void)cJSON_AddStringToObject(cli->group, "unit", unit);
    }
    if (elevation->spacing_x != 0.0 || elevation->spacing_y != 0.0) {
        show_pair(cli, "spacing", elevation->spacing_x, elevation->spacing_y);
    }
    if (elevation->placed) {
        show_pair(cli, "origin", elevation->origin_x, elevation->origin_y);
    }
    if (elevation->has_nodata) {
        hc_cli_number(cli, "nodata", elevation->nodata, NULL);
    }
    if (elevation->source_bits != 0) {
        hc_cli_number(cli, "source_bits", elevation->source_bits, NULL);
    }
}

bool hc_cli_has_cones(hc_map_kind kind)
{
    return kind == HC_MAP_CONE || kind == HC_MAP_RELAXED;
}

static void show_cones(hc_cli *cli, const hc_map_info *info)
{
    hc_cli_text(cli, "cones", hc_cones_name(info->cones));
    hc_cli_text(cli, "method", info->method);
    if (info->max_ratio > 0.0F) {
        hc_cli_number(cli, "max_ratio", (double)info->max_ratio, NULL);
    } else {
        (void)cJSON_AddNullToObject(cli->group, "max_ratio");
        hc_cli_say(cli, "%-16s none\n", "max ratio");
    }
    if (info->compat2006) {
        hc_cli_number(cli, "compat", 2006, NULL);
    }
}

void hc_cli_show_map(hc_cli *cli, const hc_map_info *info)
{
    hc_cli_text(cli, "map", hc_map_kind_name(info->kind));
    hc_cli_show_size(cli, info->width, info->height);
    hc_cli_text(cli, "layout", hc_layout_name(info->layout));
    hc_cli_number(cli, "channels", info->channels, NULL);
    hc_cli_number(cli, "bits", info->bits, NULL);
    if (info->levels > 1) {
        hc_cli_number(cli, "levels", info->levels, NULL);
    }
    if (hc_cli_has_cones(info->kind)) {
        show_cones(cli, info);
    }
    hc_cli_text(cli, "wrap", hc_wrap_name(info->wrap));
    hc_cli_text(cli, "registration", hc_registration_name(info->registration));
}

/* Names of the channels that are no ratios, in the layout's order. */
static const char *plain_name(hc_layout layout, int index)
{
    static const char *const dummer[]   = { "height", NULL, "slope_x", "slope_y" };
    static const char *const minmax[]   = { "highest", "lowest" };
    static const char *const gradient[] = { "gradient_u", "gradient_v" };
    switch (layout) {
    case HC_LAYOUT_DUMMER: return dummer[index];
    case HC_LAYOUT_MINMAX: return minmax[index];
    case HC_LAYOUT_GRADIENT: return gradient[index];
    default: return layout != HC_LAYOUT_QUAD && index == 0 ? "height" : NULL;
    }
}

int hc_cli_map_channels(hc_cli_channel channels[HC_CLI_CHANNELS_MAX], const hc_map_info *info)
{
    const int cones = hc_cli_has_cones(info->kind) ? hc_cones_channels(info->cones) : 0;
    int       cone  = 0;
    for (int i = 0; i < info->channels; i++) {
        hc_cli_channel *channel = &channels[i];
        const char     *plain   = plain_name(info->layout, i);
        *channel = (hc_cli_channel){ .index = i, .cone = plain == NULL ? cone++ : -1 };
        if (plain != NULL) {
            (void)snprintf(channel->name, sizeof channel->name, "%s", plain);
        } else if (cones == 1) {
            (void)snprintf(channel->name, sizeof channel->name, "ratio");
        } else {
            (void)snprintf(channel->name, sizeof channel->name, "ratio_%u", (unsigned)cone % 10U);
        }
    }
    return info->channels;
}

float hc_cli_map_value(const hc_map *map, const hc_cli_channel *channel, size_t texel)
{
    const hc_map_info *info    = &map->info;
    const size_t       element = texel * (size_t)info->channels + (size_t)channel->index;
    if (channel->cone >= 0) {
        const size_t width = (size_t)info->width;
        return hc_map_ratio_at(map, (int)(texel % width), (int)(texel / width), channel->cone);
    }
    switch (info->bits) {
    case 8: return (float)((const uint8_t *)map->texels)[element] / 255.0F;
    case 16: return (float)((const uint16_t *)map->texels)[element] / 65535.0F;
    default: return ((const float *)map->texels)[element];
    }
}

size_t hc_cli_map_texels(const hc_map_info *info)
{
    return hc_map_bytes(info) / (size_t)(info->channels * (info->bits / 8));
}
