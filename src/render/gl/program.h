/* Shaders of several files into a program; complaints name file and line. */
#ifndef HC_RENDER_GL_PROGRAM_H
#define HC_RENDER_GL_PROGRAM_H

#include <heightcast/result.h>

typedef struct hc_shader_text {
    const char *name, *text;
} hc_shader_text;

/* The files of shaders/, NULL name at the end. */
extern const hc_shader_text hc_shader_texts[];

/* Compile and link: `head` (the #version line, and #defines) before each stage, then the stage's
 * texts, which end with a NULL name. *program is an OpenGL name; 0 after an error. */
hc_result hc_gl_build(unsigned *program, const char *head, const hc_shader_text *vertex,
                      const hc_shader_text *fragment, hc_log *log);

/* relief.vert, and relief.frag behind heightcast.glsl, likewise. */
hc_result hc_gl_build_relief(unsigned *program, const char *head, hc_log *log);

#endif
