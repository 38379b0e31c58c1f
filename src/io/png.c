/* PNG through libspng: 1 to 16 bits, palettes expanded, metadata in a tEXt chunk. */
#include "io_internal.h"

#include "base/fail.h"

#include <spng.h>

#include <stdlib.h>
#include <string.h>

/* Deflate packs at most 1032 bytes into one. */
#define DEFLATE_RATIO 1032.0

/* Level 2 and one filter instead of the best of five for each row: files 2 to 3 % larger than those
 * of the library's defaults on height maps, in a third of the time. */
enum {
    CHUNK_CACHE = 1 << 26, /* bytes of text and profiles that a file may carry */
    ZIP_LEVEL   = 2
};

typedef struct stream {
    const hc_source *source;
    hc_output       *output;
    uint64_t         offset;
} stream;

static int pull(spng_ctx *context, void *user, void *bytes, size_t size)
{
    (void)context;
    stream *from = user;
    if (hc_source_read(from->source, from->offset, bytes, size) != size) {
        return SPNG_IO_EOF;
    }
    from->offset += size;
    return 0;
}

static int push(spng_ctx *context, void *user, void *bytes, size_t size)
{
    (void)context;
    const stream *to = user;
    return hc_output_append(to->output, bytes, size) ? 0 : SPNG_IO_ERROR;
}

static hc_result fail_reading(const hc_source *source, int error, hc_log *log)
{
    if (error == SPNG_EMEM) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to decode the PNG", source->name);
    }
    return hc_fail(log, HC_ERROR_FORMAT, "%s: damaged PNG: %s; write it again", source->name,
                   error == SPNG_IO_EOF ? "the file is cut off" : spng_strerror(error));
}

static void take_texts(hc_image *image, spng_ctx *context)
{
    uint32_t          count = 0;
    struct spng_text *texts = NULL;
    if (spng_get_text(context, NULL, &count) == 0 && count > 0) {
        texts = calloc(count, sizeof *texts);
    }
    if (texts != NULL && spng_get_text(context, texts, &count) == 0) {
        for (uint32_t i = 0; i < count; i++) {
            if (strcmp(texts[i].keyword, HC_TEXT_KEY) == 0) {
                hc_image_take_text(image, texts[i].text, texts[i].length);
            }
        }
    }
    free(texts);
}

static bool tagged_srgb(spng_ctx *context)
{
    uint8_t          intent;
    struct spng_iccp profile;
    return spng_get_srgb(context, &intent) == 0
           || (spng_get_iccp(context, &profile) == 0
               && (strstr(profile.profile_name, "sRGB") != NULL
                   || hc_profile_is_srgb(profile.profile, profile.profile_len)));
}

/* The decoder's output for a header: codes as they are, except that codes of less than 8 bits are
 * spread over 8 and palettes become colours. */
typedef struct decoding {
    int format;
    int flags;
    int channels;
} decoding;

static decoding choose_decoding(spng_ctx *context, const struct spng_ihdr *header)
{
    struct spng_trns transparency;
    switch (header->color_type) {
    case SPNG_COLOR_TYPE_INDEXED:
        if (spng_get_trns(context, &transparency) == 0) {
            return (decoding){ SPNG_FMT_RGBA8, SPNG_DECODE_TRNS, 4 };
        }
        return (decoding){ SPNG_FMT_RGB8, 0, 3 };
    case SPNG_COLOR_TYPE_GRAYSCALE:
        return (decoding){ header->bit_depth < 8 ? SPNG_FMT_G8 : SPNG_FMT_PNG, 0, 1 };
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA: return (decoding){ SPNG_FMT_PNG, 0, 2 };
    case SPNG_COLOR_TYPE_TRUECOLOR: return (decoding){ SPNG_FMT_PNG, 0, 3 };
    default: return (decoding){ SPNG_FMT_PNG, 0, 4 };
    }
}

