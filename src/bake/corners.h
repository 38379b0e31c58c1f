/* Extremes over the four corners of bilinear cells. */
#ifndef HC_BAKE_CORNERS_H
#define HC_BAKE_CORNERS_H

#include <heightcast/bake.h>

/* Cell (i, j) has the corners (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1), wrapped or clamped at
 * the border. Channel by channel; out and values width * height * channels, not overlapping. */
void hc_corner_extremes(float *out, const float *values, int width, int height, int channels,
                        hc_wrap wrap, hc_extreme extreme);

#endif
