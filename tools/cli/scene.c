#include "scene.h"

#include "options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- heights --------------------------------------------------------------------------------- */

hc_result hc_cli_load_heights(hc_cli *cli, hc_field *field, const hc_map_info *info)
{
    hc_load_options load = cli->settings.load;
    if (!hc_cli_given(&cli->settings, "wrap")) {
        load.wrap = info->wrap;
    }
    if (!hc_cli_given(&cli->settings, "registration")) {
        load.registration = info->registration;
    }
    return hc_load_field(field, cli->settings.heights, &load, &cli->log);
}

static bool stores_heights(const hc_map_info *info)
{
    switch (info->layout) {
    case HC_LAYOUT_DUMMER:
    case HC_LAYOUT_RG:
    case HC_LAYOUT_ANISO:
    case HC_LAYOUT_HEIGHT: return info->kind != HC_MAP_BOUNDS;
    case HC_LAYOUT_MINMAX: return info->kind == HC_MAP_PYRAMID;
    default: return false;
    }
}

/* The field that the map itself defines. */
static int take_heights(hc_cli_scene *scene, hc_cli *cli)
{
    const hc_map_info *info    = &scene->map.info;
    float             *heights = malloc((size_t)info->width * (size_t)info->height * sizeof(float));
    if (heights == NULL) {
        return hc_cli_fail_memory(cli);
    }
    for (int y = 0; y < info->height; y++) {
        for (int x = 0; x < info->width; x++) {
            heights[(size_t)y * (size_t)info->width + (size_t)x] =
                hc_map_height_at(&scene->map, x, y);
        }
    }
    scene->heights = heights;
    scene->field   = (hc_field){ .heights      = heights,
                                 .width        = info->width,
                                 .height       = info->height,
                                 .wrap         = info->wrap,
                                 .registration = info->registration,
                                 .elevation    = info->elevation };
    return HC_CLI_DONE;
}

static int load_beside(hc_cli_scene *scene, hc_cli *cli, const char *path)
{
    const hc_map_info *info   = &scene->map.info;
    const hc_result    result = hc_cli_load_heights(cli, &scene->field, info);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    if (info->width != scene->field.width || info->height != scene->field.height) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s is %d x %d, %s is %d x %d", path, info->width,
                           info->height, cli->settings.heights, scene->field.width,
                           scene->field.height);
    }
    return HC_CLI_DONE;
}

static int load_map(hc_cli_scene *scene, hc_cli *cli, const char *path)
{
    const hc_result result = hc_load_map(&scene->map, path, &cli->settings.load.limits, &cli->log);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    const hc_map_info *info = &scene->map.info;
    scene->is_map           = true;
    if (stores_heights(info)) {
        return take_heights(scene, cli);
    }
    if (cli->settings.heights == NULL) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE,
                           "%s is a %s map, layout %s: it stores no heights; give --heights FIELD",
                           path, hc_map_kind_name(info->kind), hc_layout_name(info->layout));
    }
    return load_beside(scene, cli, path);
}

static int load_any(hc_cli_scene *scene, hc_cli *cli, const char *path)
{
    const hc_load_options *load   = &cli->settings.load;
    hc_file_info           info   = { 0 };
    hc_result              result = HC_OK;
    /* Standard input can be read once only, and raw samples have no header. */
    if (strcmp(path, "-") != 0 && load->raw_width == 0) {
        result = hc_read_file_info(&info, path, &load->limits, &cli->log);
    }
    if (result == HC_OK && info.has_map) {
        return load_map(scene, cli, path);
    }
    if (result == HC_OK) {
        result = hc_load_field(&scene->field, path, load, &cli->log);
    }
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

/* ---- placement ------------------------------------------------------------------------------- */

/* Coordinates of maps have six or seven digits, of which float32 holds no more. */
static void warn_coarse(hc_cli *cli, const hc_placement *placement)
{
    const double far    = fmax(fabs(placement->offset[0]), fabs(placement->offset[1]));
    const double spaced = fmin(placement->spacing_x, -placement->spacing_y);
    const double grain  = far * 0x1p-23;
    if (grain > spaced / 32.0) {
        hc_cli_warn(cli,
                    "rays in float32 are %.2g apart near the origin of the file, its samples %.2g; "
                    "--space local is finer",
                    grain, spaced);
    }
}

static int place(hc_cli_scene *scene, hc_cli *cli)
{
    const hc_cli_rays  *rays      = &cli->settings.rays;
    const hc_elevation *elevation = &scene->field.elevation;
    const bool          spaced    = hc_cli_given(&cli->settings, "spacing");
    const bool          raised    = hc_cli_given(&cli->settings, "elevation");
    const bool          origin    = rays->space == HC_CLI_WORLD && elevation->placed;
    if (rays->space == HC_CLI_TEXTURE) {
        return HC_CLI_DONE;
    }
    const double x    = spaced ? rays->spacing[0] : elevation->spacing_x;
    const double y    = spaced ? rays->spacing[1] : elevation->spacing_y;
    const double low  = raised ? rays->elevation[0] : elevation->low;
    const double high = raised ? rays->elevation[1] : elevation->high;
    if (x <= 0.0 || y <= 0.0) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "%s does not say how far its samples are apart; give --spacing",
                           cli->settings.paths[0]);
    }
    if (low >= high) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "the elevations of heights 0 and 1 are %g and %g; give --elevation "
                           "LOW:HIGH, the second above the first",
                           low, high);
    }
    /* Rows run from north to south. */
    scene->placement = (hc_placement){ .spacing_x = x,
                                       .spacing_y = -y,
                                       .scale_z   = high - low,
                                       .offset    = { origin ? elevation->origin_x : 0.0,
                                                   origin ? elevation->origin_y : 0.0, low } };
    warn_coarse(cli, &scene->placement);
    return HC_CLI_DONE;
}

