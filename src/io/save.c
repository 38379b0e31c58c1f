/* Fields, maps and pictures -> files. */
#include "io_internal.h"

#include "base/fail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static hc_save_options resolve(const hc_save_options *options)
{
    return options != NULL ? *options : (hc_save_options){ 0 };
}

static hc_result write_file(const hc_format *format, const hc_image *image, const char *path,
                            bool overwrite, hc_log *log)
{
    hc_output       output;
    const hc_result opened = hc_output_open(&output, path, overwrite, log);
    if (opened != HC_OK) {
        return opened;
    }
    return hc_output_close(&output, format->write(&output, image, log), log);
}

/* ---- fields ---------------------------------------------------------------------------------- */

/* code = round(height * n); halves go up. Heights that came from codes give them back. */
static void *make_codes(const hc_field *field, int bits)
{
    const size_t count = (size_t)field->width * (size_t)field->height;
    const double n     = bits == 8 ? 255.0 : 65535.0;
    void        *codes = malloc(count * (size_t)(bits / 8));
    for (size_t i = 0; codes != NULL && i < count; i++) {
        const double code = floor((double)field->heights[i] * n + 0.5);
        if (bits == 8) {
            ((uint8_t *)codes)[i] = (uint8_t)code;
        } else {
            ((uint16_t *)codes)[i] = (uint16_t)code;
        }
    }
    return codes;
}

static hc_result resolve_bits(int *bits, const hc_container *container, const char *path,
                              hc_log *log)
{
    const int allowed = container->field_bits;
    if (*bits == 0) {
        *bits = (allowed & 32) != 0 ? 32 : 16;
    }
    if ((*bits != 8 && *bits != 16 && *bits != 32) || (allowed & *bits) == 0) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: %s fields cannot have %d bits; use%s%s%s",
                       path, container->name, *bits, (allowed & 8) != 0 ? " 8" : "",
                       (allowed & 16) != 0 ? " 16" : "", (allowed & 32) != 0 ? " 32" : "");
    }
    return HC_OK;
}

hc_result hc_save_field(const hc_field *field, const char *path, const hc_save_options *options,
                        hc_log *log)
{
    hc_save_options  given   = resolve(options);
    const hc_format *format  = hc_format_by_ending(path);
    const hc_result  checked = hc_field_check(field, log);
    if (checked != HC_OK) {
        return checked;
    }
    if (format == NULL || format->container.field_bits == 0) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: fields are not written under this ending; use .png, .tif, .exr, .pgm, "
                       ".pfm, .npy or .raw",
                       path);
    }
    const hc_result possible = resolve_bits(&given.bits, &format->container, path, log);
    if (possible != HC_OK) {
        return possible;
    }
    void    *codes = given.bits == 32 ? NULL : make_codes(field, given.bits);
    hc_image image = { .data      = codes,
                       .type      = given.bits == 8 ? HC_U8 : HC_U16,
                       .width     = field->width,
                       .height    = field->height,
                       .channels  = 1,
                       .levels    = 1,
                       .bits      = given.bits,
                       .elevation = field->elevation };
    if (given.bits == 32) {
        image.data = (void *)(uintptr_t)field->heights; /* writers only read */
        image.type = HC_F32;
    } else if (codes == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for its codes", path);
    }
    hc_text_from_field(image.text, &field->elevation);
    const hc_result result = write_file(format, &image, path, given.overwrite, log);
    free(codes);
    return result;
}

/* ---- maps ------------------------------------------------------------------------------------ */

/* The containers that could hold the map, for people. */
static hc_result refuse(const hc_map_info *info, bool levels, const char *path, hc_log *log)
{
    char   list[128] = "";
    size_t used      = 0;
    for (int i = 0; hc_container_at(i) != NULL; i++) {
        const hc_container *container = hc_container_at(i);
        if ((container->map_bits & info->bits) != 0 && (container->levels || !levels)) {
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used > 0 ? ", " : "",
                                     container->endings[0]);
        }
    }
    return hc_fail(log, HC_ERROR_UNSUPPORTED,
                   "%s: a map with %d bits and %d levels does not go under this ending; use %s%s",
                   path, info->bits, info->levels, list, levels ? ", or choose one level" : "");
}

/* One level of a pyramid as a map of its own: its samples are 2^k as far apart, and the first
 * stands amid 2^k. */
