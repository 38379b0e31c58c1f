/* shaders/terrain.frag against the CPU: every method from the air, the ground, a valley and
 * outside, shadows and all; skipped where there is no OpenGL. */
#include "shots.h"

#include <heightcast/terrain.h>

#include <math.h>
#include <string.h>

enum { SIDE = 48, SOLIDS = HC_SOLID_HOUSE + 1 };

static agree_maps maps;
static agree_shot cpu, gl;
static hc_mesh   *meshes[SOLIDS];
static hc_object  solids[SOLIDS]; /* on the ground, but for a ball in the air */

static int prepare(void **state)
{
    bool good = agree_maps_bake(&maps, "fbm", SIDE, 7, HC_WRAP_NONE);
    (void)state;
    for (int i = 0; good && i < SOLIDS; i++) {
        good      = hc_solid_create(&meshes[i], (hc_solid)i, NULL) == HC_OK;
        solids[i] = (hc_object){ .mesh     = meshes[i],
                                 .place    = { 2400.0 + 180.0 * i, -1500.0 - 260.0 * i, 0.0 },
                                 .grounded = true,
                                 .size     = 250.0,
                                 .turn     = 25.0 * i,
                                 .colour   = { 0.3F, 0.1F * (float)i, 0.2F } };
    }
    solids[HC_SOLID_BALL].place[2] = 100.0;
    return good ? 0 : -1;
}

static int tidy(void **state)
{
    (void)state;
    for (int i = 0; i < SOLIDS; i++) {
        hc_mesh_destroy(meshes[i]);
    }
    return 0;
}

static hc_terrain_scene scene_of(hc_trace_method method)
{
    hc_terrain_scene scene = {
        .field   = { .heights = maps.heights, .width = SIDE, .height = SIDE },
        .spacing = { 30.0, 40.0 },
        .low     = 500.0,
        .high    = 750.0,
        .offset  = { 2000.0, -1000.0, 10.0 },
    };
    agree_maps_choose(&scene.trace, &maps, method);
    return scene;
}

static agree_toured compare(const hc_terrain_scene *scene, hc_view view)
{
    const agree_toured toured = agree_tour(scene, view, 2500.0F);
    assert_true(toured.least_hits > 500);
    return toured;
}

/* ---- pictures -------------------------------------------------------------------------------- */

static void every_method_from_everywhere(void **state)
{
    (void)state;
    for (int method = 0; method < hc_trace_method_count(); method++) {
        const hc_terrain_scene scene = scene_of((hc_trace_method)method);
        compare(&scene, HC_VIEW_SHADED);
    }
}

static void every_ground(void **state)
{
    (void)state;
    static float image[5 * 3 * 3];
    for (int i = 0; i < 5 * 3 * 3; i++) {
        image[i] = (float)(i * 7 % 11) / 11.0F;
    }
    for (int ground = 0; ground <= HC_GROUND_PLAIN; ground++) {
        hc_terrain_scene scene = scene_of(HC_TRACE_MAXMIP);
        scene.ground           = (hc_ground)ground;
        scene.image            = image;
        scene.image_width      = 5;
        scene.image_height     = 3;
        compare(&scene, HC_VIEW_SHADED);
        scene.blocky = true;
        compare(&scene, HC_VIEW_SHADED);
    }
}

static void other_choices(void **state)
{
    (void)state;
    hc_terrain_scene scene = scene_of(HC_TRACE_SAFE);
    scene.trace.ratios     = maps.l1;
    scene.trace.cones      = HC_CONES_L1;
    scene.sun[0]           = 0.4;
    scene.sun[1]           = -1.0;
    scene.sun[2]           = 0.15;
    scene.haze             = 900.0F;
    scene.exaggeration     = 2.5;
    compare(&scene, HC_VIEW_SHADED);
    scene                    = scene_of(HC_TRACE_MAXMIP);
    scene.field.registration = HC_GRID;
    scene.no_shadows         = true;
    scene.haze               = INFINITY;
    compare(&scene, HC_VIEW_SHADED);
    scene                   = scene_of(HC_TRACE_RELIEF);
    scene.trace.refinements = -1;
    scene.trace.steps       = 100;
    compare(&scene, HC_VIEW_SHADED);
}

