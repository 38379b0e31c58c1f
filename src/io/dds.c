/* DDS with the DX10 header: one two-dimensional texture with its mip levels, uncompressed. The
 * container has no place for metadata: the text stands behind the texels, where other readers do
 * not look, and two reserved header words say so.
 * After: Microsoft's programming guide for DDS. */
#include "texture.h"

#include "base/fail.h"

#include <string.h>

enum { HEADER_SIZE = 148, RESERVED = 32 };

#define FOURCC(a, b, c, d)                                                                         \
    ((uint32_t)(a) | (uint32_t)(b) << 8 | (uint32_t)(c) << 16 | (uint32_t)(d) << 24)
#define MAGIC FOURCC('D', 'D', 'S', ' ')
#define DX10 FOURCC('D', 'X', '1', '0')
#define TEXT_MARK FOURCC('H', 'C', 'S', 'T')

/* dwFlags: caps, height, width, pitch, pixel format, mip map count. dwCaps: complex, texture, mip
 * map. */
#define FLAGS 0x2100FU
#define CAPS_TEXTURE 0x1000U
#define CAPS_MIPS 0x401008U

enum { RESOURCE_TEXTURE_2D = 3, ALPHA_CUSTOM = 4 };

/* ---- in -------------------------------------------------------------------------------------- */

static hc_result unsupported(const hc_source *source, const char *what, uint32_t value, hc_log *log)
{
    return hc_fail(
        log, HC_ERROR_UNSUPPORTED,
        "%s: DDS with %s %u is not read; use a plain 2D texture with a DX10 header and 8 "
        "or 16 bit unorm or 32 bit float texels",
        source->name, what, value);
}

/* The text ends the file; its length is in the header. */
static hc_result take_trailer(hc_image *image, const hc_source *source, const uint8_t *header,
                              hc_log *log)
{
    char           text[HC_TEXT_SIZE];
    const uint32_t length = hc_get_le32(header + RESERVED + 4);
    if (hc_get_le32(header + RESERVED) != TEXT_MARK || length >= HC_TEXT_SIZE
        || length > source->size) {
        return HC_OK;
    }
    const hc_result result = hc_source_need(source, source->size - length, text, length, log);
    if (result == HC_OK) {
        hc_image_take_text(image, text, length);
    }
    return result;
}

hc_result hc_read_dds(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    uint8_t   header[HEADER_SIZE];
    hc_result result = hc_source_need(source, 0, header, sizeof header, log);
    if (result != HC_OK) {
        return result;
    }
    if (hc_get_le32(header + 84) != DX10) {
        return unsupported(source, "FourCC", hc_get_le32(header + 84), log);
    }
    const hc_texel_format *format = hc_texel_format_of_dxgi(hc_get_le32(header + 128));
    if (format == NULL) {
        return unsupported(source, "DXGI format", hc_get_le32(header + 128), log);
    }
    if (hc_get_le32(header + 132) != RESOURCE_TEXTURE_2D || hc_get_le32(header + 136) != 0) {
        return unsupported(source, "resource dimension", hc_get_le32(header + 132), log);
    }
    if (hc_get_le32(header + 140) > 1) {
        return unsupported(source, "array size", hc_get_le32(header + 140), log);
    }
    const uint32_t sides[2] = { hc_get_le32(header + 16), hc_get_le32(header + 12) };
    result                  = take_trailer(image, source, header, log);
    if (result == HC_OK) {
        result = hc_prepare_texture(image, source, format, sides, hc_get_le32(header + 28),
                                    header_only, log);
    }
    if (result != HC_OK || header_only) {
        return result;
    }
    return hc_read_samples(source, HEADER_SIZE, image->data, hc_image_samples(image),
                           hc_sample_size(image->type), false, log);
}

/* ---- out ------------------------------------------------------------------------------------- */

hc_result hc_write_dds(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    uint8_t      header[HEADER_SIZE] = { 0 };
    const size_t size                = hc_sample_size(image->type);
    const size_t texel               = (size_t)image->channels * size;
    const size_t length              = strlen(image->text);
    hc_put_le32(header, MAGIC);
    hc_put_le32(header + 4, 124);
    hc_put_le32(header + 8, FLAGS);
    hc_put_le32(header + 12, (uint32_t)image->height);
    hc_put_le32(header + 16, (uint32_t)image->width);
    hc_put_le32(header + 20, (uint32_t)((size_t)image->width * texel));
    hc_put_le32(header + 28, (uint32_t)image->levels);
    hc_put_le32(header + RESERVED, length > 0 ? TEXT_MARK : 0U);
    hc_put_le32(header + RESERVED + 4, (uint32_t)length);
    hc_put_le32(header + 76, 32);
    hc_put_le32(header + 80, 4); /* the FourCC is valid */
    hc_put_le32(header + 84, DX10);
    hc_put_le32(header + 108, image->levels > 1 ? CAPS_MIPS : CAPS_TEXTURE);
    hc_put_le32(header + 128, hc_texel_format_of_image(image)->dxgi);
    hc_put_le32(header + 132, RESOURCE_TEXTURE_2D);
    hc_put_le32(header + 140, 1);
    hc_put_le32(header + 144, image->channels == 4 ? ALPHA_CUSTOM : 0);
    (void)hc_output_append(output, header, sizeof header);
    (void)hc_append_samples(output, image->data, hc_image_samples(image), size);
    (void)hc_output_append(output, image->text, length);
    return HC_OK;
}
