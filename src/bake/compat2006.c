/* The map that the 2006 paper's preprocessor writes, with its faults.
 * After: Dummer. Cone Step Mapping: An Iterative Ray-Heightfield Intersection Algorithm. 2006,
 * appendix B. In the extract's wrap loops a minus sign was lost in print: x2 and y2 go down by a
 * period each time.
 *
 * Faults kept, since old maps have them:
 * - Ratios are rounded to the nearest code: up to half a code wider than the truth.
 * - Where the field wraps, a line of a square is shifted by whole periods, but its run along the
 *   other axis is cut at the image's border: samples past a corner are never seen, and a run does
 *   not go on across the border. Samples are taken at every image the squares reach.
 * - The exit leaves the search when the radius passes 1.1 times what the best cone allows, measured
 *   in samples of a square texture: too early on the longer axis of an oblong one.
 * - One-sided differences at the borders are halved once more than they should be (a quarter of the
 *   true slope), also where the field wraps. Differences are cut towards level.
 * - A ratio that rounds to code 0 becomes 1.
 * Not kept: its progress dots divide by width / 50 and stop programs below 50 columns.
 *
 * Types as in the original: ratios, distances and heights are float; a quotient by 255.0, the exit
 * test and the last rounding are double. float arithmetic is IEEE single (not x87). */
#include "compat2006.h"

#include "base/parallel.h"

#include <math.h>

enum { CHANNELS = 4, RED = 0, GREEN, BLUE, ALPHA };

typedef struct original {
    uint8_t *rgba;
    int      width, height;
    bool     wrap_u, wrap_v;
    float    step_u, step_v;
} original;

static uint8_t *texel_at(const original *self, int x, int y)
{
    return self->rgba + ((size_t)y * (size_t)self->width + (size_t)x) * CHANNELS;
}

static int height_code(const original *self, int x, int y)
{
    return texel_at(self, x, y)[RED];
}

/* Twice the slope in codes per step inside, half of it at the borders: the caller halves both. */
static int difference(int before, int here, int after, int place, int side)
{
    return place == 0          ? (after - here) / 2
           : place == side - 1 ? (here - before) / 2
                               : after - before;
}

static void put_slopes(const original *self, int x, int y)
{
    const int here  = height_code(self, x, y);
    const int left  = x > 0 ? height_code(self, x - 1, y) : here;
    const int right = x < self->width - 1 ? height_code(self, x + 1, y) : here;
    const int above = y > 0 ? height_code(self, x, y - 1) : here;
    const int below = y < self->height - 1 ? height_code(self, x, y + 1) : here;
    uint8_t  *texel = texel_at(self, x, y);
    texel[BLUE]     = (uint8_t)(127 + difference(left, here, right, x, self->width) / 2);
    texel[ALPHA]    = (uint8_t)(127 - difference(above, here, below, y, self->height) / 2);
}

/* One sample at a given distance against the least squared ratio so far. */
static float limit(const original *self, int x, int y, float apart_u, float apart_v, float height,
                   float least)
{
    const float squared = apart_u * apart_u + apart_v * apart_v;
    const float rise    = (float)(height_code(self, x, y) / 255.0 - (double)height);
    return (double)rise > 0.0 && rise * rise * least > squared ? squared / (rise * rise) : least;
}

static int clamped(int place, int side)
{
    return place < 0 ? 0 : place >= side ? side - 1 : place;
}

/* The index that a line `offset` away has, or -1: brought back by whole periods where it wraps. */
static int line_at(int place, int offset, int side, bool wraps)
{
    const int index = place + offset;
    if (wraps) {
        return (index % side + side) % side;
    }
    return index >= 0 && index < side ? index : -1;
}

static float scan_columns(const original *self, int x, int y, int radius, float height, float least)
{
    const int first = clamped(y - radius + 1, self->height);
    const int last  = clamped(y + radius - 1, self->height);
    for (int side = -radius; side <= radius; side += 2 * radius) {
        const int column = line_at(x, side, self->width, self->wrap_u);
        for (int row = first; column >= 0 && row <= last; row++) {
            least = limit(self, column, row, (float)side * self->step_u,
                          (float)(row - y) * self->step_v, height, least);
        }
    }
    return least;
}

static float scan_rows(const original *self, int x, int y, int radius, float height, float least)
{
    const int first = clamped(x - radius, self->width);
    const int last  = clamped(x + radius, self->width);
    for (int side = -radius; side <= radius; side += 2 * radius) {
        const int row = line_at(y, side, self->height, self->wrap_v);
        for (int column = first; row >= 0 && column <= last; column++) {
            least = limit(self, column, row, (float)(column - x) * self->step_u,
                          (float)side * self->step_v, height, least);
        }
    }
    return least;
}

static bool goes_on(const original *self, int radius, float height, float least)
{
    const double room   = 1.0 - (double)height;
    const double square = 1.1 * 1.1 * room * room * (double)least * self->width * self->height;
    return (double)radius * radius <= square && radius <= 1.1 * room * self->width
           && radius <= 1.1 * room * self->height;
}

static void put_ratio(const original *self, int x, int y)
{
    const float height = (float)(height_code(self, x, y) / 255.0);
    float       least  = 1.0F;
    for (int radius = 1; goes_on(self, radius, height, least); radius++) {
        least = scan_columns(self, x, y, radius, height, least);
        least = scan_rows(self, x, y, radius, height, least);
    }
    const float   root          = sqrtf(sqrtf(least));
    const uint8_t code          = (uint8_t)(255.0 * (double)root + 0.5);
    texel_at(self, x, y)[GREEN] = code < 1 ? 1 : code;
}

static void bake_row(void *context, int y, int worker)
{
    (void)worker;
    const original *self = context;
    for (int x = 0; x < self->width; x++) {
        put_slopes(self, x, y);
        put_ratio(self, x, y);
    }
}

hc_result hc_compat2006(uint8_t *rgba, int width, int height, hc_wrap wrap, int threads,
                        hc_progress progress, hc_log *log)
{
    original self = { .rgba   = rgba,
                      .width  = width,
                      .height = height,
                      .wrap_u = ((unsigned)wrap & HC_WRAP_U) != 0,
                      .wrap_v = ((unsigned)wrap & HC_WRAP_V) != 0,
                      .step_u = (float)(1.0 / width),
                      .step_v = (float)(1.0 / height) };
    return hc_parallel_for(height, threads, bake_row, &self, progress, log);
}
