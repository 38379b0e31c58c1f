/* KTX2: one two-dimensional texture with its mip levels, uncompressed.
 * After: the KTX file format specification 2.0, and the Khronos data format specification 1.3 for
 * the descriptor. */
#include "texture.h"

#include "base/fail.h"

#include <stdlib.h>
#include <string.h>

enum {
    HEADER_SIZE   = 80,
    LEVEL_ENTRY   = 24,
    KEY_DATA_MAX  = 1 << 20,
    LEVELS_MAX    = 32,
    BLOCK_HEADER  = 24, /* of a basic data format descriptor block */
    BLOCK_SAMPLE  = 16,
    CHANNEL_ALPHA = 15
};

static const uint8_t identifier[12] = { 0xAB, 'K',  'T',  'X',  ' ',  '2',
                                        '0',  0xBB, '\r', '\n', 0x1A, '\n' };

/* ---- in -------------------------------------------------------------------------------------- */

static hc_result unsupported(const hc_source *source, const char *what, uint32_t value, hc_log *log)
{
    return hc_fail(
        log, HC_ERROR_UNSUPPORTED,
        "%s: KTX2 with %s %u is not read; use a plain 2D texture of 8 or 16 bit unorm or "
        "32 bit float texels without supercompression",
        source->name, what, value);
}

/* Key/value data: length, key, 0, value, padding to 4 bytes; again and again. */
static void take_keys(hc_image *image, const uint8_t *data, size_t size)
{
    size_t at = 0;
    while (at + 4 <= size) {
        const size_t length = hc_get_le32(data + at);
        at += 4;
        if (length > size - at) {
            return;
        }
        const char *key = (const char *)data + at;
        if (length > sizeof HC_TEXT_KEY && memcmp(key, HC_TEXT_KEY, sizeof HC_TEXT_KEY) == 0) {
            hc_image_take_text(image, key + sizeof HC_TEXT_KEY, length - sizeof HC_TEXT_KEY);
        }
        at += (length + 3) / 4 * 4;
    }
}

static hc_result read_keys(hc_image *image, const hc_source *source, const uint8_t *header,
                           hc_log *log)
{
    const uint32_t offset = hc_get_le32(header + 56);
    const uint32_t size   = hc_get_le32(header + 60);
    if (size > KEY_DATA_MAX) {
        return unsupported(source, "key/value bytes", size, log);
    }
    uint8_t *data = malloc((size_t)size + 1);
    if (data == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for its metadata", source->name);
    }
    const hc_result result = hc_source_need(source, offset, data, size, log);
    if (result == HC_OK) {
        take_keys(image, data, size);
    }
    free(data);
    return result;
}

static hc_result read_levels(const hc_image *image, const hc_source *source, hc_log *log)
{
    for (int level = 0; level < image->levels; level++) {
        uint8_t   entry[LEVEL_ENTRY];
        hc_result result = hc_source_need(source, HEADER_SIZE + (uint64_t)level * LEVEL_ENTRY,
                                          entry, sizeof entry, log);
        if (result != HC_OK) {
            return result;
        }
        const size_t bytes = hc_level_bytes(image, level);
        if (hc_get_le64(entry + 8) != bytes) {
            return hc_fail(
                log, HC_ERROR_FORMAT,
                "%s: damaged KTX2: level %d has %llu bytes where %zu are needed; write it "
                "again",
                source->name, level, (unsigned long long)hc_get_le64(entry + 8), bytes);
        }
        const size_t size = hc_sample_size(image->type);
        result = hc_read_samples(source, hc_get_le64(entry), hc_level_texels(image, level),
                                 bytes / size, size, false, log);
        if (result != HC_OK) {
            return result;
        }
    }
    return HC_OK;
}

hc_result hc_read_ktx2(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    static const struct {
        int         offset;
        uint32_t    wanted;
        const char *what;
    } plain[] = { { 28, 0, "depth" },
                  { 32, 0, "array layers" },
                  { 36, 1, "faces" },
                  { 44, 0, "supercompression scheme" } };
    uint8_t   header[HEADER_SIZE];
    hc_result result = hc_source_need(source, 0, header, sizeof header, log);
    if (result != HC_OK) {
        return result;
    }
    const hc_texel_format *format = hc_texel_format_of_vulkan(hc_get_le32(header + 12));
    if (format == NULL) {
        return unsupported(source, "VkFormat", hc_get_le32(header + 12), log);
    }
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        const uint32_t value = hc_get_le32(header + plain[i].offset);
        if (value != plain[i].wanted) {
            return unsupported(source, plain[i].what, value, log);
        }
    }
    const uint32_t sides[2] = { hc_get_le32(header + 20), hc_get_le32(header + 24) };
    result                  = read_keys(image, source, header, log);
    if (result == HC_OK) {
        result = hc_prepare_texture(image, source, format, sides, hc_get_le32(header + 40),
                                    header_only, log);
    }
    return result != HC_OK || header_only ? result : read_levels(image, source, log);
}

/* ---- out ------------------------------------------------------------------------------------- */

