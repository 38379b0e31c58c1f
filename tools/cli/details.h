/* What --detail and --mask name. */
#ifndef HC_CLI_DETAILS_H
#define HC_CLI_DETAILS_H

#include "cli.h"

#include <heightcast/terrain.h>

typedef struct hc_cli_detail_maps {
    hc_detail details[HC_DETAILS_MAX];
    int       count;
    float    *heights[HC_DETAILS_MAX], *colours[HC_DETAILS_MAX]; /* NULL: none */
    uint8_t  *mask;                                              /* likewise   */
} hc_cli_detail_maps;

/* Load them for `scene`, whose field is there, and put them into it. Returns the exit code.
 * hc_cli_details_free must follow, whatever it is. */
int  hc_cli_details_load(hc_cli_detail_maps *maps, hc_terrain_scene *scene, hc_cli *cli);
void hc_cli_details_free(hc_cli_detail_maps *maps);

#endif
