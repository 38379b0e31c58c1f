/* What the 2006 paper's appendix B writes into a map, told side by side of each square.
 * docs/algorithms.md, section 16. Not in double: byte for byte needs the original's types, which
 * are float but where it multiplies or divides by a double constant. */
#include "reference.h"

#include <math.h>

typedef struct image {
    const uint8_t *heights;
    int            width, height;
    bool           tiles_u, tiles_v;
} image;

static int clipped(int at, int size)
{
    return at < 0 ? 0 : at > size - 1 ? size - 1 : at;
}

/* The texel at (column, row), counted as `right` columns and `down` rows away. */
static void look(const image *im, int x, int y, int column, int row, int right, int down,
                 float *least)
{
    const float apex    = (float)(im->heights[y * im->width + x] / 255.0);
    const float rise    = (float)(im->heights[row * im->width + column] / 255.0 - (double)apex);
    const float du      = (float)right * (float)(1.0 / im->width);
    const float dv      = (float)down * (float)(1.0 / im->height);
    const float squared = du * du + dv * dv;
    if (rise > 0.0F && rise * rise * *least > squared) {
        *least = squared / (rise * rise);
    }
}

/* West or east side: its column is brought back into the image if that tiles, its rows are cut. */
static void look_along_column(const image *im, int x, int y, int right, int radius, float *least)
{
    int column = x + right;
    while (im->tiles_u && column < 0) {
        column += im->width;
    }
    while (im->tiles_u && column >= im->width) {
        column -= im->width;
    }
    if (column < 0 || column >= im->width) {
        return;
    }
    for (int row = clipped(y - radius + 1, im->height); row <= clipped(y + radius - 1, im->height);
         row++) {
        look(im, x, y, column, row, right, row - y, least);
    }
}

/* North or south side, with the corners. */
static void look_along_row(const image *im, int x, int y, int down, int radius, float *least)
{
    int row = y + down;
    while (im->tiles_v && row < 0) {
        row += im->height;
    }
    while (im->tiles_v && row >= im->height) {
        row -= im->height;
    }
    if (row < 0 || row >= im->height) {
        return;
    }
    for (int column = clipped(x - radius, im->width); column <= clipped(x + radius, im->width);
         column++) {
        look(im, x, y, column, row, column - x, down, least);
    }
}

static bool goes_on(const image *im, int x, int y, int radius, float least)
{
    const float  apex = (float)(im->heights[y * im->width + x] / 255.0);
    const double room = 1.0 - (double)apex;
    return radius * radius <= 1.1 * 1.1 * room * room * (double)least * im->width * im->height
           && radius <= 1.1 * room * im->width && radius <= 1.1 * room * im->height;
}

static int ratio_code(const image *im, int x, int y)
{
    float least = 1.0F;
    for (int radius = 1; goes_on(im, x, y, radius, least); radius++) {
        look_along_column(im, x, y, -radius, radius, &least);
        look_along_column(im, x, y, radius, radius, &least);
        look_along_row(im, x, y, -radius, radius, &least);
        look_along_row(im, x, y, radius, radius, &least);
    }
    const int code = (int)(255.0 * (double)sqrtf(sqrtf(least)) + 0.5);
    return code < 1 ? 1 : code;
}

/* Halved once at the two ends and once again everywhere, cut towards 0 both times. */
static int slope(const uint8_t *line, int stride, int at, int size)
{
    if (at == 0) {
        return (line[stride] - line[0]) / 2 / 2;
    }
    if (at == size - 1) {
        return (line[at * stride] - line[(at - 1) * stride]) / 2 / 2;
    }
    return (line[(at + 1) * stride] - line[(at - 1) * stride]) / 2;
}

void hc_ref_dummer2006(int rgba[4], const uint8_t *heights, int width, int height, hc_wrap wrap,
                       int x, int y)
{
    const image im = { .heights = heights,
                       .width   = width,
                       .height  = height,
                       .tiles_u = (wrap & HC_WRAP_U) != 0,
                       .tiles_v = (wrap & HC_WRAP_V) != 0 };
    rgba[0]        = heights[y * width + x];
    rgba[1]        = ratio_code(&im, x, y);
    rgba[2]        = 127 + slope(heights + y * width, 1, x, width);
    rgba[3]        = 127 - slope(heights + x, width, y, height);
}
