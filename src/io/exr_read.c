/* OpenEXR in: half, float and integer channels, in scan lines or tiles. OpenEXRCore finds and
 * unpacks the chunks; their samples are taken from there by this file.
 * After: the OpenEXR file layout document for the order of samples in a chunk. */
#include "io_internal.h"

#include "base/fail.h"

#include <openexr.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CHANNELS_MAX = 4,
    CHUNK_FLOOR  = 1 << 24 /* values in a chunk that every limit allows */
};

/* The user data of a context: where its bytes are and what it complained of. */
typedef struct stream {
    const hc_source *source;
    char             complaint[256];
} stream;

static void keep_complaint(exr_const_context_t context, exr_result_t code, const char *message)
{
    void *user = NULL;
    (void)code;
    if (context == NULL || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || user == NULL) {
        return;
    }
    stream *of = user;
    if (of->complaint[0] == '\0') {
        (void)snprintf(of->complaint, sizeof of->complaint, "%s", message);
    }
}

static int64_t pull(exr_const_context_t context, void *user, void *buffer, uint64_t size,
                    uint64_t offset, exr_stream_error_func_ptr_t error)
{
    (void)context;
    (void)error;
    const stream *from = user;
    return (int64_t)hc_source_read(from->source, offset, buffer, (size_t)size);
}

static int64_t source_size(exr_const_context_t context, void *user)
{
    (void)context;
    const stream *from = user;
    return (int64_t)from->source->size;
}

static hc_result damaged(const stream *from, exr_result_t code, hc_log *log)
{
    if (code == EXR_ERR_OUT_OF_MEMORY) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to decode the EXR", from->source->name);
    }
    if (code == EXR_ERR_FEATURE_NOT_IMPLEMENTED) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: %s; write it with ZIP compression",
                       from->source->name, from->complaint);
    }
    const char *complaint =
        from->complaint[0] != '\0' ? from->complaint : exr_get_default_error_message(code);
    return hc_fail(log, HC_ERROR_FORMAT, "%s: damaged EXR: %s; write it again", from->source->name,
                   complaint);
}

static hc_result unsupported(const stream *from, const char *what, hc_log *log)
{
    return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: EXR with %s is not read; write flat scan lines",
                   from->source->name, what);
}

/* ---- channels -------------------------------------------------------------------------------- */

/* Where the image's channels stand in the file's list, which is sorted by name. */
typedef struct selection {
    int              count;
    int              index[CHANNELS_MAX];
    size_t           before[CHANNELS_MAX]; /* bytes of a pixel in front of the channel */
    exr_pixel_type_t stored[CHANNELS_MAX];
    size_t           pixel_size; /* bytes of a pixel, all channels of the file */
    bool             integers;
    int              bits;
} selection;

static size_t stored_size(exr_pixel_type_t type)
{
    return type == EXR_PIXEL_HALF ? 2 : 4;
}

static int find_channel(const exr_attr_chlist_t *list, const char *name)
{
    for (int i = 0; i < list->num_channels; i++) {
        if (strcmp(list->entries[i].name.str, name) == 0) {
            return i;
        }
    }
    return -1;
}

/* The usual names in their usual order, or else all of a few others in the file's. */
static void choose_channels(selection *chosen, const exr_attr_chlist_t *list)
{
    static const char *const usual[] = { "Y", "R", "G", "B", "A" };
    for (size_t i = 0; i < sizeof usual / sizeof *usual && chosen->count < CHANNELS_MAX; i++) {
        const int found = find_channel(list, usual[i]);
        if (found >= 0) {
            chosen->index[chosen->count++] = found;
        }
    }
    if (chosen->count == 0 && list->num_channels <= CHANNELS_MAX) {
        while (chosen->count < list->num_channels) {
            chosen->index[chosen->count] = chosen->count;
            chosen->count++;
        }
    }
}