static hc_map pick_level(const hc_map *map, int level)
{
    hc_map        picked = *map;
    hc_elevation *of     = &picked.info.elevation;
    const double  scale  = (double)(1 << level);
    picked.texels        = hc_map_level(map, level, &picked.info.width, &picked.info.height);
    picked.info.levels   = 1;
    of->origin_x += (scale - 1.0) / 2.0 * of->spacing_x;
    of->origin_y -= (scale - 1.0) / 2.0 * of->spacing_y;
    of->spacing_x *= scale;
    of->spacing_y *= scale;
    return picked;
}

hc_result hc_save_map(const hc_map *map, const char *path, const hc_save_options *options,
                      hc_log *log)
{
    const hc_save_options given   = resolve(options);
    const hc_format      *format  = hc_format_by_ending(path);
    const hc_result       checked = hc_map_info_check(&map->info, log);
    if (checked != HC_OK) {
        return checked;
    }
    if (map->texels == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "map.texels is NULL; bake the map first");
    }
    if (given.level < 0 || given.level > map->info.levels) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "%s: level %d was chosen; the map has levels 1 to %d", path, given.level,
                       map->info.levels);
    }
    const hc_map one    = given.level > 0 ? pick_level(map, given.level - 1) : *map;
    const bool   levels = one.info.levels > 1;
    if (format == NULL || (format->container.map_bits & one.info.bits) == 0
        || (levels && !format->container.levels)) {
        return refuse(&one.info, levels, path, log);
    }
    hc_image image = { .data      = one.texels,
                       .type      = one.info.bits == 8    ? HC_U8
                                    : one.info.bits == 16 ? HC_U16
                                                          : HC_F32,
                       .width     = one.info.width,
                       .height    = one.info.height,
                       .channels  = one.info.channels,
                       .levels    = one.info.levels,
                       .bits      = one.info.bits,
                       .elevation = one.info.elevation };
    hc_text_from_map(image.text, &one.info);
    return write_file(format, &image, path, given.overwrite, log);
}

/* ---- pictures -------------------------------------------------------------------------------- */

static hc_result check_picture(const void *pixels, int width, int height, const char *path,
                               hc_log *log)
{
    if (pixels == NULL || width < 1 || height < 1 || width > HC_SIDE_MAX || height > HC_SIDE_MAX) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s: picture of %d x %d pixels%s; sides are 1 to %d",
                       path, width, height, pixels == NULL ? " at NULL" : "", HC_SIDE_MAX);
    }
    return HC_OK;
}

hc_result hc_save_picture(const uint8_t *rgb, int width, int height, const char *path,
                          const hc_save_options *options, hc_log *log)
{
    const hc_format *format  = hc_format_by_ending(path);
    const hc_result  checked = check_picture(rgb, width, height, path, log);
    if (checked != HC_OK) {
        return checked;
    }
    if (format == NULL || format->write != hc_write_png) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: pictures are written as PNG; end it in .png",
                       path);
    }
    const hc_image image = { .data     = (void *)(uintptr_t)rgb, /* writers only read */
                             .type     = HC_U8,
                             .width    = width,
                             .height   = height,
                             .channels = 3,
                             .levels   = 1,
                             .bits     = 8 };
    return write_file(format, &image, path, resolve(options).overwrite, log);
}

hc_result hc_save_floats(const float *values, int width, int height, int channels, const char *path,
                         const hc_save_options *options, hc_log *log)
{
    const hc_format *format  = hc_format_by_ending(path);
    const hc_result  checked = check_picture(values, width, height, path, log);
    if (checked != HC_OK) {
        return checked;
    }
    if (channels != 1 && channels != 3) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s: picture of %d channels; 1 or 3 are written",
                       path, channels);
    }
    const bool one = format != NULL && channels == 1
                     && (format->write == hc_write_pfm || format->write == hc_write_npy);
    if (!one && (format == NULL || format->write != hc_write_exr)) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: floats are written as EXR%s; end it in .exr",
                       path, channels == 1 ? ", PFM or NPY" : "");
    }
    const hc_image image = { .data     = (void *)(uintptr_t)values, /* writers only read */
                             .type     = HC_F32,
                             .width    = width,
                             .height   = height,
                             .channels = channels,
                             .levels   = 1,
                             .bits     = 32 };
    return write_file(format, &image, path, resolve(options).overwrite, log);
}
