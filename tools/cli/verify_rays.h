/* Rays of every method against the reference: the figures of `heightcast verify --rays`. */
#ifndef HC_CLI_VERIFY_RAYS_H
#define HC_CLI_VERIFY_RAYS_H

#include "scene.h"

/* Cast settings.rays.count rays at the scene, show what each method loses. Returns the exit code:
 * HC_CLI_VERIFY_FAILED if a method that promises to lose nothing did. */
int hc_cli_verify_rays(hc_cli *cli, hc_cli_scene *scene);

#endif
