/* Heights where the source has none. */
#ifndef HC_FIELD_HOLES_H
#define HC_FIELD_HOLES_H

#include <heightcast/field.h>

/* How a hole stands in a buffer of heights while it waits for one: any negative number. */
#define HC_HOLE (-1.0F)

/* Give every hole the mean of the valid heights that are nearest to it in Chebyshev distance,
 * all of them if several are equally near. At least one height must be valid. Linear in the
 * number of samples; work memory 12 bytes for each sample in the rectangle around the holes and
 * what they are filled from. HC_ERROR_MEMORY. */
hc_result hc_fill_holes(float *heights, int width, int height, hc_log *log);

/* Give every hole the lowest valid height. */
void hc_lower_holes(float *heights, int width, int height);

#endif
