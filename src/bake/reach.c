#include "reach.h"

#include "canonical.h"

#include <math.h>

/* Outweighs HC_RATIO_SAFETY and all rounding between a steepness and its stored ratio. */
static const double LOWER = 1.0 - 0x1p-18;

static double end_at(int i)
{
    return i == 0 ? 0.0 : ldexp(1.0, i - 1);
}

/* Slope that a sample must beat in each pass. */
static void slopes_of(double *slopes, const hc_exact_plan *plan, const float *ratios,
                      float max_ratio)
{
    if (plan->cones != HC_CONES_ANISO) {
        for (int i = 0; i < plan->count; i++) {
            slopes[i] = LOWER / (double)ratios[i];
        }
        return;
    }
    /* The elongations that were not chosen are unknown, but none has a smaller sum of slopes. A
     * ratio that was cut at max_ratio says only that its slope is not large. */
    const bool   cut_u = max_ratio > 0.0F && ratios[0] >= max_ratio;
    const bool   cut_v = max_ratio > 0.0F && ratios[1] >= max_ratio;
    const double sum =
        (cut_u ? 0.0 : 1.0 / (double)ratios[0]) + (cut_v ? 0.0 : 1.0 / (double)ratios[1]);
    for (int i = 0; i < plan->count; i++) {
        const double a = (double)hc_aniso_elongation[i];
        slopes[i]      = LOWER * sum / (a + 1.0 / a);
    }
    const int plain = plan->count / 2; /* its ratio is stored as well */
    slopes[plain]   = fmin(slopes[plain], LOWER / (double)ratios[2]);
}

static float sample_at(const hc_block_tree *tree, int x, int y)
{
    return hc_tree_node(&tree->levels[0], x / 4, y / 4)[y % 4 * 4 + x % 4];
}

void hc_reach_of(hc_reach *reaches, const hc_exact_plan *plan, const float *ratios, float max_ratio,
                 hc_rect rect)
{
    const size_t channels = (size_t)hc_cones_channels(plan->cones);
    for (int i = 0; i < plan->count; i++) {
        for (int k = 0; k < HC_REACH_ENDS; k++) {
            reaches[i].height[k] = INFINITY;
        }
    }
    for (int y = rect.y; y < rect.y + rect.height; y++) {
        for (int x = rect.x; x < rect.x + rect.width; x++) {
            const size_t at     = (size_t)y * (size_t)plan->tree.width + (size_t)x;
            const double height = (double)sample_at(&plan->tree, x, y);
            double       slopes[HC_ANISO_COUNT];
            slopes_of(slopes, plan, ratios + at * channels, max_ratio);
            for (int i = 0; i < plan->count; i++) {
                const double rise = slopes[i] * (double)plan->passes[i].step_u;
                for (int k = 0; k < HC_REACH_ENDS; k++) {
                    const double needed = height + rise * end_at(k);
                    reaches[i].height[k] =
                        needed < reaches[i].height[k] ? needed : reaches[i].height[k];
                }
            }
        }
    }
}

/* Between two ends a concave function lies above its chord; beyond the last it does not fall. */
static double needed_at(const hc_reach *reach, double distance)
{
    int k = 0;
    while (k + 2 < HC_REACH_ENDS && distance >= end_at(k + 1)) {
        k++;
    }
    const double start = end_at(k);
    const double end   = end_at(k + 1);
    if (distance >= end) {
        return reach->height[k + 1];
    }
    return reach->height[k]
           + (reach->height[k + 1] - reach->height[k]) * ((distance - start) / (end - start));
}

/* Samples between two ranges that begin at `from` and `to`; negative `sign`: only if `to` reaches
 * to the left of `from`'s last, positive: to the right of its first. -1 if it does not. */
static int gap(int from, int from_count, int to, int to_count, int sign)
{
    const int after  = to - (from + from_count - 1);
    const int before = from - (to + to_count - 1);
    if ((sign > 0 && before > 0) || (sign < 0 && after > 0)) {
        return -1;
    }
    return after > 0 ? after : before > 0 ? before : 0;
}

static bool image_included(const hc_reach *reach, const hc_exact_pass *pass, hc_rect rect,
                           hc_rect image, float top)
{
    const int across = gap(rect.x, rect.width, image.x, image.width, pass->sign_u);
    const int down   = gap(rect.y, rect.height, image.y, image.height, pass->sign_v);
    if (across < 0 || down < 0) {
        return false;
    }
    const double aspect = (double)pass->step_v / (double)pass->step_u;
    const double rows   = down * aspect;
    const double distance =
        pass->diamond ? across + rows : sqrt((double)across * across + rows * rows);
    return (double)top >= needed_at(reach, distance * (1.0 - 0x1p-22)) - 0x1p-40;
}

bool hc_reach_includes(const hc_reach *reach, const hc_exact_pass *pass, hc_rect rect,
                       const hc_change *change)
{
    for (int v = -(int)pass->wrap_v; v <= (int)pass->wrap_v; v++) {
        for (int u = -(int)pass->wrap_u; u <= (int)pass->wrap_u; u++) {
            hc_rect image = change->rect;
            image.x += u * pass->tree->width;
            image.y += v * pass->tree->height;
            if (image_included(reach, pass, rect, image, change->top)) {
                return true;
            }
        }
    }
    return false;
}
