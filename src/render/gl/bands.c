#include "bands.h"

#include "polygons.h"

#include "base/clock.h"
#include "base/fail.h"
#include "gl/context.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdlib.h>

enum { BAND_TEXELS = 1 << 18, CHANNELS = 4 };

/* What takes the samples. */
typedef struct sink {
    hc_pixel     *pixels;
    const hc_eye *eye;
    hc_band_add  *add;
    void         *user;
} sink;

/* Rows of the picture, one sample of each pixel. */
typedef struct band {
    int    first_row, rows;
    int    height; /* of the picture */
    double place[2];
} band;

/* ---- making -------------------------------------------------------------------------------- */

hc_result hc_bands_make(hc_bands *bands, int width, int height, int unit, hc_log *log)
{
    static const GLenum attachments[HC_GL_PLANES] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                                      GL_COLOR_ATTACHMENT2 };
    const int           rows                      = BAND_TEXELS / width + 1;
    GLint               most                      = 0;
    *bands = (hc_bands){ .width = width, .rows = rows < height ? rows : height };
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (width > most) {
        return hc_fail(log, HC_ERROR_LIMIT,
                       "picture.width is %d; this driver draws at most %d pixels in a row, use cpu",
                       width, most);
    }
    glGenFramebuffers(1, &bands->frame);
    glBindFramebuffer(GL_FRAMEBUFFER, bands->frame);
    glGenTextures(HC_GL_PLANES, bands->planes);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    for (int i = 0; i < HC_GL_PLANES; i++) {
        glBindTexture(GL_TEXTURE_2D, bands->planes[i]);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, bands->rows);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, bands->planes[i], 0);
    }
    glDrawBuffers(HC_GL_PLANES, attachments);
    glGenVertexArrays(1, &bands->vertices);
    glBindVertexArray(bands->vertices);
    /* Zero, since a context that is lost gives nothing back. */
    bands->back = calloc((size_t)width * (size_t)bands->rows * CHANNELS * (HC_GL_PLANES + 1),
                         sizeof *bands->back);
    if (bands->back == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for what GL draws");
    }
    return hc_gl_check("picture", log);
}

void hc_bands_free(hc_bands *bands)
{
    glDeleteTextures(HC_GL_PLANES, bands->planes);
    glDeleteFramebuffers(1, &bands->frame);
    glDeleteVertexArrays(1, &bands->vertices);
    glDeleteRenderbuffers(1, &bands->depth);
    free(bands->back);
}

hc_result hc_bands_take_bodies(hc_bands *bands, const hc_gl_bodies *bodies, hc_log *log)
{
    bands->bodies = *bodies;
    if (bodies->count == 0 && bodies->ground == NULL) {
        return HC_OK;
    }
    glGenRenderbuffers(1, &bands->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, bands->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, bands->width, bands->rows);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, bands->depth);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glClearDepthf(0.0F);
    return hc_gl_check("depth buffer", log);
}

/* Where fragments' middles are, rays go through the sample's place. */
static void use_window(unsigned program, const hc_bands *bands, const band *b)
{
    const double rows  = b->rows;
    const double scale = b->height / rows;
    const double right = 2.0 * (0.5 - b->place[0]) / bands->width;
    const double down  = scale + 2.0 * (0.5 - b->place[1] - b->first_row) / rows - 1.0;
    glUseProgram(program);
    glUniform4f(glGetUniformLocation(program, "u_window"), 1.0F, (float)scale, (float)right,
                (float)down);
}

static void draw_bodies(const hc_bands *bands, const band *b, bool ground)
{
    const hc_gl_bodies *bodies = &bands->bodies;
    if (ground) {
        use_window(bodies->ground_program, bands, b);
        hc_polygons_draw(bodies->ground);
    }
    if (bodies->count > 0) {
        use_window(bodies->program, bands, b);
        glBindVertexArray(bodies->array);
        glDrawArrays(GL_TRIANGLES, 0, bodies->count);
    }
    glBindVertexArray(bands->vertices);
}

