/* The decoded image: its sizes against the limits, its memory, and the bytes of its samples. */
#include "io_internal.h"

#include "base/fail.h"

#include <stdlib.h>
#include <string.h>

enum { SWAP_CHUNK = 1 << 14 };

size_t hc_image_samples(const hc_image *image)
{
    size_t samples = 0;
    for (int level = 0; level < image->levels; level++) {
        samples += (size_t)hc_level_side(image->width, level)
                   * (size_t)hc_level_side(image->height, level);
    }
    return samples * (size_t)image->channels;
}

size_t hc_image_bytes(const hc_image *image)
{
    return hc_image_samples(image) * hc_sample_size(image->type);
}

size_t hc_level_bytes(const hc_image *image, int level)
{
    return (size_t)hc_level_side(image->width, level) * (size_t)hc_level_side(image->height, level)
           * (size_t)image->channels * hc_sample_size(image->type);
}

uint8_t *hc_level_texels(const hc_image *image, int level)
{
    uint8_t *texels = image->data;
    for (int k = 0; k < level; k++) {
        texels += hc_level_bytes(image, k);
    }
    return texels;
}

static hc_result check_sides(const hc_source *source, uint64_t width, uint64_t height, hc_log *log)
{
    if (width == 0 || height == 0) {
        return hc_fail(log, HC_ERROR_FORMAT, "%s: has %s 0; at least 1 is needed", source->name,
                       width == 0 ? "width" : "height");
    }
    if (width > HC_SIDE_MAX || height > HC_SIDE_MAX) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "%s: is %llu x %llu; sides up to %d are read, cut it into tiles",
                       source->name, (unsigned long long)width, (unsigned long long)height,
                       HC_SIDE_MAX);
    }
    return HC_OK;
}

hc_result hc_image_prepare(hc_image *image, const hc_source *source, uint64_t width,
                           uint64_t height, uint64_t channels, bool header_only, hc_log *log)
{
    const hc_result sides = check_sides(source, width, height, log);
    if (sides != HC_OK) {
        return sides;
    }
    if (channels < 1 || channels > 4) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED, "%s: has %llu channels; 1 to 4 are read",
                       source->name, (unsigned long long)channels);
    }
    image->width    = (int)width;
    image->height   = (int)height;
    image->channels = (int)channels;
    if (image->levels < 1 || image->levels > hc_pyramid_levels(image->width, image->height)) {
        return hc_fail(log, HC_ERROR_FORMAT, "%s: has %d levels; %d x %d samples have 1 to %d",
                       source->name, image->levels, image->width, image->height,
                       hc_pyramid_levels(image->width, image->height));
    }
    const size_t samples = hc_image_samples(image);
    if (samples > source->limits.max_samples) {
        return hc_fail(log, HC_ERROR_LIMIT,
                       "%s: has %zu samples, the limit is %llu; raise max_samples if you trust it",
                       source->name, samples, (unsigned long long)source->limits.max_samples);
    }
    if (header_only) {
        return HC_OK;
    }
    /* zeroed: some decoders leave gaps in damaged files and call it success (libtiff with
     * libdeflate) */
    image->data = calloc(1, hc_image_bytes(image));
    if (image->data == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for %zu bytes of samples", source->name,
                       hc_image_bytes(image));
    }
    return HC_OK;
}

hc_result hc_check_promise(const hc_source *source, double needed, double ratio, hc_log *log)
{
    if (needed <= (double)source->size * ratio) {
        return HC_OK;
    }
    return hc_fail(log, HC_ERROR_FORMAT,
                   "%s: its header promises %.0f bytes of samples, more than the file's %llu bytes "
                   "can hold; it is damaged or cut off",
                   source->name, needed, (unsigned long long)source->size);
}

void hc_image_free(hc_image *image)
{
    free(image->data);
    image->data = NULL;
}

bool hc_profile_is_srgb(const void *profile, size_t size)
{
    static const char narrow[] = "sRGB";
    static const char wide[]   = "s\0R\0G\0B"; /* version 4 profiles hold UTF-16 */
    const char       *bytes    = profile;
    for (size_t i = 0; i + 7 <= size; i++) {
        if (memcmp(bytes + i, narrow, 4) == 0 || memcmp(bytes + i, wide, 7) == 0) {
            return true;
        }
    }
    return false;
}

bool hc_host_is_big_endian(void)
{
    const uint16_t one = 1;
    uint8_t        first;
    memcpy(&first, &one, 1);
    return first == 0;
}

void hc_swap_bytes(void *values, size_t count, size_t size)
{
    uint8_t *value = values;
    for (size_t i = 0; i < count; i++, value += size) {
        for (size_t low = 0; low < size / 2; low++) {
            const uint8_t kept    = value[low];
            value[low]            = value[size - 1 - low];
            value[size - 1 - low] = kept;
        }
    }
}

uint16_t hc_get_le16(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] | bytes[1] << 8);
}

uint32_t hc_get_le32(const uint8_t *bytes)
{
    return (uint32_t)hc_get_le16(bytes) | (uint32_t)hc_get_le16(bytes + 2) << 16;
}

uint64_t hc_get_le64(const uint8_t *bytes)
{
    return (uint64_t)hc_get_le32(bytes) | (uint64_t)hc_get_le32(bytes + 4) << 32;
}

void hc_put_le16(uint8_t *bytes, uint16_t value)
{
    bytes[0] = (uint8_t)value;
    bytes[1] = (uint8_t)(value >> 8);
}

void hc_put_le32(uint8_t *bytes, uint32_t value)
{
    hc_put_le16(bytes, (uint16_t)value);
    hc_put_le16(bytes + 2, (uint16_t)(value >> 16));
}

void hc_put_le64(uint8_t *bytes, uint64_t value)
{
    hc_put_le32(bytes, (uint32_t)value);
    hc_put_le32(bytes + 4, (uint32_t)(value >> 32));
}

bool hc_append_samples(hc_output *output, const void *samples, size_t count, size_t size)
{
    if (!hc_host_is_big_endian() || size == 1) {
        return hc_output_append(output, samples, count * size);
    }
    uint8_t        chunk[SWAP_CHUNK];
    const uint8_t *rest = samples;
    for (size_t left = count * size; left > 0;) {
        const size_t part = left < sizeof chunk ? left : sizeof chunk;
        memcpy(chunk, rest, part);
        hc_swap_bytes(chunk, part / size, size);
        if (!hc_output_append(output, chunk, part)) {
            return false;
        }
        rest += part;
        left -= part;
    }
    return true;
}

hc_result hc_read_samples(const hc_source *source, uint64_t offset, void *samples, size_t count,
                          size_t size, bool big_endian, hc_log *log)
{
    const hc_result result = hc_source_need(source, offset, samples, count * size, log);
    if (result == HC_OK && big_endian != hc_host_is_big_endian()) {
        hc_swap_bytes(samples, count, size);
    }
    return result;
}
