/* The map of the 2006 paper, eight bits a channel, straight into the shader: distances as the CPU
 * has them on the decoded map, normals as its stored slopes allow, the depth buffer as polygons
 * fill it. Skipped where there is no OpenGL. */
#include "render/stage.h"

#include <heightcast/bake.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#ifdef HC_HAVE_GL

#include "gl/context.h"
#include "render/gl/load.h"

#include <epoxy/gl.h>

#include <math.h>

enum { SIDE = 32, WIDE = 64, HIGH = 48, PIXELS = WIDE * HIGH };

static float   heights[SIDE * SIDE], ratios[SIDE * SIDE];
static uint8_t texels[SIDE * SIDE * 4];
static float   light[PIXELS * 4], normals[PIXELS * 4], depth[PIXELS], rgb[PIXELS * 3];
static float   buffer[PIXELS]; /* of depths, as polygons would find it */

/* The map, and the field and ratios that it stands for. */
static hc_field bake_map(void)
{
    const hc_map_options options = { .layout = HC_LAYOUT_DUMMER };
    const hc_field       field   = { heights, SIDE, SIDE, .wrap = HC_WRAP_UV };
    hc_map               map     = { .texels = texels };
    assert_int_equal(hc_synth(heights, SIDE, SIDE, "cobbles", 2, NULL), HC_OK);
    assert_int_equal(hc_map_info_for(&map.info, &field, &options, NULL), HC_OK);
    assert_int_equal(hc_map_bytes(&map.info), sizeof texels);
    assert_int_equal(hc_bake_map(&map, &field, &options, NULL), HC_OK);
    for (int i = 0; i < SIDE * SIDE; i++) {
        heights[i] = hc_map_height_at(&map, i % SIDE, i / SIDE);
        ratios[i]  = hc_map_ratio_at(&map, i % SIDE, i / SIDE, 0);
    }
    return field;
}

static void draw_map(const hc_stage *stage, unsigned program)
{
    static const GLenum attachments[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
    unsigned            planes[2], depths, frame, vertices, map;
    glGenTextures(1, &map);
    glActiveTexture(GL_TEXTURE0 + HC_GL_HEIGHTS);
    glBindTexture(GL_TEXTURE_2D, map);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glGenTextures(2, planes);
    glActiveTexture(GL_TEXTURE0 + HC_GL_TEXTURES);
    for (int i = 0; i < 2; i++) {
        glBindTexture(GL_TEXTURE_2D, planes[i]);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, WIDE, HIGH);
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, planes[i], 0);
    }
    glDrawBuffers(2, attachments);
    glGenRenderbuffers(1, &depths);
    glBindRenderbuffer(GL_RENDERBUFFER, depths);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, WIDE, HIGH);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths);
    glEnable(GL_DEPTH_TEST); /* without it nothing is written; and misses are to be, too */
    glDepthFunc(GL_ALWAYS);
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glUseProgram(program);
    hc_gl_set(program, stage, stage->scene.relief.trace.method);
    glUniform2f(glGetUniformLocation(program, "u_sample"), 0.5F, 0.5F);
    glViewport(0, 0, WIDE, HIGH);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, WIDE, HIGH, GL_RGBA, GL_FLOAT, light);
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, WIDE, HIGH, GL_RGBA, GL_FLOAT, normals);
    glReadPixels(0, 0, WIDE, HIGH, GL_DEPTH_COMPONENT, GL_FLOAT, buffer);
    assert_int_equal(hc_gl_check("the map", NULL), HC_OK);
}

