/* The shaders against the CPU: every method on every body, shadows and all; skipped where there is
 * no OpenGL. */
#include "shots.h"

#include <math.h>
#include <string.h>

static agree_maps maps;
static agree_shot cpu, gl;

static int prepare(void **state)
{
    (void)state;
    return agree_maps_bake(&maps, "cobbles", 32, 2, HC_WRAP_UV) ? 0 : -1;
}

static hc_scene scene_of(hc_body body, hc_trace_method method)
{
    hc_scene scene = { .relief = { .field = maps.field, .body = body } };
    agree_maps_choose(&scene.relief.trace, &maps, method);
    return scene;
}

static void draw(agree_shot *shot, const hc_scene *scene, hc_view view, hc_backend backend)
{
    const hc_render_options options = { .view = view, .backend = backend };
    hc_log                  log     = { .text = "" };
    agree_shot_open(shot);
    agree_shot_close(shot, hc_render(&shot->picture, scene, &options, &log), backend, &log);
}

static void compare(const hc_scene *scene, hc_view view)
{
    draw(&cpu, scene, view, HC_BACKEND_CPU);
    draw(&gl, scene, view, HC_BACKEND_GL);
    const int odd = agree_shots_odd(&cpu, &gl);
    if (odd > SHOT_ODD_MAX) {
        fail_msg("%s on %s: %d pixels differ", hc_trace_method_name(scene->relief.trace.method),
                 hc_body_name(scene->relief.body), odd);
    }
    assert_true(cpu.picture.figures.hits > 500);
}

/* ---- pictures -------------------------------------------------------------------------------- */

static void every_method_on_every_body(void **state)
{
    (void)state;
    for (int body = 0; body <= HC_BODY_TORUS; body++) {
        for (int method = 0; method < hc_trace_method_count(); method++) {
            const hc_scene scene = scene_of((hc_body)body, (hc_trace_method)method);
            compare(&scene, HC_VIEW_SHADED);
        }
    }
}

static void other_choices(void **state)
{
    (void)state;
    hc_scene scene            = scene_of(HC_BODY_PLANE, HC_TRACE_SAFE);
    scene.relief.trace.ratios = maps.l1;
    scene.relief.trace.cones  = HC_CONES_L1;
    compare(&scene, HC_VIEW_SHADED);
    scene                          = scene_of(HC_BODY_PLANE, HC_TRACE_RELIEF);
    scene.relief.trace.refinements = -1;
    scene.relief.edge              = HC_EDGE_DISCARD;
    scene.camera.orthographic      = 2.5F;
    compare(&scene, HC_VIEW_SHADED);
    scene                          = scene_of(HC_BODY_PLANE, HC_TRACE_QUICK);
    scene.relief.trace.refinements = -2;
    scene.relief.trace.steps       = 12;
    scene.relief.field.wrap        = HC_WRAP_NONE;
    scene.light.lamp               = true;
    scene.light.place[2]           = 0.7;
    compare(&scene, HC_VIEW_SHADED);
    scene                           = scene_of(HC_BODY_PLANE, HC_TRACE_MAXMIP);
    scene.relief.field.registration = HC_GRID;
    scene.relief.field.wrap         = HC_WRAP_U;
    scene.relief.repeat[0]          = 3;
    scene.camera.samples            = 2;
    compare(&scene, HC_VIEW_SHADED);
}

/* With shadows on the ground that goes on over the rim. */
static void a_clamped_edge(void **state)
{
    static const hc_trace_method methods[] = { HC_TRACE_SAFE, HC_TRACE_RELIEF, HC_TRACE_ROBUST };
    (void)state;
    for (int i = 0; i < 3; i++) {
        hc_scene scene       = scene_of(HC_BODY_PLANE, methods[i]);
        scene.relief.edge    = HC_EDGE_CLAMP;
        scene.relief.depth   = 0.5F;
        scene.light.place[0] = 1.0;
        scene.light.place[1] = 0.5;
        scene.light.place[2] = 0.6;
        compare(&scene, HC_VIEW_SHADED);
    }
}

static void fewer_steps_far_away(void **state)
{
    (void)state;
    for (int body = 0; body <= HC_BODY_TORUS; body += HC_BODY_TORUS) {
        hc_scene scene      = scene_of((hc_body)body, HC_TRACE_RELIEF);
        scene.relief.lod[0] = 2.0F;
        scene.relief.lod[1] = 6.0F;
        compare(&scene, HC_VIEW_SHADED);
        assert_true(fabs(gl.picture.figures.mean_steps - cpu.picture.figures.mean_steps) < 0.02);
    }
}

