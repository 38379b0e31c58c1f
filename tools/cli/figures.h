/* Figures that several commands show: what a field or a map is. */
#ifndef HC_CLI_FIGURES_H
#define HC_CLI_FIGURES_H

#include "cli.h"

bool hc_cli_has_cones(hc_map_kind kind);

void hc_cli_show_size(hc_cli *cli, int width, int height);
/* Original range, unit, spacing, nodata: what of it is known. */
void hc_cli_show_elevation(hc_cli *cli, const hc_elevation *elevation);
void hc_cli_show_map(hc_cli *cli, const hc_map_info *info);

/* A channel of a map as numbers: ratios decoded, floats as they are, other codes as 0 .. 1. */
typedef struct hc_cli_channel {
    char name[16]; /* "height", "ratio", "ratio_2", "gradient_u", ... */
    int  index;    /* in a texel                                      */
    int  cone;     /* of the ratio; -1: no ratio                      */
} hc_cli_channel;

enum { HC_CLI_CHANNELS_MAX = 4 };
/* The channels of a map with this info, in the order of its texels; returns their number. */
int hc_cli_map_channels(hc_cli_channel channels[HC_CLI_CHANNELS_MAX], const hc_map_info *info);
/* `texel` counts through all levels. */
float  hc_cli_map_value(const hc_map *map, const hc_cli_channel *channel, size_t texel);
size_t hc_cli_map_texels(const hc_map_info *info); /* of all levels */

#endif
