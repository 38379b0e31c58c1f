/* Terrain by OpenGL and shaders/terrain.frag. */
#ifndef HC_RENDER_GL_LANDSCAPE_H
#define HC_RENDER_GL_LANDSCAPE_H

#include "../terrain/terrain.h"

#include "base/fail.h"

/* A context, and what of a terrain is the same for all its pictures. */
typedef struct hc_terrain_gl hc_terrain_gl;

/* True if GL draws what the sun sees; of triangles rays do. */
static inline bool hc_terrain_gl_sees_sun(const hc_terrain *terrain)
{
    return terrain->options.backend == HC_BACKEND_GL && terrain->scene.polygons == HC_POLYGONS_NONE;
}

#ifdef HC_HAVE_GL
/* hc_terrain_gl_free accepts NULL. */
hc_result hc_terrain_gl_make(hc_terrain_gl **gl, const hc_terrain *terrain, hc_log *log);
void      hc_terrain_gl_free(hc_terrain_gl *gl);

/* Fill zeroed pixels. *seconds: of drawing alone. */
hc_result hc_terrain_gl_draw(hc_pixel *pixels, double *seconds, const hc_terrain *terrain,
                             const hc_eye *eye, hc_log *log);
#else
static inline hc_result hc_terrain_gl_make(hc_terrain_gl **gl, const hc_terrain *terrain,
                                           hc_log *log)
{
    (void)gl;
    (void)terrain;
    return hc_fail(log, HC_ERROR_UNSUPPORTED,
                   "options.backend is gl; heightcast was built without libepoxy");
}

static inline void hc_terrain_gl_free(hc_terrain_gl *gl)
{
    (void)gl;
}

static inline hc_result hc_terrain_gl_draw(hc_pixel *pixels, double *seconds,
                                           const hc_terrain *terrain, const hc_eye *eye,
                                           hc_log *log)
{
    (void)pixels;
    (void)seconds;
    (void)eye;
    return hc_terrain_gl_make(NULL, terrain, log);
}
#endif

#endif
