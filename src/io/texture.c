/* Texel formats of the graphics containers. */
#include "texture.h"

#include "base/fail.h"

#include <limits.h>

static const hc_texel_format formats[] = {
    { 1, HC_U8, false, 9, 61 },   { 2, HC_U8, false, 16, 49 },   { 4, HC_U8, false, 37, 28 },
    { 4, HC_U8, true, 43, 29 },   { 1, HC_U16, false, 70, 56 },  { 2, HC_U16, false, 77, 35 },
    { 4, HC_U16, false, 91, 11 }, { 1, HC_F32, false, 100, 41 }, { 2, HC_F32, false, 103, 16 },
    { 4, HC_F32, false, 109, 2 },
};
enum { FORMATS = sizeof formats / sizeof *formats };

const hc_texel_format *hc_texel_format_of(int channels, hc_sample_type type)
{
    for (int i = 0; i < FORMATS; i++) {
        if (formats[i].channels == channels && formats[i].type == type) {
            return &formats[i];
        }
    }
    return NULL;
}

const hc_texel_format *hc_texel_format_of_vulkan(uint32_t number)
{
    for (int i = 0; i < FORMATS; i++) {
        if (formats[i].vulkan == number) {
            return &formats[i];
        }
    }
    return NULL;
}

const hc_texel_format *hc_texel_format_of_dxgi(uint32_t number)
{
    for (int i = 0; i < FORMATS; i++) {
        if (formats[i].dxgi == number) {
            return &formats[i];
        }
    }
    return NULL;
}

hc_result hc_prepare_texture(hc_image *image, const hc_source *source,
                             const hc_texel_format *format, const uint32_t sides[2],
                             uint32_t levels, bool header_only, hc_log *log)
{
    image->type   = format->type;
    image->bits   = (int)hc_sample_size(format->type) * 8;
    image->srgb   = format->srgb;
    image->levels = levels == 0 ? 1 : levels > INT_MAX ? INT_MAX : (int)levels;
    const double base =
        (double)sides[0] * sides[1] * format->channels * (double)hc_sample_size(format->type);
    const hc_result held = hc_check_promise(source, base, 1.0, log);
    if (held != HC_OK) {
        return held;
    }
    return hc_image_prepare(image, source, sides[0], sides[1], (uint64_t)format->channels,
                            header_only, log);
}