/* Flat tops by all that know them, and no walls around the field; both at once. */
static void steps_and_open_sides(void **state)
{
    static const hc_trace_method methods[] = { HC_TRACE_SAFE, HC_TRACE_MAXMIP, HC_TRACE_QDM };
    (void)state;
    for (int i = 0; i < 8; i++) {
        hc_terrain_scene scene   = scene_of(i < 6 ? methods[i % 3] : HC_TRACE_RELIEF);
        scene.trace.surface      = i < 3 || i == 5 ? HC_SURFACE_STEPS : HC_SURFACE_BILINEAR;
        scene.trace.open_sides   = i >= 3;
        scene.exaggeration       = 3.0;
        scene.field.registration = i % 2 == 0 ? HC_TEXEL : HC_GRID;
        compare(&scene, i % 3 == 1 ? HC_VIEW_NORMAL : HC_VIEW_SHADED);
        const agree_toured toured = compare(&scene, HC_VIEW_MISSED);
        if (i < 6 && methods[i % 3] != HC_TRACE_QDM) {
            assert_true(toured.wrong_by_gl == 0);
        }
    }
}

static void views(void **state)
{
    (void)state;
    const hc_view shown[] = { HC_VIEW_HEIGHT, HC_VIEW_NORMAL, HC_VIEW_DEPTH };
    for (int i = 0; i < 3; i++) {
        const hc_terrain_scene scene = scene_of(HC_TRACE_SAFE);
        compare(&scene, shown[i]);
    }
    const hc_terrain_scene stairs = scene_of(HC_TRACE_QDM);
    compare(&stairs, HC_VIEW_NORMAL);
}

/* In the same depth buffer, hiding and hidden, under shadows of both. */
static void objects(void **state)
{
    (void)state;
    for (int bare = 0; bare < 2; bare++) {
        hc_terrain_scene scene = scene_of(HC_TRACE_MAXMIP);
        scene.objects          = solids;
        scene.object_count     = SOLIDS;
        scene.no_shadows       = bare == 1;
        compare(&scene, bare == 1 ? HC_VIEW_NORMAL : HC_VIEW_SHADED);
        compare(&scene, bare == 1 ? HC_VIEW_DEPTH : HC_VIEW_HEIGHT);
        compare(&scene, bare == 1 ? HC_VIEW_CROSSINGS : HC_VIEW_MISSED);
        scene.shadow_map = 150;
        compare(&scene, HC_VIEW_SHADED);
    }
}

/* ---- hits ------------------------------------------------------------------------------------ */

/* docs/algorithms.md, section 22.8, has the bound, which is for angles of at least 1/64 between ray
 * and surface. Sharper ones are as rare as edges. */
static void depths_agree(void **state)
{
    (void)state;
    const hc_terrain_scene scene  = scene_of(HC_TRACE_MAXMIP);
    hc_terrain            *by_gl  = agree_terrain_make(&scene, HC_VIEW_SHADED, HC_BACKEND_GL);
    hc_terrain            *by_cpu = agree_terrain_make(&scene, HC_VIEW_SHADED, HC_BACKEND_CPU);
    for (int tour = 0; tour <= HC_TOUR_ORBIT; tour++) {
        hc_camera camera;
        int       odd = 0, both = 0;
        hc_terrain_tour(&camera, by_cpu, (hc_tour)tour, 0.0);
        agree_shot_terrain(&cpu, by_cpu, &camera);
        agree_shot_terrain(&gl, by_gl, &camera);
        for (int i = 0; i < SHOT_PIXELS; i++) {
            const bool hit = isfinite(cpu.depth[i]) && isfinite(gl.depth[i]);
            both += hit ? 1 : 0;
            odd += hit && fabsf(cpu.depth[i] - gl.depth[i]) > 0x1p-12F * 1920.0F ? 1 : 0;
        }
        assert_true(both > 500);
        assert_true(odd <= SHOT_ODD_MAX);
        const double steps = cpu.picture.figures.mean_steps - gl.picture.figures.mean_steps;
        const double moves = cpu.picture.figures.mean_crossings - gl.picture.figures.mean_crossings;
        assert_true(fabs(steps) < 0.02 && fabs(moves) < 0.02);
        assert_true(gl.picture.figures.mean_fetches > gl.picture.figures.mean_crossings);
    }
    hc_terrain_destroy(by_cpu);
    hc_terrain_destroy(by_gl);
}

