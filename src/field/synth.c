/* The list of made fields, and how one is made: fill the canvas, then stretch it if it asks. */
#include "synth.h"

#include "noise.h"
#include "shape.h"

#include "base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Fields below this many texels are not worth starting threads for. */
enum { THREADS_FROM = 1 << 16 };

typedef struct entry {
    const char *name, *description;
    hc_result (*make)(const hc_canvas *canvas, hc_log *log);
    bool stretch; /* to 0..1 by the extremes; the others are made to measure */
} entry;

static const entry entries[] = {
    { "fbm", "fractal terrain: gradient noise, each octave half as high and half as wide; tiles",
      hc_make_fbm, true },
    { "ridged", "sharp mountain ridges: octaves of folded noise, rough where high; tiles",
      hc_make_ridged, true },
    { "dunes", "wind-blown sand: gentle windward slopes, steep slip faces, ripples; tiles",
      hc_make_dunes, true },
    { "spikes", "0.5 % one-texel towers, 0.25 to 1 high, on a flat floor at 0; tiles",
      hc_make_spikes, false },
    { "noise", "white noise, every texel on its own, evenly spread over 0..1; tiles", hc_make_noise,
      false },
    { "ridge", "one-texel diagonal wall at 1 on a flat floor at 0; no seed, tiles", hc_make_ridge,
      false },
    { "funnel", "cone-shaped pit: 0 at sample (width / 2, height / 2), 1 at the farthest; no seed",
      hc_make_funnel, false },
    { "saddle", "samples 0 and 1 in a checkerboard, every patch a saddle; no seed, tiles if even",
      hc_make_saddle, false },
    { "steps", "stepped pyramid of eight flat terraces; no seed, tiles", hc_make_steps, false },
    { "sinc", "rings of sin(r) / r around the centre; no seed", hc_make_sinc, true },
    { "spheres", "hemispheres of several sizes on a plane; tiles", hc_make_spheres, true },
    { "bricks", "brick wall in running bond with low mortar joints; tiles", hc_make_bricks, true },
    { "cobbles", "rounded cobblestones with low joints (Worley cells); tiles", hc_make_cobbles,
      true },
    { "fur", "thin combed hairs, one texel wide, of random length and height; tiles", hc_make_fur,
      true },
    { "flat", "all 0.5; no seed, tiles", hc_make_flat, false },
};

enum { ENTRIES = sizeof entries / sizeof *entries };

int hc_synth_count(void)
{
    return ENTRIES;
}

const char *hc_synth_name(int index)
{
    return index >= 0 && index < ENTRIES ? entries[index].name : NULL;
}

const char *hc_synth_description(int index)
{
    return index >= 0 && index < ENTRIES ? entries[index].description : NULL;
}

double hc_sine(double turns)
{
    /* Taylor coefficients of sin(2 * pi * t) up to t^17. The first term left out is below 2^-44 for
     * |t| <= 1/4. */
    static const double series[] = { 6.283185307179586,  -41.34170224039976,  81.60524927607506,
                                     -76.70585975306139, 42.058693944897655,  -15.09464257682299,
                                     3.819952584848282,  -0.7181223017785006, 0.10422916220813984 };
    double              t        = turns - floor(turns + 0.5);
    t                            = t > 0.25 ? 0.5 - t : t < -0.25 ? -0.5 - t : t;
    double sum                   = 0.0;
    for (int k = (int)(sizeof series / sizeof *series) - 1; k >= 0; k--) {
        sum = sum * (t * t) + series[k];
    }
    return sum * t;
}

typedef struct painting {
    const hc_canvas *canvas;
    hc_paint_run     paint;
    const void      *plan;
} painting;

static void paint_row(void *context, int y, int worker)
{
    const painting  *job    = context;
    const hc_canvas *canvas = job->canvas;
    float           *row    = canvas->heights + (size_t)y * (size_t)canvas->width;
    (void)worker;
    for (int x = 0; x < canvas->width; x += HC_RUN) {
        const int left = canvas->width - x;
        job->paint(row + x, x, y, left < HC_RUN ? left : HC_RUN, canvas, job->plan);
    }
}

hc_result hc_paint(const hc_canvas *canvas, hc_paint_run paint, const void *plan, hc_log *log)
{
    painting  job = { canvas, paint, plan };
    const int threads =
        (int64_t)canvas->width * canvas->height < THREADS_FROM ? 1 : hc_threads_resolve(0);
    return hc_parallel_for(canvas->height, threads, paint_row, &job, (hc_progress){ 0 }, log);
}

/* Extremes to 0 and 1; a constant field becomes 0. */
static void stretch(float *heights, size_t count)
{
    float lowest  = heights[0];
    float highest = heights[0];
    for (size_t i = 1; i < count; i++) {
        lowest  = heights[i] < lowest ? heights[i] : lowest;
        highest = heights[i] > highest ? heights[i] : highest;
    }
    const double span = highest > lowest ? (double)highest - (double)lowest : 1.0;
    for (size_t i = 0; i < count; i++) {
        heights[i] = (float)(((double)heights[i] - (double)lowest) / span);
    }
}

static hc_result refuse_name(const char *name, hc_log *log)
{
    char   known[256] = "";
    size_t length     = 0;
    for (int i = 0; i < ENTRIES && length < sizeof known; i++) {
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", i > 0 ? ", " : "",
                                   entries[i].name);
    }
    return hc_fail(log, HC_ERROR_ARGUMENT, "made field '%.64s' is not known; known are %s",
                   name != NULL ? name : "(null)", known);
}

hc_result hc_synth(float *heights, int width, int height, const char *name, uint64_t seed,
                   hc_log *log)
{
    int index = 0;
    while (name != NULL && index < ENTRIES && strcmp(name, entries[index].name) != 0) {
        index++;
    }
    if (name == NULL || index == ENTRIES) {
        return refuse_name(name, log);
    }
    if (heights == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "heights is NULL");
    }
    hc_result result = hc_check_shape("made field", width, height, sizeof *heights, log);
    if (result == HC_OK) {
        const hc_canvas canvas = { heights, width, height, seed };
        result                 = entries[index].make(&canvas, log);
    }
    if (result == HC_OK && entries[index].stretch) {
        stretch(heights, (size_t)width * (size_t)height);
    }
    return result;
}
