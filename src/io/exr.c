/* OpenEXR through OpenEXRCore: half, float and integer channels in scan lines or tiles; float scan
 * lines out. The channels of a map are Y, or R G, or R G B A, in the layout's order. */
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
    hc_output       *output;
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

/* A context that writes is locked while it reports, and asking it for its user data would wait for
 * that lock for ever; the reason of a failed write is known without it. */
static void keep_silent(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
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

static int64_t push(exr_const_context_t context, void *user, const void *buffer, uint64_t size,
                    uint64_t offset, exr_stream_error_func_ptr_t error)
{
    (void)context;
    (void)error;
    const stream *to = user;
    return hc_output_write_at(to->output, offset, buffer, (size_t)size) ? (int64_t)size : -1;
}

static exr_context_initializer_t initializer(stream *user)
{
    exr_context_initializer_t made = EXR_DEFAULT_CONTEXT_INITIALIZER;
    made.error_handler_fn          = keep_complaint;
    made.user_data                 = user;
    made.zip_level                 = 4;
    if (user->source != NULL) {
        made.read_fn          = pull;
        made.size_fn          = source_size;
        made.max_image_width  = HC_SIDE_MAX;
        made.max_image_height = HC_SIDE_MAX;
        made.max_tile_width   = HC_SIDE_MAX;
        made.max_tile_height  = HC_SIDE_MAX;
    } else {
        made.write_fn         = push;
        made.error_handler_fn = keep_silent;
    }
    return made;
}

static hc_result damaged(const stream *from, exr_result_t code, hc_log *log)
{
    if (code == EXR_ERR_OUT_OF_MEMORY) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory to decode the EXR", from->source->name);
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

/* ---- in -------------------------------------------------------------------------------------- */

/* The part's channels in the order of the image's: indices into the file's list, which is sorted by
 * name. */
typedef struct selection {
    const char      *names[CHANNELS_MAX];
    int              count;
    exr_pixel_type_t type; /* as decoded */
    int              bits;
} selection;

static bool has_channel(const exr_attr_chlist_t *list, const char *name)
{
    for (int i = 0; i < list->num_channels; i++) {
        if (strcmp(list->entries[i].name.str, name) == 0) {
            return true;
        }
    }
    return false;
}

static void select_names(selection *chosen, const exr_attr_chlist_t *list)
{
    static const char *const usual[] = { "Y", "R", "G", "B", "A" };
    for (size_t i = 0; i < sizeof usual / sizeof *usual && chosen->count < CHANNELS_MAX; i++) {
        if (has_channel(list, usual[i])) {
            chosen->names[chosen->count++] = usual[i];
        }
    }
    if (chosen->count == 0 && list->num_channels <= CHANNELS_MAX) {
        while (chosen->count < list->num_channels) {
            chosen->names[chosen->count] = list->entries[chosen->count].name.str;
            chosen->count++;
        }
    }
}

static hc_result select_channels(selection *chosen, const stream *from,
                                 const exr_attr_chlist_t *list, hc_log *log)
{
    select_names(chosen, list);
    if (chosen->count == 0) {
        return unsupported(from, "none of the channels Y, R, G, B, A and not 1 to 4 others", log);
    }
    int integers = 0;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        bool                           used  = false;
        for (int k = 0; k < chosen->count; k++) {
            used = used || strcmp(entry->name.str, chosen->names[k]) == 0;
        }
        if (!used) {
            continue;
        }
        if (entry->x_sampling != 1 || entry->y_sampling != 1) {
            return unsupported(from, "subsampled channels", log);
        }
        const int bits = entry->pixel_type == EXR_PIXEL_HALF ? 16 : 32;
        integers += entry->pixel_type == EXR_PIXEL_UINT;
        chosen->bits = bits > chosen->bits ? bits : chosen->bits;
    }
    if (integers != 0 && integers != chosen->count) {
        return unsupported(from, "integer and float channels mixed", log);
    }
    chosen->type = integers != 0 ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
    return HC_OK;
}

/* Let the pipeline write a chunk's pixels straight into the image. */
static void aim(exr_decode_pipeline_t *pipeline, const hc_image *image, const selection *chosen,
                size_t x, size_t y)
{
    const size_t pixel = (size_t)image->channels * sizeof(float);
    uint8_t     *first = (uint8_t *)image->data + (y * (size_t)image->width + x) * pixel;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        channel->decode_to_ptr             = NULL;
        for (int k = 0; k < chosen->count; k++) {
            if (strcmp(channel->channel_name, chosen->names[k]) == 0) {
                channel->decode_to_ptr = first + (size_t)k * sizeof(float);
            }
        }
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type         = (uint16_t)chosen->type;
        channel->user_pixel_stride      = (int32_t)pixel;
        channel->user_line_stride       = (int32_t)(pixel * (size_t)image->width);
    }
}

