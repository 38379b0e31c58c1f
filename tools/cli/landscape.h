/* The scene of `render terrain`: what the command line says and what is chosen for it. */
#ifndef HC_CLI_LANDSCAPE_H
#define HC_CLI_LANDSCAPE_H

#include "details.h"
#include "objects.h"
#include "scene.h"

#include <heightcast/terrain.h>

typedef struct hc_cli_landscape {
    hc_cli_scene       ground; /* the field and its ratios */
    hc_terrain_scene   scene;
    float             *image; /* or NULL */
    hc_cli_objects     objects;
    hc_cli_detail_maps details;
} hc_cli_landscape;

/* Load the file or the tiles, bake and choose. Returns the exit code. hc_cli_landscape_free must
 * follow, whatever it is. */
int  hc_cli_landscape_load(hc_cli_landscape *landscape, hc_cli *cli);
void hc_cli_landscape_free(hc_cli_landscape *landscape);

#endif
