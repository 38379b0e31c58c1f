/* A stage's field, ratios, pyramid and colours as textures, its numbers as uniforms, its
 * program. */
#ifndef HC_RENDER_GL_LOAD_H
#define HC_RENDER_GL_LOAD_H

#include "../stage.h"
#include "upload.h"

enum {
    HC_GL_HEIGHTS = 0,
    HC_GL_RATIOS,
    HC_GL_BOUNDS,
    HC_GL_EXACT_BOUNDS,
    HC_GL_BLOCKS,
    HC_GL_ALBEDO,
    HC_GL_TEXTURES
};

/* textures [out] names, by texture unit. */
hc_result hc_gl_load(unsigned textures[HC_GL_TEXTURES], const hc_stage *stage, hc_log *log);

/* relief.frag behind heightcast.glsl, with `head` before it: a program of `context`. */
hc_result hc_gl_build_relief(unsigned *program, hc_gl_context *context, const char *head,
                             hc_log *log);

/* All uniforms of the program in use that do not change while a picture is drawn. */
void hc_gl_set(unsigned program, const hc_stage *stage, hc_trace_method method);

#endif
