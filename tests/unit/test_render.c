/* Pictures of relief: where bodies are known by formulas, what views show, and what is refused. */
#include "render/angle.h"

#include <heightcast/bake.h>
#include <heightcast/render.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 48, HIGH = 36, SIDE = 32 };

static float level_heights[SIDE * SIDE];
static float hills[SIDE * SIDE];
static float quad[SIDE * SIDE * 4];
static float round_ratios[SIDE * SIDE];

typedef struct shot {
    float      rgb[WIDE * HIGH * 3], depth[WIDE * HIGH];
    hc_picture picture;
} shot;

static hc_field field_of(const float *heights)
{
    return (hc_field){ .heights = heights, .width = SIDE, .height = SIDE, .wrap = HC_WRAP_UV };
}

static int prepare(void **state)
{
    const hc_field field = field_of(hills);
    float         *cones = malloc(sizeof quad);
    (void)state;
    for (int i = 0; i < SIDE * SIDE; i++) {
        level_heights[i] = 0.5F;
    }
    hc_result result = hc_synth(hills, SIDE, SIDE, "cobbles", 3, NULL);
    if (result == HC_OK) {
        result =
            hc_bake_cone_map(cones, &field, &(hc_cone_options){ .cones = HC_CONES_QUAD }, NULL);
        hc_bake_cell_ratios(quad, cones, SIDE, SIDE, HC_CONES_QUAD, HC_WRAP_UV);
    }
    if (result == HC_OK) {
        result = hc_bake_cone_map(round_ratios, &field, NULL, NULL);
    }
    free(cones);
    return result == HC_OK ? 0 : -1;
}

static hc_scene scene_of(const float *heights, hc_body body, hc_trace_method method)
{
    hc_scene scene            = { .relief = { .field = field_of(heights), .body = body } };
    scene.relief.trace.method = method;
    if (hc_trace_method_needs(method) == HC_NEEDS_CELL_RATIOS) {
        scene.relief.trace.ratios = quad;
        scene.relief.trace.cones  = HC_CONES_QUAD;
    } else if (hc_trace_method_needs(method) != HC_NEEDS_NOTHING) {
        scene.relief.trace.ratios = round_ratios;
    }
    return scene;
}

