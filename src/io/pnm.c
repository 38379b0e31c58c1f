/* PGM and PPM, binary and plain, 8 and 16 bits. A header comment carries the metadata. */
#include "io_internal.h"

#include "base/fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BUFFER_SIZE = 1 << 16, LINE_SIZE = HC_TEXT_SIZE, NUMBER_MAX = 100000000 };

/* Bytes one after another, as plain samples need them. */
typedef struct reader {
    const hc_source *source;
    uint64_t         next; /* file offset of what is read into the buffer next */
    size_t           used, filled;
    uint8_t          buffer[BUFFER_SIZE];
} reader;

/* The next byte, or -1 at the end. */
static int take_byte(reader *from)
{
    if (from->used == from->filled) {
        from->filled = hc_source_read(from->source, from->next, from->buffer, BUFFER_SIZE);
        from->used   = 0;
        from->next += from->filled;
        if (from->filled == 0) {
            return -1;
        }
    }
    return from->buffer[from->used++];
}

static uint64_t position(const reader *from)
{
    return from->next - (from->filled - from->used);
}

static bool is_space(int byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

/* A comment runs to the end of its line; one of them may be ours. */
static void take_comment(reader *from, hc_image *image)
{
    char   line[LINE_SIZE];
    size_t length = 0;
    for (int byte = take_byte(from); byte >= 0 && byte != '\n' && byte != '\r';
         byte     = take_byte(from)) {
        const bool leading_blank = length == 0 && byte == ' ';
        if (!leading_blank && length < sizeof line) {
            line[length++] = (char)byte;
        }
    }
    if (image != NULL) {
        hc_image_take_text(image, line, length);
    }
}

/* The next number, and the one byte behind it; -1 if there is none or it is absurd. */
static int take_number(reader *from, hc_image *image)
{
    int byte = take_byte(from);
    while (is_space(byte) || byte == '#') {
        if (byte == '#') {
            take_comment(from, image);
        }
        byte = take_byte(from);
    }
    int number = byte >= '0' && byte <= '9' ? 0 : -1;
    while (byte >= '0' && byte <= '9') {
        number = number * 10 + (byte - '0');
        if (number > NUMBER_MAX) {
            return -1;
        }
        byte = take_byte(from);
    }
    return is_space(byte) || byte < 0 ? number : -1;
}

static hc_result bad_header(const hc_source *source, const char *what, int value, hc_log *log)
{
    return hc_fail(log, HC_ERROR_FORMAT, "%s: PNM header without a good %s (%d); write it again",
                   source->name, what, value);
}

static hc_result above_maxval(const hc_source *source, size_t index, const hc_image *image,
                              int value, hc_log *log)
{
    const size_t pixel = index / (size_t)image->channels;
    return hc_fail(log, HC_ERROR_FORMAT,
                   "%s: sample %d at (%zu, %zu) is above the header's largest value %.0f; correct "
                   "the header",
                   source->name, value, pixel % (size_t)image->width, pixel / (size_t)image->width,
                   image->type_max);
}

static void put(const hc_image *image, size_t index, int value)
{
    if (image->type == HC_U8) {
        ((uint8_t *)image->data)[index] = (uint8_t)value;
    } else {
        ((uint16_t *)image->data)[index] = (uint16_t)value;
    }
}

static hc_result read_plain(reader *from, const hc_image *image, hc_log *log)
{
    const size_t count = hc_image_samples(image);
    for (size_t i = 0; i < count; i++) {
        const int value = take_number(from, NULL);
        if (value < 0) {
            return hc_fail(log, HC_ERROR_FORMAT,
                           "%s: has %zu good numbers where %zu samples are needed; write it again",
                           from->source->name, i, count);
        }
        if (value > (int)image->type_max) {
            return above_maxval(from->source, i, image, value, log);
        }
        put(image, i, value);
    }
    return HC_OK;
}

static hc_result read_binary(const reader *from, const hc_image *image, hc_log *log)
{
    const size_t    count = hc_image_samples(image);
    const size_t    size  = hc_sample_size(image->type);
    const hc_result result =
        hc_read_samples(from->source, position(from), image->data, count, size, true, log);
    if (result != HC_OK || (int)image->type_max == (size == 1 ? 255 : 65535)) {
        return result;
    }
    for (size_t i = 0; i < count; i++) {
        const int value =
            size == 1 ? ((const uint8_t *)image->data)[i] : ((const uint16_t *)image->data)[i];
        if (value > (int)image->type_max) {
            return above_maxval(from->source, i, image, value, log);
        }
    }
    return HC_OK;
}

static hc_result read_from(reader *from, hc_image *image, bool header_only, hc_log *log)
{
    (void)take_byte(from); /* P */
    const int  kind   = take_byte(from);
    const bool plain  = kind == '2' || kind == '3';
    const bool colour = kind == '3' || kind == '6';
    if (!plain && kind != '5' && kind != '6') {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: PNM of kind P%c is not read; write PGM (P2, P5) or PPM (P3, P6)",
                       from->source->name, kind);
    }
    const int width  = take_number(from, image);
    const int height = width >= 0 ? take_number(from, image) : -1;
    const int maxval = height >= 0 ? take_number(from, image) : -1;
    if (width < 0 || height < 0) {
        return bad_header(from->source, width < 0 ? "width" : "height", -1, log);
    }
    if (maxval < 1 || maxval > 65535) {
        return bad_header(from->source, "largest value, 1 to 65535", maxval, log);
    }
    image->type     = maxval < 256 ? HC_U8 : HC_U16;
    image->bits     = maxval < 256 ? 8 : 16;
    image->type_max = maxval;
    image->levels   = 1;

    /* a plain sample takes a digit and a blank, the last one perhaps no blank */
    const double bytes_each = plain ? 2.0 : (double)hc_sample_size(image->type);
    const double samples    = (double)width * height * (colour ? 3 : 1);
    hc_result    result =
        hc_check_promise(from->source, samples * bytes_each - (plain ? 1.0 : 0.0), 1.0, log);
    if (result == HC_OK) {
        result = hc_image_prepare(image, from->source, (uint64_t)width, (uint64_t)height,
                                  colour ? 3 : 1, header_only, log);
    }
    if (result != HC_OK || header_only) {
        return result;
    }
    return plain ? read_plain(from, image, log) : read_binary(from, image, log);
}

hc_result hc_read_pnm(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    reader *from = calloc(1, sizeof *from);
    if (from == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to read it", source->name);
    }
    from->source           = source;
    const hc_result result = read_from(from, image, header_only, log);
    free(from);
    return result;
}

hc_result hc_write_pgm(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    char         header[HC_TEXT_SIZE + 64];
    const bool   wide   = image->type == HC_U16;
    const size_t count  = hc_image_samples(image);
    const int    length = snprintf(header, sizeof header, "P5\n# %s\n%d %d\n%d\n", image->text,
                                   image->width, image->height, wide ? 65535 : 255);
    (void)hc_output_append(output, header, (size_t)length);
    if (!wide) {
        (void)hc_output_append(output, image->data, count);
        return HC_OK;
    }
    const uint16_t *codes = image->data;
    uint8_t         chunk[BUFFER_SIZE];
    size_t          used = 0;
    for (size_t i = 0; i < count; i++) {
        chunk[used++] = (uint8_t)(codes[i] >> 8);
        chunk[used++] = (uint8_t)codes[i];
        if (used == sizeof chunk || i + 1 == count) {
            (void)hc_output_append(output, chunk, used);
            used = 0;
        }
    }
    return HC_OK;
}
