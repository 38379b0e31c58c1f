/* Bounding map of the bilinear cells.
 * After: GPU terrain ray casting, WSCG 2009, section 5: a bilinear patch stays between the lowest
 * and the highest of its four corners. */
#include "corners.h"

void hc_bake_bounds(float *bounds, const hc_field *field, hc_extreme extreme)
{
    hc_corner_extremes(bounds, field->heights, field->width, field->height, 1, field->wrap,
                       extreme);
}
