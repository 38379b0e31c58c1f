/* Relief round a sphere, drawn in memory and written as PNG. Quadrant cones are baked first, so
 * that the marcher called safe can take long steps and lose nothing. */
#include <heightcast/heightcast.h>
#include <heightcast/io.h>
#include <heightcast/render.h>

#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 128, WIDE = 320, HIGH = 240 };

static float   heights[SIDE * SIDE], ratios[SIDE * SIDE * 4], cells[SIDE * SIDE * 4];
static float   rgb[WIDE * HIGH * 3];
static uint8_t bytes[WIDE * HIGH * 3];

static hc_result draw(hc_picture *picture, hc_log *log)
{
    const hc_field field = {
        .heights = heights, .width = SIDE, .height = SIDE, .wrap = HC_WRAP_UV
    };
    const hc_cone_options quad   = { .cones = HC_CONES_QUAD };
    hc_result             result = hc_synth(heights, SIDE, SIDE, "bricks", 1, log);
    if (result == HC_OK) {
        result = hc_bake_cone_map(ratios, &field, &quad, log);
    }
    if (result != HC_OK) {
        return result;
    }
    hc_bake_cell_ratios(cells, ratios, SIDE, SIDE, HC_CONES_QUAD, field.wrap);
    const hc_scene scene = {
        .relief   = { .field = field,
                      .trace = { .method = HC_TRACE_SAFE, .ratios = cells, .cones = HC_CONES_QUAD },
                      .body  = HC_BODY_SPHERE,
                      .depth = 0.08F },
        .material = { .colour = { 0.42F, 0.16F, 0.10F } },
        .camera   = { .samples = 4 },
    };
    return hc_render(picture, &scene, NULL, log);
}

int main(void)
{
    const hc_save_options overwrite = { .overwrite = true };
    hc_picture            picture   = { .width = WIDE, .height = HIGH, .rgb = rgb };
    hc_log                log       = { 0 };
    hc_result             result    = draw(&picture, &log);
    if (result == HC_OK) {
        hc_picture_bytes(bytes, &picture);
        result = hc_save_picture(bytes, WIDE, HIGH, "relief.png", &overwrite, &log);
    }
    if (result != HC_OK) {
        (void)fprintf(stderr, "%s: %s\n", hc_result_name(result), log.text);
        return EXIT_FAILURE;
    }
    (void)printf("%.0f steps for each ray that came near\n", picture.figures.mean_steps);
    return EXIT_SUCCESS;
}
