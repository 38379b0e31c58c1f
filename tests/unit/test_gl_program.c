/* Complaints of OpenGL: about shaders with file and line, about memory, about contexts that are
 * lost. What needs a context is skipped where there is none. */
#ifdef HC_HAVE_GL
#include "gl/context.h"
#include "gl/program.h"

#include <epoxy/gl.h>
#endif

#include <heightcast/render.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#ifdef HC_HAVE_GL

#define HEAD "#version 430 core\n"
#define GOOD_VERTEX                                                                                \
    {                                                                                              \
        {                                                                                          \
            "good.vert", "void main(void)\n{\n    gl_Position = vec4(0.0);\n}\n"                   \
        }                                                                                          \
    }

static void expect_complaint(const hc_gl_recipe *recipe, const char *says)
{
    unsigned program = 7;
    hc_log   log     = { .text = "" };
    assert_int_equal(hc_gl_build(&program, recipe, &log), HC_ERROR_UNSUPPORTED);
    assert_int_equal(program, 0);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
    assert_null(strchr(log.text, '\n'));
}

static void expect_verdict(GLenum error, GLenum reset, hc_result wanted, const char *says)
{
    hc_log log = { .text = "" };
    assert_int_equal(hc_gl_verdict(error, reset, "field", &log), wanted);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
    assert_null(strchr(log.text, '\n'));
}

static void verdicts(void **state)
{
    (void)state;
    hc_log log = { .text = "" };
    assert_int_equal(hc_gl_verdict(GL_NO_ERROR, GL_NO_ERROR, "field", &log), HC_OK);
    assert_string_equal(log.text, "");
    expect_verdict(GL_OUT_OF_MEMORY, GL_NO_ERROR, HC_ERROR_MEMORY, "field: out of memory");
    expect_verdict(GL_CONTEXT_LOST, GL_NO_ERROR, HC_ERROR_IO, "field: the driver has lost its");
    expect_verdict(GL_NO_ERROR, GL_UNKNOWN_CONTEXT_RESET, HC_ERROR_IO, "lost its context; try");
    expect_verdict(GL_CONTEXT_LOST, GL_GUILTY_CONTEXT_RESET, HC_ERROR_IO, "for what was drawn");
    /* A lost context runs out of everything: the loss is the cause. */
    expect_verdict(GL_OUT_OF_MEMORY, GL_INNOCENT_CONTEXT_RESET, HC_ERROR_IO, "what others drew");
    expect_verdict(GL_INVALID_ENUM, GL_NO_ERROR, HC_ERROR_IO, "error 0x0500");
}

/* False: there is no OpenGL here, and the test is skipped. */
static void open_or_skip(hc_gl_context *context)
{
    hc_log          log    = { .text = "" };
    const hc_result result = hc_gl_open(context, &log);
    if (result == HC_ERROR_UNSUPPORTED) {
        hc_gl_close(context);
        print_message("%s\n", log.text);
        skip();
    }
    assert_int_equal(result, HC_OK);
}

/* A texture that no card holds: 4 TiB. */
static void a_texture_out_of_memory(void **state)
{
    hc_gl_context context;
    GLint         side = 0, layers = 0;
    GLuint        texture = 0;
    hc_log        log     = { .text = "" };
    (void)state;
    open_or_skip(&context);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_RGBA32F, side, side, layers);
    assert_int_equal(hc_gl_check("field", &log), HC_ERROR_MEMORY);
    assert_non_null(strstr(log.text, "field: out of memory for graphics"));
    assert_int_equal(hc_gl_check("the next one", &log), HC_OK);
    glDeleteTextures(1, &texture);
    hc_gl_close(&context);
}

static void complaints(void **state)
{
    const hc_gl_recipe first   = { .head     = HEAD,
                                   .vertex   = GOOD_VERTEX,
                                   .fragment = {
                                       { "first.glsl", "float f(void)\n{\n    return x;\n}\n" },
                                       { "second.frag", "void main(void) { }\n" } } };
    const hc_gl_recipe second  = { .head     = HEAD,
                                   .vertex   = GOOD_VERTEX,
                                   .fragment = {
                                       { "first.glsl", "float f(void) { return 1.0; }\n" },
                                       { "second.frag", "void main(void)\n{\n\n    g();\n}\n" } } };
    const hc_gl_recipe none    = { .head     = HEAD,
                                   .vertex   = GOOD_VERTEX,
                                   .fragment = { { "none.frag", "float f(void);\n" } } };
    const hc_gl_recipe compute = {
        .head = HEAD, .compute = { { "first.comp", "void main(void) { x = 1; }\n" } }
    };
    hc_gl_context context;
    hc_log        log = { .text = "" };
    (void)state;
    open_or_skip(&context);
    expect_complaint(&first, "shader first.glsl, line 3 ");
    expect_complaint(&second, "shader second.frag, line 4 ");
    expect_complaint(&none, "link");
    expect_complaint(&compute, "shader first.comp, line 1 ");
    assert_int_equal(hc_gl_check("nothing", &log), HC_OK);
    hc_gl_close(&context);
}

/* The same recipe is the same program, another head or file another one, and what does not compile
 * is not kept. */
static void programs_are_kept(void **state)
{
    hc_gl_recipe  recipe = { .head     = HEAD,
                             .vertex   = GOOD_VERTEX,
                             .fragment = { { "a.frag", "void main(void) { }\n" } } };
    hc_gl_context context;
    unsigned      first, other, again;
    hc_log        log = { .text = "" };
    (void)state;
    open_or_skip(&context);
    assert_int_equal(hc_gl_program_of(&first, &context, &recipe, &log), HC_OK);
    assert_true(hc_gl_first_run(&context, first));
    recipe.head = HEAD "#define A\n";
    assert_int_equal(hc_gl_program_of(&other, &context, &recipe, &log), HC_OK);
    assert_int_not_equal(other, first);
    recipe.head             = HEAD;
    recipe.fragment[0].name = "b.frag";
    assert_int_equal(hc_gl_program_of(&other, &context, &recipe, &log), HC_OK);
    assert_int_not_equal(other, first);
    assert_true(hc_gl_first_run(&context, other));
    recipe.fragment[0].name = "a.frag";
    assert_int_equal(hc_gl_program_of(&again, &context, &recipe, &log), HC_OK);
    assert_int_equal(again, first);
    assert_false(hc_gl_first_run(&context, again));
    recipe.fragment[0] = (hc_shader_text){ "c.frag", "x\n" };
    for (int i = 0; i < 2; i++) {
        assert_int_equal(hc_gl_program_of(&again, &context, &recipe, &log), HC_ERROR_UNSUPPORTED);
    }
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
    const struct CMUnitTest tests[] = {
#ifdef HC_HAVE_GL
        cmocka_unit_test(verdicts),
        cmocka_unit_test(a_texture_out_of_memory),
        cmocka_unit_test(programs_are_kept),
#endif
        cmocka_unit_test(complaints),
    };
    return cmocka_run_group_tests_name("gl_program", tests, NULL, NULL);
}