static void nothing_is_lost(void **state)
{
    (void)state;
    const hc_trace_method methods[] = { HC_TRACE_SAFE, HC_TRACE_MAXMIP, HC_TRACE_CONE_LOOP };
    for (int m = 0; m < 3; m++) {
        hc_terrain_scene scene = scene_of(methods[m]);
        scene.trace.steps      = 4; /* only the last one counts them */
        hc_terrain *by_gl      = agree_terrain_make(&scene, HC_VIEW_MISSED, HC_BACKEND_GL);
        for (int tour = 0; tour <= HC_TOUR_ORBIT; tour++) {
            hc_camera camera;
            hc_terrain_tour(&camera, by_gl, (hc_tour)tour, 0.6);
            agree_shot_terrain(&gl, by_gl, &camera);
            const uint64_t wrong = gl.picture.figures.lost + gl.picture.figures.made_up;
            assert_true((wrong == 0) == (methods[m] != HC_TRACE_CONE_LOOP));
        }
        hc_terrain_destroy(by_gl);
    }
}

/* ---- polygons -------------------------------------------------------------------------------- */

/* Triangles beside rays, both by GL. */
static void compare_polygons(hc_terrain_scene scene, hc_view view)
{
    scene.polygons      = HC_POLYGONS_NONE;
    hc_terrain *by_rays = agree_terrain_make(&scene, view, HC_BACKEND_GL);
    scene.polygons      = HC_POLYGONS_FULL;
    hc_terrain *by_mesh = agree_terrain_make(&scene, view, HC_BACKEND_GL);
    for (int tour = HC_TOUR_FLY; tour <= HC_TOUR_UP; tour++) {
        hc_camera camera;
        hc_terrain_tour(&camera, by_rays, (hc_tour)tour, 0.3);
        agree_shot_terrain(&cpu, by_rays, &camera);
        agree_shot_terrain(&gl, by_mesh, &camera);
        if (agree_shots_odd(&cpu, &gl) > SHOT_ODD_MAX) {
            fail_msg("camera %d: %d pixels differ", tour, agree_shots_odd(&cpu, &gl));
        }
        assert_true(gl.picture.figures.hits > 500);
        assert_true(cpu.picture.figures.mean_crossings > 1.0);
        assert_true(gl.picture.figures.mean_crossings == 0.0);
        if (view == HC_VIEW_MISSED) { /* the exact rays have the same objects in their way */
            assert_true(gl.picture.figures.lost + gl.picture.figures.made_up <= SHOT_ODD_MAX);
        }
    }
    hc_terrain_destroy(by_rays);
    hc_terrain_destroy(by_mesh);
}

/* Where patches are flat, triangles are the patches, among objects as alone. */
static void flat_patches_are_their_triangles(void **state)
{
    (void)state;
    static float     flat[SIDE * SIDE];
    hc_terrain_scene scene   = scene_of(HC_TRACE_MAXMIP);
    scene.field.heights      = flat;
    scene.field.registration = HC_GRID; /* texels' outermost halves have no triangles */
    for (int i = 0; i < SIDE * SIDE; i++) {
        flat[i] = 0.5F * (maps.heights[i % SIDE] + maps.heights[i / SIDE * SIDE]);
    }
    compare_polygons(scene, HC_VIEW_SHADED);
    scene.objects      = solids;
    scene.object_count = SOLIDS;
    compare_polygons(scene, HC_VIEW_SHADED);
    compare_polygons(scene, HC_VIEW_MISSED);
    scene.shadow_map = 150;
    compare_polygons(scene, HC_VIEW_SHADED);
}

