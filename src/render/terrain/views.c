/* The colours of a terrain's views. */
#include "terrain.h"

#include "../colour.h"

#include <math.h>

/* As figure 13 of WSCG 2009 has it: what is blue took few moves. */
static void spectrum(float rgb[3], double crossings)
{
    static const double stops[][4] = { { 0, 0.05, 0.05, 0.55 },  { 8, 0.10, 0.25, 0.95 },
                                       { 16, 0.35, 0.80, 1.00 }, { 24, 0.20, 0.75, 0.30 },
                                       { 35, 0.95, 0.92, 0.20 }, { 60, 1.00, 0.55, 0.10 },
                                       { 85, 0.90, 0.10, 0.05 }, { 255, 0.30, 0.00, 0.05 } };
    int                 i          = 0;
    double              c[3];
    while (i < 6 && crossings > stops[i + 1][0]) {
        i++;
    }
    const double share = fmin((crossings - stops[i][0]) / (stops[i + 1][0] - stops[i][0]), 1.0);
    for (int k = 0; k < 3; k++) {
        c[k] = stops[i][k + 1] + share * (stops[i + 1][k + 1] - stops[i][k + 1]);
    }
    hc_set_code(rgb, c[0], c[1], c[2]);
}

/* Near bright, far dark, whatever the scale: half as bright at a quarter of the terrain's side. */
static void depth(float rgb[3], const hc_terrain *terrain, const hc_pixel *p)
{
    const double half = 0.25 * terrain->side;
    const double code = half / (half + fmax((double)p->depth, 0.0));
    hc_set_code(rgb, code, code, code);
}

static void colour(float rgb[3], const hc_terrain *terrain, const hc_pixel *p, int samples)
{
    const double hits = fmax(p->hits, 1);
    const double high = (double)p->height / hits;
    for (int k = 0; k < 3; k++) {
        rgb[k] = p->rgb[k] / (float)samples;
    }
    if (terrain->options.view == HC_VIEW_MISSED) {
        hc_grey_down(rgb);
        hc_mark_wrong(rgb, p->lost, p->made_up, (float)samples);
    } else if (terrain->options.view == HC_VIEW_CROSSINGS && p->entered > 0) {
        spectrum(rgb, (double)p->crossings / p->entered);
    } else if (p->hits > 0 && terrain->options.view == HC_VIEW_HEIGHT) {
        hc_set_code(rgb, high, high, high);
    } else if (p->hits > 0 && terrain->options.view == HC_VIEW_DEPTH) {
        depth(rgb, terrain, p);
    } else if (p->hits > 0 && terrain->options.view == HC_VIEW_NORMAL) {
        hc_set_code(rgb, 0.5 + 0.5 * (double)p->normal[0] / hits,
                    0.5 + 0.5 * (double)p->normal[1] / hits,
                    0.5 + 0.5 * (double)p->normal[2] / hits);
    }
}

void hc_terrain_finish(hc_picture *picture, const hc_terrain *terrain, const hc_pixel *pixels,
                       int samples)
{
    const size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count; i++) {
        colour(picture->rgb + 3 * i, terrain, &pixels[i], samples);
        if (picture->depth != NULL) {
            picture->depth[i] = pixels[i].hits > 0 ? pixels[i].depth : INFINITY;
        }
    }
}
