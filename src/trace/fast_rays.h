/* Rays on their way into lanes, sixteen at a time: in cell coordinates, cut to where they can hit.
 * The loops over lanes become vector code: they choose, but never branch. What comes out of a ray
 * does not depend on the others. */
#ifndef HC_TRACE_FAST_RAYS_H
#define HC_TRACE_FAST_RAYS_H

#include "base/lanes.h"
#include "fast_exact.h"

#include <math.h>

typedef struct batch {
    double  origin[3][HC_LANES], direction[3][HC_LANES], inverse[2][HC_LANES];
    double  from[HC_LANES], to[HC_LANES], tmin[HC_LANES];
    int32_t meets[HC_LANES];
} batch;

static inline void place_axis(double *placed, const float *values, double scale, double shift)
{
    for (int i = 0; i < HC_LANES; i++) {
        placed[i] = (double)values[i] * scale + shift;
    }
}

static inline void place_rays(batch *b, const hc_fast *fast, const hc_ray *rays,
                              const int32_t *which)
{
    const double scale[3] = { fast->x.scale, fast->y.scale, fast->scale_z };
    const double shift[3] = { fast->x.shift, fast->y.shift, fast->shift_z };
    float        columns[HC_ROW_WORDS][HC_LANES];
    hc_columns(columns, rays, which);
    for (int i = 0; i < HC_LANES; i++) {
        const double length =
            fabs((double)columns[4][i]) + fabs((double)columns[5][i]) + fabs((double)columns[6][i]);
        const double sum = fabs((double)columns[0][i]) + fabs((double)columns[1][i])
                           + fabs((double)columns[2][i]) + fabs((double)columns[3][i]) + length;
        b->tmin[i]  = (double)columns[3][i];
        b->from[i]  = (double)columns[3][i];
        b->to[i]    = (double)columns[7][i];
        b->meets[i] = (sum < INFINITY) & (length > 0.0) & (b->to[i] >= b->from[i]);
    }
    for (int k = 0; k < 3; k++) {
        place_axis(b->origin[k], columns[k], scale[k], shift[k]);
        place_axis(b->direction[k], columns[4 + k], scale[k], 0.0);
    }
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < HC_LANES; i++) {
            b->inverse[k][i] = 1.0 / b->direction[k][i];
        }
    }
}

/* Cut to the field's ends along an unwrapped axis. */
static inline void cut_sides(batch *b, int axis, const hc_fast_axis *a)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double origin = b->origin[axis][i];
        const double low    = (a->low - origin) * b->inverse[axis][i];
        const double high   = (a->high - origin) * b->inverse[axis][i];
        const bool   along  = b->direction[axis][i] == 0.0;
        const bool   beyond = (origin < a->low) | (origin > a->high);
        const double enter  = along ? -INFINITY : lesser(low, high);
        const double leave  = along ? INFINITY : greater(low, high);
        b->from[i]          = greater(b->from[i], enter);
        b->to[i]            = lesser(b->to[i], leave);
        b->meets[i] &= !(along & beyond);
    }
}

/* Cut to HC_PERIODS_MAX periods of a wrapped axis, from where the ray is at most at height 1. */
static inline void cut_periods(batch *b, int axis, const hc_fast_axis *a)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double down  = (1.0 - b->origin[2][i]) / b->direction[2][i];
        const double start = b->direction[2][i] < 0.0 ? greater(b->from[i], down) : b->from[i];
        const double run   = HC_PERIODS_MAX * a->cells * fabs(b->inverse[axis][i]);
        b->to[i]           = lesser(b->to[i], start + run);
    }
}

/* Cut to the heights below the highest sample. */
static inline void cut_top(batch *b, double top)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double direction = b->direction[2][i];
        const double t         = (top - b->origin[2][i]) / direction;
        b->from[i]             = direction < 0.0 ? greater(b->from[i], t) : b->from[i];
        b->to[i]               = direction > 0.0 ? lesser(b->to[i], t) : b->to[i];
        b->meets[i] &= !((direction == 0.0) & (b->origin[2][i] > top));
    }
}

static inline void prepare(batch *b, const hc_fast *fast, const hc_ray *rays, const int32_t *which)
{
    place_rays(b, fast, rays, which);
    if (!fast->x.wrapped) {
        cut_sides(b, 0, &fast->x);
    }
    if (!fast->y.wrapped) {
        cut_sides(b, 1, &fast->y);
    }
    if (fast->x.wrapped) {
        cut_periods(b, 0, &fast->x);
    }
    if (fast->y.wrapped) {
        cut_periods(b, 1, &fast->y);
    }
    cut_top(b, fast->highest + HEADROOM);
    for (int i = 0; i < HC_LANES; i++) {
        b->meets[i] &= b->from[i] <= b->to[i];
    }
}

/* Ray i of a batch; false: it hits nothing. `inside` needs the sides, but not the top: a ray that
 * comes from above starts in the open. */
static inline bool take_ray(hc_fast_ray *r, const hc_fast *fast, const batch *b, int i)
{
    *r = (hc_fast_ray){ .origin    = { b->origin[0][i], b->origin[1][i], b->origin[2][i] },
                        .direction = { b->direction[0][i], b->direction[1][i], b->direction[2][i] },
                        .inverse   = { b->inverse[0][i], b->inverse[1][i] },
                        .from      = b->from[i],
                        .to        = b->to[i],
                        .inside    = b->from[i] == b->tmin[i] };
    return b->meets[i] != 0 && (!fast->open_sides || r->inside || hc_fast_emerge(fast, r));
}

#endif
