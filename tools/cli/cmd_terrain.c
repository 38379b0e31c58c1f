/* heightcast render terrain: a field as a landscape, into a picture or many. */
#include "commands.h"
#include "figures.h"
#include "frames.h"
#include "landscape.h"
#include "meaning.h"
#include "options.h"
#include "route.h"
#include "words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1280, HEIGHT = 720 };

/* ---- choices that make no sense ---- */

static int check_details(hc_cli *cli)
{
    static const char *const needing[] = { "mask", "detail-method", "detail-steps", "detail-fade" };
    const hc_cli_detail_list *details  = &cli->settings.terrain.details;
    for (size_t i = 0; i < sizeof needing / sizeof *needing; i++) {
        if (details->count == 0 && hc_cli_given(&cli->settings, needing[i])) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--%s needs --detail", needing[i]);
        }
    }
    return details->steps > 0 && details->method != HC_DETAIL_STEPS
               ? hc_cli_fail(cli, HC_CLI_USAGE, "--detail-steps needs --detail-method steps")
               : HC_CLI_DONE;
}

static int check_meaning(hc_cli *cli)
{
    static const char *const pairs[][2] = { { "eye", "tour" },       { "eye", "path" },
                                            { "eye", "frames" },     { "eye", "moment" },
                                            { "tour", "path" },      { "frames", "moment" },
                                            { "colours", "albedo" }, { "shadows", "shadow-map" } };
    int                      code = hc_cli_check_pairs(cli, pairs, sizeof pairs / sizeof *pairs);
    code                          = code == HC_CLI_DONE ? hc_cli_check_drawing(cli) : code;
    return code == HC_CLI_DONE ? check_details(cli) : code;
}

/* ---- figures ---- */

static void show_rays(hc_cli *cli, const hc_render_figures *f, hc_view view)
{
    const double entered = f->entered > 0 ? (double)f->entered : 1.0;
    hc_cli_number(cli, "rays", (double)f->rays, NULL);
    hc_cli_number(cli, "hits", (double)f->hits, NULL);
    hc_cli_number(cli, "unconverged", (double)f->unconverged, NULL);
    hc_cli_number(cli, "mean_steps", f->mean_steps / entered, NULL);
    hc_cli_number(cli, "mean_crossings", f->mean_crossings / entered, NULL);
    hc_cli_number(cli, "share_up_to_16", f->within[0] / entered, NULL);
    hc_cli_number(cli, "share_up_to_35", f->within[1] / entered, NULL);
    hc_cli_number(cli, "share_up_to_85", f->within[2] / entered, NULL);
    if (view == HC_VIEW_MISSED) {
        hc_cli_number(cli, "lost", (double)f->lost, NULL);
        hc_cli_number(cli, "made_up", (double)f->made_up, NULL);
    }
    if (cli->settings.backend == HC_CLI_GL) {
        hc_cli_number(cli, "mean_fetches", f->mean_fetches / entered, NULL);
    }
    hc_cli_number(cli, "seconds_drawing", f->seconds, NULL);
}

static void show(hc_cli *cli, const hc_terrain *terrain, const hc_picture *picture, hc_view view,
                 const hc_cli_totals *t)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_placement     place    = hc_terrain_placement(terrain);
    hc_cli_text(cli, "input", settings->paths[0]);
    hc_cli_text(cli, "output", settings->out);
    if (settings->render.depth_out != NULL) {
        hc_cli_text(cli, "depth_output", settings->render.depth_out);
    }
    if (settings->path_count > 1) {
        hc_cli_number(cli, "tiles", settings->path_count, NULL);
    }
    hc_cli_show_size(cli, picture->width, picture->height);
    if (settings->frames > 0) {
        hc_cli_number(cli, "frames", t->frames, NULL);
    }
    hc_cli_number(cli, "spacing_x", place.spacing_x, NULL);
    hc_cli_number(cli, "spacing_y", -place.spacing_y, NULL);
    hc_cli_number(cli, "low", place.offset[2], NULL);
    hc_cli_number(cli, "high", place.offset[2] + place.scale_z, NULL);
    hc_cli_text(cli, "method", hc_cli_tracer_words(settings->rays.method));
    hc_cli_text(cli, "view", hc_view_name(view));
    hc_cli_text(cli, "backend", hc_cli_backend_words((int)settings->backend));
    show_rays(cli, &t->sum, view);
}

/* ---- the work ---- */

static hc_view view_of(const hc_cli_settings *settings)
{
    int view = 0;
    while (strcmp(hc_view_name((hc_view)view), hc_cli_terrain_view_words(settings->terrain.view))
           != 0) {
        view++;
    }
    return (hc_view)view;
}

