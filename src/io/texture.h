/* Texel formats of the graphics containers, by their Vulkan and DXGI numbers. */
#ifndef HC_IO_TEXTURE_H
#define HC_IO_TEXTURE_H

#include "io_internal.h"

typedef struct hc_texel_format {
    int            channels;
    hc_sample_type type;
    bool           srgb;
    uint32_t       vulkan; /* VkFormat    */
    uint32_t       dxgi;   /* DXGI_FORMAT */
} hc_texel_format;

/* NULL if there is none. Linear formats are preferred for writing. */
const hc_texel_format *hc_texel_format_of(int channels, hc_sample_type type);
const hc_texel_format *hc_texel_format_of_vulkan(uint32_t number);
const hc_texel_format *hc_texel_format_of_dxgi(uint32_t number);

/* Take over a texel format and check the sizes; `levels` as the file says. */
hc_result hc_prepare_texture(hc_image *image, const hc_source *source,
                             const hc_texel_format *format, const uint32_t sides[2],
                             uint32_t levels, bool header_only, hc_log *log);

#endif