static void fading(void **state)
{
    (void)state;
    for (int body = 0; body <= HC_BODY_TORUS; body += HC_BODY_TORUS) {
        hc_scene scene       = scene_of((hc_body)body, HC_TRACE_MAXMIP);
        scene.relief.fade[0] = 2.0F;
        scene.relief.fade[1] = 6.0F;
        compare(&scene, HC_VIEW_SHADED);
    }
}

static void views_and_albedo(void **state)
{
    (void)state;
    static float  rgb[4 * 3 * 3];
    const hc_view views[] = { HC_VIEW_HEIGHT, HC_VIEW_NORMAL, HC_VIEW_DEPTH };
    hc_scene      scene   = scene_of(HC_BODY_TORUS, HC_TRACE_SAFE);
    for (int i = 0; i < 4 * 3 * 3; i++) {
        rgb[i] = (float)(i * 7 % 11) / 11.0F;
    }
    scene.material.albedo        = rgb;
    scene.material.albedo_width  = 4;
    scene.material.albedo_height = 3;
    compare(&scene, HC_VIEW_SHADED);
    for (int i = 0; i < 3; i++) {
        compare(&scene, views[i]);
    }
}

/* ---- hits ------------------------------------------------------------------------------------ */

/* Where both hit, depths agree: docs/algorithms.md, section 21.4, has the bound, which is for
 * angles of at least 1/64 between ray and surface. Sharper ones are as rare as edges. */
static void depths_agree(void **state)
{
    (void)state;
    for (int body = 0; body <= HC_BODY_TORUS; body++) {
        const hc_scene scene = scene_of((hc_body)body, HC_TRACE_MAXMIP);
        int            odd = 0, both = 0;
        draw(&cpu, &scene, HC_VIEW_SHADED, HC_BACKEND_CPU);
        draw(&gl, &scene, HC_VIEW_SHADED, HC_BACKEND_GL);
        for (int i = 0; i < SHOT_PIXELS; i++) {
            const bool hit = isfinite(cpu.depth[i]) && isfinite(gl.depth[i]);
            both += hit ? 1 : 0;
            odd += hit && fabsf(cpu.depth[i] - gl.depth[i]) > 0x1p-12F ? 1 : 0;
        }
        assert_true(both > 500);
        assert_true(odd <= SHOT_ODD_MAX);
    }
}

/* The exact methods lose nothing there, either; two steps do. */
static void nothing_is_lost(void **state)
{
    (void)state;
    for (int body = 0; body <= HC_BODY_TORUS; body++) {
        const hc_scene safe = scene_of((hc_body)body, HC_TRACE_SAFE);
        draw(&gl, &safe, HC_VIEW_MISSED, HC_BACKEND_GL);
        assert_int_equal(gl.picture.figures.lost, 0);
        assert_int_equal(gl.picture.figures.made_up, 0);
    }
    hc_scene few           = scene_of(HC_BODY_SPHERE, HC_TRACE_LINEAR);
    few.relief.trace.steps = 1;
    draw(&gl, &few, HC_VIEW_MISSED, HC_BACKEND_GL);
    assert_true(gl.picture.figures.lost > 20);
}

/* What is lost and made up is the same, qdm's with it, whose pyramid is not that of the judge. */
static void losses_agree(void **state)
{
    static const hc_trace_method methods[] = { HC_TRACE_QDM, HC_TRACE_LINEAR, HC_TRACE_CONE_FIXED };
    (void)state;
    for (int i = 0; i < 3; i++) {
        const hc_scene           scene = scene_of(HC_BODY_PLANE, methods[i]);
        const hc_render_figures *a     = &cpu.picture.figures;
        const hc_render_figures *b     = &gl.picture.figures;
        draw(&cpu, &scene, HC_VIEW_MISSED, HC_BACKEND_CPU);
        draw(&gl, &scene, HC_VIEW_MISSED, HC_BACKEND_GL);
        assert_true(a->lost + a->made_up > 100);
        assert_in_range(a->lost, b->lost > SHOT_ODD_MAX ? b->lost - SHOT_ODD_MAX : 0,
                        b->lost + SHOT_ODD_MAX);
        assert_in_range(a->made_up, b->made_up > SHOT_ODD_MAX ? b->made_up - SHOT_ODD_MAX : 0,
                        b->made_up + SHOT_ODD_MAX);
    }
}