static void draw_band(const hc_bands *bands, unsigned program, const band *b)
{
    glViewport(0, 0, bands->width, b->rows);
    if (bands->depth != 0) { /* the exact ground is that of rays */
        glClear(GL_DEPTH_BUFFER_BIT);
        draw_bodies(bands, b, bands->bodies.ground != NULL && program == bands->program);
    }
    glUseProgram(program);
    glUniform1f(glGetUniformLocation(program, "u_first_row"), (float)b->first_row);
    glUniform2f(glGetUniformLocation(program, "u_sample"), (float)b->place[0], (float)b->place[1]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
}

void hc_bands_warm(const hc_bands *bands)
{
    static const band one = { 0, 1, 1, { 0.5, 0.5 } };
    draw_band(bands, bands->program, &one);
    if (bands->exact != 0) {
        draw_band(bands, bands->exact, &one);
    }
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

static hc_sample sample_of(const float *planes[HC_GL_PLANES + 1], bool exact)
{
    const float *light = planes[0], *normal = planes[1], *counts = planes[2];
    return (hc_sample){ .rgb         = { light[0], light[1], light[2] },
                        .distance    = distance_of(light),
                        .exact       = exact ? distance_of(planes[3]) : INFINITY,
                        .normal      = { normal[0], normal[1], normal[2] },
                        .height      = normal[3],
                        .steps       = counts[0],
                        .fetches     = counts[1],
                        .crossings   = fmaxf(counts[2] - 1.0F, 0.0F),
                        .entered     = counts[2] > 0.5F,
                        .unconverged = counts[3] > 0.5F };
}

static void add_band(const sink *s, const hc_bands *bands, const band *b)
{
    const size_t width  = (size_t)bands->width;
    const size_t texels = width * (size_t)b->rows;
    for (size_t i = 0; i < texels; i++) {
        const int    x   = (int)(i % width);
        const int    row = b->first_row + (int)(i / width);
        const float *planes[HC_GL_PLANES + 1];
        double       origin[3], direction[3];
        for (size_t k = 0; k <= HC_GL_PLANES; k++) {
            planes[k] = bands->back + (k * texels + i) * CHANNELS;
        }
        const hc_sample sample = sample_of(planes, bands->exact != 0);
        hc_eye_ray(s->eye, origin, direction, x + b->place[0], row + b->place[1]);
        s->add(s->user, &s->pixels[(size_t)row * width + (size_t)x], &sample, direction, row);
    }
}

/* Returns the seconds that drawing took. */
static double take_band(const sink *s, const hc_bands *bands, const band *b)
{
    const size_t texels = (size_t)bands->width * (size_t)b->rows * CHANNELS;
    if (bands->exact != 0) {
        draw_band(bands, bands->exact, b);
        read_plane(bands->back + HC_GL_PLANES * texels, 0, bands->width, b->rows);
    }
    const double start = hc_clock_now();
    draw_band(bands, bands->program, b);
    const double seconds = hc_clock_now() - start;
    for (int k = 0; k < HC_GL_PLANES; k++) {
        read_plane(bands->back + (size_t)k * texels, k, bands->width, b->rows);
    }
    add_band(s, bands, b);
    return seconds;
}

hc_result hc_bands_draw(hc_pixel *pixels, double *seconds, const hc_bands *bands, const hc_eye *eye,
                        const hc_progress *progress, hc_band_add *add, void *user, hc_log *log)
{
    const sink s = { pixels, eye, add, user };
    *seconds     = 0.0;
    for (int row = 0; row < eye->height; row += bands->rows) {
        const int rest = eye->height - row;
        band      b    = { .first_row = row,
                           .rows      = bands->rows < rest ? bands->rows : rest,
                           .height    = eye->height };
        if (progress->report != NULL
            && !progress->report(progress->user, (double)row / eye->height)) {
            return HC_ERROR_CANCELLED;
        }
        for (int i = 0; i < eye->samples; i++) {
            hc_eye_sample_place(eye, b.place, i);
            *seconds += take_band(&s, bands, &b);
        }
        const hc_result result = hc_gl_check("drawing", log);
        if (result != HC_OK) {
            return result;
        }
    }
    return HC_OK;
}

hc_result hc_bands_distances(float *distances, const hc_bands *bands, const hc_eye *eye,
                             const hc_progress *progress, hc_log *log)
{
    const size_t width = (size_t)bands->width;
    for (int row = 0; row < eye->height; row += bands->rows) {
        const int  rest = eye->height - row;
        const band b    = { .first_row = row,
                            .rows      = bands->rows < rest ? bands->rows : rest,
                            .height    = eye->height,
                            .place     = { 0.5, 0.5 } };
        if (progress->report != NULL
            && !progress->report(progress->user, (double)row / eye->height)) {
            return HC_ERROR_CANCELLED;
        }
        draw_band(bands, bands->program, &b);
        read_plane(bands->back, 0, bands->width, b.rows);
        for (size_t i = 0; i < width * (size_t)b.rows; i++) {
            distances[(size_t)row * width + i] = bands->back[CHANNELS * i + 3];
        }
    }
    return hc_gl_check("drawing", log);
}
