/* The same scenes by OpenGL and the shaders in shaders/. */
#ifndef HC_RENDER_GL_H
#define HC_RENDER_GL_H

#include "../shade.h"

#include "base/fail.h"

#ifdef HC_HAVE_GL
/* Fill zeroed pixels. *seconds: of drawing alone. */
hc_result hc_gl_draw(hc_pixel *pixels, double *seconds, const hc_stage *stage, hc_log *log);
#else
static inline hc_result hc_gl_draw(hc_pixel *pixels, double *seconds, const hc_stage *stage,
                                   hc_log *log)
{
    (void)pixels;
    (void)seconds;
    (void)stage;
    return hc_fail(log, HC_ERROR_UNSUPPORTED,
                   "options.backend is gl; heightcast was built without libepoxy");
}
#endif

#endif
