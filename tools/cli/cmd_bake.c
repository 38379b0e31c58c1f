/* heightcast bake: a height map into a map file. */
#include "commands.h"
#include "figures.h"
#include "options.h"
#include "output.h"
#include "words.h"

#include <heightcast/gpu.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool given(const hc_cli *cli, const char *name)
{
    return hc_cli_given(&cli->settings, name);
}

static bool has_levels(hc_map_kind kind)
{
    return kind == HC_MAP_PYRAMID || kind == HC_MAP_BOUNDS;
}

static bool is_relaxed(hc_method method)
{
    return method == HC_METHOD_GEMS || method == HC_METHOD_FALLING_EDGE;
}

/* ---- choices that make no sense together: what is wrong, and the remedy ---- */

/* An option that would be ignored was given by mistake. */
static int refuse_idle_options(hc_cli *cli)
{
    static const char *const of_cones[] = { "method", "cones", "max-ratio", "compat" };
    const hc_map_options    *map        = &cli->settings.map;
    for (size_t i = 0; i < sizeof of_cones / sizeof *of_cones; i++) {
        if (!hc_cli_has_cones(map->kind) && given(cli, of_cones[i])) {
            return hc_cli_fail(cli, HC_CLI_USAGE, "--%s does nothing for --map %s; leave it out",
                               of_cones[i], hc_map_kind_name(map->kind));
        }
    }
    if (given(cli, "gems-steps") && map->cone.method != HC_METHOD_GEMS) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--gems-steps needs --map relaxed --method gems");
    }
    if (given(cli, "level") && !has_levels(map->kind)) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--level needs --map pyramid or bounds");
    }
    return HC_CLI_DONE;
}

/* The methods that make what was asked for, "exact, brute, quick". */
static void list_methods(char *text, size_t size, hc_map_kind kind, hc_cones cones)
{
    size_t used = 0;
    text[0]     = '\0';
    for (int i = 0; hc_method_name((hc_method)i) != NULL && used < size; i++) {
        const hc_method method = (hc_method)i;
        if (is_relaxed(method) == (kind == HC_MAP_RELAXED) && hc_method_makes(method, cones)) {
            const int wrote = snprintf(text + used, size - used, "%s%s", used == 0 ? "" : ", ",
                                       hc_method_name(method));
            used += wrote > 0 ? (size_t)wrote : 0;
        }
    }
}

static int refuse_method(hc_cli *cli)
{
    const hc_map_options *map    = &cli->settings.map;
    const hc_method       method = map->cone.method;
    const char           *name   = hc_method_name(method);
    char                  methods[256];
    list_methods(methods, sizeof methods, map->kind, map->cone.cones);
    if (map->kind == HC_MAP_CONE && is_relaxed(method)) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--method %s makes relaxed cones; add --map relaxed",
                           name);
    }
    if (map->kind == HC_MAP_RELAXED && map->cone.cones != HC_CONES_L2) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--map relaxed has --cones l2 only, not %s",
                           hc_cones_name(map->cone.cones));
    }
    if (map->kind == HC_MAP_RELAXED && given(cli, "method") && !is_relaxed(method)) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--method %s makes no relaxed cones; use %s", name,
                           methods);
    }
    if (map->kind == HC_MAP_CONE && !hc_method_makes(method, map->cone.cones)) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--method %s does not make --cones %s; use %s", name,
                           hc_cones_name(map->cone.cones), methods);
    }
    return HC_CLI_DONE;
}

/* ---- defaults that hang on the output ---- */

static bool fits_dummer(const hc_map_options *map)
{
    return hc_cli_has_cones(map->kind) && hc_cones_channels(map->cone.cones) == 1;
}

static int resolve_compat(hc_cli *cli)
{
    hc_map_options *map = &cli->settings.map;
    if (cli->settings.compat == 0) {
        return HC_CLI_DONE;
    }
    if (map->layout != HC_LAYOUT_AUTO && map->layout != HC_LAYOUT_DUMMER) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--compat 2006 writes --layout dummer, not %s",
                           hc_layout_name(map->layout));
    }
    map->layout     = HC_LAYOUT_DUMMER;
    map->compat2006 = true;
    return HC_CLI_DONE;
}

static int refuse_container(hc_cli *cli, const hc_container *container, int bits)
{
    char endings[128];
    hc_cli_list_endings(endings, sizeof endings, HC_CLI_MAP, bits);
    return hc_cli_fail(cli, HC_CLI_USAGE, "%s holds no %d bits per channel; use %s%s",
                       container->name, bits, endings,
                       given(cli, "bits") ? ", or other --bits" : "");
}

