/* DDS: one two-dimensional texture with its mip levels, uncompressed. Texels of one or four bytes
 * are written in the forms that the format has had since DirectX 9 (L8 and A8R8G8B8, blue first),
 * which everything reads; all others with the DX10 header. The container has no place for metadata:
 * the text stands behind the texels, where other readers do not look, and two reserved header words
 * say so.
 * After: Microsoft's programming guide for DDS. */
#include "texture.h"

#include "base/fail.h"

#include <string.h>

enum {
    HEADER_SIZE   = 128,
    EXTENDED_SIZE = 148, /* with the DX10 header */
    RESERVED      = 32,
    PIXEL_FORMAT  = 80, /* its flags; then FourCC, bits, four masks */
    TEXEL_CHUNK   = 4096
};

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
#define HAS_FOURCC 0x4U

enum { RESOURCE_TEXTURE_2D = 3, ALPHA_CUSTOM = 4 };

/* Pixel formats without a FourCC, 8 bits a channel. */
typedef struct classic {
    int      channels;
    uint32_t flags, bits, masks[4]; /* R, G, B, A */
} classic;

static const classic classics[] = {
    { 1, 0x20000, 8, { 0xFF, 0, 0, 0 } },
    { 4, 0x41, 32, { 0xFF0000, 0xFF00, 0xFF, 0xFF000000 } },
};
enum { CLASSICS = sizeof classics / sizeof *classics };

/* ---- in -------------------------------------------------------------------------------------- */

static hc_result unsupported(const hc_source *source, const char *what, uint32_t value, hc_log *log)
{
    return hc_fail(log, HC_ERROR_UNSUPPORTED,
                   "%s: DDS with %s %u is not read; use a plain 2D texture of 8 or 16 bit unorm or "
                   "32 bit float texels, L8, A8R8G8B8 or with a DX10 header",
                   source->name, what, value);
}

static hc_result read_classic(const hc_texel_format **format, const hc_source *source,
                              const uint8_t *header, hc_log *log)
{
    for (int i = 0; i < CLASSICS; i++) {
        bool same = hc_get_le32(header + PIXEL_FORMAT) == classics[i].flags
                    && hc_get_le32(header + PIXEL_FORMAT + 8) == classics[i].bits;
        for (int k = 0; k < 4; k++) {
            same = same && hc_get_le32(header + PIXEL_FORMAT + 12 + 4 * k) == classics[i].masks[k];
        }
        if (same) {
            *format = hc_texel_format_of(classics[i].channels, HC_U8);
            return HC_OK;
        }
    }
    return unsupported(source, "pixel format flags", hc_get_le32(header + PIXEL_FORMAT), log);
}

static hc_result read_extended(const hc_texel_format **format, const hc_source *source, hc_log *log)
{
    uint8_t         header[EXTENDED_SIZE];
    const hc_result result = hc_source_need(source, 0, header, sizeof header, log);
    if (result != HC_OK) {
        return result;
    }
    *format = hc_texel_format_of_dxgi(hc_get_le32(header + 128));
    if (*format == NULL) {
        return unsupported(source, "DXGI format", hc_get_le32(header + 128), log);
    }
    if (hc_get_le32(header + 132) != RESOURCE_TEXTURE_2D || hc_get_le32(header + 136) != 0) {
        return unsupported(source, "resource dimension", hc_get_le32(header + 132), log);
    }
    if (hc_get_le32(header + 140) > 1) {
        return unsupported(source, "array size", hc_get_le32(header + 140), log);
    }
    return HC_OK;
}

/* The text stands behind the texels; its length is in the header. */
static hc_result take_trailer(hc_image *image, const hc_source *source, const uint8_t *header,
                              uint64_t offset, hc_log *log)
{
    char           text[HC_TEXT_SIZE];
    const uint32_t length = hc_get_le32(header + RESERVED + 4);
    if (hc_get_le32(header + RESERVED) != TEXT_MARK || length >= HC_TEXT_SIZE) {
        return HC_OK;
    }
    const hc_result result = hc_source_need(source, offset, text, length, log);
    if (result == HC_OK) {
        hc_image_take_text(image, text, length);
    }
    return result;
}

static void swap_red_and_blue(uint8_t *texels, size_t bytes)
{
    for (size_t i = 0; i < bytes; i += 4) {
        const uint8_t red = texels[i];
        texels[i]         = texels[i + 2];
        texels[i + 2]     = red;
    }
}

