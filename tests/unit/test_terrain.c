/* Terrain: where heights and shadows are known by formulas, what methods lose, cameras, and what is
 * refused. */
#include "terrain_fixture.h"

#include "render/angle.h"

#include <heightcast/bake.h>

static float hills[SIDE * SIDE], quad[SIDE * SIDE * 4], round_ratios[SIDE * SIDE];

static int prepare(void **state)
{
    static float   cones[SIDE * SIDE * 4];
    const hc_field field = { .heights = hills, .width = SIDE, .height = SIDE };
    (void)state;
    fill_heights();
    hc_result result = hc_synth(hills, SIDE, SIDE, "fbm", 3, NULL);
    if (result == HC_OK) {
        result =
            hc_bake_cone_map(cones, &field, &(hc_cone_options){ .cones = HC_CONES_QUAD }, NULL);
        hc_bake_cell_ratios(quad, cones, SIDE, SIDE, HC_CONES_QUAD, HC_WRAP_NONE);
    }
    if (result == HC_OK) {
        result = hc_bake_cone_map(round_ratios, &field, NULL, NULL);
    }
    return result == HC_OK ? 0 : -1;
}

/* ---- places ---------------------------------------------------------------------------------- */

static void level_ground_lies_where_it_should(void **state)
{
    (void)state;
    const hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera        camera = from_above(800.0F);
    draw_once(&first, &scene, NULL, &camera);
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_below(place, &camera, i);
        const bool over = place[0] > 0.0 && place[0] < 320.0 && place[1] < 0.0 && place[1] > -320.0;
        if (over) {
            assert_true(fabsf(first.depth[i] - 800.0F) < 1e-2F);
        } else {
            assert_true(first.depth[i] == INFINITY);
        }
    }
}

static void place_and_scale_are_those_of_the_scene(void **state)
{
    (void)state;
    hc_terrain_scene scene = scene_of(hills);
    scene.exaggeration     = 2.0;
    scene.offset[0]        = 1000.0;
    scene.offset[2]        = -50.0;
    scene.spacing[1]       = 20.0;
    hc_terrain        *t   = make(&scene, NULL);
    const hc_placement p   = hc_terrain_placement(t);
    assert_true(p.spacing_x == 10.0 && p.spacing_y == -20.0);
    assert_true(p.offset[0] == 1000.0 && p.offset[2] == 150.0 && p.scale_z == 400.0);
    for (int i = 0; i < SIDE; i++) { /* samples, rows to the south */
        const double z = hc_terrain_ground(t, 1000.0 + 10.0 * i, -20.0 * (SIDE - 1 - i));
        assert_true(fabs(z - (150.0 + 400.0 * (double)hills[(SIDE - 1 - i) * SIDE + i])) < 1e-3);
    }
    assert_true(hc_terrain_ground(t, -5000.0, 9.0) == hc_terrain_ground(t, 1000.0, 0.0));
    hc_terrain_destroy(t);
}

static void what_a_file_says_is_the_default(void **state)
{
    (void)state;
    hc_terrain_scene scene = { .field = { .heights = hills, .width = SIDE, .height = SIDE } };
    hc_terrain      *t     = make(&scene, NULL);
    assert_true(hc_terrain_placement(t).scale_z == 1.0);
    assert_true(fabs(hc_terrain_placement(t).spacing_x * SIDE - 32.0) < 1e-9);
    hc_terrain_destroy(t);
    scene.field.elevation = (hc_elevation){ .low = 50, .high = 80, .spacing_x = 3, .spacing_y = 4 };
    t                     = make(&scene, NULL);
    assert_true(hc_terrain_placement(t).scale_z == 30.0);
    assert_true(hc_terrain_placement(t).offset[2] == 50.0);
    assert_true(hc_terrain_placement(t).spacing_y == -4.0);
    hc_terrain_destroy(t);
}

