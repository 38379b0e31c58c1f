/* Files -> fields, maps and descriptions. */
#include "io_internal.h"

#include "base/fail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- messages of code that does not know the file's name ------------------------------------- */

typedef struct named_log {
    hc_log        log; /* first: what the callee gets */
    const char   *name;
    const hc_log *outer;
} named_log;

static void warn_named(void *user, const char *line)
{
    const named_log *named = user;
    hc_warn(named->outer, "%s: %s", named->name, line);
}

/* ---- fields ---------------------------------------------------------------------------------- */

static bool has_heights(hc_layout layout)
{
    return layout != HC_LAYOUT_QUAD && layout != HC_LAYOUT_GRADIENT;
}

/* Files that heightcast wrote say themselves what their samples mean: heights, as codes of the full
 * range or as floats in 0..1. `original` [out] is the elevation they carry. */
static hc_result follow_text(hc_normalise_options *options, hc_elevation *original,
                             const hc_image *image, const char *name, hc_log *log)
{
    if (hc_text_is_map(image->text)) {
        hc_map_info     info;
        const hc_result parsed = hc_text_to_map(&info, image->text, name, log);
        if (parsed != HC_OK) {
            return parsed;
        }
        if (!has_heights(info.layout) && options->channel == HC_CHANNEL_AUTO) {
            return hc_fail(
                log, HC_ERROR_UNSUPPORTED,
                "%s: is a map of layout %s, which holds no heights; choose a channel, or "
                "another file",
                name, hc_layout_name(info.layout));
        }
        options->channel = options->channel == HC_CHANNEL_AUTO ? HC_CHANNEL_R : options->channel;
        *original        = info.elevation;
    } else {
        const hc_result parsed = hc_text_to_field(original, image->text, name, log);
        if (parsed != HC_OK) {
            return parsed;
        }
    }
    options->range = options->range == HC_RANGE_AUTO ? HC_RANGE_TYPE : options->range;
    return HC_OK;
}

/* Largest code of the type; 1 for floats. */
static double largest_code(const hc_image *image)
{
    if (image->type_max > 0.0) {
        return image->type_max;
    }
    switch (image->type) {
    case HC_U8: return 255.0;
    case HC_U16: return 65535.0;
    case HC_I16: return 32767.0;
    case HC_U32: return 4294967295.0;
    case HC_I32: return 2147483647.0;
    default: return 1.0;
    }
}

/* `found` is in codes, of which 0 .. largest stand for original->low .. high. */
static hc_elevation to_original(const hc_elevation *found, const hc_elevation *original,
                                double largest)
{
    hc_elevation combined = *original;
    const double range    = original->high - original->low;
    combined.low          = original->low + found->low / largest * range;
    combined.high         = original->low + found->high / largest * range;
    combined.source_bits  = original->source_bits != 0 ? original->source_bits : found->source_bits;
    return combined;
}

static hc_result make_field(hc_field *field, float *heights, const hc_image *image,
                            const hc_load_options *options, const char *name, hc_log *log)
{
    hc_normalise_options normalise = options->normalise;
    hc_elevation         original  = { 0 };
    hc_elevation         elevation = image->elevation;
    const bool           ours      = image->text[0] != '\0';
    if (ours) {
        const hc_result followed = follow_text(&normalise, &original, image, name, log);
        if (followed != HC_OK) {
            return followed;
        }
        elevation = (hc_elevation){ 0 };
    }
    if (!(normalise.type_max > 0.0)) {
        normalise.type_max = image->type_max;
    }
    const hc_samples samples = { image->data, image->type, image->width, image->height,
                                 image->channels };
    named_log        named   = { .name = name, .outer = log };
    named.log                = (hc_log){ .warn = warn_named, .user = &named };
    const hc_result result   = hc_normalise(heights, &samples, &normalise, &elevation, &named.log);
    if (result != HC_OK) {
        return hc_fail(log, result, "%s: %s", name, named.log.text);
    }
    *field = (hc_field){ .heights      = heights,
                         .width        = image->width,
                         .height       = image->height,
                         .wrap         = options->wrap,
                         .registration = options->registration,
                         .elevation = ours ? to_original(&elevation, &original, largest_code(image))
                                           : elevation };
    return HC_OK;
}

static void warn_of_srgb(const hc_image *image, const char *name, const hc_log *log)
{
    if (image->srgb) {
        hc_warn(
            log,
            "%s: is tagged as sRGB; its samples are taken as linear heights, so write it without "
            "a colour profile if that is what they are",
            name);
    }
}

