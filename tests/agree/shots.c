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