/* No pixel of the ground becomes one of the sky, but for those beside a silhouette. */
static void coarse_blocks_leave_no_gaps(void **state)
{
    (void)state;
    hc_terrain_scene scene = scene_of(HC_TRACE_MAXMIP);
    scene.no_shadows       = true;
    scene.polygons         = HC_POLYGONS_FULL;
    hc_terrain *full       = agree_terrain_make(&scene, HC_VIEW_SHADED, HC_BACKEND_GL);
    scene.polygons         = HC_POLYGONS_LOD;
    hc_terrain *lod        = agree_terrain_make(&scene, HC_VIEW_SHADED, HC_BACKEND_GL);
    int         changed    = 0;
    for (int frame = 0; frame < 8; frame++) {
        hc_camera camera;
        hc_terrain_tour(&camera, full, HC_TOUR_ORBIT, frame / 8.0);
        camera.eye[2] *= frame % 2 == 0 ? 1.0 : 3.0; /* coarser */
        agree_shot_terrain(&cpu, full, &camera);
        agree_shot_terrain(&gl, lod, &camera);
        changed += memcmp(cpu.depth, gl.depth, sizeof gl.depth) != 0 ? 1 : 0;
        for (int i = SHOT_WIDE + 1; i < SHOT_PIXELS - SHOT_WIDE - 1; i++) {
            bool within = true;
            for (int k = 0; k < 9; k++) {
                within = within && isfinite(cpu.depth[i + (k / 3 - 1) * SHOT_WIDE + k % 3 - 1]);
            }
            assert_true(!within || isfinite(gl.depth[i]));
        }
    }
    assert_true(changed > 0);
    hc_terrain_destroy(full);
    hc_terrain_destroy(lod);
}

static void polygons_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const hc_render_options by_gl   = { .backend = HC_BACKEND_GL };
    hc_terrain             *terrain = NULL;
    hc_terrain_scene        scene   = scene_of(HC_TRACE_MAXMIP);
    hc_log                  log     = { .text = "" };
    scene.polygons                  = HC_POLYGONS_LOD;
    assert_int_equal(hc_terrain_create(&terrain, &scene, NULL, &log), HC_ERROR_UNSUPPORTED);
    assert_non_null(strstr(log.text, "scene.polygons is lod; only gl"));
    scene.trace.method = HC_TRACE_QDM;
    assert_int_equal(hc_terrain_create(&terrain, &scene, &by_gl, &log), HC_ERROR_UNSUPPORTED);
    assert_non_null(strstr(log.text, "flat tops"));
    scene.polygons = (hc_polygons)3;
    assert_int_equal(hc_terrain_create(&terrain, &scene, &by_gl, &log), HC_ERROR_ARGUMENT);
    assert_null(hc_polygons_name(scene.polygons));
}

/* ---- terrains beside each other -------------------------------------------------------------- */

/* Each has a context of its own, and pictures may change their size. */
static void terrains_take_turns(void **state)
{
    (void)state;
    static float           small[8 * 4 * 3];
    const hc_terrain_scene first  = scene_of(HC_TRACE_MAXMIP);
    hc_terrain_scene       second = first;
    second.ground                 = HC_GROUND_PLAIN;
    hc_terrain     *a             = agree_terrain_make(&first, HC_VIEW_SHADED, HC_BACKEND_GL);
    hc_terrain     *b             = agree_terrain_make(&second, HC_VIEW_SHADED, HC_BACKEND_GL);
    hc_picture      little        = { .width = 8, .height = 4, .rgb = small };
    const hc_camera camera        = { .fov = 60.0F };
    agree_shot_terrain(&cpu, a, &camera);
    agree_shot_terrain(&gl, b, &camera);
    assert_true(agree_shots_odd(&cpu, &gl) > 1000);
    assert_int_equal(hc_terrain_draw(&little, a, &camera, NULL), HC_OK);
    hc_terrain_destroy(b);
    agree_shot_terrain(&gl, a, &camera);
    assert_memory_equal(cpu.bytes, gl.bytes, sizeof gl.bytes);
    hc_terrain_destroy(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_from_everywhere),
        cmocka_unit_test(every_ground),
        cmocka_unit_test(other_choices),
        cmocka_unit_test(steps_and_open_sides),
        cmocka_unit_test(views),
        cmocka_unit_test(objects),
        cmocka_unit_test(depths_agree),
        cmocka_unit_test(nothing_is_lost),
        cmocka_unit_test(flat_patches_are_their_triangles),
        cmocka_unit_test(coarse_blocks_leave_no_gaps),
        cmocka_unit_test(polygons_that_cannot_be_are_refused),
        cmocka_unit_test(terrains_take_turns),
    };
    return cmocka_run_group_tests(tests, prepare, tidy);
}
