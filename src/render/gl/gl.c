/* Bands of rows are drawn, read back and added to the pixels, for each sample in a pixel. */
#include "gl.h"

#include "load.h"

#include "base/clock.h"
#include "gl/context.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BAND_TEXELS = 1 << 18, PLANES = 3, CHANNELS = 4 };

typedef struct canvas {
    hc_gl_context context;
    unsigned      textures[HC_GL_TEXTURES];
    unsigned      program, exact; /* exact: 0 unless the view compares */
    unsigned      vertices;       /* core profiles want an array, though nothing is in it */
    unsigned      frame, planes[PLANES];
    int           rows; /* of a band */
    float        *back; /* what was drawn: PLANES planes, and one of exact distances */
} canvas;

/* ---- making -------------------------------------------------------------------------------- */

static hc_result build(unsigned *program, const hc_stage *stage, hc_trace_method method,
                       hc_log *log)
{
    char       head[128];
    const bool one = stage->scene.relief.trace.cones == HC_CONES_L1;
    (void)snprintf(
        head, sizeof head,
        "#version 430 core\n#define HC_METHOD %d\n#define HC_GATHER\n#define HC_CONE_CHANNELS %d\n",
        hc_gl_method(method), one ? 1 : 4);
    const hc_result result = hc_gl_build_relief(program, head, log);
    if (result == HC_OK) {
        glUseProgram(*program);
        hc_gl_set(*program, stage, method);
    }
    return result;
}

static hc_result make_frame(canvas *c, const hc_stage *stage, hc_log *log)
{
    static const GLenum attachments[PLANES] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                                GL_COLOR_ATTACHMENT2 };
    GLint               most                = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (stage->width > most) {
        return hc_fail(log, HC_ERROR_LIMIT,
                       "picture.width is %d; this driver draws at most %d pixels in a row, use cpu",
                       stage->width, most);
    }
    c->rows = BAND_TEXELS / stage->width + 1;
    c->rows = c->rows < stage->height ? c->rows : stage->height;
    glGenFramebuffers(1, &c->frame);
    glBindFramebuffer(GL_FRAMEBUFFER, c->frame);
    glGenTextures(PLANES, c->planes);
    glActiveTexture(GL_TEXTURE0 + HC_GL_TEXTURES);
    for (int i = 0; i < PLANES; i++) {
        glBindTexture(GL_TEXTURE_2D, c->planes[i]);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, stage->width, c->rows);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, c->planes[i], 0);
    }
    glDrawBuffers(PLANES, attachments);
    glGenVertexArrays(1, &c->vertices);
    glBindVertexArray(c->vertices);
    return hc_gl_check("picture", log);
}

static void draw_band(unsigned program, int first_row, int width, int rows, const double place[2])
{
    glUseProgram(program);
    glUniform1f(glGetUniformLocation(program, "u_first_row"), (float)first_row);
    glUniform2f(glGetUniformLocation(program, "u_sample"), (float)place[0], (float)place[1]);
    glViewport(0, 0, width, rows);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
}

/* Drivers finish compiling when they draw for the first time: that is no time of drawing. */
static void warm_up(const canvas *c)
{
    static const double middle[2] = { 0.5, 0.5 };
    draw_band(c->program, 0, 1, 1, middle);
    if (c->exact != 0) {
        draw_band(c->exact, 0, 1, 1, middle);
    }
}

static hc_result make(canvas *c, const hc_stage *stage, hc_log *log)
{
    const hc_trace_method method = stage->scene.relief.trace.method;
    hc_result             result = hc_gl_open(&c->context, log);
    result                       = result != HC_OK ? result : hc_gl_load(c->textures, stage, log);
    result                       = result != HC_OK ? result : make_frame(c, stage, log);
    result = result != HC_OK ? result : build(&c->program, stage, method, log);
    if (result == HC_OK && hc_view_compares(stage->options.view)) {
        result = build(&c->exact, stage, HC_TRACE_MAXMIP, log);
    }
    if (result != HC_OK) {
        return result;
    }
    /* Zero, since a context that is lost gives nothing back. */
    c->back =
        calloc((size_t)stage->width * (size_t)c->rows * CHANNELS * (PLANES + 1), sizeof *c->back);
    warm_up(c);
    return c->back != NULL ? HC_OK : hc_fail(log, HC_ERROR_MEMORY, "no memory for what GL draws");
}

static void unmake(canvas *c)
{
    if (c->context.context != NULL) {
        glDeleteProgram(c->program);
        glDeleteProgram(c->exact);
        glDeleteTextures(HC_GL_TEXTURES, c->textures);
        glDeleteTextures(PLANES, c->planes);
        glDeleteFramebuffers(1, &c->frame);
        glDeleteVertexArrays(1, &c->vertices);
    }
    free(c->back);
    hc_gl_close(&c->context);
}

