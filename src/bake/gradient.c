/* Gradients by differences of neighbouring samples. */
#include "slope.h"

#include <heightcast/bake.h>

/* Rise per texture unit. In double, so that the difference of two floats is exact and only the
 * result is rounded to float. */
static float slope(float low, float high, double per_step, int steps)
{
    return steps > 0 ? (float)(((double)high - (double)low) * (per_step / steps)) : 0.0F;
}

static void bake_row(float *out, const hc_field *field, int y)
{
    const bool          wrap_u = ((unsigned)field->wrap & HC_WRAP_U) != 0;
    const bool          wrap_v = ((unsigned)field->wrap & HC_WRAP_V) != 0;
    const int           width  = field->width;
    const double        per_u  = 1.0 / hc_field_step_u(field);
    const double        per_v  = 1.0 / hc_field_step_v(field);
    const hc_slope_pair rows   = hc_slope_pair_at(y, field->height, wrap_v);
    const float        *row    = field->heights + (size_t)y * (size_t)width;
    const float        *low    = field->heights + (size_t)rows.low * (size_t)width;
    const float        *high   = field->heights + (size_t)rows.high * (size_t)width;
    for (int x = 0; x < width; x++) {
        out[2 * x + 1] = slope(low[x], high[x], per_v, rows.steps);
    }
    for (int x = 1; x < width - 1; x++) {
        out[2 * x] = slope(row[x - 1], row[x + 1], per_u, 2);
    }
    for (int x = 0; x<width; x += width> 1 ? width - 1 : 1) {
        const hc_slope_pair ends = hc_slope_pair_at(x, width, wrap_u);
        out[2 * x]               = slope(row[ends.low], row[ends.high], per_u, ends.steps);
    }
}

void hc_bake_gradient(float *gradients, const hc_field *field)
{
    for (int y = 0; y < field->height; y++) {
        bake_row(gradients + 2 * (size_t)y * (size_t)field->width, field, y);
    }
}
