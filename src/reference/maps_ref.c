/* Blocks, cells, gradients and codes, each from its definition: docs/algorithms.md, sections 6, 7,
 * 14 and 15. */
#include "reference.h"

#include <math.h>

int hc_ref_level_size(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

int hc_ref_block_of(int sample, int level, int size)
{
    const int last  = hc_ref_level_size(size, level) - 1;
    const int block = sample >> level;
    return block < last ? block : last;
}

static float extreme_of(float a, float b, hc_ref_extreme extreme)
{
    return extreme == HC_REF_MAXIMUM ? fmaxf(a, b) : fminf(a, b);
}

float hc_ref_block_extreme(const float *heights, int width, int height, int level, int bx, int by,
                           hc_ref_extreme extreme)
{
    float found = extreme == HC_REF_MAXIMUM ? -INFINITY : INFINITY;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            if (hc_ref_block_of(x, level, width) == bx && hc_ref_block_of(y, level, height) == by) {
                found = extreme_of(found, heights[y * width + x], extreme);
            }
        }
    }
    return found;
}

static int next_sample(int sample, int size, bool wraps)
{
    if (sample + 1 < size) {
        return sample + 1;
    }
    return wraps ? 0 : sample;
}

float hc_ref_cell_extreme(const float *values, int channels, int channel, int width, int height,
                          hc_wrap wrap, int x, int y, hc_ref_extreme extreme)
{
    const int columns[2] = { x, next_sample(x, width, (wrap & HC_WRAP_U) != 0) };
    const int rows[2]    = { y, next_sample(y, height, (wrap & HC_WRAP_V) != 0) };
    float     found      = values[(y * width + x) * channels + channel];
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            const int corner = (rows[j] * width + columns[i]) * channels + channel;
            found            = extreme_of(found, values[corner], extreme);
        }
    }
    return found;
}

/* Slope through the neighbours of sample `at` of `size`, `stride` values apart; one-sided at an
 * edge that does not wrap. `line` is the first sample of the row or column. */
static double slope(const float *line, int stride, int at, int size, bool wraps, double step)
{
    int before = at - 1;
    int after  = at + 1;
    if (!wraps) {
        before = before < 0 ? 0 : before;
        after  = after > size - 1 ? size - 1 : after;
    }
    if (size == 1 || after == before) {
        return 0.0;
    }
    const double high = (double)line[(after % size) * stride];
    const double low  = (double)line[((before + size) % size) * stride];
    return (high - low) / ((after - before) * step);
}

void hc_ref_gradient(double gradient[2], const hc_field *field, int x, int y)
{
    const float *row    = field->heights + y * field->width;
    const float *column = field->heights + x;
    gradient[0] =
        slope(row, 1, x, field->width, (field->wrap & HC_WRAP_U) != 0, hc_field_step_u(field));
    gradient[1] = slope(column, field->width, y, field->height, (field->wrap & HC_WRAP_V) != 0,
                        hc_field_step_v(field));
}

static int largest_code(int bits)
{
    return (1 << bits) - 1;
}

int hc_ref_height_code(double height, int bits)
{
    return (int)floor(height * largest_code(bits) + 0.5);
}

double hc_ref_ratio_of_code(int code, double max_ratio, int bits)
{
    const double root = (double)code / largest_code(bits);
    return max_ratio * root * root;
}

int hc_ref_ratio_code(double ratio, double max_ratio, int bits)
{
    int code = largest_code(bits);
    while (code > 0 && hc_ref_ratio_of_code(code, max_ratio, bits) > ratio) {
        code--;
    }
    return code;
}

int hc_ref_slope_code(double slope, int bits)
{
    const int    bias  = largest_code(bits) / 2;
    const double steps = fmin(ceil(fabs(slope) - 0.5), bias);
    return bias + (int)(slope < 0.0 ? -steps : steps);
}
