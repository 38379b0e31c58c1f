/* Relief by OpenGL. */
#include "gl.h"

#include "bands.h"
#include "load.h"

#include "gl/map.h"

#include <epoxy/gl.h>

#include <stdio.h>

typedef struct canvas {
    hc_gl_context  own;
    hc_gl_context *context; /* its own, or one that was lent  */
    bool           there;   /* it is the thread's             */
    unsigned       textures[HC_GL_TEXTURES];
    hc_bands       bands;
} canvas;

static hc_result build(unsigned *program, const canvas *c, const hc_stage *stage,
                       hc_trace_method method, hc_log *log)
{
    char head[128];
    hc_gl_head(head, sizeof head, method, stage->scene.relief.trace.cones, stage->tracer);
    const hc_result result = hc_gl_build_relief(program, c->context, head, log);
    if (result == HC_OK) {
        glUseProgram(*program);
        hc_gl_set(*program, stage, method);
    }
    return result;
}

static hc_result take_context(canvas *c, const hc_stage *stage, hc_log *log)
{
    const struct hc_gpu_map *map = stage->scene.relief.baked;
    hc_gl_context *lent    = map != NULL ? map->context : hc_gl_context_of(stage->options.gpu);
    c->context             = lent != NULL ? lent : &c->own;
    const hc_result result = lent != NULL ? hc_gl_use(lent, log) : hc_gl_open(&c->own, log);
    c->there               = result == HC_OK;
    return result;
}

static hc_result make(canvas *c, const hc_stage *stage, hc_log *log)
{
    const hc_trace_method method = stage->scene.relief.trace.method;
    hc_result             result = take_context(c, stage, log);
    result                       = result != HC_OK ? result : hc_gl_load(c->textures, stage, log);
    if (result == HC_OK) {
        result = hc_bands_make(&c->bands, stage->width, stage->height, HC_GL_TEXTURES, log);
    }
    result = result != HC_OK ? result : build(&c->bands.program, c, stage, method, log);
    if (result == HC_OK && hc_view_compares(stage->options.view)) {
        result = build(&c->bands.exact, c, stage, HC_TRACE_MAXMIP, log);
    }
    if (result == HC_OK) {
        hc_bands_warm(&c->bands);
    }
    return result;
}

static void unmake(canvas *c)
{
    if (c->there) {
        glDeleteTextures(HC_GL_TEXTURES, c->textures);
        hc_bands_free(&c->bands);
    }
    if (c->context == &c->own) {
        hc_gl_close(&c->own);
    }
}

static void add(void *user, hc_pixel *pixel, const hc_sample *sample, const double direction[3],
                int row)
{
    hc_stage_add(pixel, user, *sample, direction, row);
}

hc_result hc_gl_draw(hc_pixel *pixels, double *seconds, const hc_stage *stage, hc_log *log)
{
    canvas    c      = { .bands = { .program = 0 } };
    hc_stage  drawn  = *stage; /* for add, which is handed no const */
    hc_result result = make(&c, stage, log);
    if (result == HC_OK) {
        result = hc_bands_draw(pixels, seconds, &c.bands, &stage->eye, &stage->options.progress,
                               add, &drawn, log);
    }
    unmake(&c);
    return result;
}
