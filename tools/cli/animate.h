/* `render relief --animate`: a field that changes, its cones baked anew for each frame. */
#ifndef HC_CLI_ANIMATE_H
#define HC_CLI_ANIMATE_H

#include "relief.h"

#include <heightcast/gpu.h>

typedef struct hc_cli_animation {
    hc_cli_relief *relief;
    hc_trace_needs needs;
    hc_cones       cones;
    float         *heights, *scratch;
    float         *ratios, *cells; /* the CPU's */
    hc_cone_baker *baker;
    hc_gpu        *gpu; /* with --backend gl: what draws */
    hc_gpu_map    *map; /* where it stays there          */
} hc_cli_animation;

/* Memory for a relief that was loaded. Returns the exit code. hc_cli_animation_end must follow,
 * whatever it is. */
int  hc_cli_animation_begin(hc_cli_animation *animation, hc_cli *cli, hc_cli_relief *relief);
void hc_cli_animation_end(hc_cli_animation *animation);

/* Make relief->scene that of the next frame, from 0 on. */
hc_result hc_cli_animation_frame(hc_cli_animation *animation, hc_cli *cli, int frame);

/* The CPU goes on: bake this frame there. */
hc_result hc_cli_animation_to_cpu(hc_cli_animation *animation, hc_cli *cli);

#endif