static int resolve_depth(hc_cli *cli, const hc_container *container)
{
    hc_map_options *map = &cli->settings.map;
    const bool      png = container->map_bits == (8 | 16);
    if (png && map->layout == HC_LAYOUT_AUTO && fits_dummer(map)
        && (map->bits == 0 || map->bits == 8)) {
        map->layout = HC_LAYOUT_DUMMER;
    }
    if (map->layout == HC_LAYOUT_DUMMER && map->bits != 0 && map->bits != 8) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "--layout dummer has 8 bits, not %d; --layout rg has 8, 16 or 32",
                           map->bits);
    }
    if (map->bits == 0) {
        map->bits = map->layout == HC_LAYOUT_DUMMER ? 8 : png ? 16 : 32;
    }
    if ((container->map_bits & map->bits) == 0) {
        return refuse_container(cli, container, map->bits);
    }
    return HC_CLI_DONE;
}

static int refuse_levels(hc_cli *cli, const hc_container *container)
{
    char endings[128];
    if (!has_levels(cli->settings.map.kind)) {
        return HC_CLI_DONE;
    }
    if (container->levels && given(cli, "level")) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "%s holds all levels; leave --level out",
                           container->name);
    }
    if (!container->levels && !given(cli, "level")) {
        hc_cli_list_endings(endings, sizeof endings, HC_CLI_PYRAMID, 8 | 16 | 32);
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "%s holds one level; choose it (--level 1 is the full size), or use %s",
                           container->name, endings);
    }
    return HC_CLI_DONE;
}

static int refuse_idle_backend(hc_cli *cli)
{
    const hc_map_options *map = &cli->settings.map;
    if (cli->settings.backend == HC_CLI_GL && !cli->settings.either
        && (map->compat2006 || (map->kind == HC_MAP_GRADIENT && map->bits != 32))) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--backend gl does nothing for %s; leave it out",
                           map->compat2006 ? "--compat" : "--map gradient in codes");
    }
    return HC_CLI_DONE;
}

/* The library's own checks, on a tiny field: what they refuse no input can make right. */
static int refuse_nonsense(hc_cli *cli)
{
    static const float heights[4] = { 0.0F };
    const hc_field     tiny       = { .heights      = heights,
                                      .width        = 2,
                                      .height       = 2,
                                      .wrap         = cli->settings.load.wrap,
                                      .registration = cli->settings.load.registration };
    hc_map_info        info;
    const hc_result    result = hc_map_info_for(&info, &tiny, &cli->settings.map, &cli->log);
    if (result == HC_OK) {
        return HC_CLI_DONE;
    }
    return hc_cli_fail(cli, HC_CLI_USAGE, "%s%s", cli->log.text,
                       given(cli, "layout") ? " (--layout auto chooses one that fits)" : "");
}

static int resolve(hc_cli *cli)
{
    hc_cli_settings    *settings  = &cli->settings;
    const hc_container *container = hc_container_of(settings->paths[1]);
    if (container == NULL || container->map_bits == 0) {
        char endings[128];
        hc_cli_list_endings(endings, sizeof endings, HC_CLI_MAP, 8 | 16 | 32);
        return hc_cli_fail(cli, HC_CLI_USAGE, "output %s: the ending must be one of %s",
                           settings->paths[1], endings);
    }
    int code = refuse_idle_options(cli);
    code     = code == HC_CLI_DONE ? refuse_method(cli) : code;
    code     = code == HC_CLI_DONE ? resolve_compat(cli) : code;
    code     = code == HC_CLI_DONE ? resolve_depth(cli, container) : code;
    code     = code == HC_CLI_DONE ? refuse_levels(cli, container) : code;
    code     = code == HC_CLI_DONE ? refuse_idle_backend(cli) : code;
    code     = code == HC_CLI_DONE ? refuse_nonsense(cli) : code;
    code     = code == HC_CLI_DONE ? hc_cli_check_output(cli, settings->paths[1]) : code;
    settings->map.cone.threads  = settings->threads;
    settings->map.cone.progress = hc_cli_progress(cli);
    return code;
}

/* ---- the work ---- */