/* A part's geometry, in chunks: strips of scan lines, or tiles. */
typedef struct grid {
    bool   tiled;
    int    first_y; /* of the data window */
    size_t chunk_width, chunk_height;
} grid;

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
                               const hc_image *image, const selection *chosen, const grid *chunks,
                               size_t x, size_t y)
{
    exr_chunk_info_t chunk;
    exr_result_t     code = find_chunk(context, &chunk, chunks, x, y);
    if (code != EXR_ERR_SUCCESS) {
        return code;
    }
    const bool   started = pipeline->channels != NULL;
    const size_t right   = (size_t)image->width - x;
    const size_t below   = (size_t)image->height - y;
    code                 = started ? exr_decoding_update(context, 0, &chunk, pipeline)
                                   : exr_decoding_initialize(context, 0, &chunk, pipeline);
    /* never write past the image, whatever the chunk says of itself */
    if (code == EXR_ERR_SUCCESS
        && ((size_t)chunk.width > right || (size_t)chunk.height > below || chunk.width < 1
            || chunk.height < 1)) {
        code = EXR_ERR_BAD_CHUNK_LEADER;
    }
    if (code == EXR_ERR_SUCCESS) {
        aim(pipeline, image, chosen, x, y);
        code = started ? code : exr_decoding_choose_default_routines(context, 0, pipeline);
    }
    return code == EXR_ERR_SUCCESS ? exr_decoding_run(context, 0, pipeline) : code;
}

static hc_result read_pixels(exr_const_context_t context, const stream *from, const hc_image *image,
                             const selection *chosen, const grid *chunks, hc_log *log)
{
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t          code     = EXR_ERR_SUCCESS;
    for (size_t y = 0; code == EXR_ERR_SUCCESS && y < (size_t)image->height;
         y += chunks->chunk_height) {
        for (size_t x = 0; code == EXR_ERR_SUCCESS && x < (size_t)image->width;
             x += chunks->chunk_width) {
            code = read_chunk(context, &pipeline, image, chosen, chunks, x, y);
        }
    }
    (void)exr_decoding_destroy(context, &pipeline);
    return code == EXR_ERR_SUCCESS ? HC_OK : damaged(from, code, log);
}

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
    exr_storage_t            storage;
    exr_attr_box2i_t         window;
    const exr_attr_chlist_t *list     = NULL;
    uint64_t                 unpacked = 0;
    int32_t                  count    = 0;
    exr_result_t             code     = exr_get_storage(context, 0, &storage);
    code = code == EXR_ERR_SUCCESS ? exr_get_data_window(context, 0, &window) : code;
    code = code == EXR_ERR_SUCCESS ? exr_get_channels(context, 0, &list) : code;
    code = code == EXR_ERR_SUCCESS ? exr_get_chunk_count(context, 0, &count) : code;
    code = code == EXR_ERR_SUCCESS ? exr_get_chunk_unpacked_size(context, 0, &unpacked) : code;
    if (code != EXR_ERR_SUCCESS) {
        return damaged(from, code, log);
    }
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) {
        return unsupported(from, "deep samples", log);
    }
    selection chosen = { .count = 0 };
    hc_result result = select_channels(&chosen, from, list, log);
    if (result == HC_OK) {
        result = hc_check_promise(from->source, 8.0 * count, 1.0, log);
    }
    if (result == HC_OK
        && unpacked / sizeof(float) > from->source->limits.max_samples + CHUNK_FLOOR) {
        result = hc_fail(log, HC_ERROR_LIMIT,
                         "%s: has chunks of %llu bytes, the limit is %llu samples; raise "
                         "max_samples if you trust it",
                         from->source->name, (unsigned long long)unpacked,
                         (unsigned long long)from->source->limits.max_samples);
    }
    if (result != HC_OK) {
        return result;
    }
    image->type   = chosen.type == EXR_PIXEL_UINT ? HC_U32 : HC_F32;
    image->bits   = chosen.bits;
    image->levels = 1;
    take_text(image, context);
    const int64_t width  = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    result               = hc_image_prepare(image, from->source, width < 0 ? 0 : (uint64_t)width,
                              height < 0 ? 0 : (uint64_t)height, (uint64_t)chosen.count,
                                            header_only, log);
    if (result != HC_OK || header_only) {
        return result;
    }
    grid chunks = { .tiled = storage == EXR_STORAGE_TILED, .first_y = window.min.y };
    code        = find_grid(context, &chunks, image);
    return code == EXR_ERR_SUCCESS ? read_pixels(context, from, image, &chosen, &chunks, log)
                                   : damaged(from, code, log);
}

hc_result hc_read_exr(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    stream                          from    = { .source = source };
    const exr_context_initializer_t init    = initializer(&from);
    exr_context_t                   context = NULL;
    const exr_result_t              code    = exr_start_read(&context, source->name, &init);
    hc_result                       result;
    if (code == EXR_ERR_SUCCESS) {
        result = read_part(context, &from, image, header_only, log);
    } else {
        result = damaged(&from, code, log);
    }
    (void)exr_finish(&context);
    return result;
}