/* ---- drawing ------------------------------------------------------------------------------- */

static void read_plane(float *plane, int index, int width, int rows)
{
    glReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)index);
    glReadPixels(0, 0, width, rows, GL_RGBA, GL_FLOAT, plane);
}

static float distance_of(const float *light)
{
    return light[3] < 1e29F ? light[3] : INFINITY; /* HC_MISS of heightcast.glsl */
}

static void add_pixel(hc_pixel *pixel, const hc_stage *stage, const float *planes[PLANES + 1],
                      double x, double y, int row)
{
    const float    *light = planes[0], *normal = planes[1], *counts = planes[2];
    const hc_sample sample = { .rgb      = { light[0], light[1], light[2] },
                               .distance = distance_of(light),
                               .exact    = stage->exact != NULL ? distance_of(planes[3]) : INFINITY,
                               .normal   = { normal[0], normal[1], normal[2] },
                               .height   = normal[3],
                               .steps    = counts[0],
                               .fetches  = counts[1],
                               .entered  = counts[2] > 0.5F,
                               .unconverged = counts[3] > 0.5F };
    double          origin[3], direction[3];
    hc_eye_ray(&stage->eye, origin, direction, x, y);
    hc_stage_add(pixel, stage, sample, direction, row);
}

static void add_band(hc_pixel *pixels, const canvas *c, const hc_stage *stage, int first_row,
                     int rows, const double place[2])
{
    const size_t texels = (size_t)stage->width * (size_t)rows;
    for (size_t i = 0; i < texels; i++) {
        const int    x   = (int)(i % (size_t)stage->width);
        const int    row = first_row + (int)(i / (size_t)stage->width);
        const float *planes[PLANES + 1];
        for (size_t k = 0; k <= PLANES; k++) {
            planes[k] = c->back + (k * texels + i) * CHANNELS;
        }
        add_pixel(&pixels[(size_t)row * (size_t)stage->width + (size_t)x], stage, planes,
                  x + place[0], row + place[1], row);
    }
}

/* One band of one sample; returns the seconds that drawing took. */
static double take_band(hc_pixel *pixels, const canvas *c, const hc_stage *stage, int first_row,
                        int rows, int sample)
{
    const size_t texels = (size_t)stage->width * (size_t)rows * CHANNELS;
    double       place[2];
    hc_eye_sample_place(&stage->eye, place, sample);
    if (c->exact != 0) {
        draw_band(c->exact, first_row, stage->width, rows, place);
        read_plane(c->back + PLANES * texels, 0, stage->width, rows);
    }
    const double start = hc_clock_now();
    draw_band(c->program, first_row, stage->width, rows, place);
    const double seconds = hc_clock_now() - start;
    for (int k = 0; k < PLANES; k++) {
        read_plane(c->back + (size_t)k * texels, k, stage->width, rows);
    }
    add_band(pixels, c, stage, first_row, rows, place);
    return seconds;
}

static bool report(const hc_stage *stage, int row)
{
    const hc_progress *progress = &stage->options.progress;
    return progress->report == NULL
           || progress->report(progress->user, (double)row / stage->height);
}

static hc_result draw(hc_pixel *pixels, double *seconds, const canvas *c, const hc_stage *stage,
                      hc_log *log)
{
    *seconds = 0.0;
    for (int row = 0; row < stage->height; row += c->rows) {
        const int rows = c->rows < stage->height - row ? c->rows : stage->height - row;
        if (!report(stage, row)) {
            return HC_ERROR_CANCELLED;
        }
        for (int i = 0; i < stage->scene.camera.samples; i++) {
            *seconds += take_band(pixels, c, stage, row, rows, i);
        }
        const hc_result result = hc_gl_check("drawing", log);
        if (result != HC_OK) {
            return result;
        }
    }
    return HC_OK;
}

hc_result hc_gl_draw(hc_pixel *pixels, double *seconds, const hc_stage *stage, hc_log *log)
{
    canvas c = { .program = 0 };
    if (hc_gl_method(stage->scene.relief.trace.method) == 0) {
        return hc_fail(log, HC_ERROR_UNSUPPORTED,
                       "relief.trace.method is %s, which is the CPU's alone",
                       hc_trace_method_name(stage->scene.relief.trace.method));
    }
    hc_result result = make(&c, stage, log);
    if (result == HC_OK) {
        result = draw(pixels, seconds, &c, stage, log);
    }
    unmake(&c);
    return result;
}