/* The data format descriptor: what each bit of a texel means. Returns its size. */
static size_t describe(uint8_t *descriptor, const hc_image *image)
{
    const uint32_t bits    = (uint32_t)hc_sample_size(image->type) * 8;
    const bool     real    = image->type == HC_F32;
    const size_t   samples = (size_t)image->channels;
    const size_t   block   = BLOCK_HEADER + samples * BLOCK_SAMPLE;
    memset(descriptor, 0, 4 + block);
    hc_put_le32(descriptor, (uint32_t)(4 + block));
    hc_put_le16(descriptor + 8, 2); /* version 1.3 of the descriptor */
    hc_put_le16(descriptor + 10, (uint16_t)block);
    descriptor[12] = 1;                              /* RGBSDA                                  */
    descriptor[13] = 1;                              /* BT.709: readers expect some colour space */
    descriptor[14] = 1;                              /* linear                                  */
    descriptor[20] = (uint8_t)(samples * bits / 8U); /* bytes of a texel                        */
    for (size_t i = 0; i < samples; i++) {
        uint8_t      *sample  = descriptor + 4 + BLOCK_HEADER + i * BLOCK_SAMPLE;
        const uint8_t channel = (uint8_t)(i == 3 ? CHANNEL_ALPHA : i);
        hc_put_le16(sample, (uint16_t)(i * bits));
        sample[2] = (uint8_t)(bits - 1);
        sample[3] = (uint8_t)(channel | (real ? 0xC0U : 0U)); /* float, signed */
        hc_put_le32(sample + 8, real ? 0xBF800000U : 0U);     /* -1.0f or 0    */
        hc_put_le32(sample + 12, real ? 0x3F800000U : (1U << bits) - 1U);
    }
    return 4 + block;
}

static size_t put_key(uint8_t *data, const char *key, const char *value)
{
    const size_t length = strlen(key) + 1 + strlen(value) + 1;
    hc_put_le32(data, (uint32_t)length);
    memcpy(data + 4, key, strlen(key) + 1);
    memcpy(data + 4 + strlen(key) + 1, value, strlen(value) + 1);
    const size_t padded = (4 + length + 3) / 4 * 4;
    memset(data + 4 + length, 0, padded - 4 - length);
    return padded;
}

/* Keys in the order of their bytes, as the specification wants them. */
static size_t put_keys(uint8_t *data, const hc_image *image)
{
    size_t size = put_key(data, "KTXorientation", "rd"); /* right, down: row 0 is the top */
    size += put_key(data + size, "KTXwriter", "heightcast " HC_VERSION_STRING);
    if (image->text[0] != '\0') {
        size += put_key(data + size, HC_TEXT_KEY, image->text);
    }
    return size;
}

/* Levels stand smallest first and start at multiples of the texel size and of 4: streaming readers
 * want it so. */
static void place_levels(uint64_t offsets[LEVELS_MAX], const hc_image *image, uint64_t start)
{
    const size_t texel     = (size_t)image->channels * hc_sample_size(image->type);
    const size_t alignment = texel < 4 ? 4 : texel;
    uint64_t     at        = start;
    for (int level = image->levels - 1; level >= 0; level--) {
        at             = (at + alignment - 1) / alignment * alignment;
        offsets[level] = at;
        at += hc_level_bytes(image, level);
    }
}

hc_result hc_write_ktx2(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    uint8_t  head[HEADER_SIZE + LEVELS_MAX * LEVEL_ENTRY] = { 0 };
    uint8_t  descriptor[4 + BLOCK_HEADER + 4 * BLOCK_SAMPLE];
    uint8_t  keys[2 * HC_TEXT_SIZE];
    uint64_t offsets[LEVELS_MAX];

    const size_t size            = hc_sample_size(image->type);
    const size_t head_size       = HEADER_SIZE + (size_t)image->levels * LEVEL_ENTRY;
    const size_t descriptor_size = describe(descriptor, image);
    const size_t keys_size       = put_keys(keys, image);
    place_levels(offsets, image, head_size + descriptor_size + keys_size);

    memcpy(head, identifier, sizeof identifier);
    hc_put_le32(head + 12, hc_texel_format_of(image->channels, image->type)->vulkan);
    hc_put_le32(head + 16, (uint32_t)size);
    hc_put_le32(head + 20, (uint32_t)image->width);
    hc_put_le32(head + 24, (uint32_t)image->height);
    hc_put_le32(head + 36, 1);
    hc_put_le32(head + 40, (uint32_t)image->levels);
    hc_put_le32(head + 48, (uint32_t)head_size);
    hc_put_le32(head + 52, (uint32_t)descriptor_size);
    hc_put_le32(head + 56, (uint32_t)(head_size + descriptor_size));
    hc_put_le32(head + 60, (uint32_t)keys_size);
    for (int level = 0; level < image->levels; level++) {
        uint8_t *entry = head + HEADER_SIZE + (size_t)level * LEVEL_ENTRY;
        hc_put_le64(entry, offsets[level]);
        hc_put_le64(entry + 8, hc_level_bytes(image, level));
        hc_put_le64(entry + 16, hc_level_bytes(image, level));
    }
    (void)hc_output_append(output, head, head_size);
    (void)hc_output_append(output, descriptor, descriptor_size);
    (void)hc_output_append(output, keys, keys_size);
    for (int level = image->levels - 1; level >= 0; level--) {
        static const uint8_t padding[16] = { 0 };
        (void)hc_output_append(output, padding, (size_t)(offsets[level] - output->size));
        (void)hc_append_samples(output, hc_level_texels(image, level),
                                hc_level_bytes(image, level) / size, size);
    }
    return HC_OK;
}