/* The walls go down a quarter of the height below the lowest, and there is nothing under them. */
static void the_block_ends(void **state)
{
    (void)state;
    const hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera        camera = { .eye          = { 160.0, -1000.0, 200.0 },
                                      .at           = { 160.0, 0.0, 200.0 },
                                      .orthographic = 400.0F };
    draw_once(&first, &scene, NULL, &camera);
    for (int row = 0; row < HIGH; row++) {
        const double z     = 200.0 - (row + 0.5 - 0.5 * HIGH) * 400.0 / WIDE;
        const float  depth = first.depth[row * WIDE + WIDE / 2];
        assert_true(z > 50.0 && z < 200.0 ? fabsf(depth - 680.0F) < 0.01F : depth == INFINITY);
    }
}

static void open_sides_have_no_walls(void **state)
{
    (void)state;
    hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera  camera = { .eye = { 160.0, -1000.0, 150.0 }, .at = { 160.0, 0.0, 160.0 } };
    draw_once(&first, &scene, NULL, &camera);
    assert_true(first.picture.figures.hits > 100);
    scene.trace.open_sides = true;
    draw_once(&first, &scene, NULL, &camera);
    assert_true(first.depth[HIGH / 2 * WIDE + WIDE / 2] == INFINITY);
}

/* ---- methods --------------------------------------------------------------------------------- */

static hc_terrain_scene scene_with(hc_trace_method method)
{
    hc_terrain_scene scene = scene_of(hills);
    scene.trace.method     = method;
    if (hc_trace_method_needs(method) == HC_NEEDS_CELL_RATIOS) {
        scene.trace.ratios = quad;
        scene.trace.cones  = HC_CONES_QUAD;
    } else if (hc_trace_method_needs(method) != HC_NEEDS_NOTHING) {
        scene.trace.ratios = round_ratios;
    }
    return scene;
}

/* In the air, on the ground, looking up, from outside: nothing is lost. */
static void exact_methods_lose_nothing_from_anywhere(void **state)
{
    (void)state;
    const hc_trace_method   methods[] = { HC_TRACE_FAST, HC_TRACE_SAFE, HC_TRACE_MAXMIP };
    const hc_render_options options   = { .view = HC_VIEW_MISSED };
    for (int m = 0; m < 3; m++) {
        const hc_terrain_scene scene = scene_with(methods[m]);
        hc_terrain            *t     = make(&scene, &options);
        for (int tour = 0; tour <= HC_TOUR_ORBIT; tour++) {
            for (double moment = 0.0; moment < 1.0; moment += 0.25) {
                hc_camera camera;
                hc_terrain_tour(&camera, t, (hc_tour)tour, moment);
                draw(&first, t, &camera);
                assert_int_equal(first.picture.figures.lost, 0);
                assert_int_equal(first.picture.figures.made_up, 0);
                assert_true(first.picture.figures.hits > 50);
            }
        }
        hc_terrain_destroy(t);
    }
}

static void few_steps_lose_much(void **state)
{
    (void)state;
    const hc_render_options options = { .view = HC_VIEW_MISSED };
    hc_terrain_scene        scene   = scene_with(HC_TRACE_CONE_LOOP);
    scene.trace.steps               = 3;
    draw_once(&first, &scene, &options, &(hc_camera){ .fov = 60.0F });
    assert_true(first.picture.figures.lost + first.picture.figures.made_up > PIXELS / 10);
    assert_true(first.picture.figures.unconverged > 0);
    scene.trace.steps = 0; /* the sample's 512 */
    draw_once(&first, &scene, &options, &(hc_camera){ .fov = 60.0F });
    assert_true(first.picture.figures.lost + first.picture.figures.made_up < PIXELS / 50);
}

