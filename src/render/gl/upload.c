#include "upload.h"

#include "gl/context.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- textures ------------------------------------------------------------------------------ */

static void begin_texture(unsigned *texture, int unit, int levels)
{
    glGenTextures(1, texture);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, *texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                    levels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
}

hc_result hc_upload_image(unsigned *texture, int unit, const float *texels, int width, int height,
                          int channels, const char *what, hc_log *log)
{
    static const GLenum inner[] = { 0, GL_R32F, 0, GL_RGB32F, GL_RGBA32F };
    static const GLenum outer[] = { 0, GL_RED, 0, GL_RGB, GL_RGBA };
    const hc_result     result  = hc_gl_check_size(width, height, what, log);
    if (result != HC_OK) {
        return result;
    }
    begin_texture(texture, unit, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, (GLint)inner[channels], width, height, 0, outer[channels],
                 GL_FLOAT, texels);
    return hc_gl_check(what, log);
}

hc_result hc_upload_bytes(unsigned *texture, int unit, const uint8_t *texels, int width, int height,
                          const char *what, hc_log *log)
{
    const hc_result result = hc_gl_check_size(width, height, what, log);
    if (result != HC_OK) {
        return result;
    }
    begin_texture(texture, unit, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    return hc_gl_check(what, log);
}

void hc_upload_wrap(hc_wrap wrap)
{
    const bool u = ((unsigned)wrap & HC_WRAP_U) != 0;
    const bool v = ((unsigned)wrap & HC_WRAP_V) != 0;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, u ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, v ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

void hc_upload_baked(int heights_unit, int ratios_unit, const struct hc_gpu_map *map)
{
    const unsigned textures[] = { map->heights, map->ratios };
    const int      units[]    = { heights_unit, ratios_unit };
    for (int i = 0; i < 2; i++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)units[i]);
        glBindTexture(GL_TEXTURE_2D, textures[i]);
        hc_upload_wrap(map->field.wrap);
    }
}

hc_result hc_upload_pyramid(unsigned *texture, int unit, const hc_pyramid *pyramid, hc_log *log)
{
    begin_texture(texture, unit, pyramid->levels);
    for (int level = 0; level < pyramid->levels; level++) {
        int          width, height;
        const float *values = hc_pyramid_level(pyramid, level, &width, &height);
        glTexImage2D(GL_TEXTURE_2D, level, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, values);
    }
    return hc_gl_check("pyramid", log);
}

hc_result hc_upload_blocks(unsigned *texture, int unit, const hc_tracer *tracer, hc_log *log)
{
    hc_block_map map;
    if (tracer == NULL || !hc_tracer_block_map(tracer, &map, NULL)) {
        return HC_OK;
    }
    const hc_result result = hc_gl_check_size(map.width, map.height, "blocks", log);
    if (result != HC_OK) {
        return result;
    }
    uint32_t *texels = calloc((size_t)map.width * (size_t)map.height, 2 * sizeof *texels);
    if (texels == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the blocks of fast");
    }
    (void)hc_tracer_block_map(tracer, &map, texels);
    begin_texture(texture, unit, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32UI, map.width, map.height, 0, GL_RG_INTEGER,
                 GL_UNSIGNED_INT, texels);
    free(texels);
    return hc_gl_check("blocks", log);
}

/* ---- uniforms ------------------------------------------------------------------------------ */

int hc_gl_method(hc_trace_method method)
{
    static const int numbers[] = {
        [HC_TRACE_SAFE] = 1,        [HC_TRACE_MAXMIP] = 2,     [HC_TRACE_QDM] = 3,
        [HC_TRACE_PARALLAX] = 4,    [HC_TRACE_LINEAR] = 5,     [HC_TRACE_RELIEF] = 6,
        [HC_TRACE_OCCLUSION] = 7,   [HC_TRACE_CONE_FIXED] = 8, [HC_TRACE_CONE_LOOP] = 9,
        [HC_TRACE_CONE_EXACT] = 10, [HC_TRACE_RELAXED] = 11,   [HC_TRACE_ROBUST] = 12,
        [HC_TRACE_QUICK] = 13,      [HC_TRACE_PDM] = 14,       [HC_TRACE_FAST] = 15
    };
    return numbers[method];
}

