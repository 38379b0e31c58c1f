#include "motion.h"

#include <math.h>
#include <string.h>

enum { PASSES = 2 }; /* of erosion in a frame */

static size_t count_of(const hc_field *field)
{
    return (size_t)field->width * (size_t)field->height;
}

/* ---- waves ----------------------------------------------------------------------------------- */

/* Periods across the field, whole ones, so that it wraps; and over all frames, so that they end as
 * they began. */
typedef struct wave {
    double u, v, turns;
} wave;

static const wave   waves[] = { { 2.0, 1.0, 1.0 }, { -1.0, 3.0, 1.0 }, { 4.0, -3.0, 2.0 } };
static const double SWELL   = 0.35; /* share of the waves in the height */
enum { WAVES = sizeof waves / sizeof *waves };

/* Like a cosine, of a phase in turns: from 1 down to 0 and back. */
static double crest(double phase)
{
    const double away = fabs(2.0 * (phase - floor(phase)) - 1.0);
    return away * away * (3.0 - 2.0 * away);
}

static void wave_over(float *heights, const hc_field *ground, double moment)
{
    for (int y = 0; y < ground->height; y++) {
        for (int x = 0; x < ground->width; x++) {
            const size_t at  = (size_t)y * (size_t)ground->width + (size_t)x;
            const double u   = (double)x / ground->width;
            const double v   = (double)y / ground->height;
            double       sum = 0.0;
            for (int i = 0; i < WAVES; i++) {
                sum += crest(waves[i].u * u + waves[i].v * v - waves[i].turns * moment);
            }
            heights[at] =
                (float)((1.0 - SWELL) * (double)ground->heights[at] + SWELL / WAVES * sum);
        }
    }
}

/* ---- erosion --------------------------------------------------------------------------------- */

/* Steeper slopes slide: height over width of the field. */
static const double STEEPEST = 1.0;

/* Of what a sample stands above a neighbour, beyond what holds, this share goes there. All four
 * together take less than half, so nothing falls below the neighbours, or rises above them. */
static const double SLIDES = 0.125;

static double slide(double here, double there, double holds)
{
    const double apart = there - here;
    return apart > holds    ? SLIDES * (apart - holds)
           : apart < -holds ? SLIDES * (apart + holds)
                            : 0.0;
}

/* The sample beside one along an axis, or itself at a border. */
static int beside(int place, int by, int side, bool wraps)
{
    const int next = place + by;
    return next >= 0 && next < side ? next : wraps ? (next + side) % side : place;
}

static double neighbours(const float *heights, const hc_field *ground, int x, int y)
{
    const size_t width   = (size_t)ground->width;
    const bool   u       = ((unsigned)ground->wrap & HC_WRAP_U) != 0;
    const bool   v       = ((unsigned)ground->wrap & HC_WRAP_V) != 0;
    const double holds_u = STEEPEST * hc_field_step_u(ground);
    const double holds_v = STEEPEST * hc_field_step_v(ground);
    const double here    = (double)heights[(size_t)y * width + (size_t)x];
    double       sum     = 0.0;
    for (int by = -1; by <= 1; by += 2) {
        const size_t column = (size_t)beside(x, by, ground->width, u);
        const size_t row    = (size_t)beside(y, by, ground->height, v);
        sum += slide(here, (double)heights[(size_t)y * width + column], holds_u);
        sum += slide(here, (double)heights[row * width + (size_t)x], holds_v);
    }
    return sum;
}

static void erode_once(float *eroded, const float *heights, const hc_field *ground)
{
    for (int y = 0; y < ground->height; y++) {
        for (int x = 0; x < ground->width; x++) {
            const size_t at = (size_t)y * (size_t)ground->width + (size_t)x;
            eroded[at]      = (float)((double)heights[at] + neighbours(heights, ground, x, y));
        }
    }
}

static int lesser(int a, int b)
{
    return a < b ? a : b;
}

static int greater(int a, int b)
{
    return a > b ? a : b;
}

/* The least rectangle that holds all samples that differ. */
static hc_rect differing(const float *a, const float *b, int width, int height)
{
    int left = width, right = -1, top = height, bottom = -1;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const size_t at = (size_t)y * (size_t)width + (size_t)x;
            if (a[at] != b[at]) {
                left   = lesser(left, x);
                right  = greater(right, x);
                top    = lesser(top, y);
                bottom = y;
            }
        }
    }
    return right < 0 ? (hc_rect){ 0 } : (hc_rect){ left, top, right - left + 1, bottom - top + 1 };
}

/* scratch: what there was before, and what there was before the pass. */
static hc_rect erode(float *heights, float *scratch, const hc_field *ground)
{
    const size_t bytes  = count_of(ground) * sizeof *heights;
    float       *before = scratch, *from = scratch + count_of(ground);
    memcpy(before, heights, bytes);
    for (int pass = 0; pass < PASSES; pass++) {
        memcpy(from, heights, bytes);
        erode_once(heights, from, ground);
    }
    return differing(before, heights, ground->width, ground->height);
}

/* ---------------------------------------------------------------------------------------------- */

hc_rect hc_cli_move(float *heights, float *scratch, const hc_field *ground, hc_cli_motion motion,
                    int frame, int frames)
{
    const hc_rect all = { 0, 0, ground->width, ground->height };
    if (motion == HC_CLI_WAVES) {
        wave_over(heights, ground, (double)frame / frames);
    } else if (frame == 0) {
        memcpy(heights, ground->heights, count_of(ground) * sizeof *heights);
    } else {
        return erode(heights, scratch, ground);
    }
    return all;
}
