/* fast by OpenGL: fields of any shape, on patches and steps, with walls and without, repeating or
 * not, dense and sparse, seen from everywhere, with shadows. It shows what the CPU's fast does, and
 * loses nothing that the exact caster beside it finds. */
#include "shots.h"

#include <heightcast/field.h>

#include <stdlib.h>

enum { SIDE_MAX = 160 };

typedef struct ground {
    const char     *name;
    int             width, height;
    hc_registration registration;
    hc_surface      surface;
    bool            open_sides;
} ground;

static float      heights[SIDE_MAX * SIDE_MAX];
static agree_shot cpu, gl;

static hc_field fill(const ground *g)
{
    assert_int_equal(hc_synth(heights, g->width, g->height, g->name, 3, NULL), HC_OK);
    return (hc_field){
        .heights = heights, .width = g->width, .height = g->height, .registration = g->registration
    };
}

static hc_terrain_scene scene_of(const ground *g)
{
    return (hc_terrain_scene){
        .field = fill(g),
        .trace = { .method = HC_TRACE_FAST, .surface = g->surface, .open_sides = g->open_sides }
    };
}

static void look_at_each(const ground *grounds, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const hc_terrain_scene scene = scene_of(&grounds[i]);
        (void)agree_tour(&scene, HC_VIEW_SHADED, 0.0F);
        assert_true(agree_tour(&scene, HC_VIEW_MISSED, 0.0F).wrong_by_gl == 0);
    }
}

static void every_shape(void **state)
{
    static const ground grounds[] = {
        { "fbm", 1, 1, HC_TEXEL, HC_SURFACE_BILINEAR, false },
        { "fbm", 2, 1, HC_GRID, HC_SURFACE_STEPS, false },
        { "fbm", 2, 150, HC_TEXEL, HC_SURFACE_BILINEAR, false },
        { "cobbles", 157, 31, HC_GRID, HC_SURFACE_BILINEAR, true },
        { "noise", 33, 64, HC_TEXEL, HC_SURFACE_BILINEAR, false },
        { "spikes", 128, 128, HC_TEXEL, HC_SURFACE_BILINEAR, true },
    };
    (void)state;
    look_at_each(grounds, sizeof grounds / sizeof *grounds);
}

static void steps(void **state)
{
    static const ground grounds[] = {
        { "fbm", 3, 100, HC_GRID, HC_SURFACE_STEPS, false },
        { "bricks", 64, 48, HC_TEXEL, HC_SURFACE_STEPS, true },
    };
    (void)state;
    look_at_each(grounds, sizeof grounds / sizeof *grounds);
}

/* ---- fields that repeat ---------------------------------------------------------------------- */

static void draw(agree_shot *shot, const hc_scene *scene, hc_view view, hc_backend backend)
{
    const hc_render_options options = { .view = view, .backend = backend };
    hc_log                  log     = { .text = "" };
    agree_shot_open(shot);
    agree_shot_close(shot, hc_render(&shot->picture, scene, &options, &log), backend, &log);
}

/* Rays go through periods, up and down both axes, and out of blocks that know nothing of the
 * next. */
static void repeated(void **state)
{
    static const ground grounds[] = {
        { "cobbles", 24, 24, HC_TEXEL, HC_SURFACE_BILINEAR, false },
        { "cobbles", 7, 3, HC_TEXEL, HC_SURFACE_BILINEAR, false },
        { "cobbles", 1, 1, HC_TEXEL, HC_SURFACE_BILINEAR, false },
    };
    static const double eyes[][3] = { { 1.0, 1.0, 0.1 }, { -1.2, 0.3, 0.2 }, { 0.1, -0.1, 2.0 } };
    (void)state;
    for (size_t i = 0; i < sizeof grounds / sizeof *grounds; i++) {
        hc_scene scene          = { .relief = { .field  = fill(&grounds[i]),
                                                .trace  = { .method = HC_TRACE_FAST },
                                                .body   = HC_BODY_PLANE,
                                                .repeat = { 9, 5 } } };
        scene.relief.field.wrap = HC_WRAP_UV;
        for (int k = 0; k < 3; k++) {
            for (int axis = 0; axis < 3; axis++) {
                scene.camera.eye[axis] = eyes[k][axis];
            }
            draw(&cpu, &scene, HC_VIEW_SHADED, HC_BACKEND_CPU);
            draw(&gl, &scene, HC_VIEW_SHADED, HC_BACKEND_GL);
            assert_true(agree_shots_odd(&cpu, &gl) <= SHOT_ODD_MAX);
            assert_true(cpu.picture.figures.hits > 500);
        }
        draw(&gl, &scene, HC_VIEW_MISSED, HC_BACKEND_GL);
        assert_int_equal(gl.picture.figures.lost + gl.picture.figures.made_up, 0);
    }
}

/* ---- how it goes ---------------------------------------------------------------------------- */

/* Blocks and cones carry rays farther than the pyramid does. */
static void few_reads(void **state)
{
    static const ground g = { "fbm", 160, 160, HC_TEXEL, HC_SURFACE_BILINEAR, false };
    double              reads[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        hc_terrain_scene scene = scene_of(&g);
        scene.trace.method     = i == 0 ? HC_TRACE_FAST : HC_TRACE_MAXMIP;
        hc_terrain *terrain    = agree_terrain_make(&scene, HC_VIEW_SHADED, HC_BACKEND_GL);
        hc_camera   camera;
        hc_terrain_tour(&camera, terrain, HC_TOUR_FLY, 0.0);
        agree_shot_terrain(&gl, terrain, &camera);
        reads[i] = gl.picture.figures.mean_fetches;
        hc_terrain_destroy(terrain);
    }
    assert_true(reads[0] > 1.0 && reads[0] < 0.75 * reads[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape),
        cmocka_unit_test(steps),
        cmocka_unit_test(repeated),
        cmocka_unit_test(few_reads),
    };
    return cmocka_run_group_tests_name("agree_gl_fast", tests, NULL, NULL);
}
