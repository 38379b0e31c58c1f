/* Light and objects in landscapes: shadows that formulas know, polygons that hide and are
 * hidden. */
#include "terrain_fixture.h"

static int prepare(void **state)
{
    (void)state;
    fill_heights();
    return 0;
}

/* ---- shadows --------------------------------------------------------------------------------- */

/* A cliff of 200 between x = 150 and 160, the sun in the west: the shadow of its edge ends where
 * the sun's ray over it comes down. */
static void a_cliff_throws_its_shadow(void **state)
{
    (void)state;
    hc_terrain_scene scene  = scene_of(cliff);
    const hc_camera  camera = from_above(600.0F);
    scene.sun[0]            = -1.0;
    scene.sun[2]            = 2.0;
    scene.ground            = HC_GROUND_PLAIN;
    draw_once(&first, &scene, NULL, &camera);
    scene.no_shadows = true;
    draw_once(&second, &scene, NULL, &camera);
    int dark = 0;
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_below(place, &camera, i);
        /* Smooth normals face away up to the sample behind the foot. */
        const bool flat = place[0] > 171.0 && place[0] < 319.0 && fabs(place[1] + 160.0) < 159.0;
        const bool same = memcmp(first.rgb + 3 * i, second.rgb + 3 * i, 3 * sizeof(float)) == 0;
        if (flat && fabs(place[0] - 250.0) > 1.0) {
            assert_true(same == (place[0] > 250.0));
            dark += same ? 0 : 1;
        }
    }
    assert_true(dark > 100);
}

/* ---- objects --------------------------------------------------------------------------------- */

static hc_mesh *solid(hc_solid which)
{
    hc_mesh *mesh = NULL;
    assert_int_equal(hc_solid_create(&mesh, which, NULL), HC_OK);
    return mesh;
}

static int pixel_at(const hc_camera *camera, double x, double y)
{
    const double unit   = (double)camera->orthographic / WIDE;
    const int    column = (int)floor((x - camera->eye[0]) / unit + 0.5 * WIDE);
    const int    row    = (int)floor((camera->eye[1] - y) / unit + 0.5 * HIGH);
    return row * WIDE + column;
}

/* A ball of 60 in the air, the sun in the west at 45 degrees: the ball where it is, and its shadow
 * as far to the east as it is high. */
static void a_ball_hides_the_ground_and_shades_it(void **state)
{
    (void)state;
    hc_mesh        *ball   = solid(HC_SOLID_BALL);
    const hc_object object = {
        .mesh = ball, .place = { 160.0, -160.0, 100.0 }, .grounded = true, .size = 60.0
    };
    hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera  camera = from_above(400.0F);
    scene.objects           = &object;
    scene.object_count      = 1;
    scene.sun[0]            = -1.0;
    scene.sun[2]            = 1.0;
    draw_once(&first, &scene, NULL, &camera);
    scene.no_shadows = true;
    draw_once(&second, &scene, NULL, &camera);
    assert_true(fabsf(first.depth[pixel_at(&camera, 160.0, -160.0)] - 640.0F) < 1.0F);
    for (int i = 0; i < PIXELS; i++) {
        double place[2];
        place_below(place, &camera, i);
        const double from_ball   = hypot(place[0] - 160.0, place[1] + 160.0);
        const double from_shadow = hypot((place[0] - 290.0) * sqrt(0.5), place[1] + 160.0);
        const bool   dark = memcmp(first.rgb + 3 * i, second.rgb + 3 * i, 3 * sizeof(float)) != 0;
        if (from_ball > 30.5 && fabs(place[0] - 160.0) < 155.0) {
            assert_true(fabsf(first.depth[i] - 800.0F) < 0.01F);
            assert_true(dark == (from_shadow < 30.0) || fabs(from_shadow - 29.75) < 0.5);
        } else if (from_ball < 29.0) {
            assert_true(first.depth[i] < 700.0F);
        }
    }
    assert_true(memcmp(first.rgb, second.rgb, sizeof first.rgb) != 0);
    hc_mesh_destroy(ball);
}

/* Boxes at the foot of the cliff: the first in its shadow, the second beyond it. */
static void the_ground_shades_boxes(void **state)
{
    (void)state;
    hc_mesh        *box       = solid(HC_SOLID_BOX);
    const hc_object objects[] = {
        { .mesh = box, .place = { 190.0, -160.0, 100.0 }, .size = 20.0 },
        { .mesh = box, .place = { 270.0, -160.0, 100.0 }, .size = 20.0 }
    };
    hc_terrain_scene scene  = scene_of(cliff);
    const hc_camera  camera = from_above(400.0F);
    scene.objects           = objects;
    scene.object_count      = 2;
    scene.sun[0]            = -1.0;
    scene.sun[2]            = 2.0;
    draw_once(&first, &scene, NULL, &camera);
    scene.no_shadows = true;
    draw_once(&second, &scene, NULL, &camera);
    for (int i = 0; i < 2; i++) {
        const int pixel = pixel_at(&camera, objects[i].place[0], -160.0);
        assert_true(fabsf(first.depth[pixel] - 880.0F) < 0.01F);
        const bool dark = memcmp(first.rgb + (ptrdiff_t)3 * pixel,
                                 second.rgb + (ptrdiff_t)3 * pixel, 3 * sizeof(float))
                          != 0;
        assert_true(dark == (i == 0));
    }
    hc_mesh_destroy(box);
}

