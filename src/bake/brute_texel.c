/* The canonical formula over all samples of a field for one texel. */
#include "brute_texel.h"

#include "canonical.h"
#include "cone_job.h"

#include <stdlib.h>

enum { LANES = 16 };

/* Samples that count: all at their nearest images, or those to one side, the texel's own line among
 * them. */
typedef enum side { EITHER = 0, AFTER, BEFORE } side;

/* Distance of sample `to` as seen from `from`, or -1 if it is not on that side. */
static int distance(int from, int to, int size, bool wraps, side looking)
{
    const int apart = looking == BEFORE ? from - to : to - from;
    if (looking == EITHER) {
        const int near = abs(apart);
        return wraps && size - near < near ? size - near : near;
    }
    return apart >= 0 ? apart : wraps ? apart + size : -1;
}

static inline float weight(bool l2, int i, int j, float step_u, float step_v)
{
    return l2 ? hc_weight_l2(i, j, step_u, step_v) : hc_weight_l1(i, j, step_u, step_v);
}

/* A maximum per lane, so that compilers make vector code of it; it does not depend on the order.
 * The texel itself comes to 0 * infinity, which no comparison takes. */
static inline float steepest_in_row(const float *row, const int *columns, int count, int j,
                                    float height, float step_u, float step_v, bool l2, float known)
{
    float best[LANES] = { 0.0F };
    int   x           = 0;
    for (; x + LANES <= count; x += LANES) {
        for (int lane = 0; lane < LANES; lane++) {
            const float rise = row[x + lane] - height;
            const float s    = rise * weight(l2, columns[x + lane], j, step_u, step_v);
            best[lane]       = s > best[lane] ? s : best[lane];
        }
    }
    for (; x < count; x++) {
        const float s = (row[x] - height) * weight(l2, columns[x], j, step_u, step_v);
        known         = s > known ? s : known;
    }
    for (int lane = 0; lane < LANES; lane++) {
        known = best[lane] > known ? best[lane] : known;
    }
    return known;
}

static float steepest(const hc_brute_texel *field, int x, int y, side across, side down,
                      float step_u, float step_v, bool l2)
{
    const size_t width  = (size_t)field->width;
    const float  height = field->heights[(size_t)y * width + (size_t)x];
    const int    first  = across == AFTER && !field->wrap_u ? x : 0;
    const int    end    = across == BEFORE && !field->wrap_u ? x + 1 : field->width;
    float        best   = 0.0F;
    for (int column = first; column < end; column++) {
        field->columns[column] = distance(x, column, field->width, field->wrap_u, across);
    }
    for (int row = 0; row < field->height; row++) {
        const int j = distance(y, row, field->height, field->wrap_v, down);
        if (j >= 0) {
            const float *line    = field->heights + (size_t)row * width + first;
            const int   *columns = field->columns + first;
            best = l2 ? steepest_in_row(line, columns, end - first, j, height, step_u, step_v, true,
                                        best)
                      : steepest_in_row(line, columns, end - first, j, height, step_u, step_v,
                                        false, best);
        }
    }
    return best;
}

static void aniso_ratios(const hc_brute_texel *field, int x, int y, float *ratios)
{
    float best[HC_ANISO_COUNT];
    for (int a = 0; a < HC_ANISO_COUNT; a++) {
        const float wide = hc_aniso_elongation[a];
        best[a] = steepest(field, x, y, EITHER, EITHER, field->step_u * wide, field->step_v / wide,
                           false);
    }
    hc_aniso_choose(ratios, best);
}

void hc_brute_ratios(const hc_brute_texel *field, int x, int y, hc_cones cones, float *ratios)
{
    const float u = field->step_u;
    const float v = field->step_v;
    switch (cones) {
    case HC_CONES_L2:
        ratios[0] = hc_ratio(steepest(field, x, y, EITHER, EITHER, u, v, true));
        break;
    case HC_CONES_L1:
        ratios[0] = hc_ratio(steepest(field, x, y, EITHER, EITHER, u, v, false));
        break;
    case HC_CONES_QUAD:
        for (int quadrant = 0; quadrant < 4; quadrant++) {
            ratios[quadrant] = hc_ratio(steepest(field, x, y, quadrant & 1 ? BEFORE : AFTER,
                                                 quadrant & 2 ? BEFORE : AFTER, u, v, false));
        }
        break;
    case HC_CONES_ANISO: aniso_ratios(field, x, y, ratios); break;
    }
}

float hc_brute_excess(const hc_brute_texel *field, int x, int y, float ratio_u, float ratio_v)
{
    return steepest(field, x, y, EITHER, EITHER, field->step_u / ratio_u, field->step_v / ratio_v,
                    false);
}
