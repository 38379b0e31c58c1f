/* heightcast render relief: a field as relief on a body, into a picture or many. */
#include "animate.h"
#include "commands.h"
#include "figures.h"
#include "frames.h"
#include "meaning.h"
#include "options.h"
#include "relief.h"
#include "words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 960, HEIGHT = 640, LEGEND_HEIGHT = 8, LEGEND_LEAST = 160, MARGIN = 10 };

/* ---- choices that make no sense ---- */

static int check_colour(hc_cli *cli)
{
    const double *colour = cli->settings.render.colour;
    for (int i = 0; i < 3; i++) {
        if (!(colour[i] >= 0.0 && colour[i] <= 1.0)) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--colour: %g is not from 0 to 1", colour[i]);
        }
    }
    return HC_CLI_DONE;
}

static int check_lod(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_trace_method  method =
        hc_cli_given(settings, "method") ? (hc_trace_method)settings->rays.method : HC_TRACE_SAFE;
    if (hc_cli_given(settings, "lod-steps") && !hc_cli_given(settings, "lod")) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--lod-steps needs --lod, which says where");
    }
    if (hc_cli_given(settings, "lod") && hc_trace_method_steps(method) == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--lod does nothing with --method %s",
                           hc_trace_method_name(method));
    }
    return HC_CLI_DONE;
}

static int check_animation(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    const bool             moves    = settings->render.motion != HC_CLI_STILL;
    if (moves && settings->frames == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--animate needs --frames, which says how many");
    }
    if (!moves && settings->frames > 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--frames needs --animate: they would be the same");
    }
    return HC_CLI_DONE;
}

static int check_meaning(hc_cli *cli)
{
    static const char *const pairs[][2] = { { "lamp", "light" }, { "albedo", "colour" } };
    const hc_cli_settings   *settings   = &cli->settings;
    if (strcmp(settings->paths[0], "relief") != 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "nothing that is drawn is called '%s'; relief and, right behind render, "
                           "terrain are",
                           settings->paths[0]);
    }
    int code = hc_cli_check_pairs(cli, pairs, sizeof pairs / sizeof *pairs);
    code     = code == HC_CLI_DONE ? hc_cli_check_drawing(cli) : code;
    code     = code == HC_CLI_DONE ? check_colour(cli) : code;
    code     = code == HC_CLI_DONE ? check_lod(cli) : code;
    return code == HC_CLI_DONE ? check_animation(cli) : code;
}

/* ---- the legend of heat maps ---- */

static bool has_legend(const hc_cli *cli, const hc_picture *picture)
{
    const hc_view view = cli->settings.render.view;
    return (view == HC_VIEW_STEPS || view == HC_VIEW_ERROR) && picture->width >= LEGEND_LEAST
           && picture->height >= LEGEND_LEAST / 2;
}

/* In the lower left corner, where the background is. */
static void draw_legend(hc_cli_canvas *c, hc_view view, double top)
{
    const int  third = c->width / 3;
    const int  width = third > LEGEND_LEAST ? third : LEGEND_LEAST - 2 * MARGIN;
    const int  y     = c->height - MARGIN - LEGEND_HEIGHT;
    const int  line  = y - 14;
    char       end[32];
    float      linear[3];
    uint8_t    codes[3];
    hc_picture one = { .width = 1, .height = 1, .rgb = linear };
    for (int x = 0; x < width; x++) {
        hc_heat_colour(linear, (double)x / (width - 1));
        hc_picture_bytes(codes, &one);
        for (int i = 0; i < LEGEND_HEIGHT; i++) {
            memcpy(c->rgb + ((size_t)(y + i) * (size_t)c->width + (size_t)(MARGIN + x)) * 3, codes,
                   3);
        }
    }
    (void)snprintf(end, sizeof end, "%.2g", top);
    hc_cli_draw_text(c, MARGIN, line, "0");
    hc_cli_draw_text(c, MARGIN + (width - hc_cli_text_width("STEPS")) / 2, line,
                     view == HC_VIEW_STEPS ? "steps" : "error");
    hc_cli_draw_text(c, MARGIN + width - hc_cli_text_width(end), line, end);
}

/* ---- the work ---- */

static void draw_over(hc_cli_canvas *c, const hc_cli *cli, const hc_picture *picture)
{
    if (has_legend(cli, picture)) {
        draw_legend(c, cli->settings.render.view, picture->figures.top);
    }
}

