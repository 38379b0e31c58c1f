/* shaders/detail.glsl against the CPU: details by both ways on top of several methods, from
 * everywhere, shadows and all; skipped where there is no OpenGL. */
#include "shots.h"

#include <heightcast/terrain.h>

enum { SIDE = 40, MAP = 16, TEXELS = MAP * MAP };

static agree_maps maps;
static float      first[TEXELS], second[TEXELS], colour[TEXELS * 3];
static uint8_t    mask[SIDE * SIDE * 4];
static hc_detail  details[2];

static int prepare(void **state)
{
    uint64_t seed = 4;
    (void)state;
    bool good = agree_maps_bake(&maps, "fbm", SIDE, 7, HC_WRAP_NONE)
                && hc_synth(first, MAP, MAP, "cobbles", 1, NULL) == HC_OK
                && hc_synth(second, MAP, MAP, "fbm", 2, NULL) == HC_OK;
    for (int i = 0; i < SIDE * SIDE * 4; i++) {
        mask[i] = (uint8_t)(i / SIDE / 4 % 16 < 4 ? 0 : agree_random(&seed) % 256);
    }
    for (int i = 0; i < TEXELS * 3; i++) {
        colour[i] = (float)(i * 7 % 11) / 11.0F;
    }
    details[0] = (hc_detail){ .heights = first,
                              .colour  = colour,
                              .width   = MAP,
                              .height  = MAP,
                              .tile    = 190.0,
                              .depth   = 16.0 };
    details[1] =
        (hc_detail){ .heights = second, .width = MAP, .height = MAP, .tile = 310.0, .depth = 40.0 };
    return good ? 0 : -1;
}

static hc_terrain_scene scene_of(hc_trace_method method, hc_detail_method way)
{
    hc_terrain_scene scene = { .field         = maps.field,
                               .spacing       = { 30.0, 40.0 },
                               .low           = 500.0,
                               .high          = 750.0,
                               .details       = details,
                               .detail_count  = 2,
                               .mask          = mask,
                               .mask_width    = SIDE,
                               .mask_height   = SIDE,
                               .detail_method = way,
                               .detail_fade   = { 500.0, 2500.0 } };
    agree_maps_choose(&scene.trace, &maps, method);
    return scene;
}

static void compare(const hc_terrain_scene *scene, hc_view view)
{
    const agree_toured toured = agree_tour(scene, view, 0.0F);
    assert_true(toured.least_hits > 500);
    if (view == HC_VIEW_MISSED && scene->detail_method == HC_DETAIL_SAFE) {
        assert_true(toured.wrong_by_cpu + toured.wrong_by_gl == 0);
    }
}

static void safely(void **state)
{
    (void)state;
    const hc_trace_method methods[] = { HC_TRACE_SAFE, HC_TRACE_FAST, HC_TRACE_CONE_LOOP };
    for (int i = 0; i < 3; i++) {
        const hc_terrain_scene scene = scene_of(methods[i], HC_DETAIL_SAFE);
        compare(&scene, HC_VIEW_SHADED);
    }
    const hc_terrain_scene scene = scene_of(HC_TRACE_MAXMIP, HC_DETAIL_SAFE);
    compare(&scene, HC_VIEW_NORMAL);
    compare(&scene, HC_VIEW_MISSED);
}

static void by_steps(void **state)
{
    (void)state;
    hc_terrain_scene scene = scene_of(HC_TRACE_CONE_LOOP, HC_DETAIL_STEPS);
    compare(&scene, HC_VIEW_SHADED); /* the sample */
    scene              = scene_of(HC_TRACE_MAXMIP, HC_DETAIL_STEPS);
    scene.detail_steps = 12;
    scene.blocky       = true;
    scene.mask         = NULL;
    compare(&scene, HC_VIEW_SHADED);
    compare(&scene, HC_VIEW_MISSED);
}

/* Flat tops by all that know them, and no walls around the field; both at once. */
static void on_steps_and_through_open_sides(void **state)
{
    static const struct kind {
        hc_trace_method  method;
        bool             open_sides;
        hc_detail_method way;
    } kinds[] = { { HC_TRACE_QDM, true, HC_DETAIL_SAFE },
                  { HC_TRACE_MAXMIP, true, HC_DETAIL_SAFE },
                  { HC_TRACE_QDM, false, HC_DETAIL_STEPS } };
    (void)state;
    for (int i = 0; i < 3; i++) {
        hc_terrain_scene scene   = scene_of(kinds[i].method, kinds[i].way);
        scene.trace.open_sides   = kinds[i].open_sides;
        scene.exaggeration       = 3.0;
        scene.field.registration = i == 0 ? HC_TEXEL : HC_GRID;
        compare(&scene, i == 2 ? HC_VIEW_NORMAL : HC_VIEW_SHADED);
    }
}

/* Among objects, under a map of shadows, on the posts of a grid. */
static void among_other_things(void **state)
{
    hc_mesh *mesh = NULL;
    (void)state;
    assert_int_equal(hc_solid_create(&mesh, HC_SOLID_HOUSE, NULL), HC_OK);
    const hc_object object = {
        .mesh = mesh, .place = { 600.0, -700.0, 0.0 }, .grounded = true, .size = 250.0
    };
    hc_terrain_scene scene   = scene_of(HC_TRACE_MAXMIP, HC_DETAIL_SAFE);
    scene.field.registration = HC_GRID;
    scene.objects            = &object;
    scene.object_count       = 1;
    compare(&scene, HC_VIEW_SHADED);
    scene.shadow_map = 300;
    compare(&scene, HC_VIEW_SHADED);
    hc_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(safely),
        cmocka_unit_test(by_steps),
        cmocka_unit_test(on_steps_and_through_open_sides),
        cmocka_unit_test(among_other_things),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
