/* Maps that stay on the GPU: updates of rectangles against full bakes, and pictures of them against
 * those of maps that came from the CPU. Skipped where there is no OpenGL. */
#include <heightcast/gpu.h>
#include <heightcast/render.h>

#include "edits.h"
#include "support.h"

#ifdef HC_HAVE_GL
#include "gpu/gpu.h"
#endif

#include <stdlib.h>
#include <string.h>

static hc_gpu *gpu;

static int open_gpu(void **state)
{
    hc_log          log    = { .text = "" };
    const hc_result result = hc_gpu_create(&gpu, &log);
    (void)state;
    if (result != HC_OK) {
        print_message("%s\n", log.text);
    }
    return result == HC_OK || result == HC_ERROR_UNSUPPORTED ? 0 : -1;
}

static int close_gpu(void **state)
{
    (void)state;
    hc_gpu_destroy(gpu);
    return 0;
}

static hc_gpu_map *make(const hc_field *field, const hc_gpu_map_options *options)
{
    hc_log      log = { .text = "" };
    hc_gpu_map *map = NULL;
    if (gpu == NULL) {
        skip();
    }
    if (hc_gpu_map_create(&map, gpu, field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    return map;
}

/* ---- updates --------------------------------------------------------------------------------- */

/* As a full bake by this GPU, which test_agree_gpu compares with the CPU's. */
static void expect_full_bake(const hc_field *field, const char *what, const hc_gpu_map *map,
                             const hc_gpu_map_options *options)
{
    const hc_cones cones = options->cone.cones;
    const size_t   bytes = agree_count(field, cones) * sizeof(float);
    float         *full  = malloc(bytes);
    float         *found = malloc(bytes);
    float         *cells = malloc(bytes);
    assert_non_null(full);
    assert_int_equal(hc_gpu_bake_cone_map(gpu, full, field, &options->cone, NULL), HC_OK);
    hc_bake_cell_ratios(cells, full, field->width, field->height, cones, field->wrap);
    memset(found, 0, bytes);
    assert_int_equal(hc_gpu_map_read(map, found, NULL), HC_OK);
    agree_expect_same(field, hc_method_name(options->cone.method), cones, what,
                      options->cells ? cells : full, found);
    free(cells);
    free(found);
    free(full);
}

static void edit_repeatedly(hc_field *field, const hc_gpu_map_options *options, int edits,
                            uint64_t *random)
{
    float       *heights  = (float *)(uintptr_t)field->heights;
    hc_gpu_map  *map      = make(field, options);
    const size_t searches = 5 * (size_t)field->width * (size_t)field->height;
    expect_full_bake(field, "made", map, options);
    for (int turn = 0; turn < edits; turn++) {
        const agree_edit how     = agree_some_edit(random);
        const hc_rect    rect    = agree_some_rect(field, turn, random);
        size_t           rebaked = searches + 1;
        agree_apply(heights, field->width, rect, how, random);
        assert_int_equal(hc_gpu_map_update(map, heights, rect, &rebaked, NULL), HC_OK);
        assert_true(rebaked <= searches);
        expect_full_bake(field, agree_edit_name(how), map, options);
    }
    hc_gpu_map_destroy(map);
}

static void run(hc_cones cones, const agree_shapes *shapes, int edits, int stride)
{
    uint64_t random = 7 + (uint64_t)cones;
    for (int i = (int)cones; i < agree_field_count(shapes); i += stride) {
        const hc_gpu_map_options options = {
            .cone  = { .cones = cones, .max_ratio = i % 3 == 0 ? 1.0F : 0.0F },
            .cells = i % 2 == 0,
        };
        hc_field field = agree_field(shapes, i);
        edit_repeatedly(&field, &options, edits, &random);
        agree_free(&field);
    }
}

static void update_equals_a_full_bake(void **state)
{
    (void)state;
    for (int cones = 0; cones <= HC_CONES_ANISO; cones++) {
        run((hc_cones)cones, &agree_small, 6, 83);
        run((hc_cones)cones, &agree_middle, 6, 301);
    }
}

/* Searches that wait for the next dispatch are counted once. */
static void updates_of_many_dispatches(void **state)
{
    (void)state;
    if (gpu == NULL) {
        skip();
    }
#ifdef HC_HAVE_GL
    const int before = gpu->looks;
    gpu->looks       = 5;
    for (int cones = 0; cones <= HC_CONES_ANISO; cones++) {
        run((hc_cones)cones, &agree_small, 3, 701);
    }
    gpu->looks = before;
#endif
}

static void other_methods_too(void **state)
{
    static const hc_method methods[] = { HC_METHOD_FALLING_EDGE, HC_METHOD_GEMS, HC_METHOD_BRUTE,
                                         HC_METHOD_QUICK_IMPROVED };
    uint64_t               random    = 3;
    (void)state;
    for (int i = 0; i < 4; i++) {
        const hc_gpu_map_options options = { .cone = { .method = methods[i] } };
        hc_field                 field   = agree_named_field("fbm", 37, 21, 4, HC_WRAP_U);
        edit_repeatedly(&field, &options, 3, &random);
        agree_free(&field);
    }
}

/* Cost follows what is affected, as far as the CPU's. */
static void a_small_change_rebakes_little(void **state)
{
    (void)state;
    hc_field                 field   = agree_named_field("fbm", 256, 256, 5, HC_WRAP_UV);
    float                   *heights = (float *)(uintptr_t)field.heights;
    const hc_gpu_map_options options = { .cone = { .cones = HC_CONES_L1 } };
    hc_gpu_map              *map     = make(&field, &options);
    float                   *ratios  = malloc(agree_count(&field, HC_CONES_L1) * sizeof *ratios);
    hc_cone_baker           *baker   = NULL;
    size_t                   sum = 0, by_cpu = 0, rebaked = 0;
    assert_int_equal(hc_cone_baker_create(&baker, ratios, &field, &options.cone, NULL), HC_OK);
    for (int i = 0; i < 8; i++) {
        const int     at   = 3000 + 7717 * i;
        const hc_rect rect = { at % 256, at / 256, 1, 1 };
        heights[at]        = heights[at] * 0.999F;
        assert_int_equal(hc_gpu_map_update(map, heights, rect, &rebaked, NULL), HC_OK);
        assert_true(rebaked >= 1);
        sum += rebaked;
        assert_int_equal(hc_cone_baker_update(baker, ratios, heights, rect, &rebaked, NULL), HC_OK);
        by_cpu += rebaked;
    }
    print_message("8 samples lowered: %zu searched again, by the CPU %zu\n", sum, by_cpu);
    assert_true(sum <= by_cpu);
    expect_full_bake(&field, "lowered", map, &options);
    hc_cone_baker_destroy(baker);
    hc_gpu_map_destroy(map);
    free(ratios);
    agree_free(&field);
}

static void refusals(void **state)
{
    (void)state;
    hc_log                   log     = { .text = "" };
    hc_field                 field   = agree_named_field("fbm", 16, 16, 5, HC_WRAP_UV);
    float                   *heights = (float *)(uintptr_t)field.heights;
    const hc_gpu_map_options ring    = { .cone = { .method = HC_METHOD_RING } };
    hc_gpu_map              *map     = make(&field, NULL);
    hc_gpu_map              *none    = map;
    assert_int_equal(hc_gpu_map_create(&none, gpu, &field, &ring, &log), HC_ERROR_UNSUPPORTED);
    assert_null(none);
    hc_gpu_map_destroy(none);
    assert_int_equal(hc_gpu_map_update(map, heights, (hc_rect){ 1, 1, 16, 1 }, NULL, &log),
                     HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "1,1 16x1 is not inside 16 x 16"));
    const float kept = heights[17];
    heights[17]      = 2.0F;
    assert_int_equal(hc_gpu_map_update(map, heights, (hc_rect){ 1, 1, 2, 2 }, NULL, &log),
                     HC_ERROR_FIELD);
    heights[17] = kept;
    expect_full_bake(&field, "refused", map, &(hc_gpu_map_options){ .cells = false });
    hc_gpu_map_destroy(map);
    agree_free(&field);
}

/* ---- pictures -------------------------------------------------------------------------------- */

enum { WIDE = 64, HIGH = 48, PIXELS = WIDE * HIGH };

static void draw_with(float rgb[PIXELS * 3], const hc_scene *scene, hc_view view, hc_gpu *in)
{
    const hc_render_options options = { .backend = HC_BACKEND_GL, .view = view, .gpu = in };
    hc_log                  log     = { .text = "" };
    hc_picture              picture = { .width = WIDE, .height = HIGH, .rgb = rgb };
    if (hc_render(&picture, scene, &options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    assert_true(picture.figures.hits > 200);
}

static void draw(float rgb[PIXELS * 3], const hc_scene *scene)
{
    draw_with(rgb, scene, HC_VIEW_SHADED, NULL);
}

/* The same shader reads the same numbers; so the same floats, where this GPU rounds. */
static void compare(const hc_field *field, const hc_gpu_map *map, hc_trace_method method,
                    const float *ratios, hc_cones cones)
{
    static float by_cpu[PIXELS * 3], by_gpu[PIXELS * 3];
    hc_scene     scene = { .relief = {
                               .body  = HC_BODY_TORUS,
                               .field = *field,
                               .trace = { .method = method, .ratios = ratios, .cones = cones } } };
    draw(by_cpu, &scene);
    scene.relief.field = (hc_field){ 0 };
    scene.relief.trace = (hc_trace_options){ .method = method };
    scene.relief.baked = map;
    draw(by_gpu, &scene);
    if (hc_gpu_rounds(gpu)) {
        assert_memory_equal(by_gpu, by_cpu, sizeof by_cpu);
    }
}

static void pictures_are_those_of_the_cpus_maps(void **state)
{
    static const struct {
        hc_trace_method method;
        hc_cones        cones;
        hc_method       bake;
        bool            cells;
    } rows[] = {
        { HC_TRACE_SAFE, HC_CONES_QUAD, HC_METHOD_EXACT, true },
        { HC_TRACE_SAFE, HC_CONES_L1, HC_METHOD_EXACT, true },
        { HC_TRACE_CONE_EXACT, HC_CONES_L2, HC_METHOD_EXACT, false },
        { HC_TRACE_RELAXED, HC_CONES_L2, HC_METHOD_FALLING_EDGE, false },
        { HC_TRACE_LINEAR, HC_CONES_L2, HC_METHOD_EXACT, false },
    };
    hc_field field   = agree_named_field("cobbles", 48, 40, 2, HC_WRAP_UV);
    float   *heights = (float *)(uintptr_t)field.heights;
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const hc_gpu_map_options options = {
            .cone  = { .cones = rows[i].cones, .method = rows[i].bake },
            .cells = rows[i].cells,
        };
        hc_gpu_map *map = make(&field, &options);
        for (int turn = 0; turn < 2; turn++) {
            const hc_rect rect   = { 5, 7, 20, 9 };
            float        *ratios = agree_bake(&field, &options.cone);
            float        *cells  = malloc(agree_count(&field, rows[i].cones) * sizeof *cells);
            hc_bake_cell_ratios(cells, ratios, 48, 40, rows[i].cones, HC_WRAP_UV);
            compare(&field, map, rows[i].method, rows[i].cells ? cells : ratios, rows[i].cones);
            free(ratios);
            free(cells);
            uint64_t random = 1;
            agree_apply(heights, 48, rect, AGREE_MIX, &random);
            assert_int_equal(hc_gpu_map_update(map, heights, rect, NULL, NULL), HC_OK);
        }
        hc_gpu_map_destroy(map);
    }
    agree_free(&field);
}

/* Scenes that differ in all that a uniform or a texture says, for programs of few heads. */
static void fill_scenes(hc_scene *scenes, int count, const hc_field *field, const float *ratios)
{
    static const float           albedo[2 * 2 * 3] = { 0.9F, 0.1F, 0.1F, 0.1F, 0.9F, 0.1F,
                                                       0.1F, 0.1F, 0.9F, 0.9F, 0.9F, 0.1F };
    static const hc_trace_method methods[]         = { HC_TRACE_CONE_EXACT, HC_TRACE_MAXMIP };
    for (int i = 0; i < count; i++) {
        const bool odd      = i % 2 == 1;
        hc_scene  *scene    = &scenes[i];
        hc_relief *relief   = &scene->relief;
        *scene              = (hc_scene){ .light = { .lamp = odd, .no_shadows = i % 4 > 1 } };
        relief->field       = *field;
        relief->trace       = (hc_trace_options){ .method = methods[i / 8], .ratios = ratios };
        relief->trace.steps = odd ? 7 : 0;
        relief->body        = (hc_body)(i % 4);
        relief->edge        = i == 4 ? HC_EDGE_CLAMP : HC_EDGE_WALL;
        relief->depth       = odd ? 0.3F : 0.0F;
        relief->fade[1] = relief->lod[1] = i % 8 > 5 ? 4.0F : 0.0F;
        relief->repeat[0] = relief->repeat[1] = i % 8 == 3 ? 5 : 0;
        scene->light.place[2]                 = odd ? 3.0 : 0.0;
        scene->light.place[1]                 = odd ? -3.0 : 0.0;
        scene->material.gloss                 = i % 8 == 2 ? 2 : 0;
        scene->material.ambient               = i % 8 == 6 ? 0.8F : 0.0F;
        scene->material.colour[1]             = i % 8 == 1 ? 0.9F : 0.0F;
        scene->camera.orthographic            = i % 8 == 5 ? 3.0F : 0.0F;
        if (i % 4 == 2) {
            scene->material.albedo        = albedo;
            scene->material.albedo_width  = 2;
            scene->material.albedo_height = 2;
        }
    }
}

/* Programs stay, with all that was set for other scenes: a picture in a context of its own is the
 * same. */
static void pictures_do_not_depend_on_those_before(void **state)
{
    enum { SCENES = 16 };
    static float alone[SCENES][PIXELS * 3], rgb[PIXELS * 3];
    hc_scene     scenes[SCENES];
    hc_field     fields[] = { agree_named_field("cobbles", 48, 40, 2, HC_WRAP_UV),
                              agree_named_field("fbm", 33, 57, 2, HC_WRAP_UV) };
    float       *ratios[2];
    (void)state;
    if (gpu == NULL) {
        skip();
    }
    for (int k = 0; k < 2; k++) {
        ratios[k] = agree_bake(&fields[k], &(hc_cone_options){ .cones = HC_CONES_L2 });
        fill_scenes(scenes, SCENES, &fields[k], ratios[k]);
        for (int i = k; i < SCENES; i += 2) {
            draw_with(alone[i], &scenes[i], i % 5 == 4 ? HC_VIEW_MISSED : HC_VIEW_SHADED, NULL);
        }
    }
    for (int turn = 0; turn < 2 * SCENES; turn++) {
        const int i = turn < SCENES ? turn : 2 * SCENES - 1 - turn;
        fill_scenes(scenes, SCENES, &fields[i % 2], ratios[i % 2]);
        draw_with(rgb, &scenes[i], i % 5 == 4 ? HC_VIEW_MISSED : HC_VIEW_SHADED, gpu);
        if (memcmp(rgb, alone[i], sizeof rgb) != 0) {
            fail_msg("scene %d is another one after others", i);
        }
    }
    for (int k = 0; k < 2; k++) {
        free(ratios[k]);
        agree_free(&fields[k]);
    }
}

static void expect_refusal(const hc_scene *scene, const hc_render_options *options,
                           const char *says)
{
    static float rgb[PIXELS * 3];
    hc_log       log     = { .text = "" };
    hc_picture   picture = { .width = WIDE, .height = HIGH, .rgb = rgb };
    assert_int_equal(hc_render(&picture, scene, options, &log), HC_ERROR_ARGUMENT);
    if (strstr(log.text, says) == NULL) {
        fail_msg("%s", log.text);
    }
}

static void what_cannot_be_drawn(void **state)
{
    (void)state;
    hc_field          field   = agree_named_field("cobbles", 16, 16, 2, HC_WRAP_UV);
    hc_gpu_map       *map     = make(&field, NULL);
    hc_scene          scene   = { .relief = { .baked = map } };
    hc_render_options options = { .backend = HC_BACKEND_GL };
    scene.relief.trace.method = HC_TRACE_CONE_EXACT;
    expect_refusal(&scene, NULL, "drawn by gl");
    options.view = HC_VIEW_MISSED;
    expect_refusal(&scene, &options, "do not compare");
    options.view              = HC_VIEW_SHADED;
    scene.relief.trace.method = HC_TRACE_MAXMIP;
    expect_refusal(&scene, &options, "which maxmip does not take");
    scene.relief.trace.method = HC_TRACE_SAFE;
    expect_refusal(&scene, &options, "l2 ratios, which safe does not take");
    scene.relief.trace.method = HC_TRACE_RELAXED;
    expect_refusal(&scene, &options, "which relaxed does not take");
    scene.relief.trace.steps = -1;
    expect_refusal(&scene, &options, "relief.trace.steps");
    hc_gpu_map_destroy(map);
    agree_free(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(update_equals_a_full_bake),
        cmocka_unit_test(updates_of_many_dispatches),
        cmocka_unit_test(other_methods_too),
        cmocka_unit_test(a_small_change_rebakes_little),
        cmocka_unit_test(refusals),
        cmocka_unit_test(pictures_are_those_of_the_cpus_maps),
        cmocka_unit_test(pictures_do_not_depend_on_those_before),
        cmocka_unit_test(what_cannot_be_drawn),
    };
    return cmocka_run_group_tests_name("agree_gpu_map", tests, open_gpu, close_gpu);
}
