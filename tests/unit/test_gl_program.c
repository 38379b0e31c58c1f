/* Complaints about shaders name file and line; skipped where there is no OpenGL. */
#ifdef HC_HAVE_GL
#include "render/gl/context.h"
#include "render/gl/program.h"
#endif

#include <heightcast/render.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#ifdef HC_HAVE_GL

static const hc_shader_text vertex[] = {
    { "good.vert", "void main(void)\n{\n    gl_Position = vec4(0.0);\n}\n" }, { NULL, NULL }
};

static void expect_complaint(const hc_shader_text *fragment, const char *says)
{
    unsigned program = 7;
    hc_log   log     = { .text = "" };
    assert_int_equal(hc_gl_build(&program, "#version 430 core\n", vertex, fragment, &log),
                     HC_ERROR_UNSUPPORTED);
    assert_int_equal(program, 0);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
    assert_null(strchr(log.text, '\n'));
}

static void complaints(void **state)
{
    static const hc_shader_text first[]  = { { "first.glsl",
                                               "float f(void)\n{\n    return x;\n}\n" },
                                             { "second.frag", "void main(void) { }\n" },
                                             { NULL, NULL } };
    static const hc_shader_text second[] = { { "first.glsl", "float f(void) { return 1.0; }\n" },
                                             { "second.frag",
                                               "void main(void)\n{\n\n    g();\n}\n" },
                                             { NULL, NULL } };
    static const hc_shader_text none[]   = { { "none.frag", "float f(void) { return 1.0; }\n" },
                                             { NULL, NULL } };
    hc_gl_context               context;
    hc_log                      log    = { .text = "" };
    hc_result                   result = hc_gl_open(&context, &log);
    (void)state;
    if (result == HC_ERROR_UNSUPPORTED) {
        hc_gl_close(&context);
        print_message("%s\n", log.text);
        skip();
    }
    assert_int_equal(result, HC_OK);
    expect_complaint(first, "shader first.glsl, line 3 ");
    expect_complaint(second, "shader second.frag, line 4 ");
    expect_complaint(none, "link");
    assert_int_equal(hc_gl_check("nothing", &log), HC_OK);
    hc_gl_close(&context);
}

#else

/* What a build without OpenGL says. */
static void complaints(void **state)
{
    static float   heights[16], rgb[3];
    const hc_scene scene = { .relief = { .field = { heights, 4, 4, .wrap = HC_WRAP_NONE } } };
    const hc_render_options options = { .backend = HC_BACKEND_GL };
    hc_picture              picture = { .width = 1, .height = 1, .rgb = rgb };
    hc_log                  log     = { .text = "" };
    (void)state;
    assert_int_equal(hc_render(&picture, &scene, &options, &log), HC_ERROR_UNSUPPORTED);
    assert_non_null(strstr(log.text, "libepoxy"));
}

#endif

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(complaints) };
    return cmocka_run_group_tests_name("gl_program", tests, NULL, NULL);
}
