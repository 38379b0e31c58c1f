/* Brute force with two shortcuts that anyone can check, for fields where all pairs take too long.
 *
 * A run of 32 samples of a row, or 32 such runs of as many rows, is left out if its highest sample,
 * weighed with the largest weight that any of its samples has, is no steeper than what is known.
 * Rounding is monotone, so each sample left out would not have raised the maximum, bit for bit.
 * Runs and weights come from the definition of hc_bake_cone_map; nothing is shared with any baker.
 *
 * Much more is left out by a search that knows from the start what it has to exceed: a hair less
 * than what is to be judged. If that is the truth it is found again, bit for bit. If it is not,
 * something steeper is found, or nothing at all, which leaves another ratio too. */
#ifndef AGREE_JUDGE_H
#define AGREE_JUDGE_H

#include <heightcast/bake.h>

/* Rows first, first + step, first + 2 * step, ... of `ratios`, as hc_bake_cone_map has them; the
 * others are left alone. `claimed` is what is judged: where it is right `ratios` is the same,
 * where it is not they differ. l2, l1 and quad. Uses all cores, and 24 bytes per sample. */
void agree_judge_rows(float *ratios, const float *claimed, const hc_field *field, hc_cones cones,
                      int first, int step);

#endif
