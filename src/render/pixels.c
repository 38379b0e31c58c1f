/* Pixels from what their rays saw: sums, views, figures. */
#include "shade.h"

#include "colour.h"
#include "vec.h"

#include <stdlib.h>
#include <string.h>

/* ---- sums ---------------------------------------------------------------------------------- */

static void background(float rgb[3], const hc_stage *stage, int row)
{
    static const float top[3]    = { 0.020F, 0.026F, 0.036F };
    static const float bottom[3] = { 0.110F, 0.112F, 0.115F };
    const float        share     = ((float)row + 0.5F) / (float)stage->height;
    for (int i = 0; i < 3; i++) {
        rgb[i] = top[i] + share * (bottom[i] - top[i]);
    }
}

/* Hits behind or before the exact ones by more than this count as lost or made up. */
static float slack_of(const hc_stage *stage)
{
    return (float)(stage->shape.depth / 64.0);
}

void hc_stage_add(hc_pixel *pixel, const hc_stage *stage, hc_sample sample,
                  const double direction[3], int row)
{
    if (!(sample.distance < INFINITY)) {
        background(sample.rgb, stage, row);
    }
    hc_pixel_add(pixel, &sample, hc_dot(direction, stage->eye.forward),
                 hc_view_compares(stage->options.view) ? slack_of(stage) : -1.0F);
}

/* ---- colours ------------------------------------------------------------------------------- */

static void view_numbers(float rgb[3], const hc_stage *stage, const hc_pixel *p, double top)
{
    const double hits = fmax(p->hits, 1);
    const double far  = ((double)p->depth - stage->near) / (stage->far - stage->near);
    const double high = (double)p->height / hits;
    switch (stage->options.view) {
    case HC_VIEW_HEIGHT: hc_set_code(rgb, high, high, high); break;
    case HC_VIEW_DEPTH: hc_set_code(rgb, 1.0 - 0.9 * far, 1.0 - 0.9 * far, 1.0 - 0.9 * far); break;
    case HC_VIEW_NORMAL:
        hc_set_code(rgb, 0.5 + 0.5 * (double)p->normal[0] / hits,
                    0.5 + 0.5 * (double)p->normal[1] / hits,
                    0.5 + 0.5 * (double)p->normal[2] / hits);
        break;
    case HC_VIEW_STEPS: hc_heat_colour(rgb, (double)p->steps / p->entered / top); break;
    default: hc_heat_colour(rgb, (double)p->error / fmax(p->both, 1) / top); break;
    }
}

static void colour(float rgb[3], const hc_stage *stage, const hc_pixel *p, double top)
{
    const hc_view view    = stage->options.view;
    const float   samples = (float)stage->scene.camera.samples;
    const bool    seen    = view == HC_VIEW_STEPS ? p->entered > 0 : p->hits > 0;
    for (int i = 0; i < 3; i++) {
        rgb[i] = p->rgb[i] / samples;
    }
    if (view == HC_VIEW_UNCONVERGED) {
        hc_mix(rgb, (float)p->unconverged / samples, 1.0F, 0.0F, 1.0F);
    } else if (view == HC_VIEW_MISSED) {
        hc_grey_down(rgb);
        hc_mark_wrong(rgb, p->lost, p->made_up, samples);
    } else if (view != HC_VIEW_SHADED && seen) {
        view_numbers(rgb, stage, p, top);
    }
    if (view == HC_VIEW_ERROR) {
        hc_mark_wrong(rgb, p->exact - p->both, p->hits - p->both, samples);
    }
}

/* ---- figures ------------------------------------------------------------------------------- */

static int by_value(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

/* What a heat map shows of a pixel; negative: nothing. */
static float heat_of(const hc_stage *stage, const hc_pixel *p)
{
    if (stage->options.view == HC_VIEW_STEPS) {
        return p->entered > 0 ? p->steps / (float)p->entered : -1.0F;
    }
    return p->both > 0 ? p->error / (float)p->both : -1.0F;
}

static double top_of_most(const hc_stage *stage, const hc_pixel *pixels, size_t count,
                          float *scratch)
{
    size_t shown = 0;
    for (size_t i = 0; i < count; i++) {
        const float heat = heat_of(stage, &pixels[i]);
        if (heat >= 0.0F) {
            scratch[shown++] = heat;
        }
    }
    qsort(scratch, shown, sizeof *scratch, by_value);
    const double top = shown > 0 ? (double)scratch[(shown - 1) * 99 / 100] : 0.0;
    return stage->options.view == HC_VIEW_STEPS ? fmax(ceil(top), 1.0) : fmax(top, 1e-9);
}

void hc_pixels_finish(hc_picture *picture, const hc_stage *stage, const hc_pixel *pixels,
                      float *scratch)
{
    const size_t  pixel_count = (size_t)picture->width * (size_t)picture->height;
    const hc_view view        = stage->options.view;
    double        top         = (double)stage->options.top;
    hc_pixels_count(&picture->figures, pixels, pixel_count, stage->eye.samples);
    if (top <= 0.0 && (view == HC_VIEW_STEPS || view == HC_VIEW_ERROR)) {
        top = top_of_most(stage, pixels, pixel_count, scratch);
    }
    picture->figures.top = top;
    for (size_t i = 0; i < pixel_count; i++) {
        colour(picture->rgb + 3 * i, stage, &pixels[i], top);
        if (picture->depth != NULL) {
            picture->depth[i] = pixels[i].hits > 0 ? pixels[i].depth : INFINITY;
        }
    }
}
