/* Tracers made from maps: what they trace is the surface that the map stores. */
#include "agree/rays.h"

#include <heightcast/bake.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static hc_map baked(const hc_field *field, hc_layout layout, hc_map_kind kind, hc_cones cones,
                    int bits)
{
    const hc_map_options options = {
        .kind = kind, .layout = layout, .bits = bits, .cone = { .cones = cones }
    };
    hc_map map;
    assert_int_equal(hc_map_info_for(&map.info, field, &options, NULL), HC_OK);
    map.texels = malloc(hc_map_bytes(&map.info));
    assert_non_null(map.texels);
    assert_int_equal(hc_bake_map(&map, field, &options, NULL), HC_OK);
    return map;
}

/* Heights as the map has them, for the judge. */
static hc_field stored(const hc_map *map)
{
    const hc_map_info *info    = &map->info;
    float             *heights = malloc((size_t)(info->width * info->height) * sizeof *heights);
    assert_non_null(heights);
    for (int i = 0; i < info->width * info->height; i++) {
        heights[i] = hc_map_height_at(map, i % info->width, i / info->width);
    }
    return (hc_field){ .heights      = heights,
                       .width        = info->width,
                       .height       = info->height,
                       .wrap         = info->wrap,
                       .registration = info->registration };
}

static void judge_map(const hc_map *map, hc_trace_method method, uint64_t *random)
{
    const hc_trace_options options = { .method = method };
    hc_field               field   = stored(map);
    agree_scene            scene   = { .field  = &field,
                                       .kind   = "a map",
                                       .method = hc_trace_method_name(method) };
    hc_log                 log     = { .text = "" };
    hc_tracer             *tracer;
    agree_score            score = { .fired = 0 };
    if (hc_tracer_create_from_map(&tracer, map, &options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    hc_tracer_tolerance(tracer, &scene.surface.rise, &scene.surface.reach);
    for (int i = 0; i < 700; i++) {
        const hc_ray ray = agree_ray(&field, (agree_rays)(i % RAYS_SETS), random);
        hc_hit       hit;
        const bool   found = hc_trace_nearest(tracer, &hit, &ray);
        agree_judge(&score, &scene, &ray, &hit, found);
    }
    agree_expect_right(&score);
    hc_tracer_destroy(tracer);
    agree_free(&field);
}

static void safe_stays_safe_in_all_depths(void **state)
{
    (void)state;
    static const char *const names[] = { "fbm", "spikes", "dem" };
    uint64_t                 random  = 31;
    for (int i = 0; i < 24; i++) {
        hc_field field     = agree_named_field(names[i % 3], 37, 29, 9, (hc_wrap)(i % 4));
        field.registration = i % 5 == 0 ? HC_GRID : HC_TEXEL;
        hc_map map         = baked(&field, HC_LAYOUT_RG, HC_MAP_CONE, HC_CONES_L1, 8 << (i / 8));
        judge_map(&map, HC_TRACE_SAFE, &random);
        judge_map(&map, HC_TRACE_MAXMIP, &random);
        free(map.texels);
        agree_free(&field);
    }
}

static void expect_refused(const hc_map *map, hc_trace_method method, const char *says)
{
    const hc_trace_options options = { .method = method };
    hc_log                 log     = { .text = "" };
    hc_tracer             *tracer  = NULL;
    assert_int_equal(hc_tracer_create_from_map(&tracer, map, &options, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, says));
}

static void maps_without_what_is_needed_are_refused(void **state)
{
    (void)state;
    hc_field field    = agree_named_field("fbm", 16, 16, 1, HC_WRAP_NONE);
    hc_map   round    = baked(&field, HC_LAYOUT_RG, HC_MAP_CONE, HC_CONES_L2, 16);
    hc_map   quad     = baked(&field, HC_LAYOUT_QUAD, HC_MAP_CONE, HC_CONES_QUAD, 16);
    hc_map   gradient = baked(&field, HC_LAYOUT_GRADIENT, HC_MAP_GRADIENT, HC_CONES_L2, 32);
    hc_map   bounds   = baked(&field, HC_LAYOUT_MINMAX, HC_MAP_BOUNDS, HC_CONES_L2, 32);
    expect_refused(NULL, HC_TRACE_MAXMIP, "map is NULL");
    expect_refused(&round, HC_TRACE_SAFE, "ratios is NULL");
    expect_refused(&quad, HC_TRACE_MAXMIP, "layout is quad");
    expect_refused(&gradient, HC_TRACE_MAXMIP, "layout is gradient");
    expect_refused(&bounds, HC_TRACE_MAXMIP, "kind is bounds");
    free(round.texels);
    free(quad.texels);
    free(gradient.texels);
    free(bounds.texels);
    agree_free(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(safe_stays_safe_in_all_depths),
        cmocka_unit_test(maps_without_what_is_needed_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