static hc_result read_with(spng_ctx *context, hc_image *image, stream *from, bool header_only,
                           hc_log *log)
{
    struct spng_ihdr header;
    int              error = spng_set_chunk_limits(context, CHUNK_CACHE, CHUNK_CACHE);
    error                  = error != 0 ? error : spng_set_png_stream(context, pull, from);
    error                  = error != 0 ? error : spng_get_ihdr(context, &header);
    if (error != 0) {
        return fail_reading(from->source, error, log);
    }
    const decoding chosen = choose_decoding(context, &header);
    take_texts(image, context);
    image->srgb   = tagged_srgb(context);
    image->bits   = header.bit_depth;
    image->type   = header.bit_depth == 16 ? HC_U16 : HC_U8;
    image->levels = 1;

    const int stored_channels = header.color_type == SPNG_COLOR_TYPE_INDEXED ? 1 : chosen.channels;
    const double packed_bits  = (double)header.width * header.bit_depth * stored_channels;
    hc_result    result =
        hc_check_promise(from->source, packed_bits / 8.0 * header.height, DEFLATE_RATIO, log);
    if (result == HC_OK) {
        result = hc_image_prepare(image, from->source, header.width, header.height,
                                  (uint64_t)chosen.channels, header_only, log);
    }
    if (result != HC_OK || header_only) {
        return result;
    }
    error =
        spng_decode_image(context, image->data, hc_image_bytes(image), chosen.format, chosen.flags);
    return error != 0 ? fail_reading(from->source, error, log) : HC_OK;
}

hc_result hc_read_png(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    stream    from    = { .source = source };
    spng_ctx *context = spng_ctx_new(0);
    if (context == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to decode the PNG", source->name);
    }
    const hc_result result = read_with(context, image, &from, header_only, log);
    spng_ctx_free(context);
    return result;
}

static int write_with(spng_ctx *context, const hc_image *image, stream *to)
{
    static const uint8_t color_types[] = { 0, SPNG_COLOR_TYPE_GRAYSCALE,
                                           SPNG_COLOR_TYPE_GRAYSCALE_ALPHA,
                                           SPNG_COLOR_TYPE_TRUECOLOR,
                                           SPNG_COLOR_TYPE_TRUECOLOR_ALPHA };
    struct spng_ihdr     header        = { .width      = (uint32_t)image->width,
                                           .height     = (uint32_t)image->height,
                                           .bit_depth  = image->type == HC_U16 ? 16 : 8,
                                           .color_type = color_types[image->channels] };
    char                 copy[HC_TEXT_SIZE];
    memcpy(copy, image->text, sizeof copy);
    struct spng_text text = {
        .keyword = HC_TEXT_KEY, .type = SPNG_TEXT, .length = strlen(copy), .text = copy
    };

    int error = spng_set_png_stream(context, push, to);
    error     = error != 0 ? error : spng_set_ihdr(context, &header);
    error = error != 0 ? error : spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, ZIP_LEVEL);
    error =
        error != 0 ? error : spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_PAETH);
    if (error == 0 && text.length > 0) {
        error = spng_set_text(context, &text, 1);
    }
    if (error == 0) {
        error = spng_encode_image(context, image->data, hc_image_bytes(image), SPNG_FMT_PNG,
                                  SPNG_ENCODE_FINALIZE);
    }
    return error;
}

hc_result hc_write_png(hc_output *output, const hc_image *image, hc_log *log)
{
    stream    to      = { .output = output };
    spng_ctx *context = spng_ctx_new(SPNG_CTX_ENCODER);
    const int error   = context != NULL ? write_with(context, image, &to) : SPNG_EMEM;
    spng_ctx_free(context);
    if (error != 0) {
        return hc_fail(log, error == SPNG_EMEM ? HC_ERROR_MEMORY : HC_ERROR_IO,
                       "%s: cannot encode the PNG: %s", output->path, spng_strerror(error));
    }
    return HC_OK;
}