int hc_cli_scene_load(hc_cli_scene *scene, hc_cli *cli, const char *path)
{
    *scene         = (hc_cli_scene){ 0 };
    const int code = load_any(scene, cli, path);
    return code == HC_CLI_DONE ? place(scene, cli) : code;
}

void hc_cli_scene_free(hc_cli_scene *scene)
{
    free(scene->ratios);
    if (scene->heights == NULL) {
        hc_free_field(&scene->field);
    }
    free(scene->heights);
    hc_free_map(&scene->map);
}

/* ---- ratios ---------------------------------------------------------------------------------- */

bool hc_cli_scene_holds(const hc_cli_scene *scene, hc_trace_needs needs)
{
    const hc_map_info *info = &scene->map.info;
    if (!scene->is_map || info->layout == HC_LAYOUT_HEIGHT) {
        return needs == HC_NEEDS_NOTHING;
    }
    switch (needs) {
    case HC_NEEDS_NOTHING: return true;
    case HC_NEEDS_CELL_RATIOS:
        return info->kind == HC_MAP_CONE
               && (info->cones == HC_CONES_L1 || info->cones == HC_CONES_QUAD);
    case HC_NEEDS_RATIOS: return info->kind == HC_MAP_CONE && info->cones == HC_CONES_L2;
    case HC_NEEDS_RELAXED: return info->kind == HC_MAP_RELAXED && info->cones == HC_CONES_L2;
    }
    return false;
}

static void decode_ratios(float *ratios, const hc_map *map)
{
    const int channels = hc_cones_channels(map->info.cones);
    for (int y = 0; y < map->info.height; y++) {
        for (int x = 0; x < map->info.width; x++) {
            for (int cone = 0; cone < channels; cone++) {
                *ratios++ = hc_map_ratio_at(map, x, y, cone);
            }
        }
    }
}

static int fill_ratios(float *ratios, hc_cli_scene *scene, hc_cli *cli, hc_trace_needs needs)
{
    hc_cone_options options = cli->settings.map.cone;
    if (hc_cli_scene_holds(scene, needs)) {
        decode_ratios(ratios, &scene->map);
        return HC_CLI_DONE;
    }
    options.method   = needs == HC_NEEDS_RELAXED ? HC_METHOD_FALLING_EDGE : HC_METHOD_EXACT;
    options.cones    = scene->cones;
    options.threads  = cli->settings.threads;
    options.progress = hc_cli_progress(cli);
    hc_cli_phase(cli, "bake");
    const hc_result result = hc_bake_cone_map(ratios, &scene->field, &options, &cli->log);
    hc_cli_phase(cli, NULL);
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

/* From ratios of samples to those of cells, for which the proof is. */
static int to_cells(hc_cli_scene *scene, hc_cli *cli, size_t count)
{
    float *cells = malloc(count * sizeof *cells);
    if (cells == NULL) {
        return hc_cli_fail_memory(cli);
    }
    hc_bake_cell_ratios(cells, scene->ratios, scene->field.width, scene->field.height, scene->cones,
                        scene->field.wrap);
    free(scene->ratios);
    scene->ratios = cells;
    return HC_CLI_DONE;
}

hc_cones hc_cli_scene_cones(const hc_cli_scene *scene, const hc_cli *cli, hc_trace_needs needs)
{
    return needs != HC_NEEDS_CELL_RATIOS           ? HC_CONES_L2
           : hc_cli_scene_holds(scene, needs)      ? scene->map.info.cones
           : hc_cli_given(&cli->settings, "cones") ? cli->settings.map.cone.cones
                                                   : HC_CONES_QUAD;
}

int hc_cli_scene_ratios(hc_cli_scene *scene, hc_cli *cli, hc_trace_needs needs)
{
    if (needs == HC_NEEDS_NOTHING || needs == scene->has) {
        return HC_CLI_DONE;
    }
    scene->cones       = hc_cli_scene_cones(scene, cli, needs);
    const size_t count = (size_t)scene->field.width * (size_t)scene->field.height
                         * (size_t)hc_cones_channels(scene->cones);
    free(scene->ratios);
    scene->has    = HC_NEEDS_NOTHING;
    scene->ratios = malloc(count * sizeof *scene->ratios);
    if (scene->ratios == NULL) {
        return hc_cli_fail_memory(cli);
    }
    int code = fill_ratios(scene->ratios, scene, cli, needs);
    if (code == HC_CLI_DONE && needs == HC_NEEDS_CELL_RATIOS) {
        code = to_cells(scene, cli, count);
    }
    scene->has = code == HC_CLI_DONE ? needs : HC_NEEDS_NOTHING;
    return code;
}

hc_trace_options hc_cli_scene_options(const hc_cli_scene *scene, const hc_cli *cli,
                                      hc_trace_method method)
{
    const hc_cli_rays *rays  = &cli->settings.rays;
    const bool         needs = hc_trace_method_needs(method) != HC_NEEDS_NOTHING;
    return (hc_trace_options){ .method      = method,
                               .surface     = rays->surface,
                               .open_sides  = rays->open_sides,
                               .placement   = scene->placement,
                               .ratios      = needs ? scene->ratios : NULL,
                               .cones       = scene->cones,
                               .steps       = rays->steps,
                               .refinements = rays->secant ? -1 : rays->refinements,
                               .isa         = cli->settings.map.cone.isa,
                               .threads     = cli->settings.threads };
}

int hc_cli_refinements(const hc_cli_settings *settings)
{
    switch (settings->render.refine) {
    case HC_CLI_SECANT: return -1;
    case HC_CLI_NO_REFINEMENT: return -2;
    default: return settings->rays.refinements;
    }
}