static hc_result select_channels(selection *chosen, const stream *from,
                                 const exr_attr_chlist_t *list, hc_log *log)
{
    choose_channels(chosen, list);
    if (chosen->count == 0) {
        return unsupported(from, "none of the channels Y, R, G, B, A and not 1 to 4 others", log);
    }
    int integers = 0;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        if (entry->x_sampling != 1 || entry->y_sampling != 1) {
            return unsupported(from, "subsampled channels", log);
        }
        for (int k = 0; k < chosen->count; k++) {
            if (chosen->index[k] == i) {
                const int bits    = (int)stored_size(entry->pixel_type) * 8;
                chosen->before[k] = chosen->pixel_size;
                chosen->stored[k] = entry->pixel_type;
                chosen->bits      = bits > chosen->bits ? bits : chosen->bits;
                integers += entry->pixel_type == EXR_PIXEL_UINT;
            }
        }
        chosen->pixel_size += stored_size(entry->pixel_type);
    }
    if (integers != 0 && integers != chosen->count) {
        return unsupported(from, "integer and float channels mixed", log);
    }
    chosen->integers = integers != 0;
    return HC_OK;
}

/* ---- samples --------------------------------------------------------------------------------- */

/* A half float in the bits of a float. */
static uint32_t widen(uint16_t half)
{
    const uint32_t sign     = (uint32_t)(half & 0x8000U) << 16;
    const uint32_t exponent = (half >> 10) & 0x1FU;
    const uint32_t mantissa = half & 0x3FFU;
    if (exponent == 0x1F) {
        return sign | 0x7F800000U | mantissa << 13;
    }
    if (exponent != 0) {
        return sign | (exponent + 112U) << 23 | mantissa << 13;
    }
    const float small = (float)mantissa * 0x1p-24F; /* exact: ten bits and a power of two */
    uint32_t    bits;
    memcpy(&bits, &small, sizeof bits);
    return sign | bits;
}

/* Where a chunk's samples go. */
typedef struct placement {
    const hc_image  *image;
    const selection *chosen;
    size_t           x, y;
} placement;

/* A chunk holds its rows one after another, in a row the channels, in a channel the samples. */
static void place_samples(const placement *place, const exr_chunk_info_t *chunk,
                          const uint8_t *bytes)
{
    const selection *chosen   = place->chosen;
    const size_t     width    = (size_t)chunk->width;
    const size_t     channels = (size_t)chosen->count;
    for (size_t y = 0; y < (size_t)chunk->height; y++) {
        const uint8_t *row   = bytes + y * width * chosen->pixel_size;
        const size_t   first = (place->y + y) * (size_t)place->image->width + place->x;
        for (size_t k = 0; k < channels; k++) {
            const uint8_t *from = row + width * chosen->before[k];
            uint8_t       *to   = (uint8_t *)place->image->data + (first * channels + k) * 4;
            for (size_t x = 0; x < width; x++, to += channels * 4) {
                const uint32_t value = chosen->stored[k] == EXR_PIXEL_HALF
                                           ? widen(hc_get_le16(from + 2 * x))
                                           : hc_get_le32(from + 4 * x);
                memcpy(to, &value, sizeof value);
            }
        }
    }
}

/* Stands in for OpenEXRCore's own unpacking, which crashes on some files where channels are left
 * out (3.1.5). Nothing a chunk says of itself may reach beyond the image or the unpacked bytes. */
static exr_result_t unpack(exr_decode_pipeline_t *pipeline)
{
    const placement        *place = pipeline->decoding_user_data;
    const exr_chunk_info_t *chunk = &pipeline->chunk;
    const bool              plain = pipeline->unpacked_buffer == pipeline->packed_buffer;
    const uint64_t          size  = plain ? chunk->packed_size : chunk->unpacked_size;
    const size_t            right = (size_t)place->image->width - place->x;
    const size_t            below = (size_t)place->image->height - place->y;
    const bool inside = chunk->width > 0 && chunk->height > 0 && (size_t)chunk->width <= right
                        && (size_t)chunk->height <= below;
    const uint64_t needed =
        inside ? (uint64_t)chunk->width * (uint64_t)chunk->height * place->chosen->pixel_size : 0;
    if (!inside || chunk->packed_size == 0 || size < needed || pipeline->unpacked_buffer == NULL) {
        return EXR_ERR_BAD_CHUNK_LEADER;
    }
    place_samples(place, chunk, pipeline->unpacked_buffer);
    return EXR_ERR_SUCCESS;
}

/* Zeroed: what a damaged chunk leaves out is the same in every run. */
static void *take_buffer(exr_transcoding_pipeline_buffer_id_t which, size_t size)
{
    (void)which;
    return calloc(1, size);
}

