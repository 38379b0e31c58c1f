#include "shots.h"

#include <stdlib.h>

enum { CODES_MAX = 2 };

/* ---- pictures -------------------------------------------------------------------------------- */

void agree_shot_open(agree_shot *shot)
{
    shot->picture = (hc_picture){
        .width = SHOT_WIDE, .height = SHOT_HIGH, .rgb = shot->rgb, .depth = shot->depth
    };
}

void agree_skip_without_gl(hc_result result, hc_backend backend, const hc_log *log)
{
    if (result == HC_ERROR_UNSUPPORTED && backend == HC_BACKEND_GL) {
        print_message("%s\n", log->text);
        skip();
    }
    if (result != HC_OK) {
        fail_msg("%s", log->text);
    }
}

void agree_shot_close(agree_shot *shot, hc_result result, hc_backend backend, const hc_log *log)
{
    agree_skip_without_gl(result, backend, log);
    hc_picture_bytes(shot->bytes, &shot->picture);
}

hc_terrain *agree_terrain_make(const hc_terrain_scene *scene, hc_view view, hc_backend backend)
{
    const hc_render_options options = { .view = view, .backend = backend };
    hc_log                  log     = { .text = "" };
    hc_terrain             *terrain = NULL;
    agree_skip_without_gl(hc_terrain_create(&terrain, scene, &options, &log), backend, &log);
    return terrain;
}

void agree_shot_terrain(agree_shot *shot, const hc_terrain *terrain, const hc_camera *camera)
{
    hc_log log = { .text = "" };
    agree_shot_open(shot);
    agree_shot_close(shot, hc_terrain_draw(&shot->picture, terrain, camera, &log), HC_BACKEND_CPU,
                     &log);
}

int agree_shots_odd(const agree_shot *a, const agree_shot *b)
{
    int odd = 0;
    for (int i = 0; i < SHOT_PIXELS; i++) {
        bool differs = false;
        for (int k = 3 * i; k < 3 * i + 3; k++) {
            differs = differs || abs(a->bytes[k] - b->bytes[k]) > CODES_MAX;
        }
        odd += differs ? 1 : 0;
    }
    return odd;
}

static uint64_t wrong_rays(const agree_shot *shot)
{
    return shot->picture.figures.lost + shot->picture.figures.made_up;
}

agree_toured agree_tour(const hc_terrain_scene *scene, hc_view view, float parallel)
{
    static agree_shot cpu, gl;
    hc_terrain       *by_gl  = agree_terrain_make(scene, view, HC_BACKEND_GL); /* or skips */
    hc_terrain       *by_cpu = agree_terrain_make(scene, view, HC_BACKEND_CPU);
    const int         last   = parallel > 0.0F ? HC_TOUR_ORBIT + 1 : HC_TOUR_ORBIT;
    agree_toured      toured = { .least_hits = SHOT_PIXELS };
    for (int from = 0; from <= last; from++) {
        hc_camera camera;
        hc_terrain_tour(&camera, by_cpu, from > HC_TOUR_ORBIT ? HC_TOUR_ORBIT : (hc_tour)from, 0.3);
        camera.orthographic = from > HC_TOUR_ORBIT ? parallel : 0.0F;
        agree_shot_terrain(&cpu, by_cpu, &camera);
        agree_shot_terrain(&gl, by_gl, &camera);
        const int odd = agree_shots_odd(&cpu, &gl);
        if (odd > SHOT_ODD_MAX) {
            fail_msg("%s, %s, %d x %d, view %d, camera %d: %d pixels differ",
                     hc_trace_method_name(scene->trace.method),
                     hc_detail_method_name(scene->detail_method), scene->field.width,
                     scene->field.height, (int)view, from, odd);
        }
        const uint64_t hits = cpu.picture.figures.hits;
        toured.least_hits   = hits < toured.least_hits ? hits : toured.least_hits;
        toured.wrong_by_cpu += wrong_rays(&cpu);
        toured.wrong_by_gl += wrong_rays(&gl);
    }
    hc_terrain_destroy(by_cpu);
    hc_terrain_destroy(by_gl);
    return toured;
}

/* ---- maps ------------------------------------------------------------------------------------ */

static bool bake(float *ratios, const hc_field *field, hc_cones cones, hc_method method)
{
    const hc_cone_options options = { .cones = cones, .method = method };
    return hc_bake_cone_map(ratios, field, &options, NULL) == HC_OK;
}

bool agree_maps_bake(agree_maps *maps, const char *name, int side, uint64_t seed, hc_wrap wrap)
{
    static float cones[4 * SHOT_SAMPLES_MAX];
    assert_in_range(side, 1, SHOT_SIDE_MAX);
    maps->field =
        (hc_field){ .heights = maps->heights, .width = side, .height = side, .wrap = wrap };
    bool good = hc_synth(maps->heights, side, side, name, seed, NULL) == HC_OK
                && bake(maps->l2, &maps->field, HC_CONES_L2, HC_METHOD_EXACT)
                && bake(maps->relaxed, &maps->field, HC_CONES_L2, HC_METHOD_FALLING_EDGE)
                && bake(cones, &maps->field, HC_CONES_L1, HC_METHOD_EXACT);
    hc_bake_cell_ratios(maps->l1, cones, side, side, HC_CONES_L1, wrap);
    good = good && bake(cones, &maps->field, HC_CONES_QUAD, HC_METHOD_EXACT);
    hc_bake_cell_ratios(maps->quad, cones, side, side, HC_CONES_QUAD, wrap);
    return good;
}

void agree_maps_choose(hc_trace_options *trace, const agree_maps *maps, hc_trace_method method)
{
    trace->method = method;
    switch (hc_trace_method_needs(method)) {
    case HC_NEEDS_CELL_RATIOS:
        trace->ratios = maps->quad;
        trace->cones  = HC_CONES_QUAD;
        break;
    case HC_NEEDS_RATIOS: trace->ratios = maps->l2; break;
    case HC_NEEDS_RELAXED: trace->ratios = maps->relaxed; break;
    default: break;
    }
}
