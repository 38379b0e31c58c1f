/* Raw samples to heights: pick a channel, find the range, map it to 0..1, settle the holes. */
#include "holes.h"
#include "shape.h"

#include <math.h>
#include <string.h>

/* Heights that use less of the type's range than this get a warning. */
#define POOR_USE (1.0 / 16.0)

enum { LUMA = -1 }; /* in place of a channel's index */

/* Everything the passes over the samples need to know. */
typedef struct source {
    const char    *data;
    hc_sample_type type;
    size_t         element_bytes, texel_bytes;
    int            width, height;
    int            channel; /* 0 .. 3 or LUMA */
    bool           has_nodata;
    double         nodata; /* as the type holds it */
} source;

typedef struct survey {
    double lowest, highest; /* of the valid samples */
    size_t holes;
    int    hole_x, hole_y; /* the first hole */
    double hole_value;
} survey;

/* From raw value to height: (value - low) / span, all three times `scale`, which keeps `span`
 * finite. */
typedef struct mapping {
    double low, high;
    double scaled_low, scaled_span, scale;
    bool   invert;
} mapping;

/* Copied out byte by byte, since rows of a file in memory need not be aligned. */
static double element_at(const source *from, const char *bytes)
{
    union {
        uint8_t  u8;
        uint16_t u16;
        int16_t  i16;
        uint32_t u32;
        int32_t  i32;
        float    f32;
        double   f64;
    } element;
    switch (from->type) {
    case HC_U8: memcpy(&element.u8, bytes, sizeof element.u8); return element.u8;
    case HC_U16: memcpy(&element.u16, bytes, sizeof element.u16); return element.u16;
    case HC_I16: memcpy(&element.i16, bytes, sizeof element.i16); return element.i16;
    case HC_U32: memcpy(&element.u32, bytes, sizeof element.u32); return element.u32;
    case HC_I32: memcpy(&element.i32, bytes, sizeof element.i32); return element.i32;
    case HC_F32: memcpy(&element.f32, bytes, sizeof element.f32); return (double)element.f32;
    case HC_F64: memcpy(&element.f64, bytes, sizeof element.f64); return element.f64;
    }
    return NAN;
}

static bool is_hole(const source *from, double value)
{
    return !isfinite(value) || (from->has_nodata && value == from->nodata);
}

/* Value of one texel; *hole tells whether it is one. Luma is a hole where any of its channels is
 * not finite, and where all of them are nodata: a single channel may well have that value by
 * right. */
static double value_at(const source *from, int x, int y, bool *hole)
{
    const size_t texel = (size_t)y * (size_t)from->width + (size_t)x;
    const char  *bytes = from->data + texel * from->texel_bytes;
    if (from->channel != LUMA) {
        const double value = element_at(from, bytes + (size_t)from->channel * from->element_bytes);
        *hole              = is_hole(from, value);
        return value;
    }
    const double red   = element_at(from, bytes);
    const double green = element_at(from, bytes + from->element_bytes);
    const double blue  = element_at(from, bytes + 2 * from->element_bytes);
    const double luma  = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    *hole = !isfinite(luma) || (is_hole(from, red) && is_hole(from, green) && is_hole(from, blue));
    return luma;
}

/* True if the first three channels hold the same bytes everywhere. */
static bool is_grey(const hc_samples *samples)
{
    const size_t bytes  = hc_sample_size(samples->type);
    const size_t texel  = bytes * (size_t)samples->channels;
    const size_t texels = (size_t)samples->width * (size_t)samples->height;
    const char  *at     = samples->data;
    for (size_t i = 0; i < texels; i++, at += texel) {
        if (memcmp(at, at + bytes, bytes) != 0 || memcmp(at, at + 2 * bytes, bytes) != 0) {
            return false;
        }
    }
    return true;
}

/* Index of the wanted channel, LUMA, or below that: not there. */
static int find_channel(const hc_samples *samples, hc_channel wanted)
{
    enum { MISSING = LUMA - 1 };
    const int channels = samples->channels;
    switch (wanted) {
    case HC_CHANNEL_AUTO: return channels < 3 || is_grey(samples) ? 0 : LUMA;
    case HC_CHANNEL_R: return 0;
    case HC_CHANNEL_G: return channels >= 2 ? 1 : MISSING;
    case HC_CHANNEL_B: return channels >= 3 ? 2 : MISSING;
    case HC_CHANNEL_A: return channels == 2 ? 1 : channels == 4 ? 3 : MISSING;
    case HC_CHANNEL_LUMA: return channels >= 3 ? LUMA : 0;
    }
    return MISSING;
}