static void free_buffer(exr_transcoding_pipeline_buffer_id_t which, void *buffer)
{
    (void)which;
    free(buffer);
}

/* The routines are chosen for channels that all go somewhere, to be converted: that keeps the steps
 * up to the unpacked bytes; the last step is then replaced. */
static exr_result_t choose_routines(exr_const_context_t context, exr_decode_pipeline_t *pipeline,
                                    placement *place)
{
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        channel->decode_to_ptr             = place->image->data;
        channel->user_pixel_stride         = 8;
        channel->user_line_stride          = 8;
    }
    const exr_result_t code         = exr_decoding_choose_default_routines(context, 0, pipeline);
    pipeline->unpack_and_convert_fn = unpack;
    pipeline->decoding_user_data    = place;
    pipeline->alloc_fn              = take_buffer;
    pipeline->free_fn               = free_buffer;
    return code;
}

/* ---- chunks ---------------------------------------------------------------------------------- */

/* A part's geometry, in chunks: strips of scan lines, or tiles. */
typedef struct grid {
    bool   tiled;
    int    first_y; /* of the data window */
    size_t chunk_width, chunk_height;
} grid;

static exr_result_t find_grid(exr_const_context_t context, grid *chunks, const hc_image *image)
{
    int32_t      width  = image->width;
    int32_t      height = 1;
    exr_result_t code   = chunks->tiled ? exr_get_tile_sizes(context, 0, 0, 0, &width, &height)
                                        : exr_get_scanlines_per_chunk(context, 0, &height);
    if (code == EXR_ERR_SUCCESS && (width < 1 || height < 1)) {
        code = EXR_ERR_INVALID_ATTR;
    }
    chunks->chunk_width  = (size_t)width;
    chunks->chunk_height = (size_t)height;
    return code;
}

static exr_result_t find_chunk(exr_const_context_t context, exr_chunk_info_t *chunk,
                               const grid *chunks, size_t x, size_t y)
{
    if (chunks->tiled) {
        return exr_read_tile_chunk_info(context, 0, (int)(x / chunks->chunk_width),
                                        (int)(y / chunks->chunk_height), 0, 0, chunk);
    }
    return exr_read_scanline_chunk_info(context, 0, chunks->first_y + (int)y, chunk);
}

static exr_result_t read_chunk(exr_const_context_t context, exr_decode_pipeline_t *pipeline,
                               placement *place, const grid *chunks)
{
    exr_chunk_info_t chunk;
    exr_result_t     code = find_chunk(context, &chunk, chunks, place->x, place->y);
    if (code != EXR_ERR_SUCCESS) {
        return code;
    }
    if (pipeline->channels == NULL) {
        code = exr_decoding_initialize(context, 0, &chunk, pipeline);
        code = code == EXR_ERR_SUCCESS ? choose_routines(context, pipeline, place) : code;
    } else {
        code = exr_decoding_update(context, 0, &chunk, pipeline);
    }
    return code == EXR_ERR_SUCCESS ? exr_decoding_run(context, 0, pipeline) : code;
}

static hc_result read_pixels(exr_const_context_t context, const stream *from, const hc_image *image,
                             const selection *chosen, const grid *chunks, hc_log *log)
{
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t          code     = EXR_ERR_SUCCESS;
    placement             place    = { .image = image, .chosen = chosen };
    for (place.y = 0; code == EXR_ERR_SUCCESS && place.y < (size_t)image->height;
         place.y += chunks->chunk_height) {
        for (place.x = 0; code == EXR_ERR_SUCCESS && place.x < (size_t)image->width;
             place.x += chunks->chunk_width) {
            code = read_chunk(context, &pipeline, &place, chunks);
        }
    }
    (void)exr_decoding_destroy(context, &pipeline);
    return code == EXR_ERR_SUCCESS ? HC_OK : damaged(from, code, log);
}

/* ---- file ------------------------------------------------------------------------------------ */

/* What the header says, as OpenEXRCore understands it. */
typedef struct part {
    exr_storage_t            storage;
    exr_attr_box2i_t         window;
    const exr_attr_chlist_t *channels;
    int32_t                  chunks;
    uint64_t                 chunk_size; /* of the largest, unpacked */
} part;

