#include "details.h"

#include "albedo.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = HC_DETAILS_MAX };

static int load_colour(hc_cli_detail_maps *maps, hc_cli *cli, const hc_cli_detail *named, int index)
{
    hc_detail *detail = &maps->details[index];
    int        width = 0, height = 0;
    const int  code =
        hc_cli_load_colours(cli, named->colour, &maps->colours[index], &width, &height);
    if (code == HC_CLI_DONE && (width != detail->width || height != detail->height)) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s is %d x %d and its heights, %s, %d x %d",
                           named->colour, width, height, named->map, detail->width, detail->height);
    }
    detail->colour = maps->colours[index];
    return code;
}

static int load_map(hc_cli_detail_maps *maps, hc_cli *cli, const hc_cli_detail *named, int index)
{
    hc_field              field;
    const hc_load_options load   = { .normalise = { .range = HC_RANGE_TYPE },
                                     .limits    = cli->settings.load.limits };
    const hc_result       result = hc_load_field(&field, named->map, &load, &cli->log);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    const size_t bytes   = (size_t)field.width * (size_t)field.height * sizeof(float);
    maps->heights[index] = malloc(bytes);
    if (maps->heights[index] == NULL) {
        hc_free_field(&field);
        return hc_cli_fail_memory(cli);
    }
    memcpy(maps->heights[index], field.heights, bytes);
    maps->details[index] = (hc_detail){ .heights = maps->heights[index],
                                        .width   = field.width,
                                        .height  = field.height,
                                        .tile    = named->tile,
                                        .depth   = named->depth };
    hc_free_field(&field);
    return named->colour[0] != '\0' ? load_colour(maps, cli, named, index) : HC_CLI_DONE;
}

static int check_mask(hc_cli *cli, const hc_terrain_scene *scene, int count)
{
    const char     *path = cli->settings.terrain.details.mask;
    hc_file_info    info;
    const hc_result result = hc_read_file_info(&info, path, &cli->settings.load.limits, &cli->log);
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    if (info.width != scene->field.width || info.height != scene->field.height) {
        return hc_cli_fail(cli, HC_CLI_BAD_FILE,
                           "%s is %d x %d; the terrain has %d x %d samples, and its mask as many "
                           "texels",
                           path, info.width, info.height, scene->field.width, scene->field.height);
    }
    return info.channels >= count
               ? HC_CLI_DONE
               : hc_cli_fail(cli, HC_CLI_BAD_FILE, "%s has %d channels; %d details take one each",
                             path, info.channels, count);
}

static int load_mask(hc_cli_detail_maps *maps, hc_terrain_scene *scene, hc_cli *cli)
{
    const size_t texels = (size_t)scene->field.width * (size_t)scene->field.height;
    int          code   = check_mask(cli, scene, maps->count);
    maps->mask          = code == HC_CLI_DONE ? calloc(texels, CHANNELS) : NULL;
    if (code == HC_CLI_DONE && maps->mask == NULL) {
        code = hc_cli_fail_memory(cli);
    }
    for (int channel = 0; code == HC_CLI_DONE && channel < maps->count; channel++) {
        hc_field plane;
        code = hc_cli_load_channel(&plane, cli, cli->settings.terrain.details.mask,
                                   (hc_channel)(HC_CHANNEL_R + channel));
        if (code == HC_CLI_DONE) {
            for (size_t i = 0; i < texels; i++) {
                maps->mask[i * CHANNELS + (size_t)channel] =
                    (uint8_t)(fminf(fmaxf(plane.heights[i], 0.0F), 1.0F) * 255.0F + 0.5F);
            }
            hc_free_field(&plane);
        }
    }
    scene->mask        = maps->mask;
    scene->mask_width  = scene->field.width;
    scene->mask_height = scene->field.height;
    return code;
}

int hc_cli_details_load(hc_cli_detail_maps *maps, hc_terrain_scene *scene, hc_cli *cli)
{
    const hc_cli_detail_list *named = &cli->settings.terrain.details;
    int                       code  = HC_CLI_DONE;
    *maps                           = (hc_cli_detail_maps){ .count = named->count };
    for (int i = 0; code == HC_CLI_DONE && i < maps->count; i++) {
        code = load_map(maps, cli, &named->maps[i], i);
    }
    if (code == HC_CLI_DONE && named->mask != NULL) {
        code = load_mask(maps, scene, cli);
    }
    scene->details       = maps->details;
    scene->detail_count  = maps->count;
    scene->detail_method = named->method;
    scene->detail_steps  = named->steps;
    memcpy(scene->detail_fade, named->fade, sizeof scene->detail_fade);
    return code;
}

void hc_cli_details_free(hc_cli_detail_maps *maps)
{
    for (int i = 0; i < maps->count; i++) {
        free(maps->heights[i]);
        free(maps->colours[i]);
    }
    free(maps->mask);
}