/* Uniforms that the compiler has thrown away have the location -1, which GL ignores. */
void hc_upload_int(unsigned program, const char *name, int value)
{
    glUniform1i(glGetUniformLocation(program, name), value);
}

void hc_upload_float(unsigned program, const char *name, double value)
{
    glUniform1f(glGetUniformLocation(program, name), (float)value);
}

void hc_upload_pair(unsigned program, const char *name, double x, double y)
{
    glUniform2f(glGetUniformLocation(program, name), (float)x, (float)y);
}

void hc_upload_vector(unsigned program, const char *name, const double v[3])
{
    glUniform3f(glGetUniformLocation(program, name), (float)v[0], (float)v[1], (float)v[2]);
}

void hc_upload_field(unsigned program, const hc_field *field, const hc_trace_options *trace,
                     hc_trace_method method)
{
    const unsigned wrap = (unsigned)field->wrap;
    const bool     tops = method == HC_TRACE_QDM || trace->surface == HC_SURFACE_STEPS;
    const double   zero = (field->registration == HC_GRID ? 0.0 : 0.5) - (tops ? 0.5 : 0.0);
    hc_upload_int(program, "hc_levels", hc_pyramid_levels(field->width, field->height));
    glUniform2i(glGetUniformLocation(program, "hc_size"), field->width, field->height);
    glUniform2i(glGetUniformLocation(program, "hc_wraps"), (wrap & HC_WRAP_U) != 0,
                (wrap & HC_WRAP_V) != 0);
    hc_upload_pair(program, "hc_steps", floor(1.0 / hc_field_step_u(field) + 0.5),
                   floor(1.0 / hc_field_step_v(field) + 0.5));
    hc_upload_pair(program, "hc_zero", zero, zero);
    hc_upload_int(program, "hc_step_count", trace->steps);
    hc_upload_int(program, "hc_refinements", trace->refinements);
}

static void set_whole_pair(unsigned program, const char *name, const int pair[2])
{
    glUniform2i(glGetUniformLocation(program, name), pair[0], pair[1]);
}

void hc_upload_block_shape(unsigned program, int unit, const hc_tracer *tracer)
{
    hc_block_map map;
    if (tracer == NULL || !hc_tracer_block_map(tracer, &map, NULL)) {
        return;
    }
    hc_upload_int(program, "hc_blocks", unit);
    set_whole_pair(program, "hc_block_room", map.room);
    set_whole_pair(program, "hc_block_cells", map.cells);
    set_whole_pair(program, "hc_block_first", map.first);
    hc_upload_int(program, "hc_block_levels", map.levels);
    hc_upload_float(program, "hc_block_blur", (double)map.blur);
}

void hc_upload_eye(unsigned program, const hc_eye *eye)
{
    hc_upload_vector(program, "u_eye", eye->place);
    hc_upload_vector(program, "u_forward", eye->forward);
    hc_upload_vector(program, "u_right", eye->right);
    hc_upload_vector(program, "u_down", eye->down);
    hc_upload_int(program, "u_orthographic", eye->parallel);
    hc_upload_pair(program, "u_picture", eye->width, eye->height);
}

/* ---- programs ------------------------------------------------------------------------------ */

static bool is_sparse(const hc_tracer *tracer)
{
    hc_block_map map;
    return tracer != NULL && hc_tracer_block_map(tracer, &map, NULL) && map.sparse;
}

void hc_gl_head(char *head, size_t size, hc_trace_method method, hc_cones cones,
                const hc_tracer *tracer)
{
    (void)snprintf(head, size,
                   "#version 430 core\n#define HC_METHOD %d\n#define HC_GATHER\n"
                   "#define HC_CONE_CHANNELS %d\n%s",
                   hc_gl_method(method), cones == HC_CONES_L1 ? 1 : 4,
                   is_sparse(tracer) ? "#define HC_SPARSE\n" : "");
}

static hc_shader_text named(const char *name)
{
    return (hc_shader_text){ name, hc_shader_text_named(name) };
}

hc_gl_recipe hc_gl_recipe_of(const char *head, const char *vertex, const char *const *fragment)
{
    hc_gl_recipe recipe = { .head     = head,
                            .vertex   = { named(vertex) },
                            .fragment = { named("heightcast.glsl") } };
    for (int i = 0; fragment[i] != NULL; i++) {
        recipe.fragment[1 + i] = named(fragment[i]);
    }
    return recipe;
}
