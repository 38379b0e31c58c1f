/* Extremes over the four corners of bilinear cells: two rows at a time, two texels at a time. */
#include "corners.h"

#include "extreme.h"

static inline void bake_row(float *out, const float *row, const float *next, int width,
                            int channels, bool wraps, hc_extreme extreme)
{
    const int inner = (width - 1) * channels;
    for (int i = 0; i < inner; i++) {
        const float left  = hc_extreme_of(row[i], next[i], extreme);
        const float right = hc_extreme_of(row[i + channels], next[i + channels], extreme);
        out[i]            = hc_extreme_of(left, right, extreme);
    }
    for (int i = inner; i < inner + channels; i++) {
        const int   beside = wraps ? i - inner : i;
        const float left   = hc_extreme_of(row[i], next[i], extreme);
        const float right  = hc_extreme_of(row[beside], next[beside], extreme);
        out[i]             = hc_extreme_of(left, right, extreme);
    }
}

void hc_corner_extremes(float *out, const float *values, int width, int height, int channels,
                        hc_wrap wrap, hc_extreme extreme)
{
    const bool   wrap_u = ((unsigned)wrap & HC_WRAP_U) != 0;
    const bool   wrap_v = ((unsigned)wrap & HC_WRAP_V) != 0;
    const size_t stride = (size_t)width * (size_t)channels;
    for (int y = 0; y < height; y++) {
        const int    below = y + 1 < height ? y + 1 : wrap_v ? 0 : y;
        const float *row   = values + (size_t)y * stride;
        const float *next  = values + (size_t)below * stride;
        if (extreme == HC_MAXIMUM) {
            bake_row(out + (size_t)y * stride, row, next, width, channels, wrap_u, HC_MAXIMUM);
        } else {
            bake_row(out + (size_t)y * stride, row, next, width, channels, wrap_u, HC_MINIMUM);
        }
    }
}
