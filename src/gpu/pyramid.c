/* Pyramids level by level, each from the one below it. */
#include "gpu.h"

#include "base/fail.h"

#include <epoxy/gl.h>

static int half(int side, int level)
{
    return side >> level > 1 ? side >> level : 1;
}

/* The block of a level that holds a sample; the last one has what is left over. */
static int block_of(int sample, int side, int level)
{
    const int last = half(side, level) - 1;
    return sample >> level < last ? sample >> level : last;
}

static void bind_levels(unsigned texture, int level)
{
    glBindImageTexture(0, texture, level, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
    glBindImageTexture(1, texture, level - 1, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
}

hc_result hc_gpu_update_pyramid(hc_gpu *gpu, unsigned texture, int width, int height,
                                hc_rect changed, hc_extreme extreme, hc_log *log)
{
    const int       right = changed.x + changed.width - 1;
    const int       low   = changed.y + changed.height - 1;
    unsigned        program;
    const hc_result result = hc_gpu_use(gpu, &program, HC_GPU_PYRAMID, false, false, log);
    if (result != HC_OK) {
        return result;
    }
    hc_gpu_set_pair(program, "u_size", width, height);
    glUniform1i(glGetUniformLocation(program, "u_minimum"), extreme == HC_MINIMUM);
    if (hc_pyramid_levels(width, height) < 2) {
        return HC_OK;
    }
    bind_levels(texture, 1);
    hc_gpu_warm_up(gpu, program);
    hc_gpu_start(gpu);
    for (int level = 1; level < hc_pyramid_levels(width, height); level++) {
        const int first[2] = { block_of(changed.x, width, level),
                               block_of(changed.y, height, level) };
        const int end[2] = { block_of(right, width, level) + 1, block_of(low, height, level) + 1 };
        glUniform1i(glGetUniformLocation(program, "u_level"), level);
        bind_levels(texture, level);
        hc_gpu_dispatch(program, first, end);
    }
    (void)hc_gpu_stop(gpu);
    return hc_gl_check("pyramid", log);
}

hc_result hc_gpu_fill_pyramid(hc_gpu *gpu, unsigned texture, int width, int height,
                              hc_extreme extreme, hc_log *log)
{
    const hc_rect all = { 0, 0, width, height };
    return hc_gpu_update_pyramid(gpu, texture, width, height, all, extreme, log);
}

static void read_levels(const hc_pyramid *pyramid, unsigned texture)
{
    glBindTexture(GL_TEXTURE_2D, texture);
    for (int level = 0; level < pyramid->levels; level++) {
        glGetTexImage(GL_TEXTURE_2D, level, GL_RED, GL_FLOAT,
                      hc_pyramid_level(pyramid, level, NULL, NULL));
    }
}

hc_result hc_gpu_bake_pyramid(hc_gpu *gpu, hc_pyramid *pyramid, float *values, const float *heights,
                              int width, int height, hc_extreme extreme, hc_log *log)
{
    unsigned  texture = 0;
    hc_result result  = hc_gpu_begin(gpu, log);
    *pyramid          = (hc_pyramid){ .values = values,
                                      .width  = width,
                                      .height = height,
                                      .levels = hc_pyramid_levels(width, height) };
    if (result == HC_OK && pyramid->levels == 0) {
        result = hc_fail(log, HC_ERROR_ARGUMENT, "a pyramid of %d x %d samples", width, height);
    }
    if (result == HC_OK) {
        result = hc_gpu_texture(&texture, width, height, pyramid->levels, heights, log);
    }
    if (result == HC_OK) {
        result = hc_gpu_fill_pyramid(gpu, texture, width, height, extreme, log);
    }
    if (result == HC_OK) {
        read_levels(pyramid, texture);
        result = hc_gl_check("pyramid", log);
    }
    glDeleteTextures(1, &texture);
    return result;
}
