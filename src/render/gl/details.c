#include "details.h"

#include "upload.h"

#include "base/fail.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- textures -------------------------------------------------------------------------------- */

/* Column of a map's first texel; of the one beyond the last: the width of all. */
static int first_of(const hc_details *details, int index)
{
    int first = 0;
    for (int i = 0; i < index; i++) {
        first += details->maps[i].width;
    }
    return first;
}

/* Colour and height in one. */
static void fill(float *texels, int width, int first, const hc_detail *map)
{
    for (int y = 0; y < map->height; y++) {
        for (int x = 0; x < map->width; x++) {
            const size_t from = (size_t)y * (size_t)map->width + (size_t)x;
            float       *to   = texels + 4 * ((size_t)y * (size_t)width + (size_t)(first + x));
            for (size_t k = 0; k < 3 && map->colour != NULL; k++) {
                to[k] = map->colour[3 * from + k];
            }
            to[3] = map->heights[from];
        }
    }
}

static hc_result load_maps(unsigned *texture, int unit, const hc_details *details, hc_log *log)
{
    const int width  = first_of(details, details->count);
    int       height = 0;
    for (int i = 0; i < details->count; i++) {
        height = height > details->maps[i].height ? height : details->maps[i].height;
    }
    float *texels = calloc((size_t)width * (size_t)height, 4 * sizeof *texels);
    if (texels == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for details of %d x %d", width, height);
    }
    for (int i = 0; i < details->count; i++) {
        fill(texels, width, first_of(details, i), &details->maps[i]);
    }
    const hc_result result =
        hc_upload_image(texture, unit, texels, width, height, 4, "details", log);
    free(texels);
    return result;
}

enum { TOPS_WIDE = 4096, LEVELS = 17 };

/* All levels of all pyramids, one after another. */
static hc_result load_tops(unsigned *texture, int unit, const hc_details *details, hc_log *log)
{
    size_t count = 0, used = 0;
    for (int i = 0; i < details->count; i++) {
        count += hc_pyramid_size(details->tops[i].width, details->tops[i].height);
    }
    const size_t rows   = (count + TOPS_WIDE - 1) / TOPS_WIDE;
    float       *texels = calloc(rows, TOPS_WIDE * sizeof *texels);
    if (texels == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the tops of details");
    }
    for (int i = 0; i < details->count; i++) {
        const size_t own = hc_pyramid_size(details->tops[i].width, details->tops[i].height);
        memcpy(texels + used, details->tops[i].values, own * sizeof *texels);
        used += own;
    }
    const hc_result result =
        hc_upload_image(texture, unit, texels, TOPS_WIDE, (int)rows, 1, "tops of details", log);
    free(texels);
    return result;
}

hc_result hc_details_upload(unsigned textures[HC_DETAIL_UNITS], int unit, const hc_terrain *terrain,
                            hc_log *log)
{
    const hc_terrain_scene *scene  = &terrain->scene;
    hc_result               result = HC_OK;
    if (terrain->details.count > 0 && scene->mask != NULL) {
        result = hc_upload_bytes(&textures[0], unit, scene->mask, scene->mask_width,
                                 scene->mask_height, "mask", log);
    }
    if (result == HC_OK && terrain->details.count > 0) {
        result = load_maps(&textures[1], unit + 1, &terrain->details, log);
    }
    return result == HC_OK && terrain->details.count > 0
               ? load_tops(&textures[2], unit + 2, &terrain->details, log)
               : result;
}

/* ---- uniforms -------------------------------------------------------------------------------- */

static const char *element(char name[40], const char *of, int index)
{
    (void)snprintf(name, 40, "%s[%d]", of, index);
    return name;
}

static void set_map(unsigned program, const hc_terrain *terrain, int i)
{
    const hc_details *details = &terrain->details;
    const hc_detail  *map     = &details->maps[i];
    char              name[40];
    hc_upload_pair(program, element(name, "hc_detail_rate", i),
                   details->rate[i] * (terrain->high[0] - terrain->low[0]),
                   details->rate[i] * (terrain->high[1] - terrain->low[1]));
    glUniform2i(glGetUniformLocation(program, element(name, "hc_detail_size", i)), map->width,
                map->height);
    hc_upload_int(program, element(name, "hc_detail_first", i), first_of(details, i));
    hc_upload_float(program, element(name, "hc_detail_cut", i), details->cut[i]);
    hc_upload_vector(program, element(name, "hc_detail_mean", i), details->mean[i]);
    hc_upload_int(program, element(name, "hc_detail_colours", i), map->colour != NULL);
}

static void set_levels(unsigned program, const hc_details *details)
{
    size_t first = 0;
    char   name[40];
    for (int i = 0; i < details->count; i++) {
        const hc_pyramid *tops = &details->tops[i];
        hc_upload_int(program, element(name, "hc_detail_level_count", i), tops->levels);
        for (int level = 0; level < tops->levels; level++) {
            const float *values = hc_pyramid_level(tops, level, NULL, NULL);
            hc_upload_int(program, element(name, "hc_detail_level_first", LEVELS * i + level),
                          (int)(first + (size_t)(values - tops->values)));
        }
        first += hc_pyramid_size(tops->width, tops->height);
    }
    hc_upload_int(program, "hc_detail_level_max", details->level_max);
}

void hc_details_set_uniforms(unsigned program, int unit, const hc_terrain *terrain)
{
    const hc_terrain_scene *scene = &terrain->scene;
    const hc_details       *d     = &terrain->details;
    hc_upload_int(program, "hc_mask", unit);
    hc_upload_int(program, "hc_details", unit + 1);
    hc_upload_int(program, "hc_detail_tops", unit + 2);
    hc_upload_int(program, "hc_masked", scene->mask != NULL);
    hc_upload_int(program, "hc_detail_count", d->count);
    hc_upload_int(program, "hc_detail_steps", scene->detail_steps);
    hc_upload_int(program, "hc_detail_flat", scene->blocky);
    hc_upload_float(program, "hc_world", 1.0 / terrain->placement.scale_z);
    hc_upload_pair(program, "hc_detail_fade", fmin(d->fade[0], 1e29), fmin(d->fade[1], 1e30));
    for (int i = 0; i < d->count; i++) {
        set_map(program, terrain, i);
    }
    set_levels(program, d);
}
