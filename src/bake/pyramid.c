/* Pyramids of block maxima and minima, whole or the part above a changed rectangle.
 * After: Tevs, Ihrke, Seidel. Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height Field
 * Rendering. 2008; with the odd sizes' last column and row kept. */
#include "extreme.h"
#include "span.h"

#include <heightcast/bake.h>

#include <string.h>

static hc_span parents(hc_span children, int coarse_side)
{
    const int end = coarse_side - 1;
    return (hc_span){ children.first >> 1 < end ? children.first >> 1 : end,
                      children.last >> 1 < end ? children.last >> 1 : end };
}

/* Merge one row of children into a row of parents; `fresh` parents hold nothing yet. */
static inline void merge_row(float *coarse, int coarse_side, const float *fine, int fine_side,
                             hc_span columns, bool fresh, hc_extreme extreme)
{
    const int end = coarse_side - 1;
    for (int x = columns.first; x <= columns.last && x < end; x++) {
        const float pair = hc_extreme_of(fine[2 * x], fine[2 * x + 1], extreme);
        coarse[x]        = fresh ? pair : hc_extreme_of(coarse[x], pair, extreme);
    }
    if (columns.last == end) {
        float last = fresh ? fine[2 * end] : coarse[end];
        for (int x = 2 * end; x < fine_side; x++) {
            last = hc_extreme_of(last, fine[x], extreme);
        }
        coarse[end] = last;
    }
}

static inline void merge_level(const hc_pyramid *pyramid, int level, hc_span columns, hc_span rows,
                               hc_extreme extreme)
{
    int          fine_width, width, height;
    const float *fine   = hc_pyramid_level(pyramid, level - 1, &fine_width, NULL);
    float       *coarse = hc_pyramid_level(pyramid, level, &width, &height);
    for (int y = rows.first; y <= rows.last; y++) {
        const hc_span below = hc_block_children(pyramid->height, level, y);
        for (int from = below.first; from <= below.last; from++) {
            merge_row(coarse + (size_t)y * (size_t)width, width,
                      fine + (size_t)from * (size_t)fine_width, fine_width, columns,
                      from == below.first, extreme);
        }
    }
}

void hc_update_pyramid(hc_pyramid *pyramid, const float *heights, hc_rect changed,
                       hc_extreme extreme)
{
    if (changed.width <= 0 || changed.height <= 0) {
        return;
    }
    if (heights != pyramid->values) {
        for (int y = changed.y; y < changed.y + changed.height; y++) {
            const size_t start = (size_t)y * (size_t)pyramid->width + (size_t)changed.x;
            memcpy(pyramid->values + start, heights + start, (size_t)changed.width * sizeof(float));
        }
    }
    hc_span columns = { changed.x, changed.x + changed.width - 1 };
    hc_span rows    = { changed.y, changed.y + changed.height - 1 };
    for (int level = 1; level < pyramid->levels; level++) {
        columns = parents(columns, hc_level_side(pyramid->width, level));
        rows    = parents(rows, hc_level_side(pyramid->height, level));
        if (extreme == HC_MAXIMUM) {
            merge_level(pyramid, level, columns, rows, HC_MAXIMUM);
        } else {
            merge_level(pyramid, level, columns, rows, HC_MINIMUM);
        }
    }
}

void hc_bake_pyramid(hc_pyramid *pyramid, float *values, const float *heights, int width,
                     int height, hc_extreme extreme)
{
    *pyramid = (hc_pyramid){ .values = values,
                             .width  = width,
                             .height = height,
                             .levels = hc_pyramid_levels(width, height) };
    hc_update_pyramid(pyramid, heights, (hc_rect){ 0, 0, width, height }, extreme);
}
