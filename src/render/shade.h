/* Light on what a ray hits, and what a pixel shows of it. All backends fill hc_sample; the colours
 * of views that show numbers are made here for all of them. */
#ifndef HC_RENDER_SHADE_H
#define HC_RENDER_SHADE_H

#include "stage.h"

/* What one ray of a pixel saw. */
typedef struct hc_sample {
    float rgb[3];   /* lit, linear; undefined where nothing was hit     */
    float distance; /* along the ray; INFINITY: nothing                 */
    float exact;    /* of the exact caster, in views that compare       */
    float normal[3];
    float height;
    float steps, fetches;
    bool  entered, unconverged;
} hc_sample;

/* Sums over the rays of a pixel. */
typedef struct hc_pixel {
    float rgb[3];
    float normal[3];
    float height, depth, steps, fetches, error;
    int   hits, entered, unconverged, lost, made_up, exact, both;
} hc_pixel;

/* Light what the CPU's ray came to. */
void hc_shade(hc_sample *sample, const hc_stage *stage, const hc_gaze *gaze, const hc_sight *sight);

/* Add what a ray saw; `direction` is the ray's. */
void hc_pixel_add(hc_pixel *pixel, const hc_stage *stage, const hc_sample *sample,
                  const double direction[3], int row);

/* Colours and figures of all pixels; scratch: a float for each. */
void hc_pixels_finish(hc_picture *picture, const hc_stage *stage, const hc_pixel *pixels,
                      float *scratch);

#endif