static void steps_are_level_and_upright(void **state)
{
    (void)state;
    const hc_render_options options = { .view = HC_VIEW_NORMAL };
    hc_terrain_scene        scene   = scene_of(hills);
    scene.trace.surface             = HC_SURFACE_STEPS;
    draw_once(&first, &scene, &options, &(hc_camera){ .fov = 60.0F });
    for (int i = 0; i < PIXELS; i++) {
        if (first.depth[i] < INFINITY) { /* one component is 1, the others are 0: code 0.5 */
            const float *c       = first.rgb + 3 * i;
            const float  middle  = 0.2140F;
            int          between = 0;
            for (int k = 0; k < 3; k++) {
                between += fabsf(c[k] - middle) < 1e-3F ? 1 : 0;
            }
            assert_int_equal(between, 2);
        }
    }
}

/* ---- views ----------------------------------------------------------------------------------- */

static void crossings_are_counted(void **state)
{
    (void)state;
    const hc_render_options options = { .view = HC_VIEW_CROSSINGS };
    const hc_terrain_scene  scene   = scene_with(HC_TRACE_MAXMIP);
    draw_once(&first, &scene, &options, &(hc_camera){ .fov = 60.0F });
    const hc_render_figures *f = &first.picture.figures;
    assert_true(f->mean_crossings > 1.0 && f->mean_crossings < f->mean_steps);
    assert_true(f->within[0] > 0.2 && f->within[0] <= f->within[1]);
    assert_true(f->within[1] <= f->within[2] && f->within[2] <= 1.0);
    for (int i = 0; i < PIXELS; i++) { /* nobody needs 85 here, nothing is red */
        assert_true(f->within[2] < 1.0 || first.rgb[3 * i + 2] > 0.0F);
    }
}

static void haze_hides_what_is_far(void **state)
{
    (void)state;
    hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera  camera = { .eye = { 160.0, -310.0, 202.0 }, .at = { 160.0, 0.0, 200.0 } };
    scene.ground            = HC_GROUND_PLAIN;
    scene.haze              = 30.0F;
    draw_once(&first, &scene, NULL, &camera);
    scene.haze = INFINITY;
    draw_once(&second, &scene, NULL, &camera);
    const int far  = (HIGH / 2 + 1) * WIDE + WIDE / 2;
    const int near = (HIGH - 1) * WIDE + WIDE / 2;
    assert_true(first.rgb[3 * far + 2] > first.rgb[3 * near + 2] + 0.1F);
    assert_true(fabsf(second.rgb[3 * far + 2] - second.rgb[3 * near + 2]) < 1e-5F);
}

static void an_image_lies_on_the_ground(void **state)
{
    (void)state;
    static const float image[] = {
        1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1
    }; /* red green / blue white */
    hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera  camera = from_above(800.0F);
    scene.ground            = HC_GROUND_IMAGE;
    scene.image             = image;
    scene.image_width       = 2;
    scene.image_height      = 2;
    scene.blocky            = true;
    scene.haze              = INFINITY;
    draw_once(&first, &scene, NULL, &camera);
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_below(place, &camera, i);
        if (first.depth[i] < INFINITY) {
            const float *texel = image + (place[1] < -160.0 ? 6 : 0) + (place[0] > 160.0 ? 3 : 0);
            for (int k = 0; k < 3; k++) {
                assert_true((first.rgb[3 * i + k] > 0.0F) == (texel[k] > 0.0F));
            }
        }
    }
}

static void same_bytes_for_every_number_of_threads(void **state)
{
    (void)state;
    const hc_terrain_scene scene  = scene_of(hills);
    const hc_camera        camera = { .fov = 70.0F, .samples = 3 };
    draw_once(&first, &scene, &(hc_render_options){ .threads = 1 }, &camera);
    draw_once(&second, &scene, &(hc_render_options){ .threads = 5 }, &camera);
    assert_memory_equal(first.rgb, second.rgb, sizeof first.rgb);
    assert_memory_equal(first.depth, second.depth, sizeof first.depth);
}

/* ---- cameras --------------------------------------------------------------------------------- */

static void turns_are_those_of_libm(void **state)
{
    (void)state;
    for (int i = -500; i < 500; i++) {
        double       c, s;
        const double turns = i / 100.0 + 0.003;
        hc_turn(&c, &s, turns);
        assert_true(fabs(c - cos(turns * 2.0 * HC_PI)) < 1e-13);
        assert_true(fabs(s - sin(turns * 2.0 * HC_PI)) < 1e-13);
    }
}

