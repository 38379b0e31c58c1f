/* Numbers to the codes of 8 and 16 bit maps, each rounded to its safe side. What a code means is in
 * maps/codes.h; every function here is judged by that, not by its own formula. */
#ifndef HC_BAKE_QUANTISE_H
#define HC_BAKE_QUANTISE_H

#include <stddef.h>

/* Nearest code of a height in 0..1, halves up. */
int hc_height_code(float height, int bits);

/* Lowest code that stands for at least, highest that stands for at most, this height in 0..1. */
int hc_height_code_up(float height, int bits);
int hc_height_code_down(float height, int bits);

/* Highest code that stands for a ratio of at most `ratio`: code 0, "no free space known", only
 * where the ratio is below that of code 1. ratio > 0, may be infinite; max_ratio > 0, what the
 * largest code stands for. */
int hc_ratio_code(float ratio, int bits, float max_ratio);

/* Code of a slope, given in height codes per texel step: nearest, halves towards level as the 2006
 * paper's integer division does, plus the bias; slopes beyond +-bias count as that. */
int hc_slope_bias(int bits); /* 127, 32767 */
int hc_slope_code(double slope, int bits);

/* The heights that the nearest codes stand for. rounded may be heights. */
void hc_round_heights(float *rounded, const float *heights, size_t count, int bits);

#endif