static hc_result check_samples(const float *heights, const hc_samples *samples, hc_log *log)
{
    if (heights == NULL || samples == NULL || samples->data == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "heights, samples or samples.data is NULL");
    }
    if (hc_sample_size(samples->type) == 0) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "samples.type is %d; known are 0 .. %d",
                       (int)samples->type, (int)HC_F64);
    }
    if (samples->channels < 1 || samples->channels > 4) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "samples.channels is %d; it must be 1 .. 4",
                       samples->channels);
    }
    return hc_check_shape("samples", samples->width, samples->height,
                          hc_sample_size(samples->type) * (size_t)samples->channels, log);
}

static hc_result check_options(const hc_normalise_options *options, hc_log *log)
{
    if ((unsigned)options->range > HC_RANGE_GIVEN || (unsigned)options->holes > HC_HOLES_LOWEST) {
        return hc_fail(
            log, HC_ERROR_ARGUMENT, "range is %d and holes is %d; known are 0 .. %d and 0 .. %d",
            (int)options->range, (int)options->holes, (int)HC_RANGE_GIVEN, (int)HC_HOLES_LOWEST);
    }
    if (options->range == HC_RANGE_GIVEN
        && (!isfinite(options->low) || !isfinite(options->high) || options->low == options->high)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "the given range is %.17g to %.17g; its ends must be finite and differ",
                       options->low, options->high);
    }
    if (!(options->type_max >= 0.0) || !isfinite(options->type_max)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "type_max is %g; it must be finite and >= 0",
                       options->type_max);
    }
    return HC_OK;
}

static hc_result find_source(source *from, const hc_samples *samples,
                             const hc_normalise_options *options, const hc_elevation *elevation,
                             hc_log *log)
{
    const size_t bytes   = hc_sample_size(samples->type);
    const int    channel = find_channel(samples, options->channel);
    if (channel < LUMA) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "channel %d (1 R, 2 G, 3 B, 4 A) is not there: the samples have %d channels",
                       (int)options->channel, samples->channels);
    }
    *from = (source){ .data          = samples->data,
                      .type          = samples->type,
                      .element_bytes = bytes,
                      .texel_bytes   = bytes * (size_t)samples->channels,
                      .width         = samples->width,
                      .height        = samples->height,
                      .channel       = channel };
    if (elevation != NULL && elevation->has_nodata) {
        from->has_nodata = true;
        /* Files name the value in decimal; float samples hold it rounded to float. */
        from->nodata =
            samples->type == HC_F32 ? (double)(float)elevation->nodata : elevation->nodata;
    }
    return HC_OK;
}

static survey survey_samples(const source *from)
{
    survey found = { .lowest = INFINITY, .highest = -INFINITY };
    for (int y = 0; y < from->height; y++) {
        for (int x = 0; x < from->width; x++) {
            bool         hole;
            const double value = value_at(from, x, y, &hole);
            if (!hole) {
                found.lowest  = fmin(found.lowest, value);
                found.highest = fmax(found.highest, value);
            } else if (found.holes++ == 0) {
                found.hole_x     = x;
                found.hole_y     = y;
                found.hole_value = value;
            }
        }
    }
    return found;
}

static hc_result check_holes(const survey *found, const source *from, hc_holes policy, hc_log *log)
{
    const size_t samples = (size_t)from->width * (size_t)from->height;
    if (found->holes == samples) {
        return hc_fail(log, HC_ERROR_FIELD,
                       "none of %zu samples has a height: all are NaN, infinite or nodata",
                       samples);
    }
    if (found->holes > 0 && policy == HC_HOLES_ERROR) {
        return hc_fail(
            log, HC_ERROR_FIELD,
            "%zu of %zu samples have no height (NaN, infinite or nodata), the first at [%d, %d]: "
            "%.9g; set holes to fill or lowest",
            found->holes, samples, found->hole_x, found->hole_y, found->hole_value);
    }
    return HC_OK;
}

static double type_max(const source *from, double given)
{
    static const double largest[] = { UINT8_MAX, UINT16_MAX, INT16_MAX, UINT32_MAX,
                                      INT32_MAX, 1.0,        1.0 };
    const bool          whole     = from->type < HC_F32;
    return whole && given > 0.0 ? given : largest[from->type];
}

