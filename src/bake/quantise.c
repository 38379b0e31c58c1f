/* Heights, ratios and slopes as integer codes. */
#include "quantise.h"

#include "maps/codes.h"

#include <math.h>

int hc_height_code(float height, int bits)
{
    /* the product of 24 by 16 bits and the sum are exact in double */
    return (int)((double)height * hc_code_max(bits) + 0.5);
}

int hc_height_code_up(float height, int bits)
{
    const int code = hc_height_code(height, bits);
    return hc_code_height(code, bits) < height ? code + 1 : code;
}

int hc_height_code_down(float height, int bits)
{
    const int code = hc_height_code(height, bits);
    return hc_code_height(code, bits) > height ? code - 1 : code;
}

int hc_ratio_code(float ratio, int bits, float max_ratio)
{
    const int   most     = hc_code_max(bits);
    const float fraction = ratio < max_ratio ? ratio / max_ratio : 1.0F;
    int         code     = (int)(sqrtf(fraction) * (float)most);
    code                 = code < most ? code : most;
    /* the guess may be off by rounding, either way */
    while (code < most && hc_code_ratio(code + 1, bits, max_ratio) <= ratio) {
        code++;
    }
    while (code > 0 && hc_code_ratio(code, bits, max_ratio) > ratio) {
        code--;
    }
    return code;
}

int hc_slope_bias(int bits)
{
    return hc_code_max(bits) / 2;
}

int hc_slope_code(double slope, int bits)
{
    const int    bias    = hc_slope_bias(bits);
    const double steep   = fabs(slope);
    const int    rounded = steep < bias ? (int)ceil(steep - 0.5) : bias;
    return slope < 0.0 ? bias - rounded : bias + rounded;
}

void hc_round_heights(float *rounded, const float *heights, size_t count, int bits)
{
    for (size_t i = 0; i < count; i++) {
        rounded[i] = hc_code_height(hc_height_code(heights[i], bits), bits);
    }
}
