#include "context.h"

#include "program.h"

#include "base/fail.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

static hc_result refuse(const char *missing, hc_log *log)
{
    return hc_fail(log, HC_ERROR_UNSUPPORTED, "OpenGL cannot be used: %s", missing);
}

/* epoxy ends the program where a library is missing. */
static bool has_libraries(void)
{
    void *egl = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (egl == NULL) {
        return false;
    }
    (void)dlclose(egl);
    return true;
}

static hc_result open_display(hc_gl_context *context, hc_log *log)
{
    if (!has_libraries()) {
        return refuse("there is no libEGL.so.1", log);
    }
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")
        || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return refuse("EGL has no driver that works without a window", log);
    }
    context->display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (context->display == EGL_NO_DISPLAY || !eglInitialize(context->display, NULL, NULL)) {
        context->display = NULL;
        return refuse("EGL finds no driver", log);
    }
    return HC_OK;
}

/* A context that says when the card was reset under it, where the driver can; else a plain one. */
static EGLContext make_context(EGLDisplay display)
{
    static const EGLint watchful[] = { EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                       EGL_LOSE_CONTEXT_ON_RESET,
                                       EGL_CONTEXT_MAJOR_VERSION,
                                       4,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       3,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE };
    const EGLContext    context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, watchful);
    return context != EGL_NO_CONTEXT
               ? context
               : eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, watchful + 2);
}

hc_result hc_gl_open(hc_gl_context *context, hc_log *log)
{
    *context               = (hc_gl_context){ .display = NULL };
    const hc_result result = open_display(context, log);
    if (result != HC_OK) {
        return result;
    }
    if (!eglBindAPI(EGL_OPENGL_API)) {
        return refuse("EGL has no OpenGL", log);
    }
    context->context = make_context(context->display);
    if (context->context == EGL_NO_CONTEXT) {
        context->context = NULL;
        return refuse("the driver has no OpenGL 4.3 core", log);
    }
    return hc_gl_use(context, log);
}

hc_result hc_gl_use(const hc_gl_context *context, hc_log *log)
{
    return eglMakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context)
               ? HC_OK
               : refuse("the driver draws to windows only", log);
}

void hc_gl_close(hc_gl_context *context)
{
    if (context->display != NULL) {
        (void)eglMakeCurrent(context->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    if (context->context != NULL) {
        (void)eglDestroyContext(context->display, context->context); /* with its programs */
    }
    hc_gl_forget_programs(context);
    /* The display is shared by the whole process, so it is not terminated. */
}

hc_result hc_gl_verdict(unsigned error, unsigned reset, const char *what, hc_log *log)
{
    if (reset != GL_NO_ERROR || error == GL_CONTEXT_LOST) {
        return hc_fail(log, HC_ERROR_IO,
                       "%s: the driver has lost its context%s; try again, or use cpu", what,
                       reset == GL_GUILTY_CONTEXT_RESET     ? ", for what was drawn"
                       : reset == GL_INNOCENT_CONTEXT_RESET ? ", for what others drew"
                                                            : "");
    }
    switch (error) {
    case GL_NO_ERROR: return HC_OK;
    case GL_OUT_OF_MEMORY:
        return hc_fail(log, HC_ERROR_MEMORY, "%s: out of memory for graphics; use cpu", what);
    default: return hc_fail(log, HC_ERROR_IO, "%s: OpenGL error 0x%04x; use cpu", what, error);
    }
}

static bool knows_resets(void)
{
    return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
}

hc_result hc_gl_check(const char *what, hc_log *log)
{
    const GLenum reset = knows_resets() ? glGetGraphicsResetStatus() : GL_NO_ERROR;
    return hc_gl_verdict(glGetError(), reset, what, log);
}

hc_result hc_gl_check_size(int width, int height, const char *what, hc_log *log)
{
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return width <= most && height <= most
               ? HC_OK
               : hc_fail(log, HC_ERROR_LIMIT,
                         "%s of %d x %d: textures of this driver have at most %d texels a side; "
                         "use cpu",
                         what, width, height, most);
}
