/* Light on what a ray hits, and what a pixel shows of it. All backends fill hc_sample; the colours
 * of views that show numbers are made here for all of them. */
#ifndef HC_RENDER_SHADE_H
#define HC_RENDER_SHADE_H

#include "stage.h"
#include "sums.h"

/* Light what the CPU's ray came to. */
void hc_shade(hc_sample *sample, const hc_stage *stage, const hc_gaze *gaze, const hc_sight *sight);

/* Add what a ray saw, or the background; `direction` is the ray's. */
void hc_stage_add(hc_pixel *pixel, const hc_stage *stage, hc_sample sample,
                  const double direction[3], int row);

/* Colours and figures of all pixels; scratch: a float for each. */
void hc_pixels_finish(hc_picture *picture, const hc_stage *stage, const hc_pixel *pixels,
                      float *scratch);

#endif