static void no_legend(hc_cli_canvas *canvas, const hc_cli *cli, const hc_picture *picture)
{
    (void)canvas;
    (void)cli;
    (void)picture;
}

static int draw_frames(hc_cli *cli, hc_cli_totals *t, hc_picture *picture,
                       const hc_terrain *terrain, const hc_cli_route *route)
{
    const int frames = cli->settings.frames;
    for (int i = 0; i == 0 || i < frames; i++) {
        hc_camera camera;
        hc_cli_route_camera(&camera, route, cli, terrain, i);
        if (i == 0 && camera.eye[2] < hc_terrain_ground(terrain, camera.eye[0], camera.eye[1])) {
            hc_cli_warn(cli, "the eye is under the ground at %g, %g", camera.eye[0], camera.eye[1]);
        }
        hc_cli_phase(cli, "cast");
        hc_result result = hc_terrain_draw(picture, terrain, &camera, &cli->log);
        hc_cli_phase(cli, "save");
        result = result == HC_OK ? hc_cli_save_frame(cli, picture, i, no_legend) : result;
        hc_cli_phase(cli, NULL);
        if (result != HC_OK) {
            return hc_cli_stop_frames(cli, result, i);
        }
        hc_cli_add_figures(t, &picture->figures);
    }
    return HC_CLI_DONE;
}

/* Where there is no OpenGL the CPU draws, as long as it may, and can: it has no polygons. */
static hc_result make(hc_terrain **terrain, hc_cli *cli, const hc_terrain_scene *scene)
{
    hc_cli_settings  *settings = &cli->settings;
    hc_render_options options  = { .view     = view_of(settings),
                                   .backend  = hc_cli_drawn_by(settings),
                                   .threads  = settings->threads,
                                   .progress = hc_cli_progress(cli) };
    hc_cli_phase(cli, "build");
    hc_result result = hc_terrain_create(terrain, scene, &options, &cli->log);
    if (scene->polygons == HC_POLYGONS_NONE && hc_cli_falls_back(cli, result, "draws")) {
        options.backend = HC_BACKEND_CPU;
        result          = hc_terrain_create(terrain, scene, &options, &cli->log);
    }
    hc_cli_phase(cli, NULL);
    return result;
}

static int draw(hc_cli *cli, const hc_cli_landscape *landscape, const hc_cli_route *route)
{
    const hc_cli_size size    = cli->settings.size;
    hc_picture        picture = { .width  = size.width > 0 ? size.width : WIDTH,
                                  .height = size.width > 0 ? size.height : HEIGHT };
    hc_cli_totals     t       = { .frames = 0 };
    hc_terrain       *terrain = NULL;
    const hc_result   result  = make(&terrain, cli, &landscape->scene);
    int               code    = result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
    if (code == HC_CLI_DONE
        && !hc_cli_take_picture(&picture, cli->settings.render.depth_out != NULL)) {
        code = hc_cli_fail_memory(cli);
    }
    if (code == HC_CLI_DONE) {
        code = draw_frames(cli, &t, &picture, terrain, route);
    }
    if (code == HC_CLI_DONE) {
        show(cli, terrain, &picture, view_of(&cli->settings), &t);
    }
    free(picture.depth);
    free(picture.rgb);
    hc_terrain_destroy(terrain);
    return code;
}

/* Many files hold heights and nothing about where they are. */
static void warn_of_spacing(hc_cli *cli, const hc_cli_landscape *landscape)
{
    const hc_elevation *e = &landscape->ground.field.elevation;
    if (!hc_cli_given(&cli->settings, "spacing") && !(e->spacing_x > 0.0 && e->spacing_y > 0.0)) {
        hc_cli_warn(
            cli,
            "%s does not say how far its samples are apart: the longer side is taken to be 32 "
            "times the height; --spacing says more",
            cli->settings.paths[0]);
    }
}

int hc_cli_run_terrain(hc_cli *cli)
{
    hc_cli_landscape landscape;
    hc_cli_route     route;
    int              code = check_meaning(cli);
    code                  = code == HC_CLI_DONE ? hc_cli_check_frames(cli) : code;
    if (code != HC_CLI_DONE) {
        return code;
    }
    code = hc_cli_route_load(&route, cli);
    if (code == HC_CLI_DONE) {
        code = hc_cli_landscape_load(&landscape, cli);
        if (code == HC_CLI_DONE) {
            warn_of_spacing(cli, &landscape);
            code = draw(cli, &landscape, &route);
        }
        hc_cli_landscape_free(&landscape);
    }
    hc_cli_route_free(&route);
    return code;
}
