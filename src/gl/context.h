/* An OpenGL context without a window. */
#ifndef HC_GL_CONTEXT_H
#define HC_GL_CONTEXT_H

#include <heightcast/result.h>

typedef struct hc_gl_context {
    void                 *display, *context; /* NULL: not there */
    struct hc_gl_program *programs;          /* compiled so far: hc_gl_program_of */
} hc_gl_context;

/* Make an OpenGL 4.3 core context and make it the calling thread's. HC_ERROR_UNSUPPORTED says what
 * is missing. hc_gl_close must follow, whatever the result. */
hc_result hc_gl_open(hc_gl_context *context, hc_log *log);
void      hc_gl_close(hc_gl_context *context);

/* Make it the calling thread's again, whatever was opened and closed since. */
hc_result hc_gl_use(const hc_gl_context *context, hc_log *log);

/* What GL has to complain about since the last call: HC_OK, HC_ERROR_MEMORY, or HC_ERROR_IO if the
 * context is lost. `what` is what was done. */
hc_result hc_gl_check(const char *what, hc_log *log);

/* HC_ERROR_LIMIT if textures cannot be as large as `what`. */
hc_result hc_gl_check_size(int width, int height, const char *what, hc_log *log);

/* What is made of the answers of glGetError and glGetGraphicsResetStatus. */
hc_result hc_gl_verdict(unsigned error, unsigned reset, const char *what, hc_log *log);

#endif
