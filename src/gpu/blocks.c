/* What searches walk, in textures and buffers of their own: mips, or families (bake.comp). */
#include "cones.h"

#include <epoxy/gl.h>

enum { WAITING_BYTES = 5 * sizeof(GLuint) };

hc_gpu_walk hc_gpu_walks(hc_method method)
{
    switch (method) {
    case HC_METHOD_BRUTE: return HC_GPU_NOTHING;
    case HC_METHOD_EXACT:
    case HC_METHOD_GEMS: return HC_GPU_ALL;
    case HC_METHOD_FALLING_EDGE: return HC_GPU_LIMITING;
    default: return HC_GPU_MIPS;
    }
}

int hc_gpu_top_level(const hc_gpu_baking *b)
{
    int level = 1;
    while (1 << level < b->job->width || 1 << level < b->job->height) {
        level++;
    }
    return level;
}

/* ---- filling -------------------------------------------------------------------------------- */

static hc_result use_families(const hc_gpu_baking *b, unsigned *program)
{
    const hc_cone_search *search = &b->searches[b->current];
    const hc_cone_job    *job    = b->job;
    const hc_result result = hc_gpu_use(b->gpu, program, HC_GPU_FAMILIES, false, false, job->log);
    if (result == HC_OK) {
        hc_gpu_set_pair(*program, "u_size", job->width, job->height);
        hc_gpu_set_pair(*program, "u_wraps", job->wrap_u, job->wrap_v);
        hc_gpu_set_pair(*program, "u_sides", search->sign_u, search->sign_v);
        glUniform1i(glGetUniformLocation(*program, "u_heights"), HC_GPU_HEIGHTS_UNIT);
        glUniform1i(glGetUniformLocation(*program, "u_falling"),
                    hc_gpu_walks(b->method) == HC_GPU_LIMITING);
        glBindImageTexture(1, b->blocks, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    }
    return result;
}

static hc_result fill_families(const hc_gpu_baking *b, hc_rect changed)
{
    const int       right = changed.x + changed.width - 1;
    const int       low   = changed.y + changed.height - 1;
    unsigned        program;
    const hc_result result = use_families(b, &program);
    if (result != HC_OK) {
        return result;
    }
    hc_gpu_warm_up(b->gpu, program);
    hc_gpu_start(b->gpu);
    for (int level = 1; level <= hc_gpu_top_level(b); level++) {
        const int first[2] = { changed.x >> level, changed.y >> level };
        const int end[2]   = { (right >> level) + 1, (low >> level) + 1 };
        glUniform1i(glGetUniformLocation(program, "u_level"), level);
        hc_gpu_dispatch(program, first, end);
    }
    (void)hc_gpu_stop(b->gpu);
    return hc_gl_check("pyramid", b->job->log);
}

hc_result hc_gpu_fill_blocks(const hc_gpu_baking *b, hc_rect changed)
{
    const hc_cone_job *job = b->job;
    switch (hc_gpu_walks(b->method)) {
    case HC_GPU_NOTHING: return HC_OK;
    case HC_GPU_MIPS:
        return hc_gpu_update_pyramid(b->gpu, b->blocks, job->width, job->height, changed,
                                     HC_MAXIMUM, job->log);
    default: return fill_families(b, changed);
    }
}

/* ---- making --------------------------------------------------------------------------------- */

/* Rows where bake.comp's place_of puts the last level. */
static hc_result make_families(hc_gpu_baking *b)
{
    const int half_w = (b->job->width + 1) / 2;
    const int half_h = (b->job->height + 1) / 2;
    const int top    = hc_gpu_top_level(b);
    const int last   = top < 2 ? 0 : half_h - (half_h >> (top - 2)) + top - 2;
    return hc_gpu_empty_texture(&b->blocks, half_w + (half_w + 1) / 2,
                                half_h > last + 1 ? half_h : last + 1, 4, b->job->log);
}

static hc_result make_buffers(hc_gpu_baking *b)
{
    static const GLuint none[2] = { 0, 0 };
    const size_t        samples = (size_t)b->job->width * (size_t)b->job->height;
    const size_t        most    = HC_GPU_WAITING_MAX;
    const size_t        count   = samples < most ? samples : most;
    glGenBuffers(1, &b->counters);
    glBindBuffer(GL_ATOMIC_COUNTER_BUFFER, b->counters);
    glBufferData(GL_ATOMIC_COUNTER_BUFFER, sizeof none, none, GL_DYNAMIC_READ);
    glGenBuffers(1, &b->waiting);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, b->waiting);
    glBufferData(GL_SHADER_STORAGE_BUFFER, (GLsizeiptr)(count * WAITING_BYTES), NULL,
                 GL_DYNAMIC_COPY);
    return hc_gl_check("baking", b->job->log);
}