static void draw(shot *s, const hc_scene *scene, const hc_render_options *options)
{
    hc_log log       = { .text = "" };
    *s               = (shot){ .picture = { .width = WIDE, .height = HIGH } };
    s->picture.rgb   = s->rgb;
    s->picture.depth = s->depth;
    if (hc_render(&s->picture, scene, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
}

static void refuse(const hc_scene *scene, const hc_render_options *options, const char *says)
{
    static float rgb[3];
    hc_log       log     = { .text = "" };
    hc_picture   picture = { .width = 1, .height = 1, .rgb = rgb };
    assert_int_equal(hc_render(&picture, scene, options, &log), HC_ERROR_ARGUMENT);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
}

static double distance_to_axis(const double p[3])
{
    return sqrt(p[0] * p[0] + p[1] * p[1]);
}

/* ---- bodies whose surface has a formula ------------------------------------------------------ */

/* How far a point is outside the surface of a level relief. */
static double outside_level(hc_body body, const double p[3], double depth)
{
    const double sunk = 0.5 * depth;
    const double flat = distance_to_axis(p) - 0.8;
    switch (body) {
    case HC_BODY_PLANE: return p[2] + sunk;
    case HC_BODY_CYLINDER: return distance_to_axis(p) - (0.6 - sunk);
    case HC_BODY_SPHERE: return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - (1.0 - sunk);
    default: return sqrt(flat * flat + p[2] * p[2]) - (0.4 - sunk);
    }
}

/* A level relief, by parallel rays along y. */
static hc_scene seen_from_front(hc_body body, hc_trace_method method, float depth, float width)
{
    hc_scene scene            = scene_of(level_heights, body, method);
    scene.relief.depth        = depth;
    scene.camera.eye[1]       = -3.0;
    scene.camera.orthographic = width;
    return scene;
}

/* Parallel rays along y: a point of the picture is x, z, and the depth is y from the eye. The
 * surface is where its formula says, within the bend that is allowed. */
static void level_bodies_are_where_they_should_be(void **state)
{
    (void)state;
    static shot s;
    for (int body = HC_BODY_CYLINDER; body <= HC_BODY_TORUS; body++) {
        const hc_scene scene = seen_from_front((hc_body)body, HC_TRACE_MAXMIP, 0.2F, 3.0F);
        draw(&s, &scene, NULL);
        int hits = 0;
        for (int i = 0; i < WIDE * HIGH; i++) {
            const double p[3] = { 3.0 * ((i % WIDE + 0.5) / WIDE - 0.5), (double)s.depth[i] - 3.0,
                                  -3.0 / WIDE * (i / WIDE + 0.5 - HIGH / 2.0) };
            const bool   cap  = body == HC_BODY_CYLINDER && fabs(p[2]) > 0.9;
            if (isfinite(s.depth[i])) {
                hits++;
                assert_false(cap);
                assert_true(fabs(outside_level((hc_body)body, p, 0.2)) < 0.2 / 512.0 + 1e-5);
            }
        }
        assert_int_equal(s.picture.figures.hits, hits);
        assert_true(hits > 300);
    }
}

/* Rays that miss the formula's body by more than the bend miss, those well inside hit. */
static void level_silhouettes_are_exact(void **state)
{
    (void)state;
    static shot    s;
    const hc_scene scene = seen_from_front(HC_BODY_SPHERE, HC_TRACE_SAFE, 0.4F, 2.2F);
    draw(&s, &scene, NULL);
    for (int i = 0; i < WIDE * HIGH; i++) {
        const double x = 2.2 * ((i % WIDE + 0.5) / WIDE - 0.5);
        const double z = 2.2 / WIDE * (i / WIDE + 0.5 - HIGH / 2.0);
        const double r = sqrt(x * x + z * z);
        if (fabs(r - 0.8) > 0.4 / 512.0 + 1e-5) {
            assert_int_equal(isfinite(s.depth[i]) ? 1 : 0, r < 0.8 ? 1 : 0);
        }
    }
}

static void a_plane_from_above(void **state)
{
    (void)state;
    static shot s;
    hc_scene    scene         = scene_of(level_heights, HC_BODY_PLANE, HC_TRACE_SAFE);
    scene.relief.depth        = 0.5F;
    scene.relief.aspect       = 0.5F;
    scene.camera.eye[2]       = 3.0;
    scene.camera.orthographic = 4.0F;
    draw(&s, &scene, &(hc_render_options){ .view = HC_VIEW_NORMAL });
    for (int i = 0; i < WIDE * HIGH; i++) {
        const double x = 4.0 * ((i % WIDE + 0.5) / WIDE - 0.5);
        const double y = 4.0 / WIDE * (HIGH / 2.0 - i / WIDE - 0.5);
        if (fabs(x) < 1.0 && fabs(y) < 0.5) {
            assert_true(fabs((double)s.depth[i] - 3.25) < 1e-6);
            assert_true(fabs((double)s.rgb[3 * i + 2] - 1.0) < 1e-6);
            assert_true(fabs((double)s.rgb[3 * i] - 0.2140411404822325) < 1e-6); /* code 0.5 */
        } else {
            assert_true(isinf(s.depth[i]));
        }
    }
}

/* ---- edges, light, views --------------------------------------------------------------------- */

/* A block seen from the side shows its wall; a polygon shows nothing from there. */
static void edges(void **state)
{
    (void)state;
    static shot s;
    hc_scene    scene = seen_from_front(HC_BODY_PLANE, HC_TRACE_SAFE, 0.8F, 3.0F);
    draw(&s, &scene, NULL);
    const int middle = (HIGH / 2 + 10) * WIDE + WIDE / 2; /* z = -0.66 */
    assert_true(fabs((double)s.depth[middle] - 2.0) < 1e-6);
    assert_true(s.picture.figures.hits > 0);
    scene.relief.edge = HC_EDGE_DISCARD;
    draw(&s, &scene, NULL);
    assert_int_equal(s.picture.figures.hits, 0);
}

/* Where an orthographic ray straight along y, tilted down by half, comes to a pixel's depth. */
static void point_of(double p[3], const hc_scene *scene, int pixel, double depth)
{
    const double width  = (double)scene->camera.orthographic;
    const double x      = width * ((pixel % WIDE + 0.5) / WIDE - 0.5);
    const double y      = width / WIDE * (HIGH / 2.0 - pixel / WIDE - 0.5);
    const double length = sqrt(1.25);
    p[0]                = scene->camera.eye[0] + x;
    p[1]                = scene->camera.eye[1] + y * 0.5 / length + depth / length;
    p[2]                = scene->camera.eye[2] + y / length - depth * 0.5 / length;
}

/* Height of the ground below a point, whose rim goes on outwards. */
static double clamped_ground(const hc_scene *scene, const double p[3])
{
    const double u = fmin(fmax(0.5 + 0.5 * p[0], 1e-6), 1.0 - 1e-6);
    const double v = fmin(fmax(0.5 - 0.5 * p[1], 1e-6), 1.0 - 1e-6);
    const double h = hc_field_surface(&scene->relief.field, u, v);
    return (double)scene->relief.depth * (h - 1.0);
}

/* Each ray through the top face hits, on the ground that goes on over the rim, and not later than
 * it should: halfway to the hit it is still above. */
static void a_clamped_edge_goes_on(void **state)
{
    (void)state;
    static shot s;
    hc_scene    scene         = scene_of(hills, HC_BODY_PLANE, HC_TRACE_SAFE);
    int         beside        = 0;
    scene.relief.edge         = HC_EDGE_CLAMP;
    scene.relief.depth        = 0.8F;
    scene.camera.eye[1]       = -2.0;
    scene.camera.eye[2]       = 1.0;
    scene.camera.orthographic = 3.0F;
    draw(&s, &scene, NULL);
    for (int i = 0; i < WIDE * HIGH; i++) {
        double top[3], p[3];
        point_of(top, &scene, i, 0.0);
        point_of(top, &scene, i, top[2] * sqrt(1.25) / 0.5);
        const bool through = fabs(top[0]) < 1.0 && fabs(top[1]) < 1.0;
        assert_int_equal(isfinite(s.depth[i]) ? 1 : 0, through ? 1 : 0);
        if (!through) {
            continue;
        }
        point_of(p, &scene, i, (double)s.depth[i]);
        assert_true(fabs(p[2] - clamped_ground(&scene, p)) < 1e-4);
        beside += fabs(p[0]) > 1.0 || fabs(p[1]) > 1.0;
        for (int k = 1; k < 100; k++) {
            double before[3];
            for (int axis = 0; axis < 3; axis++) {
                before[axis] = top[axis] + 0.01 * k * (p[axis] - top[axis]);
            }
            assert_true(before[2] > clamped_ground(&scene, before) - 1e-5);
        }
    }
    assert_true(beside > 20);
}

/* Near by all steps are taken, far away the fewest, and between them some. */
static void steps_fall_with_distance(void **state)
{
    (void)state;
    static shot most, least, between;
    for (int body = 0; body <= HC_BODY_TORUS; body++) {
        hc_scene scene           = scene_of(hills, (hc_body)body, HC_TRACE_LINEAR);
        scene.relief.trace.steps = 24;
        draw(&most, &scene, NULL);
        scene.relief.trace.steps = 6;
        draw(&least, &scene, NULL);
        scene.relief.trace.steps = 24;
        scene.relief.lod[0]      = 100.0F;
        scene.relief.lod[1]      = 200.0F;
        draw(&between, &scene, NULL);
        assert_memory_equal(most.rgb, between.rgb, sizeof most.rgb);
        scene.relief.lod[0] = 0.1F;
        scene.relief.lod[1] = 0.2F;
        draw(&between, &scene, NULL); /* 24 / 4 */
        assert_memory_equal(least.rgb, between.rgb, sizeof most.rgb);
        scene.relief.lod[1]    = 10.0F;
        scene.relief.lod_steps = 2;
        draw(&between, &scene, NULL);
        assert_true(between.picture.figures.mean_steps < 0.9 * most.picture.figures.mean_steps);
        assert_true(memcmp(between.rgb, least.rgb, sizeof most.rgb) != 0);
    }
    hc_scene bad         = scene_of(hills, HC_BODY_PLANE, HC_TRACE_LINEAR);
    bad.relief.lod_steps = 33;
    refuse(&bad, NULL, "relief.lod_steps is 33; it must be 0 .. 32");
    bad.relief.lod_steps = 0;
    bad.relief.lod[0]    = 1.0F;
    refuse(&bad, NULL, "relief.lod[1] is 0");
}

/* Before it begins to fade the relief is as it was, beyond it lies in the hull. */
static void relief_fades(void **state)
{
    (void)state;
    static shot whole, faded;
    for (int body = 0; body <= HC_BODY_TORUS; body++) {
        hc_scene scene      = scene_of(level_heights, (hc_body)body, HC_TRACE_SAFE);
        scene.relief.depth  = 0.3F;
        scene.camera.eye[2] = 6.0;
        scene.camera.eye[0] = 0.01;
        scene.camera.fov    = 30.0F;
        draw(&whole, &scene, NULL);
        scene.relief.fade[0] = 20.0F;
        scene.relief.fade[1] = 30.0F;
        draw(&faded, &scene, NULL);
        assert_memory_equal(whole.depth, faded.depth, sizeof whole.depth);
        scene.relief.fade[0] = 1.0F;
        scene.relief.fade[1] = 2.0F;
        draw(&faded, &scene, NULL);
        if (body == HC_BODY_PLANE) {
            const int middle = HIGH / 2 * WIDE + WIDE / 2;
            assert_true(fabs((double)whole.depth[middle] - 6.15) < 0.01);
            assert_true(fabs((double)faded.depth[middle] - 6.0) < 0.01);
        }
        assert_true(faded.picture.figures.hits >= whole.picture.figures.hits);
    }
    hc_scene bad       = scene_of(level_heights, HC_BODY_PLANE, HC_TRACE_SAFE);
    bad.relief.fade[0] = 2.0F;
    bad.relief.fade[1] = 1.0F;
    refuse(&bad, NULL, "relief.fade[1] is 1");
}

/* A wall of height 1 at the left, a sun at 45 degrees: its shadow is as long as it is high. */
static void a_shadow_has_its_length(void **state)
{
    (void)state;
    static shot  s;
    static float wall[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        wall[i] = i % SIDE < 4 ? 1.0F : 0.0F;
    }
    hc_scene scene            = scene_of(wall, HC_BODY_PLANE, HC_TRACE_MAXMIP);
    scene.relief.field.wrap   = HC_WRAP_NONE;
    scene.relief.depth        = 0.5F;
    scene.camera.eye[2]       = 3.0;
    scene.camera.orthographic = 2.0F;
    scene.light.place[0]      = -1.0;
    scene.light.place[2]      = 1.0;
    draw(&s, &scene, NULL);
    const float *row = s.rgb + (size_t)(HIGH / 2) * WIDE * 3;
    for (int x = 0; x < WIDE; x++) {
        const double place = 2.0 * (x + 0.5) / WIDE; /* from the left side; the edge is at 0.25 */
        if (place > 0.28 && place < 0.66) {
            assert_true(row[3 * x] < 0.2F);
        } else if (place > 0.75) {
            assert_true(row[3 * x] > 0.3F);
        }
    }
    scene.light.no_shadows = true;
    draw(&s, &scene, NULL);
    assert_true(row[3 * (WIDE / 4)] > 0.3F);
}

/* A lamp straight above the middle lights the middle most. */
static void a_lamp_is_near(void **state)
{
    (void)state;
    static shot s;
    hc_scene    scene         = scene_of(level_heights, HC_BODY_PLANE, HC_TRACE_FAST);
    scene.camera.eye[2]       = 3.0;
    scene.camera.orthographic = 1.9F;
    scene.light.lamp          = true;
    scene.light.place[2]      = 0.3;
    draw(&s, &scene, NULL);
    const float middle = s.rgb[(HIGH / 2 * WIDE + WIDE / 2) * 3];
    const float corner = s.rgb[3 * WIDE + 3];
    assert_true(middle > 2.0F * corner);
}

static void albedo_lies_on_the_field(void **state)
{
    (void)state;
    static shot  s;
    static float half[2 * 3]  = { 0.9F, 0.0F, 0.0F, 0.0F, 0.0F, 0.9F };
    hc_scene     scene        = scene_of(level_heights, HC_BODY_PLANE, HC_TRACE_FAST);
    scene.camera.eye[2]       = 3.0;
    scene.camera.orthographic = 1.9F;
    scene.material =
        (hc_material){ .albedo = half, .albedo_width = 2, .albedo_height = 1, .diffuse = 1.0F };
    draw(&s, &scene, NULL);
    const float *left  = s.rgb + (HIGH / 2 * WIDE + WIDE / 4) * 3;
    const float *right = s.rgb + (HIGH / 2 * WIDE + WIDE * 3 / 4) * 3;
    assert_true(left[0] > 10.0F * left[2]);
    assert_true(right[2] > 10.0F * right[0]);
}

static void exact_methods_lose_nothing(void **state)
{
    (void)state;
    static shot                  s;
    static const hc_trace_method methods[] = { HC_TRACE_FAST, HC_TRACE_SAFE, HC_TRACE_MAXMIP };
    const hc_render_options      missed    = { .view = HC_VIEW_MISSED };
    for (int body = 0; body <= HC_BODY_TORUS; body++) {
        for (int i = 0; i < 3; i++) {
            const hc_scene scene = scene_of(hills, (hc_body)body, methods[i]);
            draw(&s, &scene, &missed);
            assert_int_equal(s.picture.figures.lost, 0);
            assert_int_equal(s.picture.figures.made_up, 0);
            assert_true(s.picture.figures.hits > 200);
            assert_int_equal(s.picture.figures.rays, WIDE * HIGH);
        }
        hc_scene few           = scene_of(hills, (hc_body)body, HC_TRACE_LINEAR);
        few.relief.trace.steps = 2;
        draw(&s, &few, &missed);
        assert_true(s.picture.figures.lost > 20);
    }
}

static bool is_magenta(const float *rgb)
{
    return rgb[0] > 0.99F && rgb[1] < 0.01F && rgb[2] > 0.99F;
}

static void views_show_what_they_say(void **state)
{
    (void)state;
    static shot       s, heat;
    hc_render_options options = { .view = HC_VIEW_UNCONVERGED };
    hc_scene          scene   = scene_of(hills, HC_BODY_PLANE, HC_TRACE_CONE_LOOP);
    scene.relief.trace.steps  = 4;
    draw(&s, &scene, &options);
    uint64_t magenta = 0;
    for (int i = 0; i < WIDE * HIGH; i++) {
        magenta += is_magenta(s.rgb + 3 * i);
    }
    assert_true(magenta > 0);
    assert_int_equal(magenta, s.picture.figures.unconverged);
    options.view = HC_VIEW_STEPS;
    draw(&heat, &scene, &options);
    assert_true(heat.picture.figures.top == 4.0);
    assert_true(heat.picture.figures.mean_steps > 1.0 && heat.picture.figures.mean_steps <= 4.0);
    options.top = 400.0F;
    draw(&heat, &scene, &options);
    assert_true(heat.picture.figures.top == 400.0);
    options = (hc_render_options){ .view = HC_VIEW_ERROR };
    draw(&heat, &scene, &options);
    assert_true(heat.picture.figures.mean_error > 0.0 && heat.picture.figures.mean_error < 0.2);
    options.view = HC_VIEW_DEPTH;
    draw(&heat, &scene, &options);
    options.view = HC_VIEW_HEIGHT;
    draw(&s, &scene, &options);
    assert_true(memcmp(heat.rgb, s.rgb, sizeof s.rgb) != 0);
    assert_memory_equal(heat.depth, s.depth, sizeof s.depth);
}

static void threads_and_samples(void **state)
{
    (void)state;
    static shot one, three;
    hc_scene    scene    = scene_of(hills, HC_BODY_TORUS, HC_TRACE_SAFE);
    scene.camera.samples = 3;
    draw(&one, &scene, &(hc_render_options){ .threads = 1 });
    draw(&three, &scene, &(hc_render_options){ .threads = 3 });
    assert_memory_equal(one.rgb, three.rgb, sizeof one.rgb);
    assert_memory_equal(one.depth, three.depth, sizeof one.depth);
    assert_int_equal(one.picture.figures.rays, 3 * WIDE * HIGH);
    float colour[3];
    hc_heat_colour(colour, 2.0);
    assert_true(colour[0] > 0.9F);
}

static bool stop_at_once(void *user, double fraction)
{
    (void)user;
    return fraction < 0.0;
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void bad_scenes_are_refused(void **state)
{
    (void)state;
    const hc_scene good = scene_of(hills, HC_BODY_TORUS, HC_TRACE_SAFE);
    hc_scene       bad  = good;
    refuse(&good, &(hc_render_options){ .view = (hc_view)8 }, "options.view is 8");
    refuse(&good, &(hc_render_options){ .threads = -1 }, "options.threads is -1");
    bad.relief.field.wrap = HC_WRAP_U;
    refuse(&bad, NULL, "wraps along v");
    bad              = good;
    bad.relief.depth = 0.4F;
    refuse(&bad, NULL, "relief.depth is 0.4");
    bad.relief.depth = NAN;
    refuse(&bad, NULL, "relief.depth is nan");
    bad                  = good;
    bad.relief.repeat[1] = 257;
    refuse(&bad, NULL, "relief.repeat[1] is 257");
    bad                     = good;
    bad.relief.trace.ratios = NULL;
    refuse(&bad, NULL, "ratios is NULL");
    bad                      = good;
    bad.relief.trace.surface = HC_SURFACE_STEPS;
    refuse(&bad, NULL, "surface");
    bad            = good;
    bad.light.lamp = true;
    refuse(&bad, NULL, "light.place");
    bad               = good;
    bad.camera.eye[0] = (double)INFINITY;
    refuse(&bad, NULL, "camera.eye is inf");
    bad            = good;
    bad.camera.fov = 171.0F;
    refuse(&bad, NULL, "camera.fov is 171");
    bad             = good;
    bad.relief.body = (hc_body)4;
    refuse(&bad, NULL, "relief.body is 4");
    bad             = good;
    bad.relief.edge = (hc_edge)3;
    refuse(&bad, NULL, "relief.edge is 3");
}

static void cancelling(void **state)
{
    (void)state;
    static float            rgb[3 * 64];
    hc_log                  log     = { .text = "" };
    hc_picture              picture = { .width = 8, .height = 8, .rgb = rgb };
    const hc_scene          scene   = scene_of(hills, HC_BODY_PLANE, HC_TRACE_SAFE);
    const hc_render_options options = { .threads = 1, .progress = { .report = stop_at_once } };
    assert_int_equal(hc_render(&picture, &scene, &options, &log), HC_ERROR_CANCELLED);
    picture.rgb = NULL;
    assert_int_equal(hc_render(&picture, &scene, NULL, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "rgb is NULL"));
}

static void names(void **state)
{
    (void)state;
    assert_string_equal(hc_body_name(HC_BODY_TORUS), "torus");
    assert_string_equal(hc_edge_name(HC_EDGE_DISCARD), "discard");
    assert_string_equal(hc_view_name(HC_VIEW_ERROR), "error");
    assert_null(hc_view_name((hc_view)(HC_VIEW_CROSSINGS + 1)));
    assert_null(hc_body_name((hc_body)-1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_bodies_are_where_they_should_be),
        cmocka_unit_test(level_silhouettes_are_exact),
        cmocka_unit_test(a_plane_from_above),
        cmocka_unit_test(edges),
        cmocka_unit_test(a_clamped_edge_goes_on),
        cmocka_unit_test(steps_fall_with_distance),
        cmocka_unit_test(relief_fades),
        cmocka_unit_test(a_shadow_has_its_length),
        cmocka_unit_test(a_lamp_is_near),
        cmocka_unit_test(albedo_lies_on_the_field),
        cmocka_unit_test(exact_methods_lose_nothing),
        cmocka_unit_test(views_show_what_they_say),
        cmocka_unit_test(threads_and_samples),
        cmocka_unit_test(bad_scenes_are_refused),
        cmocka_unit_test(cancelling),
        cmocka_unit_test(names),
    };
    return cmocka_run_group_tests_name("render", tests, prepare, NULL);
}