/* Of one picture, or of all frames; top: of the last. */
static void show(hc_cli *cli, const hc_picture *picture, const hc_cli_totals *totals)
{
    const hc_cli_settings   *settings = &cli->settings;
    const hc_render_figures *f        = &totals->sum;
    const hc_view            view     = settings->render.view;
    const double             entered  = f->entered > 0 ? (double)f->entered : 1.0;
    hc_cli_text(cli, "input", settings->paths[1]);
    hc_cli_text(cli, "output", settings->out);
    if (settings->render.depth_out != NULL) {
        hc_cli_text(cli, "depth_output", settings->render.depth_out);
    }
    hc_cli_show_size(cli, picture->width, picture->height);
    if (settings->frames > 0) {
        hc_cli_number(cli, "frames", totals->frames, NULL);
    }
    hc_cli_text(cli, "object", hc_body_name(settings->render.body));
    hc_cli_text(cli, "method", hc_cli_tracer_words(settings->rays.method));
    hc_cli_text(cli, "view", hc_view_name(view));
    hc_cli_text(cli, "backend", hc_cli_backend_words((int)settings->backend));
    hc_cli_number(cli, "rays", (double)f->rays, NULL);
    hc_cli_number(cli, "hits", (double)f->hits, NULL);
    hc_cli_number(cli, "unconverged", (double)f->unconverged, NULL);
    hc_cli_number(cli, "mean_steps", f->mean_steps / entered, NULL);
    hc_cli_number(cli, "seconds_drawing", f->seconds, NULL);
    if (settings->backend == HC_CLI_GL) {
        hc_cli_number(cli, "mean_fetches", f->mean_fetches / entered, NULL);
    }
    if (view == HC_VIEW_MISSED || view == HC_VIEW_ERROR) {
        hc_cli_number(cli, "lost", (double)f->lost, NULL);
        hc_cli_number(cli, "made_up", (double)f->made_up, NULL);
        hc_cli_number(cli, "mean_error", f->mean_error / totals->frames, NULL);
    }
    if (picture->figures.top > 0.0) {
        hc_cli_number(cli, "top", picture->figures.top, NULL);
    }
}

/* Where there is no OpenGL the CPU draws, as long as it may. animation: NULL if nothing moves. */
static hc_result cast(hc_cli *cli, const hc_cli_relief *relief, hc_cli_animation *animation,
                      hc_picture *picture)
{
    hc_cli_settings  *settings = &cli->settings;
    hc_render_options options  = { .view     = settings->render.view,
                                   .backend  = hc_cli_drawn_by(settings),
                                   .top      = settings->render.top,
                                   .threads  = settings->threads,
                                   .progress = hc_cli_progress(cli),
                                   .gpu      = animation != NULL ? animation->gpu : NULL };
    hc_result         result   = hc_render(picture, &relief->scene, &options, &cli->log);
    if (hc_cli_falls_back(cli, result, "draws")) {
        options.backend = HC_BACKEND_CPU;
        options.gpu     = NULL;
        result          = animation != NULL ? hc_cli_animation_to_cpu(animation, cli) : HC_OK;
        result = result == HC_OK ? hc_render(picture, &relief->scene, &options, &cli->log) : result;
    }
    return result;
}

static hc_result draw_frame(hc_cli *cli, const hc_cli_relief *relief, hc_cli_animation *animation,
                            hc_picture *picture, int frame)
{
    hc_result result = animation != NULL ? hc_cli_animation_frame(animation, cli, frame) : HC_OK;
    hc_cli_phase(cli, "cast");
    result = result == HC_OK ? cast(cli, relief, animation, picture) : result;
    hc_cli_phase(cli, "save");
    result = result == HC_OK ? hc_cli_save_frame(cli, picture, frame, draw_over) : result;
    hc_cli_phase(cli, NULL);
    return result;
}

static int draw(hc_cli *cli, const hc_cli_relief *relief, hc_cli_animation *animation,
                hc_picture *picture)
{
    hc_cli_totals totals = { .frames = 0 };
    if (!hc_cli_take_picture(picture, cli->settings.render.depth_out != NULL)) {
        return hc_cli_fail_memory(cli);
    }
    for (int i = 0; i == 0 || i < cli->settings.frames; i++) {
        const hc_result result = draw_frame(cli, relief, animation, picture, i);
        if (result != HC_OK) {
            return hc_cli_stop_frames(cli, result, i);
        }
        hc_cli_add_figures(&totals, &picture->figures);
    }
    show(cli, picture, &totals);
    return HC_CLI_DONE;
}

static int draw_moving(hc_cli *cli, hc_cli_relief *relief, hc_picture *picture)
{
    hc_cli_animation animation;
    int              code = hc_cli_animation_begin(&animation, cli, relief);
    if (code == HC_CLI_DONE) {
        code = draw(cli, relief, &animation, picture);
    }
    hc_cli_animation_end(&animation);
    return code;
}

int hc_cli_run_render(hc_cli *cli)
{
    const hc_cli_size size    = cli->settings.size;
    const bool        moves   = cli->settings.render.motion != HC_CLI_STILL;
    hc_picture        picture = { .width  = size.width > 0 ? size.width : WIDTH,
                                  .height = size.width > 0 ? size.height : HEIGHT };
    hc_cli_relief     relief;
    int               code = check_meaning(cli);
    code                   = code == HC_CLI_DONE ? hc_cli_check_frames(cli) : code;
    if (code != HC_CLI_DONE) {
        return code;
    }
    code = hc_cli_relief_load(&relief, cli, cli->settings.paths[1]);
    if (code == HC_CLI_DONE) {
        code = moves ? draw_moving(cli, &relief, &picture) : draw(cli, &relief, NULL, &picture);
    }
    free(picture.depth);
    free(picture.rgb);
    hc_cli_relief_free(&relief);
    return code;
}
