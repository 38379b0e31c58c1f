/* Landscapes: fbm, ridged, dunes. All are sums of noise that repeats, so all of them tile.
 *
 * After: F. Kenton Musgrave, in: Texturing and Modeling, a Procedural Approach. 1994 (fractional
 * Brownian motion, ridged multifractal). */
#include "noise.h"
#include "synth.h"

#include <math.h>

static void paint_fbm(float *run, int x, int y, int count, const hc_canvas *canvas,
                      const void *plan)
{
    (void)canvas;
    hc_fractal_run(run, plan, x, y, count);
}

hc_result hc_make_fbm(const hc_canvas *canvas, hc_log *log)
{
    const hc_fractal fractal = hc_make_fractal(canvas->width, canvas->height, 4.0, HC_OCTAVES_MAX,
                                               hc_stream(canvas->seed, 0));
    return hc_paint(canvas, paint_fbm, &fractal, log);
}

/* Folding the noise at 0 makes the crests; each octave counts as much as the ground so far is high,
 * which leaves the valleys smooth. */
static void paint_ridged(float *run, int x, int y, int count, const hc_canvas *canvas,
                         const void *plan)
{
    const hc_fractal *fractal = plan;
    float             weight[HC_RUN];
    float             amplitude = 1.0F;
    (void)canvas;
    for (int i = 0; i < count; i++) {
        run[i]    = 0.0F;
        weight[i] = 1.0F;
    }
    for (int k = 0; k < fractal->octaves; k++) {
        float noise[HC_RUN] = { 0 };
        hc_add_octave(noise, &fractal->octave[k], x, y, count, 1.6F);
        for (int i = 0; i < count; i++) {
            const float crest  = 1.0F - (noise[i] < 0.0F ? -noise[i] : noise[i]);
            const float signal = crest * crest * weight[i];
            run[i] += amplitude * signal;
            weight[i] = hc_clamp_unit(2.0F * signal);
        }
        amplitude *= 0.5F;
    }
}

hc_result hc_make_ridged(const hc_canvas *canvas, hc_log *log)
{
    const hc_fractal fractal = hc_make_fractal(canvas->width, canvas->height, 3.0, HC_OCTAVES_MAX,
                                               hc_stream(canvas->seed, 0));
    return hc_paint(canvas, paint_ridged, &fractal, log);
}

/* Waves across the field, in whole periods so that they tile. */
typedef struct waves {
    int along_u, along_v;
} waves;

typedef struct dunes {
    hc_fractal bends, sizes, floor;
    waves      crests, ripples;
} dunes;

/* Turns of the wave at a texel, not reduced to one period. */
static double wave_phase(const hc_canvas *canvas, waves wave, int x, int y)
{
    return (x + 0.5) * wave.along_u / canvas->width + (y + 0.5) * wave.along_v / canvas->height;
}

/* Wind from the left: rising gently over most of the period, then falling as sand slides. */
static float dune_profile(double phase)
{
    const float crest = 0.74F;
    const float t     = (float)(phase - (double)(int)phase);
    return t < crest ? hc_smooth(t / crest) : (1.0F - t) / (1.0F - crest);
}

static void paint_dunes(float *run, int x, int y, int count, const hc_canvas *canvas,
                        const void *plan)
{
    const dunes *sand = plan;
    float        bends[HC_RUN], sizes[HC_RUN], ground[HC_RUN];
    hc_fractal_run(bends, &sand->bends, x, y, count);
    hc_fractal_run(sizes, &sand->sizes, x, y, count);
    hc_fractal_run(ground, &sand->floor, x, y, count);
    for (int i = 0; i < count; i++) {
        /* 16 keeps the phase positive, whatever the bend. */
        const double crests  = wave_phase(canvas, sand->crests, x + i, y) + 1.1 * (double)bends[i];
        const double ripples = wave_phase(canvas, sand->ripples, x + i, y) + 9.0 * (double)bends[i];
        const float  dune    = dune_profile(crests + 16.0);
        const float  size    = hc_smooth(hc_clamp_unit(0.6F + 0.7F * sizes[i]));
        run[i] = dune * size + 0.35F * ground[i] + 0.006F * (float)hc_sine(ripples) * size;
    }
}

static waves make_waves(const hc_canvas *canvas, double texels_u, double texels_v)
{
    return (waves){ hc_cells_along(canvas->width, texels_u),
                    hc_cells_along(canvas->height, texels_v) };
}

hc_result hc_make_dunes(const hc_canvas *canvas, hc_log *log)
{
    const int    width = canvas->width, height = canvas->height;
    const double longer = hc_longer_side(canvas);
    const dunes  sand   = {
           .bends   = hc_make_fractal(width, height, 3.0, 3, hc_stream(canvas->seed, 0)),
           .sizes   = hc_make_fractal(width, height, 5.0, 2, hc_stream(canvas->seed, 1)),
           .floor   = hc_make_fractal(width, height, 2.0, 2, hc_stream(canvas->seed, 2)),
           .crests  = make_waves(canvas, longer / 9.0, longer / 2.0),
           .ripples = make_waves(canvas, fmax(longer / 150.0, 5.0), longer / 20.0),
    };
    return hc_paint(canvas, paint_dunes, &sand, log);
}