/* Rounding that nobody asked for is worth a word. */
static void warn_of_rounding(hc_cli *cli, const hc_field *field, const hc_map_info *info)
{
    if (field->elevation.source_bits > info->bits && !given(cli, "bits") && !given(cli, "layout")
        && !given(cli, "compat")) {
        hc_cli_warn(
            cli, "%d-bit heights are rounded to the %d bits of layout %s; --layout rg keeps more",
            field->elevation.source_bits, info->bits, hc_layout_name(info->layout));
    }
}

static void show(hc_cli *cli, const hc_map_info *info)
{
    const char  *out     = cli->settings.paths[1];
    const double samples = (double)info->width * (double)info->height;
    hc_cli_text(cli, "input", cli->settings.paths[0]);
    hc_cli_text(cli, "output", out);
    hc_cli_number(cli, "output_bytes", hc_cli_file_bytes(out), NULL);
    hc_cli_show_map(cli, info);
    hc_cli_text(cli, "backend", hc_cli_backend_words((int)cli->settings.backend));
    hc_cli_number(cli, "ns_per_texel", 1e9 * hc_cli_seconds(cli, "bake") / samples, NULL);
    hc_cli_details(cli, true);
    hc_cli_show_elevation(cli, &info->elevation);
    hc_cli_number(cli, "threads", cli->settings.threads,
                  cli->settings.threads == 0 ? "(one for each core)" : NULL);
    hc_cli_text(cli, "isa", hc_isa_name(hc_isa_resolve(cli->settings.map.cone.isa)));
    hc_cli_details(cli, false);
}

static void show_gpu(hc_cli *cli, const hc_gpu *gpu)
{
    hc_cli_text(cli, "gpu", hc_gpu_name(gpu));
    hc_cli_text(cli, "gpu_rounds", hc_gpu_rounds(gpu) ? "yes" : "no");
    hc_cli_number(cli, "seconds_of_shaders", hc_gpu_seconds(gpu), NULL);
}

static hc_result bake_by_gl(hc_cli *cli, const hc_field *field, hc_map *map)
{
    hc_map_options options = cli->settings.map;
    hc_gpu        *gpu;
    hc_result      result = hc_gpu_create(&gpu, &cli->log);
    if (result == HC_OK) {
        options.baker = hc_gpu_map_baker(gpu);
        result        = hc_bake_map(map, field, &options, &cli->log);
    }
    if (result == HC_OK) {
        show_gpu(cli, gpu);
    }
    hc_gpu_destroy(gpu);
    return result;
}

/* Where there is no OpenGL, or not for this method, the CPU bakes. */
static hc_result bake(hc_cli *cli, const hc_field *field, hc_map *map)
{
    if (cli->settings.backend == HC_CLI_GL) {
        const hc_result result = bake_by_gl(cli, field, map);
        if (!hc_cli_falls_back(cli, result, "bakes")) {
            return result;
        }
    }
    return hc_bake_map(map, field, &cli->settings.map, &cli->log);
}

static int bake_and_save(hc_cli *cli, const hc_field *field, hc_map *map)
{
    const hc_cli_settings *settings = &cli->settings;
    hc_cli_phase(cli, "bake");
    hc_result result = bake(cli, field, map);
    if (result == HC_OK) {
        hc_cli_phase(cli, "save");
        result = hc_save_map(map, settings->paths[1], &settings->save, &cli->log);
    }
    hc_cli_phase(cli, NULL);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    show(cli, &map->info);
    return HC_CLI_DONE;
}

static int bake_field(hc_cli *cli, const hc_field *field)
{
    hc_map          map    = { 0 };
    const hc_result result = hc_map_info_for(&map.info, field, &cli->settings.map, &cli->log);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    warn_of_rounding(cli, field, &map.info);
    map.texels     = malloc(hc_map_bytes(&map.info));
    const int code = map.texels == NULL ? hc_cli_fail_memory(cli) : bake_and_save(cli, field, &map);
    free(map.texels);
    return code;
}

int hc_cli_run_bake(hc_cli *cli)
{
    hc_field field = { 0 };
    int      code  = resolve(cli);
    if (code != HC_CLI_DONE) {
        return code;
    }
    hc_cli_phase(cli, "load");
    const hc_result result =
        hc_load_field(&field, cli->settings.paths[0], &cli->settings.load, &cli->log);
    code = result == HC_OK ? bake_field(cli, &field) : hc_cli_fail_result(cli, result);
    hc_free_field(&field);
    return code;
}
