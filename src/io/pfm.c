/* PFM: float samples, bottom row first. */
#include "io_internal.h"

#include "base/fail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_MAX = 256 };

static bool is_space(char byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

/* The number that starts at *place, and past the one byte behind it; NAN if there is none. */
static double take_number(const char **place)
{
    char        *end;
    const double value = hc_parse_number(*place, &end);
    if (end == *place || !is_space(*end)) {
        return NAN;
    }
    *place = end + 1;
    return value;
}

static bool is_side(double value)
{
    return value >= 0.0 && value <= 1e9 && floor(value) >= value;
}

static hc_result read_rows(const hc_image *image, const hc_source *source, uint64_t offset,
                           bool big_endian, hc_log *log)
{
    const size_t row = (size_t)image->width * (size_t)image->channels;
    for (int y = 0; y < image->height; y++) {
        const size_t    below  = (size_t)(image->height - 1 - y);
        const hc_result result = hc_read_samples(source, offset + below * row * sizeof(float),
                                                 (float *)image->data + (size_t)y * row, row,
                                                 sizeof(float), big_endian, log);
        if (result != HC_OK) {
            return result;
        }
    }
    return HC_OK;
}

hc_result hc_read_pfm(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    char header[HEADER_MAX + 1] = "";
    (void)hc_source_read(source, 0, header, HEADER_MAX);
    const char  *rest   = header + 3; /* P, f or F, blank: hc_format_by_content saw them */
    const double width  = take_number(&rest);
    const double height = take_number(&rest);
    const double scale  = take_number(&rest);
    if (!is_side(width) || !is_side(height) || !isfinite(scale) || !(fabs(scale) > 0.0)) {
        return hc_fail(log, HC_ERROR_FORMAT,
                       "%s: PFM header without good width, height and scale (%g, %g, %g); write it "
                       "again",
                       source->name, width, height, scale);
    }
    image->type           = HC_F32;
    image->bits           = 32;
    image->levels         = 1;
    const int    channels = header[1] == 'F' ? 3 : 1;
    const double bytes    = width * height * channels * (double)sizeof(float);
    hc_result    result   = hc_check_promise(source, bytes, 1.0, log);
    if (result == HC_OK) {
        result = hc_image_prepare(image, source, (uint64_t)width, (uint64_t)height,
                                  (uint64_t)channels, header_only, log);
    }
    if (result != HC_OK || header_only) {
        return result;
    }
    /* the scale's sign is the byte order; its size would scale heights that are normalised
     * anyway */
    return read_rows(image, source, (uint64_t)(rest - header), scale > 0.0, log);
}

hc_result hc_write_pfm(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    char         header[64];
    const size_t row = (size_t)image->width * (size_t)image->channels;
    const int    length =
        snprintf(header, sizeof header, "Pf\n%d %d\n-1.0\n", image->width, image->height);
    (void)hc_output_append(output, header, (size_t)length);
    for (int y = image->height - 1; y >= 0; y--) {
        (void)hc_append_samples(output, (const float *)image->data + (size_t)y * row, row,
                                sizeof(float));
    }
    return HC_OK;
}