static void tours_are_closed_and_over_the_ground(void **state)
{
    (void)state;
    const hc_terrain_scene scene = scene_of(hills);
    hc_terrain            *t     = make(&scene, NULL);
    for (int tour = 0; tour <= HC_TOUR_ORBIT; tour++) {
        hc_camera start, end;
        hc_terrain_tour(&start, t, (hc_tour)tour, 0.0);
        hc_terrain_tour(&end, t, (hc_tour)tour, 1.0);
        for (int i = 0; i < 40; i++) {
            hc_camera c;
            hc_terrain_tour(&c, t, (hc_tour)tour, i / 40.0);
            const double above = c.eye[2] - hc_terrain_ground(t, c.eye[0], c.eye[1]);
            assert_true(above > 0.0);
            assert_true(tour != HC_TOUR_WALK || fabs(above - 0.5) < 1e-6);
        }
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(start.eye[k] - end.eye[k]) < 1e-6);
            assert_true(fabs(start.at[k] - end.at[k]) < 1e-6);
        }
    }
    hc_terrain_destroy(t);
}

static void paths_go_through_their_keys(void **state)
{
    (void)state;
    const hc_camera keys[] = { { .eye = { 0, 0, 5 }, .at = { 1, 0, 0 }, .fov = 30, .samples = 2 },
                               { .eye = { 4, 0, 7 }, .at = { 1, 2, 0 } },
                               { .eye = { 4, 4, 6 }, .at = { 1, 0, 3 }, .fov = 90 } };
    hc_camera       c;
    for (int i = 0; i < 3; i++) {
        hc_camera_between(&c, keys, 3, i / 2.0);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(c.eye[k] - keys[i].eye[k]) < 1e-12);
            assert_true(fabs(c.at[k] - keys[i].at[k]) < 1e-12);
        }
        assert_int_equal(c.samples, 2);
    }
    hc_camera_between(&c, keys, 3, 0.5);
    assert_true(c.fov == 60.0F);
    hc_camera_between(&c, keys, 3, 0.25);
    assert_true(c.eye[0] > 1.0 && c.eye[0] < 3.0 && c.fov > 30.0F && c.fov < 60.0F);
    hc_camera_between(&c, keys, 1, 0.7);
    assert_memory_equal(c.eye, keys[0].eye, sizeof c.eye);
}

/* ---- refusals -------------------------------------------------------------------------------- */

static void bad_scenes_are_refused(void **state)
{
    (void)state;
    const hc_terrain_scene good = scene_of(hills);
    hc_terrain_scene       bad  = good;
    bad.spacing[0]              = 0.0;
    refuse(&bad, NULL, "scene.spacing");
    bad.spacing[0] = (double)NAN;
    refuse(&bad, NULL, "scene.spacing[0]");
    bad      = good;
    bad.high = 99.0;
    refuse(&bad, NULL, "scene.high");
    bad              = good;
    bad.exaggeration = -1.0;
    refuse(&bad, NULL, "scene.exaggeration");
    bad           = good;
    bad.offset[1] = INFINITY;
    refuse(&bad, NULL, "scene.offset");
    bad            = good;
    bad.field.wrap = HC_WRAP_U;
    refuse(&bad, NULL, "scene.field.wrap");
    bad              = good;
    bad.field.height = 0;
    refuse(&bad, NULL, "field size");
    bad        = good;
    bad.ground = HC_GROUND_IMAGE;
    refuse(&bad, NULL, "scene.image_width");
    bad      = good;
    bad.haze = -1.0F;
    refuse(&bad, NULL, "scene.haze");
    bad            = good;
    bad.shadow_map = 16385;
    refuse(&bad, NULL, "scene.shadow_map");
    bad              = good;
    bad.trace.method = HC_TRACE_SAFE;
    refuse(&bad, NULL, "ratios");
    refuse(&good, &(hc_render_options){ .view = HC_VIEW_STEPS }, "options.view");
    refuse(&good, &(hc_render_options){ .threads = -1 }, "options.threads");
}

