/* OpenEXR out: float scan lines, ZIP compressed. The channels of a map are Y, or R G, or R G B A,
 * in the layout's order. */
#include "io_internal.h"

#include "base/fail.h"

#include <openexr.h>

#include <string.h>

enum { ZIP_LEVEL = 4 };

/* A context that writes is locked while it reports, and asking it for its user data would wait for
 * that lock for ever; the reason of a failed write is known without it. */
static void keep_silent(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static int64_t push(exr_const_context_t context, void *user, const void *buffer, uint64_t size,
                    uint64_t offset, exr_stream_error_func_ptr_t error)
{
    (void)context;
    (void)error;
    return hc_output_write_at(user, offset, buffer, (size_t)size) ? (int64_t)size : -1;
}

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
    exr_context_initializer_t init    = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t             context = NULL;
    init.error_handler_fn             = keep_silent;
    init.user_data                    = output;
    init.write_fn                     = push;
    init.zip_level                    = ZIP_LEVEL;
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
