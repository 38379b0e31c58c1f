/* NPY: NumPy's array file. The header is a Python dictionary; the metadata is a comment behind it,
 * which Python's own parser skips.
 * After: the format description in NumPy's documentation (versions 1, 2 and 3). */
#include "npy_header.h"

#include "base/fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    char           name[4];
    hc_sample_type type;
} types[] = {
    { "u1", HC_U8 },  { "u2", HC_U16 }, { "i2", HC_I16 }, { "u4", HC_U32 },
    { "i4", HC_I32 }, { "f4", HC_F32 }, { "f8", HC_F64 },
};

/* ---- in -------------------------------------------------------------------------------------- */

/* Read the header text, zero-terminated, to be freed; *offset becomes that of the samples. */
static hc_result read_header(char **header, uint64_t *offset, const hc_source *source, hc_log *log)
{
    uint8_t   prefix[HC_NPY_PREFIX_MAX] = { 0 };
    uint32_t  length;
    size_t    start;
    hc_result result = hc_source_need(source, 0, prefix, HC_NPY_PREFIX, log);
    if (result == HC_OK) {
        (void)hc_source_read(source, 0, prefix, sizeof prefix);
        result = hc_npy_read_prefix(&length, &start, prefix, source->name, log);
    }
    if (result != HC_OK) {
        return result;
    }
    *header = calloc(1, (size_t)length + 1);
    if (*header == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for its header", source->name);
    }
    *offset = start + length;
    return hc_source_need(source, start, *header, length, log);
}

static void take_comment(hc_image *image, const char *text)
{
    if (*text == '#') {
        text = hc_npy_skip_blanks(text + 1);
        hc_image_take_text(image, text, strcspn(text, "\n"));
    }
}

/* Column-major samples, in the file's order, to interleaved rows. */
static void transpose(uint8_t *rows, const uint8_t *columns, const hc_image *image, size_t size)
{
    const size_t width    = (size_t)image->width;
    const size_t height   = (size_t)image->height;
    const size_t channels = (size_t)image->channels;
    for (size_t y = 0; y < height; y++) {
        for (size_t x = 0; x < width; x++) {
            for (size_t c = 0; c < channels; c++) {
                memcpy(rows + ((y * width + x) * channels + c) * size,
                       columns + (y + height * (x + width * c)) * size, size);
            }
        }
    }
}

static hc_result read_samples(const hc_image *image, const hc_source *source, uint64_t offset,
                              const hc_npy_description *found, hc_log *log)
{
    const size_t count   = hc_image_samples(image);
    const size_t size    = hc_sample_size(image->type);
    const bool   foreign = found->order == '>' || (found->order == '=' && hc_host_is_big_endian());
    if (!found->columns_first) {
        return hc_read_samples(source, offset, image->data, count, size, foreign, log);
    }
    uint8_t *columns = malloc(count * size);
    if (columns == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to turn %zu samples into rows",
                       source->name, count);
    }
    const hc_result result = hc_read_samples(source, offset, columns, count, size, foreign, log);
    if (result == HC_OK) {
        transpose(image->data, columns, image, size);
    }
    free(columns);
    return result;
}

static hc_result read_described(hc_image *image, const hc_source *source,
                                const hc_npy_description *found, uint64_t offset, bool header_only,
                                hc_log *log)
{
    size_t i = 0;
    while (i < sizeof types / sizeof *types && strcmp(types[i].name, found->type) != 0) {
        i++;
    }
    if (i == sizeof types / sizeof *types) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: NPY with samples of type \"%s\" is not read; save u1, u2, i2, u4, i4, "
                       "f4 or f8",
                       source->name, found->type);
    }
    if (found->axes != 2 && found->axes != 3) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: NPY with %d axes is not read; save (height, width) or (height, width, "
                       "channels)",
                       source->name, found->axes);
    }
    image->type             = types[i].type;
    image->bits             = (int)hc_sample_size(image->type) * 8;
    image->levels           = 1;
    const uint64_t channels = found->axes == 3 ? found->shape[2] : 1;
    const double   bytes    = (double)found->shape[0] * (double)found->shape[1] * (double)channels
                         * (double)hc_sample_size(image->type);
    hc_result result = hc_check_promise(source, bytes, 1.0, log);
    if (result == HC_OK) {
        result = hc_image_prepare(image, source, found->shape[1], found->shape[0], channels,
                                  header_only, log);
    }
    return result != HC_OK || header_only ? result
                                          : read_samples(image, source, offset, found, log);
}

hc_result hc_read_npy(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    char              *header = NULL;
    uint64_t           offset = 0;
    hc_npy_description found  = { .order = '|' };
    hc_result          result = read_header(&header, &offset, source, log);
    if (result == HC_OK) {
        const char *rest = "";
        const char *bad  = hc_npy_parse(&found, header, &rest);
        if (bad != NULL) {
            result = hc_npy_bad_header(source->name, bad, log);
        } else {
            take_comment(image, rest);
            result = read_described(image, source, &found, offset, header_only, log);
        }
    }
    free(header);
    return result;
}

/* ---- out ------------------------------------------------------------------------------------- */

hc_result hc_write_npy(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    uint8_t     header[HC_NPY_TEXT_MAX];
    char        shape[48];
    const char *type   = image->type == HC_U8 ? "|u1" : image->type == HC_U16 ? "<u2" : "<f4";
    int         length = snprintf(shape, sizeof shape, "%d, %d", image->height, image->width);
    if (image->channels > 1) {
        (void)snprintf(shape + length, sizeof shape - (size_t)length, ", %d", image->channels);
    }
    (void)hc_output_append(output, header,
                           hc_npy_format_header(header, sizeof header, type, shape, image->text));
    (void)hc_append_samples(output, image->data, hc_image_samples(image),
                            hc_sample_size(image->type));
    return HC_OK;
}
