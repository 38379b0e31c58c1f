#include "landscape.h"

#include "albedo.h"
#include "options.h"
#include "words.h"

#include <stdlib.h>
#include <string.h>

/* ---- tiles ----------------------------------------------------------------------------------- */

static int choose_tiling(hc_tiling *tiling, hc_cli *cli)
{
    const int   count = cli->settings.path_count;
    hc_cli_size size  = cli->settings.terrain.tiles;
    for (int side = 1; size.width == 0 && side * side <= count; side++) {
        if (side * side == count) {
            size = (hc_cli_size){ side, side };
        }
    }
    if (size.width == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "%d files make no square; give --tiles CxR", count);
    }
    if ((int64_t)size.width * size.height != count) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--tiles %dx%d needs %lld files; got %d", size.width,
                           size.height, (long long)size.width * size.height, count);
    }
    *tiling = (hc_tiling){ size.width, size.height, cli->settings.terrain.seams };
    return HC_CLI_DONE;
}

static int join(hc_cli_scene *ground, hc_cli *cli, const hc_tiling *tiling, const hc_field *fields)
{
    int       width = 0, height = 0;
    hc_result result = hc_join_size(&width, &height, tiling, fields, &cli->log);
    if (result == HC_OK) {
        ground->heights = malloc((size_t)width * (size_t)height * sizeof *ground->heights);
        if (ground->heights == NULL) {
            return hc_cli_fail_memory(cli);
        }
        result = hc_join_fields(ground->heights, &ground->field, tiling, fields, &cli->log);
    }
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

static int load_tiles(hc_cli_scene *ground, hc_cli *cli)
{
    const int     count  = cli->settings.path_count;
    hc_cli_scene *tiles  = calloc((size_t)count, sizeof *tiles);
    hc_field     *fields = calloc((size_t)count, sizeof *fields);
    hc_tiling     tiling = { .columns = 0 };
    int           code   = choose_tiling(&tiling, cli);
    if (code == HC_CLI_DONE && (tiles == NULL || fields == NULL)) {
        code = hc_cli_fail_memory(cli);
    }
    for (int i = 0; code == HC_CLI_DONE && i < count; i++) {
        code           = hc_cli_scene_load(&tiles[i], cli, cli->settings.paths[i]);
        fields[i]      = tiles[i].field;
        fields[i].wrap = HC_WRAP_NONE; /* a map may say otherwise */
    }
    if (code == HC_CLI_DONE) {
        code = join(ground, cli, &tiling, fields);
    }
    for (int i = 0; tiles != NULL && i < count; i++) {
        hc_cli_scene_free(&tiles[i]);
    }
    free(fields);
    free(tiles);
    return code;
}

/* ---- the scene ------------------------------------------------------------------------------- */

static int load_ground(hc_cli_landscape *landscape, hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_trace_needs   needs    = hc_trace_method_needs((hc_trace_method)settings->rays.method);
    const bool             one = settings->path_count == 1 && settings->terrain.tiles.width == 0;
    if (!hc_cli_given(settings, "range")) {
        cli->settings.load.normalise.range = HC_RANGE_DATA;
    }
    hc_cli_phase(cli, "load");
    int code = one ? hc_cli_scene_load(&landscape->ground, cli, settings->paths[0])
                   : load_tiles(&landscape->ground, cli);
    if (code == HC_CLI_DONE && settings->render.albedo != NULL) {
        code = hc_cli_load_colours(cli, settings->render.albedo, &landscape->image,
                                   &landscape->scene.image_width, &landscape->scene.image_height);
    }
    if (code == HC_CLI_DONE) {
        code = hc_cli_objects_load(&landscape->objects, cli);
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
    scene->polygons          = settings->terrain.polygons;
    scene->objects           = landscape->objects.objects;
    scene->object_count      = landscape->objects.count;
    scene->blocky            = settings->terrain.blocky;
    scene->no_shadows        = settings->render.shadows != 0;
    scene->shadow_map        = settings->terrain.shadow_map;
    scene->haze              = settings->terrain.haze;
    memcpy(scene->spacing, settings->rays.spacing, sizeof scene->spacing);
    memcpy(scene->offset, settings->terrain.offset, sizeof scene->offset);
    memcpy(scene->sun, settings->render.light, sizeof scene->sun);
}

int hc_cli_landscape_load(hc_cli_landscape *landscape, hc_cli *cli)
{
    *landscape     = (hc_cli_landscape){ .image = NULL };
    const int code = load_ground(landscape, cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    choose_scene(landscape, cli);
    return hc_cli_details_load(&landscape->details, &landscape->scene, cli);
}

void hc_cli_landscape_free(hc_cli_landscape *landscape)
{
    hc_cli_details_free(&landscape->details);
    hc_cli_objects_free(&landscape->objects);
    free(landscape->image);
    hc_cli_scene_free(&landscape->ground);
}
