/* Brute force with three shortcuts that anyone can check: for fields where all pairs take too
 * long.
 *
 * A row of samples, or a run of 32 of them, is left out if its highest sample, weighed with the
 * largest weight that any of its samples has, is no steeper than what is known; and the rows
 * further away are left out when that holds for the highest sample of all. Rounding is monotone,
 * so each sample left out would not have raised the maximum, bit for bit. Rows, runs and weights
 * come from the definition of hc_bake_cone_map; nothing is shared with any baker. */
#ifndef AGREE_JUDGE_H
#define AGREE_JUDGE_H

#include <heightcast/bake.h>

/* Rows first, first + step, first + 2 * step, ... of `ratios`, as hc_bake_cone_map has them; the
 * others are left alone. l2, l1 and quad. Uses all cores, and 16 bytes per sample. */
void agree_judge_rows(float *ratios, const hc_field *field, hc_cones cones, int first, int step);

#endif