/* ---- out ------------------------------------------------------------------------------------- */

static const char *const *channel_names(int channels)
{
    static const char *const one[]  = { "Y" };
    static const char *const many[] = { "R", "G", "B", "A" };
    return channels == 1 ? one : many;
}

static exr_result_t write_header(exr_context_t context, const hc_image *image)
{
    int          part = 0;
    exr_result_t code = exr_add_part(context, "", EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS) {
        code = exr_initialize_required_attr_simple(context, part, image->width, image->height,
                                                   EXR_COMPRESSION_ZIP);
    }
    for (int i = 0; i < image->channels && code == EXR_ERR_SUCCESS; i++) {
        code = exr_add_channel(context, part, channel_names(image->channels)[i], EXR_PIXEL_FLOAT,
                               EXR_PERCEPTUALLY_LINEAR, 1, 1);
    }
    if (code == EXR_ERR_SUCCESS && image->text[0] != '\0') {
        code = exr_attr_set_string(context, part, HC_TEXT_KEY, image->text);
    }
    return code == EXR_ERR_SUCCESS ? exr_write_header(context) : code;
}

static void aim_encoder(exr_encode_pipeline_t *pipeline, const hc_image *image, int y)
{
    const size_t   pixel = (size_t)image->channels * sizeof(float);
    const uint8_t *row   = (const uint8_t *)image->data + (size_t)y * (size_t)image->width * pixel;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        size_t                     k       = 0;
        while (strcmp(channel->channel_name, channel_names(image->channels)[k]) != 0) {
            k++;
        }
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type         = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride      = (int32_t)pixel;
        channel->user_line_stride       = (int32_t)(pixel * (size_t)image->width);
        channel->encode_from_ptr        = row + k * sizeof(float);
    }
}

typedef exr_result_t encode_step(exr_encode_pipeline_t *pipeline);

/* Readers take a chunk whose packed size is its plain size for a plain one, but OpenEXRCore (3.1.5)
 * leaves it packed when both happen to be equal. */
static exr_result_t compress(exr_encode_pipeline_t *pipeline)
{
    encode_step *const *step = pipeline->encoding_user_data;
    const exr_result_t  code = (*step)(pipeline);
    if (code == EXR_ERR_SUCCESS && pipeline->compressed_bytes == pipeline->packed_bytes) {
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    }
    return code;
}

static exr_result_t choose_routines(exr_context_t context, exr_encode_pipeline_t *pipeline,
                                    encode_step **original)
{
    const exr_result_t code = exr_encoding_choose_default_routines(context, 0, pipeline);
    if (code == EXR_ERR_SUCCESS && pipeline->compress_fn != NULL) {
        *original                    = pipeline->compress_fn;
        pipeline->encoding_user_data = original;
        pipeline->compress_fn        = compress;
    }
    return code;
}

static exr_result_t write_pixels(exr_context_t context, const hc_image *image)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    encode_step          *original = NULL;
    int32_t               lines    = 1;
    exr_result_t          code     = exr_get_scanlines_per_chunk(context, 0, &lines);
    for (int y = 0; y < image->height && code == EXR_ERR_SUCCESS; y += lines) {
        exr_chunk_info_t chunk;
        code = exr_write_scanline_chunk_info(context, 0, y, &chunk);
        if (code == EXR_ERR_SUCCESS) {
            code = y == 0 ? exr_encoding_initialize(context, 0, &chunk, &pipeline)
                          : exr_encoding_update(context, 0, &chunk, &pipeline);
        }
        if (code == EXR_ERR_SUCCESS) {
            aim_encoder(&pipeline, image, y);
            code = y == 0 ? choose_routines(context, &pipeline, &original) : code;
        }
        code = code == EXR_ERR_SUCCESS ? exr_encoding_run(context, 0, &pipeline) : code;
    }
    (void)exr_encoding_destroy(context, &pipeline);
    return code;
}

hc_result hc_write_exr(hc_output *output, const hc_image *image, hc_log *log)
{
    stream                          to      = { .output = output };
    const exr_context_initializer_t init    = initializer(&to);
    exr_context_t                   context = NULL;
    /* the name only serves messages, and removal after a failure */
    exr_result_t code =
        exr_start_write(&context, output->temporary, EXR_WRITE_FILE_DIRECTLY, &init);
    code                   = code == EXR_ERR_SUCCESS ? write_header(context, image) : code;
    code                   = code == EXR_ERR_SUCCESS ? write_pixels(context, image) : code;
    const exr_result_t end = context != NULL ? exr_finish(&context) : EXR_ERR_SUCCESS;
    code                   = code == EXR_ERR_SUCCESS ? end : code;
    if (code != EXR_ERR_SUCCESS) {
        return hc_fail(log, code == EXR_ERR_OUT_OF_MEMORY ? HC_ERROR_MEMORY : HC_ERROR_IO,
                       "%s: cannot encode the EXR: %s", output->path,
                       exr_get_default_error_message(code));
    }
    return HC_OK;
}
