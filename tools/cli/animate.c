#include "animate.h"

#include "motion.h"

#include <stdlib.h>

static size_t count_of(const hc_cli_animation *a, int channels)
{
    const hc_field *field = &a->relief->ground.field;
    return (size_t)field->width * (size_t)field->height * (size_t)channels;
}

/* As the scenes that stand still. */
static hc_cone_options options_of(const hc_cli_animation *a, hc_cli *cli)
{
    hc_cone_options options = cli->settings.map.cone;
    options.method   = a->needs == HC_NEEDS_RELAXED ? HC_METHOD_FALLING_EDGE : HC_METHOD_EXACT;
    options.cones    = a->cones;
    options.threads  = cli->settings.threads;
    options.progress = hc_cli_progress(cli);
    return options;
}

/* ---- on the CPU ------------------------------------------------------------------------------ */

static hc_result bake_by_cpu(hc_cli_animation *a, hc_cli *cli, const hc_field *field,
                             hc_rect changed)
{
    const hc_cone_options options = options_of(a, cli);
    hc_result             result;
    if (options.method != HC_METHOD_EXACT) {
        result = hc_bake_cone_map(a->ratios, field, &options, &cli->log);
    } else if (a->baker == NULL) {
        result = hc_cone_baker_create(&a->baker, a->ratios, field, &options, &cli->log);
    } else {
        result =
            hc_cone_baker_update(a->baker, a->ratios, field->heights, changed, NULL, &cli->log);
    }
    if (result == HC_OK && a->needs == HC_NEEDS_CELL_RATIOS) {
        hc_bake_cell_ratios(a->cells, a->ratios, field->width, field->height, a->cones,
                            field->wrap);
    }
    a->relief->scene.relief.trace.ratios = a->needs == HC_NEEDS_CELL_RATIOS ? a->cells : a->ratios;
    a->relief->scene.relief.trace.cones  = a->cones;
    return result;
}

/* ---- on the GPU ------------------------------------------------------------------------------ */

/* Views that compare draw what the CPU has, too. */
static bool stays_on_gpu(const hc_cli_animation *a, const hc_cli *cli)
{
    const hc_view view = cli->settings.render.view;
    return a->gpu != NULL && a->needs != HC_NEEDS_NOTHING && view != HC_VIEW_MISSED
           && view != HC_VIEW_ERROR;
}

static hc_result bake_by_gpu(hc_cli_animation *a, hc_cli *cli, const hc_field *field,
                             hc_rect changed)
{
    const hc_gpu_map_options options = { .cone  = options_of(a, cli),
                                         .cells = a->needs == HC_NEEDS_CELL_RATIOS };
    hc_result                result  = HC_OK;
    if (a->map == NULL) {
        result = hc_gpu_map_create(&a->map, a->gpu, field, &options, &cli->log);
    } else {
        result = hc_gpu_map_update(a->map, field->heights, changed, NULL, &cli->log);
    }
    a->relief->scene.relief.baked = a->map;
    return result;
}

static void leave_gpu(hc_cli_animation *a)
{
    a->relief->scene.relief.baked = NULL;
    hc_gpu_map_destroy(a->map);
    hc_gpu_destroy(a->gpu);
    a->map = NULL;
    a->gpu = NULL;
}

/* ---- frames ---------------------------------------------------------------------------------- */

int hc_cli_animation_begin(hc_cli_animation *animation, hc_cli *cli, hc_cli_relief *relief)
{
    hc_cli_animation *a = animation;
    *a                  = (hc_cli_animation){ .relief = relief };
    a->needs            = hc_trace_method_needs((hc_trace_method)cli->settings.rays.method);
    a->cones            = hc_cli_scene_cones(&relief->ground, cli, a->needs);
    a->heights          = malloc(count_of(a, 1) * sizeof *a->heights);
    a->scratch          = malloc(count_of(a, 2) * sizeof *a->scratch);
    const size_t bytes  = count_of(a, hc_cones_channels(a->cones)) * sizeof *a->ratios;
    a->ratios           = malloc(bytes);
    a->cells            = malloc(bytes);
    const bool all =
        a->heights != NULL && a->scratch != NULL && a->ratios != NULL && a->cells != NULL;
    return all ? HC_CLI_DONE : hc_cli_fail_memory(cli);
}

void hc_cli_animation_end(hc_cli_animation *animation)
{
    leave_gpu(animation);
    hc_cone_baker_destroy(animation->baker);
    free(animation->heights);
    free(animation->scratch);
    free(animation->ratios);
    free(animation->cells);
}

static hc_result bake(hc_cli_animation *a, hc_cli *cli, hc_rect changed)
{
    const hc_field *field  = &a->relief->scene.relief.field;
    hc_result       result = HC_OK;
    if (a->gpu == NULL && cli->settings.backend == HC_CLI_GL) {
        result = hc_gpu_create(&a->gpu, &cli->log);
    }
    if (result == HC_OK && a->needs != HC_NEEDS_NOTHING) {
        result = stays_on_gpu(a, cli) ? bake_by_gpu(a, cli, field, changed)
                                      : bake_by_cpu(a, cli, field, changed);
    }
    return hc_cli_falls_back(cli, result, "bakes and draws") ? hc_cli_animation_to_cpu(a, cli)
                                                             : result;
}

hc_result hc_cli_animation_to_cpu(hc_cli_animation *animation, hc_cli *cli)
{
    const hc_rect none = { 0 };
    leave_gpu(animation);
    return animation->needs == HC_NEEDS_NOTHING
               ? HC_OK
               : bake_by_cpu(animation, cli, &animation->relief->scene.relief.field, none);
}

hc_result hc_cli_animation_frame(hc_cli_animation *animation, hc_cli *cli, int frame)
{
    hc_cli_relief *relief = animation->relief;
    const hc_rect  changed =
        hc_cli_move(animation->heights, animation->scratch, &relief->ground.field,
                    cli->settings.render.motion, frame, cli->settings.frames);
    relief->scene.relief.field.heights = animation->heights;
    hc_cli_relief_repaint(relief);
    hc_cli_phase(cli, "bake");
    const hc_result result = bake(animation, cli, changed);
    hc_cli_phase(cli, NULL);
    return result;
}
