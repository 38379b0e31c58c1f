#include "relief.h"

#include "albedo.h"
#include "options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 4 };

/* ---- the field ------------------------------------------------------------------------------- */

/* Heights fill the depth, and the field closes where the body does. */
static void choose_loading(hc_cli *cli)
{
    hc_cli_settings     *settings = &cli->settings;
    const hc_cli_render *render   = &settings->render;
    const bool           round    = render->body != HC_BODY_PLANE;
    const bool           u        = round || render->repeat[0] > 1;
    const bool v = round || render->repeat[1] > 1; /* cylinders and spheres repeat along v, too */
    if (!hc_cli_given(settings, "range")) {
        settings->load.normalise.range = HC_RANGE_DATA;
    }
    if (!hc_cli_given(settings, "wrap")) {
        settings->load.wrap = (hc_wrap)((u ? HC_WRAP_U : 0) | (v ? HC_WRAP_V : 0));
    }
}

static int load_ground(hc_cli_relief *relief, hc_cli *cli, const char *path)
{
    const hc_trace_needs needs = hc_trace_method_needs((hc_trace_method)cli->settings.rays.method);
    int                  code  = hc_cli_scene_load(&relief->ground, cli, path);
    if (code == HC_CLI_DONE && cli->settings.render.motion == HC_CLI_STILL) {
        code = hc_cli_scene_ratios(&relief->ground, cli, needs);
    }
    return code;
}

/* ---- colours --------------------------------------------------------------------------------- */

/* From valleys to peaks, in linear light. */
static void by_height(float rgb[3], float height)
{
    static const float stops[5][3] = { { 0.085F, 0.115F, 0.06F },
                                       { 0.21F, 0.20F, 0.09F },
                                       { 0.34F, 0.24F, 0.13F },
                                       { 0.50F, 0.42F, 0.34F },
                                       { 0.82F, 0.81F, 0.80F } };
    const float        at          = fminf(fmaxf(height, 0.0F), 1.0F) * 4.0F;
    const int          stop        = at < 4.0F ? (int)at : 3;
    for (int i = 0; i < 3; i++) {
        rgb[i] = stops[stop][i] + (at - (float)stop) * (stops[stop + 1][i] - stops[stop][i]);
    }
}

static void paint(float *rgb, const hc_field *field)
{
    const size_t count = (size_t)field->width * (size_t)field->height;
    for (size_t i = 0; i < count; i++) {
        by_height(rgb + 3 * i, field->heights[i]);
    }
}

void hc_cli_relief_repaint(hc_cli_relief *relief)
{
    if (relief->by_height) {
        paint(relief->albedo, &relief->scene.relief.field);
    }
}

static int choose_colours(hc_cli_relief *relief, hc_cli *cli)
{
    hc_material *m    = &relief->scene.material;
    int          code = HC_CLI_DONE;
    for (int i = 0; i < 3; i++) {
        m->colour[i] = (float)cli->settings.render.colour[i];
    }
    if (hc_cli_given(&cli->settings, "colour")) {
        return HC_CLI_DONE;
    }
    if (cli->settings.render.albedo != NULL) {
        code = hc_cli_load_colours(cli, cli->settings.render.albedo, &relief->albedo,
                                   &m->albedo_width, &m->albedo_height);
    } else {
        const hc_field *field = &relief->ground.field;
        relief->albedo =
            malloc((size_t)field->width * (size_t)field->height * 3 * sizeof *relief->albedo);
        relief->by_height = relief->albedo != NULL;
        m->albedo_width   = field->width;
        m->albedo_height  = field->height;
        if (relief->by_height) {
            paint(relief->albedo, field);
        }
    }
    m->albedo = relief->albedo;
    return code == HC_CLI_DONE && m->albedo == NULL ? hc_cli_fail_memory(cli) : code;
}

/* ---- the rest -------------------------------------------------------------------------------- */

/* Samples of a field may be farther apart along one axis: so is the plane. */
static float aspect_of(const hc_cli_settings *settings, const hc_field *field)
{
    const hc_elevation *e = &field->elevation;
    if (settings->render.aspect > 0.0F || !(e->spacing_x > 0.0) || !(e->spacing_y > 0.0)) {
        return settings->render.aspect;
    }
    return (float)(e->spacing_y * field->height / (e->spacing_x * field->width));
}

static void choose_scene(hc_cli_relief *relief, const hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_cli_render   *render   = &settings->render;
    hc_scene              *scene    = &relief->scene;
    const bool             lamp     = hc_cli_given(settings, "lamp");
    scene->relief.field             = relief->ground.field;
    scene->relief.trace =
        hc_cli_scene_options(&relief->ground, cli, (hc_trace_method)settings->rays.method);
    scene->relief.trace.refinements = hc_cli_refinements(settings);
    scene->relief.body              = render->body;
    scene->relief.edge              = render->edge;
    scene->relief.depth             = render->depth;
    scene->relief.aspect            = aspect_of(settings, &relief->ground.field);
    scene->relief.fade[0]           = (float)render->fade[0];
    scene->relief.fade[1]           = (float)render->fade[1];
    scene->relief.lod[0]            = (float)render->lod[0];
    scene->relief.lod[1]            = (float)render->lod[1];
    scene->relief.lod_steps         = render->lod_steps;
    memcpy(scene->relief.repeat, render->repeat, sizeof render->repeat);
    scene->light.lamp       = lamp;
    scene->light.no_shadows = render->shadows != 0;
    memcpy(scene->light.place, lamp ? render->lamp : render->light, sizeof scene->light.place);
    memcpy(scene->camera.eye, render->camera, sizeof scene->camera.eye);
    memcpy(scene->camera.at, settings->rays.at, sizeof scene->camera.at);
    scene->camera.fov          = settings->rays.fov;
    scene->camera.orthographic = render->ortho;
    scene->camera.samples      = render->samples > 0 ? render->samples : SAMPLES;
}

int hc_cli_relief_load(hc_cli_relief *relief, hc_cli *cli, const char *path)
{
    *relief = (hc_cli_relief){ .albedo = NULL };
    if (!hc_cli_given(&cli->settings, "method")) {
        cli->settings.rays.method = HC_TRACE_SAFE;
    }
    choose_loading(cli);
    hc_cli_phase(cli, "load");
    int code = load_ground(relief, cli, path);
    if (code == HC_CLI_DONE) {
        code = choose_colours(relief, cli);
    }
    hc_cli_phase(cli, NULL);
    if (code == HC_CLI_DONE) {
        choose_scene(relief, cli);
    }
    return code;
}

void hc_cli_relief_free(hc_cli_relief *relief)
{
    free(relief->albedo);
    hc_cli_scene_free(&relief->ground);
}