hc_result hc_read_dds(hc_image *image, const hc_source *source, bool header_only, hc_log *log)
{
    uint8_t   header[HEADER_SIZE];
    hc_result result = hc_source_need(source, 0, header, sizeof header, log);
    if (result != HC_OK) {
        return result;
    }
    const bool fourcc   = (hc_get_le32(header + PIXEL_FORMAT) & HAS_FOURCC) != 0;
    const bool extended = fourcc && hc_get_le32(header + PIXEL_FORMAT + 4) == DX10;
    if (fourcc && !extended) {
        return unsupported(source, "FourCC", hc_get_le32(header + PIXEL_FORMAT + 4), log);
    }
    const hc_texel_format *format = NULL;
    result =
        extended ? read_extended(&format, source, log) : read_classic(&format, source, header, log);
    if (result == HC_OK) {
        const uint32_t sides[2] = { hc_get_le32(header + 16), hc_get_le32(header + 12) };
        result = hc_prepare_texture(image, source, format, sides, hc_get_le32(header + 28),
                                    header_only, log);
    }
    const uint64_t start = extended ? EXTENDED_SIZE : HEADER_SIZE;
    if (result == HC_OK) {
        result = take_trailer(image, source, header, start + hc_image_bytes(image), log);
    }
    if (result != HC_OK || header_only) {
        return result;
    }
    result = hc_read_samples(source, start, image->data, hc_image_samples(image),
                             hc_sample_size(image->type), false, log);
    if (result == HC_OK && !extended && image->channels == 4) {
        swap_red_and_blue(image->data, hc_image_bytes(image));
    }
    return result;
}

/* ---- out ------------------------------------------------------------------------------------- */

static const classic *find_classic(const hc_image *image)
{
    for (int i = 0; i < CLASSICS; i++) {
        if (image->type == HC_U8 && image->channels == classics[i].channels) {
            return &classics[i];
        }
    }
    return NULL;
}

static void put_pixel_format(uint8_t *header, const hc_image *image, const classic *form)
{
    if (form == NULL) {
        hc_put_le32(header + PIXEL_FORMAT, HAS_FOURCC);
        hc_put_le32(header + PIXEL_FORMAT + 4, DX10);
        hc_put_le32(header + 128, hc_texel_format_of(image->channels, image->type)->dxgi);
        hc_put_le32(header + 132, RESOURCE_TEXTURE_2D);
        hc_put_le32(header + 140, 1);
        hc_put_le32(header + 144, image->channels == 4 ? ALPHA_CUSTOM : 0);
        return;
    }
    hc_put_le32(header + PIXEL_FORMAT, form->flags);
    hc_put_le32(header + PIXEL_FORMAT + 8, form->bits);
    for (int k = 0; k < 4; k++) {
        hc_put_le32(header + PIXEL_FORMAT + 12 + 4 * k, form->masks[k]);
    }
}

static void append_blue_first(hc_output *output, const hc_image *image)
{
    uint8_t        chunk[TEXEL_CHUNK];
    const uint8_t *rest = image->data;
    for (size_t left = hc_image_bytes(image); left > 0;) {
        const size_t part = left < sizeof chunk ? left : sizeof chunk;
        memcpy(chunk, rest, part);
        swap_red_and_blue(chunk, part);
        (void)hc_output_append(output, chunk, part);
        rest += part;
        left -= part;
    }
}

hc_result hc_write_dds(hc_output *output, const hc_image *image, hc_log *log)
{
    (void)log; /* write errors stay with the output */
    uint8_t        header[EXTENDED_SIZE] = { 0 };
    const size_t   size                  = hc_sample_size(image->type);
    const size_t   texel                 = (size_t)image->channels * size;
    const size_t   length                = strlen(image->text);
    const classic *form                  = find_classic(image);
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
    hc_put_le32(header + 108, image->levels > 1 ? CAPS_MIPS : CAPS_TEXTURE);
    put_pixel_format(header, image, form);
    (void)hc_output_append(output, header, form == NULL ? EXTENDED_SIZE : HEADER_SIZE);
    if (form != NULL && image->channels == 4) {
        append_blue_first(output, image);
    } else {
        (void)hc_append_samples(output, image->data, hc_image_samples(image), size);
    }
    (void)hc_output_append(output, image->text, length);
    return HC_OK;
}
