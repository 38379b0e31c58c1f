/* Numbers, images and programs of any scene, to the context that is current. */
#ifndef HC_RENDER_GL_UPLOAD_H
#define HC_RENDER_GL_UPLOAD_H

#include "../eye.h"

#include "base/fail.h"
#include "gl/map.h"
#include "gl/program.h"

#include <heightcast/trace.h>

/* ---- textures: *texture is a new name, bound to `unit` ---- */

hc_result hc_upload_image(unsigned *texture, int unit, const float *texels, int width, int height,
                          int channels, const char *what, hc_log *log);
/* Four channels of a byte each, as 0 .. 1. */
hc_result hc_upload_bytes(unsigned *texture, int unit, const uint8_t *texels, int width, int height,
                          const char *what, hc_log *log);
/* Of the texture just loaded: textureGather reads over the edges that repeat. */
void hc_upload_wrap(hc_wrap wrap);
/* Heights and ratios that are textures already. */
void      hc_upload_baked(int heights_unit, int ratios_unit, const struct hc_gpu_map *map);
hc_result hc_upload_pyramid(unsigned *texture, int unit, const hc_pyramid *pyramid, hc_log *log);
/* Of fast; of other methods, and of NULL, there are none. */
hc_result hc_upload_blocks(unsigned *texture, int unit, const hc_tracer *tracer, hc_log *log);

/* ---- uniforms of the program in use; those that it does not have are passed over ---- */

void hc_upload_int(unsigned program, const char *name, int value);
void hc_upload_float(unsigned program, const char *name, double value);
void hc_upload_pair(unsigned program, const char *name, double x, double y);
void hc_upload_vector(unsigned program, const char *name, const double v[3]);

/* What heightcast.glsl wants to know, but for its textures. */
void hc_upload_field(unsigned program, const hc_field *field, const hc_trace_options *trace,
                     hc_trace_method method);
/* And about the texture of blocks, if the tracer has some. */
void hc_upload_block_shape(unsigned program, int unit, const hc_tracer *tracer);
/* u_eye, u_forward, u_right, u_down, u_orthographic, u_picture. */
void hc_upload_eye(unsigned program, const hc_eye *eye);

/* ---- programs ---- */

/* Number of the tracer's method in heightcast.glsl. */
int hc_gl_method(hc_trace_method method);

/* What stands before both shaders. tracer: the method's, or NULL where its map is on the GPU. */
void hc_gl_head(char *head, size_t size, hc_trace_method method, hc_cones cones,
                const hc_tracer *tracer);

/* A file for the vertex shader, and for the fragment shader some, NULL at the end, behind
 * heightcast.glsl; `head` before both. */
hc_gl_recipe hc_gl_recipe_of(const char *head, const char *vertex, const char *const *fragment);

#endif
