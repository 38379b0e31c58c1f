/* The scene of `render relief`: what the command line says and what is chosen for it. */
#ifndef HC_CLI_RELIEF_H
#define HC_CLI_RELIEF_H

#include "scene.h"

typedef struct hc_cli_relief {
    hc_cli_scene ground; /* the field and its ratios */
    hc_scene     scene;
    float       *albedo;    /* or NULL */
    bool         by_height; /* what `albedo` is painted by */
} hc_cli_relief;

/* Load, bake and choose. Returns the exit code. hc_cli_relief_free must follow, whatever it is. */
int hc_cli_relief_load(hc_cli_relief *relief, hc_cli *cli, const char *path);
/* Colours by height, of heights that have changed. */
void hc_cli_relief_repaint(hc_cli_relief *relief);
void hc_cli_relief_free(hc_cli_relief *relief);

#endif
