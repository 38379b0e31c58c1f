#include "sums.h"

#include <math.h>

/* As in figure 13 of WSCG 2009. */
static const float few[HC_FEW] = { 16.0F, 35.0F, 85.0F };

static void compare(hc_pixel *pixel, const hc_sample *sample, float slack)
{
    pixel->lost += sample->exact + slack < sample->distance ? 1 : 0;
    pixel->made_up += sample->distance + slack < sample->exact ? 1 : 0;
    pixel->exact += sample->exact < INFINITY ? 1 : 0;
    if (sample->distance < INFINITY && sample->exact < INFINITY) {
        pixel->both++;
        pixel->error += fabsf(sample->distance - sample->exact);
    }
}

void hc_pixel_add(hc_pixel *pixel, const hc_sample *sample, double along, float slack)
{
    const bool hit = sample->distance < INFINITY;
    for (int i = 0; i < 3; i++) {
        pixel->rgb[i] += sample->rgb[i];
        pixel->normal[i] += hit ? sample->normal[i] : 0.0F;
        pixel->few[i] += sample->entered && sample->crossings <= few[i] ? 1 : 0;
    }
    if (hit) {
        const float depth = (float)((double)sample->distance * along);
        pixel->depth      = pixel->hits > 0 ? fminf(pixel->depth, depth) : depth;
        pixel->height += sample->height;
        pixel->hits++;
    }
    pixel->steps += sample->steps;
    pixel->fetches += sample->fetches;
    pixel->crossings += sample->crossings;
    pixel->entered += sample->entered ? 1 : 0;
    pixel->unconverged += sample->unconverged ? 1 : 0;
    if (slack >= 0.0F) {
        compare(pixel, sample, slack);
    }
}

void hc_pixels_count(hc_render_figures *figures, const hc_pixel *pixels, size_t pixel_count,
                     int samples)
{
    double   steps = 0.0, error = 0.0, fetches = 0.0, crossings = 0.0;
    uint64_t both = 0, within[HC_FEW] = { 0 };
    *figures =
        (hc_render_figures){ .rays = pixel_count * (uint64_t)samples, .seconds = figures->seconds };
    for (size_t i = 0; i < pixel_count; i++) {
        const hc_pixel *p = &pixels[i];
        figures->hits += (uint64_t)p->hits;
        figures->unconverged += (uint64_t)p->unconverged;
        figures->lost += (uint64_t)p->lost;
        figures->made_up += (uint64_t)p->made_up;
        figures->entered += (uint64_t)p->entered;
        both += (uint64_t)p->both;
        steps += (double)p->steps;
        fetches += (double)p->fetches;
        crossings += (double)p->crossings;
        error += (double)p->error;
        for (int k = 0; k < HC_FEW; k++) {
            within[k] += (uint64_t)p->few[k];
        }
    }
    const double entered    = fmax((double)figures->entered, 1.0);
    figures->mean_steps     = steps / entered;
    figures->mean_fetches   = fetches / entered;
    figures->mean_crossings = crossings / entered;
    figures->mean_error     = both > 0 ? error / (double)both : 0.0;
    for (int k = 0; k < HC_FEW; k++) {
        figures->within[k] = (double)within[k] / entered;
    }
}
