/* RAW: samples without a header, their shape told by the caller. Written little-endian. */
#include "io_internal.h"

#include "base/fail.h"

hc_result hc_read_raw(hc_image *image, const hc_source *source, const hc_load_options *options,
                      hc_log *log)
{
    const size_t size = hc_sample_size(options->raw_type);
    if (size == 0 || options->raw_width < 1 || options->raw_height < 1) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "%s: raw samples of type %d, %d x %d; give both sides and a known type",
                       source->name, (int)options->raw_type, options->raw_width,
                       options->raw_height);
    }
    const uint64_t count = (uint64_t)options->raw_width * (uint64_t)options->raw_height;
    if (source->size != count * size) {
        return hc_fail(
            log, HC_ERROR_FORMAT,
            "%s: has %llu bytes, %d x %d samples of %zu bytes are %llu; correct the size "
            "or the type",
            source->name, (unsigned long long)source->size, options->raw_width, options->raw_height,
            size, (unsigned long long)(count * size));
    }
    image->type      = options->raw_type;
    image->bits      = (int)size * 8;
    image->levels    = 1;
    hc_result result = hc_image_prepare(image, source, (uint64_t)options->raw_width,
                                        (uint64_t)options->raw_height, 1, false, log);
    if (result == HC_OK) {
        result = hc_read_samples(source, 0, image->data, (size_t)count, size,
                                 options->raw_big_endian, log);
    }
    return result;
}

hc_result hc_write_raw(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    (void)hc_append_samples(output, image->data, hc_image_samples(image),
                            hc_sample_size(image->type));
    return HC_OK;
}
