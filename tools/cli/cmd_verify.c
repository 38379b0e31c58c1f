/* heightcast verify: a cone map against brute force on the heights it was baked from, and rays
 * against the reference. */
#include "commands.h"
#include "figures.h"
#include "options.h"
#include "scene.h"
#include "verify_rays.h"

#include <stdio.h>

/* Up to this many texels are all checked; of larger maps as many as make about this many pairs of
 * samples, which takes seconds. --help says the same. */
enum { CHECK_ALL_UP_TO = 65536, SAMPLE_PAIRS = 1 << 30, SAMPLE_MIN = 256 };

static size_t texels_wanted(const hc_cli_settings *settings, const hc_map_info *info)
{
    const size_t texels = (size_t)info->width * (size_t)info->height;
    if (settings->all) {
        return texels;
    }
    if (settings->texels > 0) {
        return (size_t)settings->texels;
    }
    const size_t sample = (size_t)SAMPLE_PAIRS / texels;
    return texels <= CHECK_ALL_UP_TO ? texels : sample > SAMPLE_MIN ? sample : SAMPLE_MIN;
}

static void show(hc_cli *cli, const hc_map_info *info, const hc_verdict *verdict)
{
    const int    cones  = hc_cones_channels(info->cones);
    const double texels = (double)info->width * (double)info->height;
    hc_cli_text(cli, "input", cli->settings.paths[0]);
    hc_cli_text(cli, "heights", cli->settings.heights);
    hc_cli_show_map(cli, info);
    hc_cli_number(cli, "texels_checked", (double)verdict->checked / cones, NULL);
    hc_cli_number(cli, "part_checked", (double)verdict->checked / cones / texels, NULL);
    hc_cli_number(cli, "wider", (double)verdict->wider, NULL);
    hc_cli_number(cli, "widest_factor", verdict->widest_factor, NULL);
    if (verdict->wider > 0) {
        hc_cli_number(cli, "widest_x", verdict->worst_x, NULL);
        hc_cli_number(cli, "widest_y", verdict->worst_y, NULL);
    }
    hc_cli_number(cli, "mean_kept", verdict->mean_kept, NULL);
    hc_cli_number(cli, "heights_differ", (double)verdict->height_differs, NULL);
}

static int judge(hc_cli *cli, const hc_verdict *verdict)
{
    if (verdict->wider > 0) {
        return hc_cli_fail(
            cli, HC_CLI_VERIFY_FAILED,
            "%zu of %zu ratios are wider than the truth, by up to a factor of %.9g at "
            "texel %d, %d",
            verdict->wider, verdict->checked, verdict->widest_factor, verdict->worst_x,
            verdict->worst_y);
    }
    if (verdict->height_differs > 0) {
        return hc_cli_fail(
            cli, HC_CLI_VERIFY_FAILED,
            "%zu heights of the map are not those of %s; give the options it was baked "
            "with (--invert, --range, ...)",
            verdict->height_differs, cli->settings.heights);
    }
    return HC_CLI_DONE;
}

static int verify(hc_cli *cli, const hc_map *map, const hc_field *field)
{
    const hc_cli_settings *settings = &cli->settings;
    const hc_map_info     *info     = &map->info;
    hc_verdict             verdict;
    if (info->width != field->width || info->height != field->height) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE, "the map is %d x %d, %s is %d x %d", info->width,
                           info->height, settings->heights, field->width, field->height);
    }
    hc_cli_phase(cli, "verify");
    const hc_result result = hc_verify_map(&verdict, map, field, texels_wanted(settings, info),
                                           settings->threads, hc_cli_progress(cli), &cli->log);
    hc_cli_phase(cli, NULL);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    show(cli, info, &verdict);
    return judge(cli, &verdict);
}

static int verify_map(hc_cli *cli, const hc_map *map)
{
    hc_field field = { 0 };
    if (!hc_cli_has_cones(map->info.kind) || map->info.layout == HC_LAYOUT_HEIGHT) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s is a %s map, layout %s: it has no ratios",
                           cli->settings.paths[0], hc_map_kind_name(map->info.kind),
                           hc_layout_name(map->info.layout));
    }
    const hc_result result = hc_cli_load_heights(cli, &field, &map->info);
    const int code = result == HC_OK ? verify(cli, map, &field) : hc_cli_fail_result(cli, result);
    hc_free_field(&field);
    return code;
}

static int verify_ratios(hc_cli *cli)
{
    hc_map map = { 0 };
    hc_cli_phase(cli, "load");
    const hc_result result =
        hc_load_map(&map, cli->settings.paths[0], &cli->settings.load.limits, &cli->log);
    const int code = result == HC_OK ? verify_map(cli, &map) : hc_cli_fail_result(cli, result);
    hc_free_map(&map);
    return code;
}

static int verify_rays(hc_cli *cli)
{
    hc_cli_scene scene;
    hc_cli_phase(cli, "load");
    int code = hc_cli_scene_load(&scene, cli, cli->settings.paths[0]);
    hc_cli_phase(cli, NULL);
    if (code == HC_CLI_DONE) {
        code = hc_cli_verify_rays(cli, &scene);
    }
    hc_cli_scene_free(&scene);
    return code;
}

static int check_arguments(hc_cli *cli)
{
    static const char *const of_rays[] = { "method", "steps",   "refinements", "secant",
                                           "seed",   "surface", "open-sides" };
    const hc_cli_settings   *settings  = &cli->settings;
    if (settings->heights == NULL && settings->rays.count == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "needs --heights FIELD, or --rays N, or both");
    }
    if (settings->all && settings->texels > 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--all and --texels exclude each other");
    }
    if (settings->rays.method == hc_trace_method_count()) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--method reference is what rays are judged by");
    }
    for (size_t i = 0; i < sizeof of_rays / sizeof *of_rays && settings->rays.count == 0; i++) {
        if (hc_cli_given(settings, of_rays[i])) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--%s does nothing without --rays; leave it out",
                               of_rays[i]);
        }
    }
    return HC_CLI_DONE;
}

/* Ratios with --heights, rays with --rays. */
int hc_cli_run_verify(hc_cli *cli)
{
    const hc_cli_settings *settings = &cli->settings;
    int                    code     = check_arguments(cli);
    if (code == HC_CLI_DONE && settings->heights != NULL) {
        code = verify_ratios(cli);
    }
    if (code == HC_CLI_DONE && settings->rays.count > 0) {
        code = verify_rays(cli);
    }
    return code;
}