static void bad_cameras_are_refused(void **state)
{
    (void)state;
    const hc_terrain_scene scene   = scene_of(hills);
    hc_terrain            *t       = make(&scene, NULL);
    hc_log                 log     = { .text = "" };
    hc_picture             picture = { .width = WIDE, .height = HIGH, .rgb = first.rgb };
    const hc_camera        bad[]   = { { .eye = { 1, 2, 3 }, .at = { 1, 2, 3 } },
                                       { .eye = { (double)NAN, 2, 3 } },
                                       { .eye = { 1, 2, 3 }, .fov = 171.0F },
                                       { .eye = { 1, 2, 3 }, .samples = 257 } };
    const char *const says[] = { "looks nowhere", "camera.eye", "camera.fov", "camera.samples" };
    for (int i = 0; i < 4; i++) {
        assert_int_equal(hc_terrain_draw(&picture, t, &bad[i], &log), HC_ERROR_ARGUMENT);
        assert_non_null(strstr(log.text, says[i]));
    }
    picture.width = 0;
    assert_int_equal(hc_terrain_draw(&picture, t, &(hc_camera){ .fov = 0 }, &log),
                     HC_ERROR_ARGUMENT);
    hc_terrain_destroy(t);
    hc_terrain_destroy(NULL);
}

static bool stop_at_once(void *user, double done)
{
    (void)user;
    (void)done;
    return false;
}

static void drawing_can_be_stopped(void **state)
{
    (void)state;
    const hc_terrain_scene scene = scene_of(hills);
    /* On several threads all may be drawn before the calling one is asked. */
    const hc_render_options options = { .threads = 1, .progress = { .report = stop_at_once } };
    hc_terrain             *t       = make(&scene, &options);
    hc_picture              picture = { .width = WIDE, .height = HIGH, .rgb = first.rgb };
    assert_int_equal(hc_terrain_draw(&picture, t, &(hc_camera){ .fov = 0 }, NULL),
                     HC_ERROR_CANCELLED);
    hc_terrain_destroy(t);
}

static void names(void **state)
{
    (void)state;
    assert_string_equal(hc_ground_name(HC_GROUND_PLAIN), "plain");
    assert_null(hc_ground_name((hc_ground)(HC_GROUND_PLAIN + 1)));
    assert_string_equal(hc_tour_name(HC_TOUR_ORBIT), "orbit");
    assert_null(hc_tour_name((hc_tour)(HC_TOUR_ORBIT + 1)));
    assert_string_equal(hc_view_name(HC_VIEW_CROSSINGS), "crossings");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_ground_lies_where_it_should),
        cmocka_unit_test(place_and_scale_are_those_of_the_scene),
        cmocka_unit_test(what_a_file_says_is_the_default),
        cmocka_unit_test(the_block_ends),
        cmocka_unit_test(open_sides_have_no_walls),
        cmocka_unit_test(exact_methods_lose_nothing_from_anywhere),
        cmocka_unit_test(few_steps_lose_much),
        cmocka_unit_test(steps_are_level_and_upright),
        cmocka_unit_test(crossings_are_counted),
        cmocka_unit_test(haze_hides_what_is_far),
        cmocka_unit_test(an_image_lies_on_the_ground),
        cmocka_unit_test(same_bytes_for_every_number_of_threads),
        cmocka_unit_test(turns_are_those_of_libm),
        cmocka_unit_test(tours_are_closed_and_over_the_ground),
        cmocka_unit_test(paths_go_through_their_keys),
        cmocka_unit_test(bad_scenes_are_refused),
        cmocka_unit_test(bad_cameras_are_refused),
        cmocka_unit_test(drawing_can_be_stopped),
        cmocka_unit_test(names),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