/* Golden: a change of these means that marchers step otherwise. Means over the rays of the pictures
 * above that come near. */
static const struct {
    hc_body         body;
    hc_trace_method method;
    double          steps;
} golden[] = {
    { HC_BODY_PLANE, HC_TRACE_SAFE, 2.5825 },
    { HC_BODY_PLANE, HC_TRACE_MAXMIP, 8.0439 },
    { HC_BODY_PLANE, HC_TRACE_QDM, 7.3403 },
    { HC_BODY_PLANE, HC_TRACE_PARALLAX, 1.0000 },
    { HC_BODY_PLANE, HC_TRACE_LINEAR, 14.1876 },
    { HC_BODY_PLANE, HC_TRACE_RELIEF, 19.4691 },
    { HC_BODY_PLANE, HC_TRACE_OCCLUSION, 14.1876 },
    { HC_BODY_PLANE, HC_TRACE_CONE_EXACT, 2.3989 },
    { HC_BODY_PLANE, HC_TRACE_ROBUST, 7.8792 },
    { HC_BODY_CYLINDER, HC_TRACE_SAFE, 3.9299 },
    { HC_BODY_CYLINDER, HC_TRACE_MAXMIP, 18.2242 },
    { HC_BODY_SPHERE, HC_TRACE_SAFE, 6.0747 },
    { HC_BODY_SPHERE, HC_TRACE_MAXMIP, 23.3294 },
    { HC_BODY_TORUS, HC_TRACE_SAFE, 5.6189 },
    { HC_BODY_TORUS, HC_TRACE_MAXMIP, 25.1605 },
    /* In double precision these lead on long after float32 has arrived. */
    { HC_BODY_PLANE, HC_TRACE_CONE_FIXED, 5.1061 },
    { HC_BODY_PLANE, HC_TRACE_CONE_LOOP, 20.3666 },
    { HC_BODY_PLANE, HC_TRACE_RELAXED, 22.7156 },
    { HC_BODY_PLANE, HC_TRACE_QUICK, 22.8034 },
};

enum { GOLDEN = sizeof golden / sizeof *golden, GOLDEN_ON_GL = GOLDEN - 4 };

static void step_counts(void **state)
{
    (void)state;
    for (int i = 0; i < GOLDEN; i++) {
        const hc_scene scene = scene_of(golden[i].body, golden[i].method);
        draw(&cpu, &scene, HC_VIEW_SHADED, HC_BACKEND_CPU);
        if (fabs(cpu.picture.figures.mean_steps - golden[i].steps) > 5e-5) {
            fail_msg("%s on %s: %.4f steps", hc_trace_method_name(golden[i].method),
                     hc_body_name(golden[i].body), cpu.picture.figures.mean_steps);
        }
    }
}

static void step_counts_of_opengl(void **state)
{
    (void)state;
    for (int i = 0; i < GOLDEN_ON_GL; i++) {
        const hc_scene           scene   = scene_of(golden[i].body, golden[i].method);
        const hc_render_figures *figures = &gl.picture.figures;
        draw(&gl, &scene, HC_VIEW_SHADED, HC_BACKEND_GL);
        assert_true(fabs(figures->mean_steps - golden[i].steps) < 0.02);
        assert_true(figures->mean_fetches >= figures->mean_steps);
    }
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void refusals(void **state)
{
    (void)state;
    static float            rgb[3 * 40000];
    const hc_scene          safe    = scene_of(HC_BODY_PLANE, HC_TRACE_SAFE);
    const hc_render_options options = { .backend = HC_BACKEND_GL };
    hc_log                  log     = { .text = "" };
    hc_picture              wide    = { .width = 40000, .height = 1, .rgb = rgb };
    draw(&gl, &safe, HC_VIEW_SHADED, HC_BACKEND_GL); /* skips */
    assert_int_equal(hc_render(&wide, &safe, &options, &log), HC_ERROR_LIMIT);
    assert_non_null(strstr(log.text, "picture.width is 40000"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_on_every_body),
        cmocka_unit_test(other_choices),
        cmocka_unit_test(a_clamped_edge),
        cmocka_unit_test(fewer_steps_far_away),
        cmocka_unit_test(fading),
        cmocka_unit_test(views_and_albedo),
        cmocka_unit_test(depths_agree),
        cmocka_unit_test(nothing_is_lost),
        cmocka_unit_test(losses_agree),
        cmocka_unit_test(step_counts),
        cmocka_unit_test(step_counts_of_opengl),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests_name("agree_gl", tests, prepare, NULL);
}
