/* What the made fields share: the canvas they fill and how they fill it. */
#ifndef HC_FIELD_SYNTH_H
#define HC_FIELD_SYNTH_H

#include <heightcast/field.h>

typedef struct hc_canvas {
    float   *heights;
    int      width, height;
    uint64_t seed;
} hc_canvas;

/* Fill count <= HC_RUN texels of row y from column x on. Must not depend on other texels: runs are
 * handed to threads in any order. */
typedef void (*hc_paint_run)(float *run, int x, int y, int count, const hc_canvas *canvas,
                             const void *plan);

/* Call `paint` for all runs of the canvas. */
hc_result hc_paint(const hc_canvas *canvas, hc_paint_run paint, const void *plan, hc_log *log);

/* The longer side; sizes of features follow it. */
static inline int hc_longer_side(const hc_canvas *canvas)
{
    return canvas->width > canvas->height ? canvas->width : canvas->height;
}

static inline float hc_clamp_unit(float value)
{
    return value < 0.0F ? 0.0F : value > 1.0F ? 1.0F : value;
}

/* From 0 at 0 to 1 at 1, level at both ends. */
static inline float hc_smooth(float t)
{
    return t * t * (3.0F - 2.0F * t);
}

/* sin(2 * pi * turns), to within 2^-43. Only + - * and floor, unlike libm the same everywhere. */
double hc_sine(double turns);

/* One function a field; hc_synth's table says which are stretched to 0..1 afterwards. */
hc_result hc_make_fbm(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_ridged(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_dunes(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_spikes(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_noise(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_ridge(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_funnel(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_saddle(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_steps(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_sinc(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_spheres(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_bricks(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_cobbles(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_fur(const hc_canvas *canvas, hc_log *log);
hc_result hc_make_flat(const hc_canvas *canvas, hc_log *log);

#endif
