#include "landscape.h"

#include "albedo.h"
#include "options.h"
#include "words.h"

#include <stdlib.h>
#include <string.h>

static int load_ground(hc_cli_landscape *landscape, hc_cli *cli, const char *path)
{
    const hc_trace_needs needs = hc_trace_method_needs((hc_trace_method)cli->settings.rays.method);
    if (!hc_cli_given(&cli->settings, "range")) {
        cli->settings.load.normalise.range = HC_RANGE_DATA;
    }
    hc_cli_phase(cli, "load");
    int code = hc_cli_scene_load(&landscape->ground, cli, path);
    if (code == HC_CLI_DONE && cli->settings.render.albedo != NULL) {
        code = hc_cli_load_albedo(cli, &landscape->image, &landscape->scene.image_width,
                                  &landscape->scene.image_height);
    }
    if (code == HC_CLI_DONE) {
        code = hc_cli_scene_ratios(&landscape->ground, cli, needs);
    }
    hc_cli_phase(cli, NULL);
    return code;
}

static hc_ground ground_of(const hc_cli_settings *settings)
{
    int ground = 0;
    if (settings->render.albedo != NULL) {
        return HC_GROUND_IMAGE;
    }
    while (strcmp(hc_ground_name((hc_ground)ground), hc_cli_ground_words(settings->terrain.ground))
           != 0) {
        ground++;
    }
    return (hc_ground)ground;
}

static void choose_scene(hc_cli_landscape *landscape, const hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    hc_terrain_scene      *scene    = &landscape->scene;
    scene->field                    = landscape->ground.field;
    scene->field.wrap               = HC_WRAP_NONE; /* a map may say otherwise */
    scene->trace =
        hc_cli_scene_options(&landscape->ground, cli, (hc_trace_method)settings->rays.method);
    scene->trace.refinements = hc_cli_refinements(settings);
    scene->low               = settings->rays.elevation[0];
    scene->high              = settings->rays.elevation[1];
    scene->exaggeration      = (double)settings->terrain.exaggeration;
    scene->ground            = ground_of(settings);
    scene->image             = landscape->image;
    scene->blocky            = settings->terrain.blocky;
    scene->no_shadows        = settings->render.shadows != 0;
    scene->haze              = settings->terrain.haze;
    memcpy(scene->spacing, settings->rays.spacing, sizeof scene->spacing);
    memcpy(scene->offset, settings->terrain.offset, sizeof scene->offset);
    memcpy(scene->sun, settings->render.light, sizeof scene->sun);
}

int hc_cli_landscape_load(hc_cli_landscape *landscape, hc_cli *cli, const char *path)
{
    *landscape     = (hc_cli_landscape){ .image = NULL };
    const int code = load_ground(landscape, cli, path);
    if (code == HC_CLI_DONE) {
        choose_scene(landscape, cli);
    }
    return code;
}

void hc_cli_landscape_free(hc_cli_landscape *landscape)
{
    free(landscape->image);
    hc_cli_scene_free(&landscape->ground);
}
