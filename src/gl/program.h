/* Shaders of several files into a program; complaints name file and line. A context keeps what it
 * has compiled. */
#ifndef HC_GL_PROGRAM_H
#define HC_GL_PROGRAM_H

#include "context.h"

typedef struct hc_shader_text {
    const char *name, *text;
} hc_shader_text;

/* The files of shaders/, NULL name at the end. */
extern const hc_shader_text hc_shader_texts[];

const char *hc_shader_text_named(const char *name);

enum { HC_GL_FILES_MAX = 5 };

/* Shaders of a program: texts, which end with a NULL name, behind `head`. */
typedef struct hc_gl_recipe {
    const char    *head; /* the #version line, and #defines */
    hc_shader_text vertex[HC_GL_FILES_MAX + 1], fragment[HC_GL_FILES_MAX + 1];
    hc_shader_text compute[HC_GL_FILES_MAX + 1]; /* no texts: the program has no such shader */
} hc_gl_recipe;

/* Compile and link in the context that is current. *program is an OpenGL name; 0 after an error. */
hc_result hc_gl_build(unsigned *program, const hc_gl_recipe *recipe, hc_log *log);

/* The same, unless `context`, which is current, has compiled it before: with the same head and
 * texts of the same names. It lives as long as the context, and its uniforms are as they were left:
 * set all that the shaders read. */
hc_result hc_gl_program_of(unsigned *program, hc_gl_context *context, const hc_gl_recipe *recipe,
                           hc_log *log);

/* True the first time that this is asked of a program of the context: drivers finish compiling when
 * it runs for the first time. */
bool hc_gl_first_run(hc_gl_context *context, unsigned program);

/* What hc_gl_close does with them. */
void hc_gl_forget_programs(hc_gl_context *context);

#endif
