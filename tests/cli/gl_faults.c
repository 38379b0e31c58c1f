/* Loaded before the program: the first bake finds OpenGL failing in the way that HC_GL_FAULT names.
 * epoxy calls GL by pointers that can be set. */
#include <epoxy/gl.h>

#include <stdlib.h>
#include <string.h>

/* The trial of arithmetic, which comes first, is let pass: two programs, and what they do. */
enum { SHADERS_BEFORE = 2, CHECKS_BEFORE = 12 };

static int asked;

static GLenum lost(void)
{
    return ++asked > CHECKS_BEFORE ? GL_INNOCENT_CONTEXT_RESET : GL_NO_ERROR;
}

static GLenum out_of_memory(void)
{
    return ++asked > CHECKS_BEFORE ? GL_OUT_OF_MEMORY : GL_NO_ERROR;
}

static void does_not_compile(GLuint shader, GLenum name, GLint *value)
{
    (void)shader;
    *value = name == GL_COMPILE_STATUS && ++asked > SHADERS_BEFORE ? GL_FALSE : GL_TRUE;
}

__attribute__((constructor)) static void set_fault(void)
{
    const char *fault = getenv("HC_GL_FAULT");
    if (fault != NULL && strcmp(fault, "lost") == 0) {
        epoxy_glGetGraphicsResetStatus = lost;
    } else if (fault != NULL && strcmp(fault, "memory") == 0) {
        epoxy_glGetError = out_of_memory;
    } else if (fault != NULL && strcmp(fault, "compile") == 0) {
        epoxy_glGetShaderiv = does_not_compile;
    }
}
