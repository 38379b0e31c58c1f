/* Shaders of several files into a program; complaints name file and line. */
#ifndef HC_GL_PROGRAM_H
#define HC_GL_PROGRAM_H

#include <heightcast/result.h>

typedef struct hc_shader_text {
    const char *name, *text;
} hc_shader_text;

/* The files of shaders/, NULL name at the end. */
extern const hc_shader_text hc_shader_texts[];

const char *hc_shader_text_named(const char *name);

/* Compile and link: `head` (the #version line, and #defines) before each stage, then the stage's
 * texts, which end with a NULL name. *program is an OpenGL name; 0 after an error. */
hc_result hc_gl_build(unsigned *program, const char *head, const hc_shader_text *vertex,
                      const hc_shader_text *fragment, hc_log *log);

/* A program of one compute shader, likewise. */
hc_result hc_gl_build_compute(unsigned *program, const char *head, const hc_shader_text *compute,
                              hc_log *log);

#endif