static unsigned build(hc_gl_context *context, const char *head)
{
    unsigned program;
    hc_log   log = { .text = "" };
    if (hc_gl_build_relief(&program, context, head, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    return program;
}

/* Of a thousand pixels one may decide otherwise at an edge. Slopes are rounded to codes: by half a
 * code of a texel, so by SIDE / 510 of a tile, times depth over the tile's width. */
static void expect_agreement(const hc_stage *stage, const hc_picture *cpu)
{
    const double slope = 0.5 / 255.0 * SIDE * stage->shape.depth / 2.0;
    int          odd = 0, hits = 0;
    for (int i = 0; i < PIXELS; i++) {
        double origin[3], direction[3];
        hc_eye_ray(&stage->eye, origin, direction, i % WIDE + 0.5, i / WIDE + 0.5);
        const double along = direction[0] * stage->eye.forward[0]
                             + direction[1] * stage->eye.forward[1]
                             + direction[2] * stage->eye.forward[2];
        const bool   found = light[4 * i + 3] < 1e29F;
        const double away  = found ? (double)light[4 * i + 3] * along - (double)depth[i] : 0.0;
        bool         bad   = found != isfinite(depth[i]) || fabs(away) > 0x1p-12;
        for (int k = 0; k < 3 && found; k++) {
            const double cpu_normal = 2.0 * (double)cpu->rgb[3 * i + k] - 1.0;
            bad = bad || fabs((double)normals[4 * i + k] - cpu_normal) > 2.0 * slope + 1e-3;
        }
        odd += bad ? 1 : 0;
        hits += found ? 1 : 0;
    }
    assert_true(hits > 500);
    assert_in_range(odd, 0, PIXELS / 1000);
}

/* In the depth buffer lies what the usual projection makes of the hit, so that polygons and relief
 * hide each other: z of the clip space over its w, from -1 .. 1 to 0 .. 1. */
static void expect_projected_depths(const hc_stage *stage)
{
    const double near = fmax(stage->near, 1e-3);
    const double far  = stage->far;
    int          seen = 0;
    for (int i = 0; i < PIXELS; i++) {
        double origin[3], direction[3];
        hc_eye_ray(&stage->eye, origin, direction, i % WIDE + 0.5, i / WIDE + 0.5);
        double along = 0.0;
        for (int k = 0; k < 3; k++) {
            along += direction[k] * stage->eye.forward[k] * (double)light[4 * i + 3];
        }
        const double clip_z = ((far + near) * along - 2.0 * far * near) / (far - near);
        const bool   found  = light[4 * i + 3] < 1e29F;
        const double wanted = found ? 0.5 + 0.5 * clip_z / along : 1.0;
        assert_true(fabs((double)buffer[i] - wanted) < 1e-5);
        seen += found && wanted > 0.1 && wanted < 0.9 ? 1 : 0;
    }
    assert_true(seen > 300);
}

/* rgb of the view of normals is linear light; back to 0 .. 1. */
static void to_codes(hc_picture *picture)
{
    for (int i = 0; i < PIXELS * 3; i++) {
        const double c  = (double)picture->rgb[i];
        picture->rgb[i] = (float)(c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055);
    }
}

static void the_map_is_read_as_it_is(void **state)
{
    const hc_field          field   = bake_map();
    hc_scene                scene   = { .relief = { .field = field, .body = HC_BODY_PLANE } };
    hc_picture              cpu     = { .width = WIDE, .height = HIGH, .rgb = rgb, .depth = depth };
    const hc_render_options options = { .view = HC_VIEW_NORMAL };
    unsigned                textures[HC_GL_TEXTURES] = { 0 };
    hc_gl_context           context;
    hc_stage                stage;
    hc_log                  log = { .text = "" };
    (void)state;
    scene.relief.trace =
        (hc_trace_options){ .method = HC_TRACE_CONE_LOOP, .ratios = ratios, .steps = 64 };
    if (hc_gl_open(&context, &log) == HC_ERROR_UNSUPPORTED) {
        print_message("%s\n", log.text);
        skip();
    }
    assert_int_equal(hc_render(&cpu, &scene, &options, &log), HC_OK);
    to_codes(&cpu);
    assert_int_equal(hc_stage_set(&stage, &cpu, &scene, &options, &log), HC_OK);
    assert_int_equal(hc_gl_load(textures, &stage, &log), HC_OK);
    draw_map(
        &stage,
        build(&context, "#version 430 core\n#define HC_METHOD HC_CONE_LOOP\n#define HC_DUMMER\n"));
    expect_agreement(&stage, &cpu);
    expect_projected_depths(&stage);
    draw_map(&stage, build(&context,
                           "#version 430 core\n#define HC_METHOD HC_CONE_LOOP\n#define HC_DUMMER\n"
                           "#define HC_GATHER\n"));
    expect_agreement(&stage, &cpu);
    hc_stage_clear(&stage);
    hc_gl_close(&context);
}

#else

static void the_map_is_read_as_it_is(void **state)
{
    (void)state;
    skip();
}

#endif

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(the_map_is_read_as_it_is) };
    return cmocka_run_group_tests_name("agree_dummer", tests, NULL, NULL);
}
