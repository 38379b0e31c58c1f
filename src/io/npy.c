/* NPY: NumPy's array file. The header is a Python dictionary; the metadata is a comment behind it,
 * which Python's own parser skips.
 * After: the format description in NumPy's documentation (versions 1, 2 and 3). */
#include "io_internal.h"

#include "base/fail.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_MAX = 1 << 16, AXES_MAX = 8, PREFIX = 10, ALIGNMENT = 64 };

static const uint8_t magic[6] = { 0x93, 'N', 'U', 'M', 'P', 'Y' };

/* What the dictionary says. */
typedef struct description {
    char     order; /* '<', '>', '|', '=' */
    char     type[4];
    bool     columns_first;
    int      axes;
    uint64_t shape[AXES_MAX];
    bool     has_type, has_order, has_shape;
} description;

static const struct {
    char           name[4];
    hc_sample_type type;
} types[] = {
    { "u1", HC_U8 },  { "u2", HC_U16 }, { "i2", HC_I16 }, { "u4", HC_U32 },
    { "i4", HC_I32 }, { "f4", HC_F32 }, { "f8", HC_F64 },
};

static hc_result bad_header(const hc_source *source, const char *near_text, hc_log *log)
{
    return hc_fail(log, HC_ERROR_FORMAT,
                   "%s: NPY header makes no sense near \"%.24s\"; save the array again",
                   source->name, near_text);
}

/* ---- the dictionary -------------------------------------------------------------------------- */

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t\r\n");
}

/* Past `wanted` and the blanks around it; NULL if something else is there. */
static const char *expect(const char *text, char wanted)
{
    text = skip_blanks(text);
    return *text == wanted ? skip_blanks(text + 1) : NULL;
}

/* A quoted word of at most size - 1 bytes; NULL if it is none. */
static const char *take_word(char *word, size_t size, const char *text)
{
    const char   quote  = *text;
    const char  *end    = quote == '\'' || quote == '"' ? strchr(text + 1, quote) : NULL;
    const size_t length = end != NULL ? (size_t)(end - text - 1) : size;
    if (length >= size) {
        return NULL;
    }
    memcpy(word, text + 1, length);
    word[length] = '\0';
    return end + 1;
}

static const char *take_shape(description *found, const char *text)
{
    text = expect(text, '(');
    while (text != NULL && *text != ')') {
        char                    *end;
        const unsigned long long side = strtoull(text, &end, 10);
        if (*text < '0' || *text > '9' || found->axes == AXES_MAX) {
            return NULL;
        }
        found->shape[found->axes++] = side;
        text                        = skip_blanks(end);
        if (*text == ',') {
            text = skip_blanks(text + 1);
        } else if (*text != ')') {
            return NULL;
        }
    }
    found->has_shape = text != NULL;
    return text != NULL ? text + 1 : NULL;
}

static const char *take_flag(description *found, const char *text)
{
    found->columns_first = strncmp(text, "True", 4) == 0;
    found->has_order     = found->columns_first || strncmp(text, "False", 5) == 0;
    return found->has_order ? text + (found->columns_first ? 4 : 5) : NULL;
}

static const char *take_type(description *found, const char *text)
{
    char        word[8];
    const char *rest = take_word(word, sizeof word, text);
    if (rest == NULL || strlen(word) != 3) {
        return NULL;
    }
    found->order = word[0];
    memcpy(found->type, word + 1, 3);
    found->has_type = strchr("<>|=", word[0]) != NULL;
    return found->has_type ? rest : NULL;
}

/* Returns where it stopped making sense, or NULL if all is well; then *rest is what follows the
 * dictionary. */
static const char *parse_dictionary(description *found, const char *text, const char **rest)
{
    const char *place = expect(text, '{');
    if (place == NULL) {
        return text;
    }
    while (*place != '}') {
        char        key[24];
        const char *here  = place;
        const char *value = take_word(key, sizeof key, place);
        value             = value != NULL ? expect(value, ':') : NULL;
        if (value == NULL) {
            return here;
        }
        if (strcmp(key, "descr") == 0) {
            place = take_type(found, value);
        } else if (strcmp(key, "fortran_order") == 0) {
            place = take_flag(found, value);
        } else if (strcmp(key, "shape") == 0 && !found->has_shape) {
            place = take_shape(found, value);
        } else {
            return here;
        }
        if (place == NULL) {
            return value;
        }
        place = skip_blanks(place);
        if (*place == ',') {
            place = skip_blanks(place + 1);
        } else if (*place != '}') {
            return place;
        }
    }
    *rest = skip_blanks(place + 1);
    return found->has_type && found->has_order && found->has_shape ? NULL : text;
}

/* ---- in -------------------------------------------------------------------------------------- */

/* Read the header text, zero-terminated, to be freed; *offset becomes that of the samples. */
static hc_result read_header(char **header, uint64_t *offset, const hc_source *source, hc_log *log)
{
    uint8_t   prefix[12] = { 0 };
    hc_result result     = hc_source_need(source, 0, prefix, PREFIX, log);
    if (result != HC_OK) {
        return result;
    }
    const bool   wide  = prefix[6] >= 2;
    const size_t start = wide ? 12 : PREFIX;
    (void)hc_source_read(source, 0, prefix, start);
    const uint32_t length = wide ? hc_get_le32(prefix + 8) : hc_get_le16(prefix + 8);
    if (prefix[6] < 1 || prefix[6] > 3 || length > HEADER_MAX) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: NPY of version %d with a header of %u bytes is not read; save a plain "
                       "array as version 1",
                       source->name, prefix[6], length);
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
        text = skip_blanks(text + 1);
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
                              const description *found, hc_log *log)
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

static hc_result read_described(hc_image *image, const hc_source *source, const description *found,
                                uint64_t offset, bool header_only, hc_log *log)
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
    char       *header = NULL;
    uint64_t    offset = 0;
    description found  = { .order = '|' };
    hc_result   result = read_header(&header, &offset, source, log);
    if (result == HC_OK) {
        const char *rest = "";
        const char *bad  = parse_dictionary(&found, header, &rest);
        if (bad != NULL) {
            result = bad_header(source, bad, log);
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
    char        text[HC_TEXT_SIZE + 256];
    char        channels[16] = "";
    const char *type         = image->type == HC_U8 ? "|u1" : image->type == HC_U16 ? "<u2" : "<f4";
    if (image->channels > 1) {
        (void)snprintf(channels, sizeof channels, ", %d", image->channels);
    }
    const int length = snprintf(
        text, sizeof text, "{'descr': '%s', 'fortran_order': False, 'shape': (%d, %d%s), }%s%s",
        type, image->height, image->width, channels, image->text[0] != '\0' ? "  # " : "",
        image->text);
    /* blanks and a newline fill the header up, so that the samples are aligned */
    const size_t total  = (PREFIX + (size_t)length + 1 + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    const size_t padded = total - PREFIX;
    uint8_t      prefix[PREFIX] = { 0, 0, 0, 0, 0, 0, 1, 0, 0, 0 };
    memcpy(prefix, magic, sizeof magic);
    hc_put_le16(prefix + 8, (uint16_t)padded);
    (void)hc_output_append(output, prefix, sizeof prefix);
    (void)hc_output_append(output, text, (size_t)length);
    for (size_t i = (size_t)length; i < padded; i++) {
        (void)hc_output_append(output, i + 1 < padded ? " " : "\n", 1);
    }
    (void)hc_append_samples(output, image->data, hc_image_samples(image),
                            hc_sample_size(image->type));
    return HC_OK;
}
