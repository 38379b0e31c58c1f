/* Colours in linear light, from sRGB codes and to them, without libm. */
#ifndef HC_RENDER_COLOUR_H
#define HC_RENDER_COLOUR_H

#include <heightcast/render.h>

/* From sRGB codes, 0 .. 1. */
void hc_set_code(float rgb[3], double r, double g, double b);

/* Towards another colour by a share. */
void hc_mix(float rgb[3], float share, float r, float g, float b);

void hc_grey_down(float rgb[3]);

/* Shares of rays whose hits are wrong, on top of what is there: red and yellow. */
void hc_mark_wrong(float rgb[3], int lost, int made_up, float samples);

#endif