/* The same from a map, but for what lies within a few texels of an edge. */
static void a_map_of_shadows_has_them_but_for_edges(void **state)
{
    (void)state;
    hc_mesh         *ball   = solid(HC_SOLID_BALL);
    const hc_object  object = { .mesh = ball, .place = { 280.0, -60.0, 150.0 }, .size = 40.0 };
    hc_terrain_scene scene  = scene_of(cliff);
    const hc_camera  camera = from_above(400.0F);
    scene.ground            = HC_GROUND_PLAIN;
    scene.objects           = &object;
    scene.object_count      = 1;
    scene.sun[0]            = -1.0;
    scene.sun[2]            = 2.0;
    draw_once(&first, &scene, NULL, &camera);
    scene.shadow_map = 400; /* texels of one unit */
    draw_once(&second, &scene, NULL, &camera);
    assert_memory_equal(first.depth, second.depth, sizeof first.depth);
    int same = 0, dark = 0;
    for (int i = 0; i < PIXELS; i++) {
        const bool alike = fabsf(first.rgb[3 * i] - second.rgb[3 * i]) < 1e-6F;
        double     place[2];
        place_below(place, &camera, i);
        same += alike ? 1 : 0;
        if (place[0] > 175.0 && place[0] < 240.0 && fabs(place[1] + 160.0) < 150.0) {
            assert_true(alike);
            dark++;
        }
    }
    assert_true(dark > 100 && same > PIXELS - PIXELS / 20);
    scene.shadow_map = 3;
    draw_once(&second, &scene, NULL, &camera);
    assert_memory_not_equal(first.rgb, second.rgb, sizeof first.rgb);
    hc_mesh_destroy(ball);
}

/* Behind the cliff there is nothing to see of a house; on it there is, turned or not. */
static void the_ground_hides_a_house(void **state)
{
    (void)state;
    hc_mesh         *house  = solid(HC_SOLID_HOUSE);
    hc_object        object = { .mesh = house, .place = { 220.0, -160.0, 100.0 }, .size = 40.0 };
    hc_terrain_scene scene  = scene_of(cliff);
    const hc_camera  camera = { .eye = { -300.0, -160.0, 290.0 }, .at = { 160.0, -160.0, 290.0 } };
    draw_once(&first, &scene, NULL, &camera);
    scene.objects      = &object;
    scene.object_count = 1;
    draw_once(&second, &scene, NULL, &camera);
    assert_memory_equal(first.depth, second.depth, sizeof first.depth);
    object.place[0] = 100.0;
    object.grounded = true;
    object.place[2] = 0.0;
    draw_once(&second, &scene, NULL, &camera);
    const float *middle = &second.depth[HIGH / 2 * WIDE + WIDE / 2];
    const int    up     = 3 * WIDE; /* the cliff's edge is above the eye */
    assert_true(middle[-up] > 379.0F && middle[-up] < 381.0F);
    object.turn = 90.0;
    draw_once(&first, &scene, NULL, &camera);
    assert_true(fabsf(first.depth[HIGH / 2 * WIDE + WIDE / 2 - up] - 386.0F) < 1.0F);
    hc_mesh_destroy(house);
}

static void bad_objects_are_refused(void **state)
{
    (void)state;
    hc_terrain_scene bad    = scene_of(cliff);
    hc_object        object = { .size = 1.0 };
    bad.objects             = &object;
    bad.object_count        = 1;
    refuse(&bad, NULL, "object 0 has no mesh");
    object.size = -1.0;
    refuse(&bad, NULL, "size -1");
    object.size     = 1.0;
    object.place[1] = (double)NAN;
    refuse(&bad, NULL, "object.place");
    object.place[1]   = 0.0;
    hc_mesh *box      = solid(HC_SOLID_BOX);
    object.mesh       = box;
    box->triangles[0] = 9;
    refuse(&bad, NULL, "has vertex 9");
    hc_mesh_destroy(box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cliff_throws_its_shadow),
        cmocka_unit_test(a_ball_hides_the_ground_and_shades_it),
        cmocka_unit_test(the_ground_shades_boxes),
        cmocka_unit_test(a_map_of_shadows_has_them_but_for_edges),
        cmocka_unit_test(the_ground_hides_a_house),
        cmocka_unit_test(bad_objects_are_refused),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
