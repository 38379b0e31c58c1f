/* heightcast trace: rays from a file or a camera, hits into a file or a picture. */
#include "caster.h"
#include "commands.h"
#include "figures.h"
#include "options.h"
#include "output.h"
#include "picture.h"
#include "words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- choices that make no sense together: what is wrong, and the remedy ---- */

static bool is_stream(const char *path)
{
    return path != NULL && strcmp(path, "-") == 0;
}

static int refuse_idle(hc_cli *cli, const char *const *names, const char *need)
{
    for (; *names != NULL; names++) {
        if (hc_cli_given(&cli->settings, *names)) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--%s does nothing without %s; leave it out",
                               *names, need);
        }
    }
    return HC_CLI_DONE;
}

static int check_source(hc_cli *cli)
{
    static const char *const of_camera[] = { "eye", "at", "fov", "size", NULL };
    const hc_cli_rays       *rays        = &cli->settings.rays;
    const bool               camera      = rays->picture != NULL || rays->save != NULL;
    if (rays->in == NULL && !camera) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "needs rays: --rays FILE.npy, or --picture FILE.png for a camera's");
    }
    if (rays->in != NULL && camera) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--rays and --%s exclude each other",
                           rays->picture != NULL ? "picture" : "save-rays");
    }
    if (is_stream(rays->in) && is_stream(cli->settings.paths[0])) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "FIELD and --rays cannot both be standard input; name a file");
    }
    return camera ? HC_CLI_DONE : refuse_idle(cli, of_camera, "--picture");
}

static int check_meaning(hc_cli *cli)
{
    static const char *const of_world[] = { "spacing", "elevation", NULL };
    const hc_cli_settings   *settings   = &cli->settings;
    const hc_cli_size       *size       = &settings->size;
    if (settings->rays.any && settings->rays.picture != NULL) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--any finds no surface to draw; leave out --picture");
    }
    if (settings->rays.secant && settings->rays.refinements > 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--secant and --refinements exclude each other");
    }
    if ((uint64_t)size->width * (uint64_t)size->height > HC_CLI_PIXELS_MAX) {
        return hc_cli_fail(cli, HC_CLI_MEMORY, "--size %dx%d: at most %llu pixels are drawn",
                           size->width, size->height, (unsigned long long)HC_CLI_PIXELS_MAX);
    }
    return settings->rays.space != HC_CLI_TEXTURE
               ? HC_CLI_DONE
               : refuse_idle(cli, of_world, "--space local or world");
}

static int check_rows(hc_cli *cli, const char *option, const char *path)
{
    const hc_container *container = path == NULL ? NULL : hc_container_of(path);
    if (path == NULL || (is_stream(path) && !cli->settings.json)) {
        return HC_CLI_DONE;
    }
    if (is_stream(path)) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--json and --%s - both want standard output; name a file", option);
    }
    if (container == NULL || strcmp(container->name, "NPY") != 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--%s %s: the ending must be .npy", option, path);
    }
    return hc_cli_check_output(cli, path);
}

static int check_outputs(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    int                    code     = check_rows(cli, "out", settings->out);
    if (code == HC_CLI_DONE) {
        code = check_rows(cli, "save-rays", settings->rays.save);
    }
    if (code == HC_CLI_DONE && is_stream(settings->out) && is_stream(settings->rays.save)) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--out and --save-rays cannot both be standard output; name a file");
    }
    if (code == HC_CLI_DONE) {
        code = hc_cli_check_apart(cli, "out", settings->out, "save-rays", settings->rays.save);
    }
    return code == HC_CLI_DONE && settings->rays.picture != NULL
               ? hc_cli_check_picture(cli, "picture", settings->rays.picture)
               : code;
}

/* ---- the work ---- */

static void show(hc_cli *cli, const hc_cli_caster *caster)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_cli_counts   *counts   = &caster->counts;
    const double           rays     = (double)caster->done;
    hc_cli_text(cli, "input", settings->paths[0]);
    hc_cli_show_size(cli, caster->scene->field.width, caster->scene->field.height);
    hc_cli_text(cli, "method", hc_cli_marcher_words(settings->rays.method));
    hc_cli_text(cli, "surface", hc_surface_name(settings->rays.surface));
    hc_cli_text(cli, "space", hc_cli_space_words((int)settings->rays.space));
    if (settings->out != NULL) {
        hc_cli_text(cli, "output", settings->out);
    }
    if (settings->rays.picture != NULL) {
        hc_cli_text(cli, "picture", settings->rays.picture);
    }
    hc_cli_number(cli, "tracer_bytes", caster->tracer_bytes, NULL);
    hc_cli_number(cli, "rays", rays, NULL);
    hc_cli_number(cli, "hits", (double)counts->hits, NULL);
    if (!settings->rays.any) {
        hc_cli_number(cli, "inside", (double)counts->inside, NULL);
        hc_cli_number(cli, "side", (double)counts->side, NULL);
        hc_cli_number(cli, "unconverged", (double)counts->unconverged, NULL);
        hc_cli_number(cli, "mean_steps", rays > 0.0 ? counts->steps / rays : 0.0, NULL);
    }
    hc_cli_number(cli, "rays_per_second",
                  caster->seconds_tracing > 0.0 ? rays / caster->seconds_tracing : 0.0, NULL);
    hc_cli_details(cli, true);
    hc_cli_number(cli, "seconds_reading", caster->seconds_reading, NULL);
    hc_cli_number(cli, "seconds_tracing", caster->seconds_tracing, NULL);
    hc_cli_number(cli, "seconds_writing", caster->seconds_writing, NULL);
    hc_cli_details(cli, false);
}

static int cast(hc_cli *cli, hc_cli_scene *scene)
{
    hc_cli_caster caster;
    int           code = hc_cli_caster_open(&caster, cli, scene);
    if (code == HC_CLI_DONE) {
        code = hc_cli_caster_run(&caster);
    }
    code = hc_cli_caster_close(&caster, code);
    if (code == HC_CLI_DONE) {
        show(cli, &caster);
    }
    return code;
}

int hc_cli_run_trace(hc_cli *cli)
{
    hc_cli_scene scene;
    int          code = check_source(cli);
    if (code == HC_CLI_DONE) {
        code = check_meaning(cli);
    }
    if (code == HC_CLI_DONE) {
        code = check_outputs(cli);
    }
    if (code != HC_CLI_DONE) {
        return code;
    }
    hc_cli_phase(cli, "load");
    code = hc_cli_scene_load(&scene, cli, cli->settings.paths[0]);
    hc_cli_phase(cli, NULL);
    if (code == HC_CLI_DONE) {
        code = cast(cli, &scene);
    }
    hc_cli_scene_free(&scene);
    return code;
}
