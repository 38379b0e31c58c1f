/* Where the camera of `render terrain` is: one picture, or many along a tour or a path. */
#ifndef HC_CLI_ROUTE_H
#define HC_CLI_ROUTE_H

#include "cli.h"

#include <heightcast/terrain.h>

typedef struct hc_cli_route {
    hc_camera *keys; /* of a path file, or NULL */
    int        count;
} hc_cli_route;

/* Read --path if there is one. Returns the exit code. hc_cli_route_free must follow, whatever it
 * is. */
int  hc_cli_route_load(hc_cli_route *route, hc_cli *cli);
void hc_cli_route_free(hc_cli_route *route);

/* The camera of frame 0 .. --frames - 1, or of the one picture. */
void hc_cli_route_camera(hc_camera *camera, const hc_cli_route *route, const hc_cli *cli,
                         const hc_terrain *terrain, int frame);

#endif
