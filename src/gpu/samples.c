/* What depends on a sample and its neighbours alone: bounds of cells, slopes. */
#include "gpu.h"

#include "base/fail.h"

#include <epoxy/gl.h>

#include <stdlib.h>

enum { HEIGHTS_UNIT = 1 };

typedef struct pass {
    hc_gpu         *gpu;
    const hc_field *field;
    unsigned        heights, out;
    hc_log         *log;
} pass;

static hc_result begin(pass *p)
{
    const hc_field *field  = p->field;
    hc_result       result = hc_field_check(field, p->log);
    result                 = result == HC_OK ? hc_gpu_begin(p->gpu, p->log) : result;
    if (result == HC_OK) {
        glActiveTexture(GL_TEXTURE0);
        result = hc_gpu_texture(&p->out, field->width, field->height, 1, NULL, p->log);
    }
    if (result == HC_OK) {
        glActiveTexture(GL_TEXTURE0 + HEIGHTS_UNIT);
        result =
            hc_gpu_texture(&p->heights, field->width, field->height, 1, field->heights, p->log);
    }
    return result;
}

static void end(const pass *p)
{
    glDeleteTextures(1, &p->heights);
    glDeleteTextures(1, &p->out);
}

static hc_result use(const pass *p, unsigned *program, hc_gpu_shader shader)
{
    const hc_field *field  = p->field;
    const unsigned  wrap   = (unsigned)field->wrap;
    const hc_result result = hc_gpu_use(p->gpu, program, shader, false, false, p->log);
    if (result == HC_OK) {
        hc_gpu_set_pair(*program, "u_size", field->width, field->height);
        hc_gpu_set_pair(*program, "u_wraps", (wrap & HC_WRAP_U) != 0, (wrap & HC_WRAP_V) != 0);
        glUniform1i(glGetUniformLocation(*program, "u_heights"), HEIGHTS_UNIT);
        glBindImageTexture(0, p->out, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
    }
    return result;
}

static hc_result run(const pass *p, unsigned program, float *values)
{
    const int first[2] = { 0, 0 };
    const int last[2]  = { p->field->width, p->field->height };
    (void)hc_gpu_run(p->gpu, program, first, last);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, p->out);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, values);
    return hc_gl_check("baking", p->log);
}

hc_result hc_gpu_bake_bounds(hc_gpu *gpu, float *bounds, const hc_field *field, hc_extreme extreme,
                             hc_log *log)
{
    pass      p = { .gpu = gpu, .field = field, .log = log };
    unsigned  program;
    hc_result result = begin(&p);
    result           = result == HC_OK ? use(&p, &program, HC_GPU_BOUNDS) : result;
    if (result == HC_OK) {
        glUniform1i(glGetUniformLocation(program, "u_minimum"), extreme == HC_MINIMUM);
        result = run(&p, program, bounds);
    }
    end(&p);
    return result;
}

static hc_result slopes(const pass *p, unsigned program, float *slope, bool along_u)
{
    const double step = along_u ? hc_field_step_u(p->field) : hc_field_step_v(p->field);
    hc_gpu_set_pair(program, "u_sides", along_u ? 1 : 0, along_u ? 0 : 1);
    glUniform1d(glGetUniformLocation(program, "u_per_step"), 1.0 / step);
    return run(p, program, slope);
}

static hc_result both_slopes(const pass *p, float *gradients, float *slope)
{
    const size_t count = (size_t)p->field->width * (size_t)p->field->height;
    unsigned     program;
    hc_result    result = use(p, &program, HC_GPU_GRADIENT);
    for (size_t axis = 0; axis < 2 && result == HC_OK; axis++) {
        result = slopes(p, program, slope, axis == 0);
        for (size_t i = 0; i < count && result == HC_OK; i++) {
            gradients[2 * i + axis] = slope[i];
        }
    }
    return result;
}

hc_result hc_gpu_bake_gradient(hc_gpu *gpu, float *gradients, const hc_field *field, hc_log *log)
{
    pass      p      = { .gpu = gpu, .field = field, .log = log };
    float    *slope  = NULL;
    hc_result result = begin(&p);
    if (result == HC_OK) {
        slope  = malloc((size_t)field->width * (size_t)field->height * sizeof *slope);
        result = slope != NULL
                     ? both_slopes(&p, gradients, slope)
                     : hc_fail(log, HC_ERROR_MEMORY, "no memory for slopes of %d x %d samples",
                               field->width, field->height);
    }
    free(slope);
    end(&p);
    return result;
}