hc_result hc_load_field_source(hc_field *field, const hc_source *source,
                               const hc_load_options *options, hc_log *log)
{
    static const hc_load_options none  = { 0 };
    const hc_load_options       *given = options != NULL ? options : &none;
    hc_image                     image = { .levels = 1 };
    *field                             = (hc_field){ 0 };
    hc_result result = given->raw_width > 0 ? hc_read_raw(&image, source, given, log)
                                            : hc_read_image(&image, NULL, source, false, log);
    if (result != HC_OK) {
        hc_image_free(&image);
        return result;
    }
    warn_of_srgb(&image, source->name, log);
    const size_t count   = (size_t)image.width * (size_t)image.height;
    float       *heights = malloc(count * sizeof *heights);
    if (heights == NULL) {
        result =
            hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for %zu heights", source->name, count);
    } else {
        result = make_field(field, heights, &image, given, source->name, log);
    }
    if (result != HC_OK) {
        free(heights);
    }
    hc_image_free(&image);
    return result;
}

hc_result hc_load_field(hc_field *field, const char *path, const hc_load_options *options,
                        hc_log *log)
{
    hc_source source;
    *field = (hc_field){ 0 };
    hc_result result =
        hc_source_open(&source, path, options != NULL ? &options->limits : NULL, log);
    if (result == HC_OK) {
        result = hc_load_field_source(field, &source, options, log);
    }
    hc_source_close(&source);
    return result;
}

void hc_free_field(hc_field *field)
{
    if (field != NULL) {
        /* heights are const for those who only read them; this library allocated them */
        free((void *)(uintptr_t)field->heights);
        *field = (hc_field){ 0 };
    }
}

/* ---- maps ------------------------------------------------------------------------------------ */

static hc_result check_map(const hc_map_info *info, const hc_image *image, const char *name,
                           hc_log *log)
{
    const int bits = (int)hc_sample_size(image->type) * 8;
    if (info->width != image->width || info->height != image->height
        || info->channels != image->channels || info->levels != image->levels
        || info->bits != bits) {
        return hc_fail(
            log, HC_ERROR_FORMAT,
            "%s: holds %d x %d texels, %d channels, %d levels of %d bits, but was baked as "
            "%d x %d, %d, %d, %d; it was changed since: bake it again",
            name, image->width, image->height, image->channels, image->levels, bits, info->width,
            info->height, info->channels, info->levels, info->bits);
    }
    return HC_OK;
}

hc_result hc_load_map_source(hc_map *map, const hc_source *source, hc_log *log)
{
    hc_image    image;
    hc_map_info info;
    *map             = (hc_map){ .texels = NULL };
    hc_result result = hc_read_image(&image, NULL, source, false, log);
    if (result != HC_OK) {
        return result;
    }
    result = hc_text_to_map(&info, image.text, source->name, log);
    if (result == HC_OK) {
        result = check_map(&info, &image, source->name, log);
    }
    if (result != HC_OK) {
        hc_image_free(&image);
        return result;
    }
    warn_of_srgb(&image, source->name, log);
    *map = (hc_map){ .info = info, .texels = image.data };
    return HC_OK;
}

hc_result hc_load_map(hc_map *map, const char *path, const hc_limits *limits, hc_log *log)
{
    hc_source source;
    *map             = (hc_map){ .texels = NULL };
    hc_result result = hc_source_open(&source, path, limits, log);
    if (result == HC_OK) {
        result = hc_load_map_source(map, &source, log);
    }
    hc_source_close(&source);
    return result;
}

void hc_free_map(hc_map *map)
{
    if (map != NULL) {
        free(map->texels);
        *map = (hc_map){ .texels = NULL };
    }
}

/* ---- what a file is -------------------------------------------------------------------------- */

hc_result hc_read_source_info(hc_file_info *info, const hc_source *source, hc_log *log)
{
    hc_image image;
    *info            = (hc_file_info){ .width = 0 };
    hc_result result = hc_read_image(&image, info->format, source, true, log);
    if (result == HC_OK && hc_text_is_map(image.text)) {
        result          = hc_text_to_map(&info->map, image.text, source->name, log);
        info->has_map   = result == HC_OK;
        image.elevation = info->map.elevation;
    } else if (result == HC_OK && image.text[0] != '\0') {
        result = hc_text_to_field(&image.elevation, image.text, source->name, log);
    }
    if (result != HC_OK) {
        *info = (hc_file_info){ .width = 0 };
        return result;
    }
    info->width     = image.width;
    info->height    = image.height;
    info->channels  = image.channels;
    info->type      = image.type;
    info->bits      = image.bits;
    info->srgb      = image.srgb;
    info->elevation = image.elevation;
    return HC_OK;
}

hc_result hc_read_file_info(hc_file_info *info, const char *path, const hc_limits *limits,
                            hc_log *log)
{
    hc_source source;
    *info            = (hc_file_info){ .width = 0 };
    hc_result result = hc_source_open(&source, path, limits, log);
    if (result == HC_OK) {
        result = hc_read_source_info(info, &source, log);
    }
    hc_source_close(&source);
    return result;
}
