/* Cone ratios that hold anywhere in a bilinear cell: the least of its corners'. */
#include "corners.h"

void hc_bake_cell_ratios(float *cells, const float *ratios, int width, int height, hc_cones cones,
                         hc_wrap wrap)
{
    hc_corner_extremes(cells, ratios, width, height, hc_cones_channels(cones), wrap, HC_MINIMUM);
}
