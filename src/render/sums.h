/* What the rays of a pixel saw, and sums of it, whatever the scene and the backend. */
#ifndef HC_RENDER_SUMS_H
#define HC_RENDER_SUMS_H

#include <heightcast/render.h>

/* What one ray of a pixel saw. */
typedef struct hc_sample {
    float rgb[3];   /* linear                                           */
    float distance; /* along the ray; INFINITY: nothing                 */
    float exact;    /* of the exact caster, in views that compare       */
    float normal[3];
    float height;
    float steps, fetches, crossings;
    bool  entered, unconverged;
} hc_sample;

enum { HC_FEW = 3 }; /* numbers of crossings that figures have shares for */

/* Sums over the rays of a pixel. */
typedef struct hc_pixel {
    float rgb[3];
    float normal[3];
    float height, depth, steps, fetches, crossings, error;
    int   hits, entered, unconverged, lost, made_up, exact, both;
    int   few[HC_FEW];
} hc_pixel;

/* along: cosine between the ray and the view axis. Hits behind or before the exact ones by more
 * than `slack` count as lost or made up; negative: none are compared. */
void hc_pixel_add(hc_pixel *pixel, const hc_sample *sample, double along, float slack);

/* All figures but `seconds`, which stay, and `top`. */
void hc_pixels_count(hc_render_figures *figures, const hc_pixel *pixels, size_t pixel_count,
                     int samples);

#endif