static hc_result make_blocks(hc_gpu_baking *b)
{
    const hc_cone_job *job  = b->job;
    const hc_gpu_walk  walk = hc_gpu_walks(b->method);
    hc_result          result;
    glActiveTexture(GL_TEXTURE0 + HC_GPU_BLOCKS_UNIT);
    if (walk == HC_GPU_NOTHING || walk == HC_GPU_MIPS) {
        return walk == HC_GPU_NOTHING ? HC_OK
                                      : hc_gpu_texture(&b->blocks, job->width, job->height,
                                                       hc_pyramid_levels(job->width, job->height),
                                                       job->heights, job->log);
    }
    result = make_families(b);
    return result == HC_OK ? make_buffers(b) : result;
}

hc_result hc_gpu_load(hc_gpu_baking *b)
{
    const hc_rect all = { 0, 0, b->job->width, b->job->height };
    glActiveTexture(GL_TEXTURE0 + HC_GPU_HEIGHTS_UNIT);
    hc_result result =
        hc_gpu_texture(&b->heights, b->job->width, b->job->height, 1, b->job->heights, b->job->log);
    result = result == HC_OK ? make_blocks(b) : result;
    if (result == HC_OK) {
        hc_gpu_bind(b);
    }
    const bool later = hc_gpu_walks(b->method) == HC_GPU_LIMITING;
    return result != HC_OK || later ? result : hc_gpu_fill_blocks(b, all);
}

void hc_gpu_unload(const hc_gpu_baking *b)
{
    glDeleteTextures(1, &b->heights);
    glDeleteTextures(1, &b->blocks);
    glDeleteBuffers(1, &b->counters);
    glDeleteBuffers(1, &b->waiting);
}

void hc_gpu_bind(const hc_gpu_baking *b)
{
    glActiveTexture(GL_TEXTURE0 + HC_GPU_HEIGHTS_UNIT);
    glBindTexture(GL_TEXTURE_2D, b->heights);
    glActiveTexture(GL_TEXTURE0 + HC_GPU_BLOCKS_UNIT);
    glBindTexture(GL_TEXTURE_2D, b->blocks);
    glBindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, b->counters);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, b->waiting);
}

/* ---- counters ------------------------------------------------------------------------------- */

uint32_t hc_gpu_count(const hc_gpu_baking *b, hc_gpu_counter counter)
{
    GLuint counted = 0;
    glBindBuffer(GL_ATOMIC_COUNTER_BUFFER, b->counters);
    glGetBufferSubData(GL_ATOMIC_COUNTER_BUFFER, (GLintptr)((size_t)counter * sizeof counted),
                       sizeof counted, &counted);
    return counted;
}

void hc_gpu_set_count(const hc_gpu_baking *b, hc_gpu_counter counter, uint32_t count)
{
    const GLuint set = count;
    glBindBuffer(GL_ATOMIC_COUNTER_BUFFER, b->counters);
    glBufferSubData(GL_ATOMIC_COUNTER_BUFFER, (GLintptr)((size_t)counter * sizeof set), sizeof set,
                    &set);
}