static exr_result_t read_header(exr_const_context_t context, part *found)
{
    exr_result_t code = exr_get_storage(context, 0, &found->storage);
    code = code == EXR_ERR_SUCCESS ? exr_get_data_window(context, 0, &found->window) : code;
    code = code == EXR_ERR_SUCCESS ? exr_get_channels(context, 0, &found->channels) : code;
    code = code == EXR_ERR_SUCCESS ? exr_get_chunk_count(context, 0, &found->chunks) : code;
    return code == EXR_ERR_SUCCESS ? exr_get_chunk_unpacked_size(context, 0, &found->chunk_size)
                                   : code;
}

static hc_result check_chunks(const stream *from, const part *found, hc_log *log)
{
    const uint64_t allowed = from->source->limits.max_samples;
    if (found->chunk_size / sizeof(float) > allowed + CHUNK_FLOOR) {
        return hc_fail(
            log, HC_ERROR_LIMIT,
            "%s: has chunks of %llu bytes, the limit is %llu samples; raise max_samples if "
            "you trust it",
            from->source->name, (unsigned long long)found->chunk_size, (unsigned long long)allowed);
    }
    /* each chunk has an entry of 8 bytes in the table of offsets */
    return hc_check_promise(from->source, 8.0 * found->chunks, 1.0, log);
}

static void take_text(hc_image *image, exr_const_context_t context)
{
    int32_t     length = 0;
    const char *text   = NULL;
    if (exr_attr_get_string(context, 0, HC_TEXT_KEY, &length, &text) == EXR_ERR_SUCCESS
        && text != NULL && length > 0) {
        hc_image_take_text(image, text, (size_t)length);
    }
}

static hc_result read_part(exr_const_context_t context, const stream *from, hc_image *image,
                           bool header_only, hc_log *log)
{
    part         found = { .chunks = 0 };
    exr_result_t code  = read_header(context, &found);
    if (code != EXR_ERR_SUCCESS) {
        return damaged(from, code, log);
    }
    if (found.storage != EXR_STORAGE_SCANLINE && found.storage != EXR_STORAGE_TILED) {
        return unsupported(from, "deep samples", log);
    }
    selection chosen = { .count = 0 };
    hc_result result = select_channels(&chosen, from, found.channels, log);
    result           = result == HC_OK ? check_chunks(from, &found, log) : result;
    if (result != HC_OK) {
        return result;
    }
    image->type   = chosen.integers ? HC_U32 : HC_F32;
    image->bits   = chosen.bits;
    image->levels = 1;
    take_text(image, context);
    const int64_t width  = (int64_t)found.window.max.x - found.window.min.x + 1;
    const int64_t height = (int64_t)found.window.max.y - found.window.min.y + 1;
    result               = hc_image_prepare(image, from->source, width < 0 ? 0 : (uint64_t)width,
                              height < 0 ? 0 : (uint64_t)height, (uint64_t)chosen.count,
                                            header_only, log);
    if (result != HC_OK || header_only) {
        return result;
    }
    grid chunks = { .tiled = found.storage == EXR_STORAGE_TILED, .first_y = found.window.min.y };
    code        = find_grid(context, &chunks, image);
    return code == EXR_ERR_SUCCESS ? read_pixels(context, from, image, &chosen, &chunks, log)
                                   : damaged(from, code, log);
}

hc_result hc_read_exr(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    stream                    from    = { .source = source };
    exr_context_initializer_t init    = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t             context = NULL;
    hc_result                 result;
    init.error_handler_fn   = keep_complaint;
    init.user_data          = &from;
    init.read_fn            = pull;
    init.size_fn            = source_size;
    init.max_image_width    = HC_SIDE_MAX;
    init.max_image_height   = HC_SIDE_MAX;
    init.max_tile_width     = HC_SIDE_MAX;
    init.max_tile_height    = HC_SIDE_MAX;
    const exr_result_t code = exr_start_read(&context, source->name, &init);
    if (code == EXR_ERR_SUCCESS) {
        result = read_part(context, &from, image, header_only, log);
    } else {
        result = damaged(&from, code, log);
    }
    (void)exr_finish(&context);
    return result;
}
