/* The bounding map: the highest corner of every cell, and the max pyramid of it (of tops, the
 * tops). Nothing of a surface rises above its cells' bounds.
 * Source: WSCG 2009, section 5. */
#include "tracer.h"

#include <math.h>

static float highest_corner(const hc_tracer *tracer, int x, int y)
{
    float     top   = 0.0F;
    const int ahead = tracer->tops ? 0 : 1;
    for (int j = y; j <= y + ahead; j++) {
        for (int i = x; i <= x + ahead; i++) {
            top = fmaxf(top, tracer->heights[hc_tracer_index(tracer, i, j)]);
        }
    }
    return top;
}

/* Every texel of a level goes into the one above it; the last also takes what odd sizes leave. */
static void reduce(float *coarse, int coarse_width, int coarse_height, const float *fine, int width,
                   int height)
{
    for (size_t i = 0; i < (size_t)coarse_width * (size_t)coarse_height; i++) {
        coarse[i] = 0.0F;
    }
    for (int y = 0; y < height; y++) {
        float *row =
            coarse
            + (size_t)(y / 2 < coarse_height ? y / 2 : coarse_height - 1) * (size_t)coarse_width;
        for (int x = 0; x < width; x++) {
            const int above = x / 2 < coarse_width ? x / 2 : coarse_width - 1;
            row[above]      = fmaxf(row[above], fine[(size_t)y * (size_t)width + (size_t)x]);
        }
    }
}

void hc_bounds_fill(hc_tracer *tracer, float *values)
{
    const int width  = tracer->width;
    const int height = tracer->height;
    tracer->bounds   = (hc_pyramid){ values, width, height, hc_pyramid_levels(width, height) };
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            values[(size_t)y * (size_t)width + (size_t)x] = highest_corner(tracer, x, y);
        }
    }
    for (int level = 1; level < tracer->bounds.levels; level++) {
        int          wide, high, coarse_wide, coarse_high;
        const float *fine   = hc_pyramid_level(&tracer->bounds, level - 1, &wide, &high);
        float       *coarse = hc_pyramid_level(&tracer->bounds, level, &coarse_wide, &coarse_high);
        reduce(coarse, coarse_wide, coarse_high, fine, wide, high);
    }
}