/* HC_RANGE_AUTO resolved. */
static hc_range find_range(const source *from, hc_range wanted, const hc_elevation *elevation)
{
    if (wanted != HC_RANGE_AUTO) {
        return wanted;
    }
    const bool measured = from->type >= HC_F32 || (elevation != NULL && elevation->placed);
    return measured ? HC_RANGE_DATA : HC_RANGE_TYPE;
}

static mapping make_mapping(double low, double high, bool invert)
{
    mapping map     = { .low = low, .high = high, .invert = invert };
    map.scale       = isinf(high - low) ? 0.5 : 1.0;
    map.scaled_low  = low * map.scale;
    map.scaled_span = high * map.scale - map.scaled_low;
    return map;
}

static mapping choose_mapping(const source *from, const survey *found, hc_range range,
                              const hc_normalise_options *options)
{
    switch (range) {
    case HC_RANGE_GIVEN: return make_mapping(options->low, options->high, options->invert);
    case HC_RANGE_TYPE:
        return make_mapping(0.0, type_max(from, options->type_max), options->invert);
    default: return make_mapping(found->lowest, found->highest, options->invert);
    }
}

static double position_of(const mapping *map, double value)
{
    return map->scaled_span == 0.0 ? 0.0
                                   : (value * map->scale - map->scaled_low) / map->scaled_span;
}

static float height_of(const mapping *map, double value)
{
    const double position = fmin(fmax(position_of(map, value), 0.0), 1.0);
    /* Adding 0 turns the -0 of a falling range into 0. */
    return (float)(map->invert ? 1.0 - position : position + 0.0);
}

static void write_heights(float *heights, const source *from, const mapping *map)
{
    for (int y = 0; y < from->height; y++) {
        float *row = heights + (size_t)y * (size_t)from->width;
        for (int x = 0; x < from->width; x++) {
            bool         hole;
            const double value = value_at(from, x, y, &hole);
            row[x]             = hole ? HC_HOLE : height_of(map, value);
        }
    }
}

static void warn_about_type_range(const survey *found, const mapping *map, const hc_log *log)
{
    if (found->lowest < map->low || found->highest > map->high) {
        hc_warn(
            log,
            "samples from %.9g to %.9g reach beyond the type's range of 0 to %.9g and were clamped",
            found->lowest, found->highest, map->high);
    }
    const double used =
        fmin(position_of(map, found->highest), 1.0) - fmax(position_of(map, found->lowest), 0.0);
    if (used < POOR_USE) {
        hc_warn(
            log,
            "heights use %.2g %% of the type's range (%.9g to %.9g of 0 to %.9g); normalise by the "
            "data or by a given range to use all of it",
            100.0 * fmax(used, 0.0), found->lowest, found->highest, map->high);
    }
}

static void describe(hc_elevation *elevation, const source *from, const mapping *map)
{
    elevation->low         = map->invert ? map->high : map->low;
    elevation->high        = map->invert ? map->low : map->high;
    elevation->source_bits = (int)from->element_bytes * 8;
}

static hc_result settle_holes(float *heights, const source *from, hc_holes policy, hc_log *log)
{
    if (policy == HC_HOLES_FILL) {
        return hc_fill_holes(heights, from->width, from->height, log);
    }
    hc_lower_holes(heights, from->width, from->height);
    return HC_OK;
}

hc_result hc_normalise(float *heights, const hc_samples *samples,
                       const hc_normalise_options *options, hc_elevation *elevation, hc_log *log)
{
    static const hc_normalise_options defaults = { 0 };
    source                            from     = { 0 };
    if (options == NULL) {
        options = &defaults;
    }
    hc_result result = check_samples(heights, samples, log);
    if (result == HC_OK) {
        result = check_options(options, log);
    }
    if (result == HC_OK) {
        result = find_source(&from, samples, options, elevation, log);
    }
    if (result != HC_OK) {
        return result;
    }
    const survey found = survey_samples(&from);
    result             = check_holes(&found, &from, options->holes, log);
    if (result != HC_OK) {
        return result;
    }
    const hc_range range = find_range(&from, options->range, elevation);
    const mapping  map   = choose_mapping(&from, &found, range, options);
    write_heights(heights, &from, &map);
    if (found.holes > 0) {
        result = settle_holes(heights, &from, options->holes, log);
    }
    if (result == HC_OK && range == HC_RANGE_TYPE) {
        warn_about_type_range(&found, &map, log);
    }
    if (result == HC_OK && elevation != NULL) {
        describe(elevation, &from, &map);
    }
    return result;
}
