/* Rays on their way into lanes, sixteen at a time: in cell coordinates, cut to where they can hit.
 * The loops over lanes become vector code: they choose, but never branch. What comes out of a ray
 * does not depend on the others. */
#ifndef HC_TRACE_FAST_RAYS_H
#define HC_TRACE_FAST_RAYS_H

#include "base/lanes.h"
#include "fast_exact.h"

#include <math.h>

static const int32_t hc_lane[16] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };

/* Periods that double precision bears without a thought for them. */
static const double FAR_PERIODS = 4.0 * HC_PERIODS_MAX;

typedef struct batch {
    HC_ROW(double) origin[3][HC_LANES];
    double direction[3][HC_LANES], inverse[2][HC_LANES];
    double run[HC_LANES]; /* cells gone sideways per t                 */
    /* from > to, or `to` is NaN: it cannot hit anything. What cuts a ray stands first in greater()
     * and lesser(), so that this stays as it is. */
    double from[HC_LANES], to[HC_LANES];
} batch;

static inline void place_axis(double *placed, const float *values, double scale, double shift)
{
    for (int i = 0; i < HC_LANES; i++) {
        placed[i] = (double)values[i] * scale + shift;
    }
}

/* Rays all of whose numbers are finite, and that go somewhere. */
static inline unsigned find_good(float columns[HC_ROW_WORDS][HC_LANES])
{
    const hc_v none = hc_v_set(0.0F);
    hc_v       sum  = none; /* 0 or NaN */
    hc_i       bits = hc_i_set(0);
    for (int k = 0; k < 7; k++) {
        sum = hc_v_about_muladd(hc_v_load(columns[k]), none, sum);
    }
    for (int k = 4; k < 7; k++) {
        bits = hc_i_or(bits, hc_v_bits(hc_v_load(columns[k])));
    }
    return hc_v_greater(hc_v_set(1.0F), sum)
           & hc_i_differ(hc_i_left(bits, hc_i_set(1)), hc_i_set(0));
}

static inline void place_rays(batch *b, const hc_fast *fast, float columns[HC_ROW_WORDS][HC_LANES])
{
    const double   scale[3] = { fast->x.scale, fast->y.scale, fast->scale_z };
    const double   shift[3] = { fast->x.shift, fast->y.shift, fast->shift_z };
    const unsigned good     = find_good(columns);
    hc_v_store(columns[3], hc_v_pick(good, hc_v_load(columns[3]), hc_v_set(INFINITY)));
    for (int i = 0; i < HC_LANES; i++) {
        b->from[i] = (double)columns[3][i];
        b->to[i]   = lesser(HC_FAST_T_MAX, (double)columns[7][i]);
    }
    for (int k = 0; k < 3; k++) {
        place_axis(b->origin[k], columns[k], scale[k], shift[k]);
        place_axis(b->direction[k], columns[4 + k], scale[k], 0.0);
    }
    for (int i = 0; i < HC_LANES; i++) {
        b->inverse[0][i] = 1.0 / b->direction[0][i];
        b->inverse[1][i] = 1.0 / b->direction[1][i];
        b->run[i]        = fabs(b->direction[0][i]) + fabs(b->direction[1][i]);
    }
}

/* A loop of its own: of one that both chooses and cuts gcc makes branches. */
static inline void cut(batch *b, const double *enter, const double *leave)
{
    for (int i = 0; i < HC_LANES; i++) {
        b->from[i] = greater(enter[i], b->from[i]);
        b->to[i]   = lesser(leave[i], b->to[i]);
    }
}

/* Cut to the field's ends along an unwrapped axis. A ray along them meets them at infinity, or,
 * where it is on one of them, at NaN, which cuts nothing. */
static inline void cut_sides(batch *b, int axis, const hc_fast_axis *a)
{
    HC_ROW(double) enter[HC_LANES];
    HC_ROW(double) leave[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        const double origin  = b->origin[axis][i];
        const double inverse = b->inverse[axis][i];
        const double low     = (a->low - origin) * inverse;
        const double high    = (a->high - origin) * inverse;
        const bool   up      = inverse > 0.0;
        enter[i]             = up ? low : high;
        leave[i]             = up ? high : low;
    }
    cut(b, enter, leave);
}

/* Cut to HC_PERIODS_MAX periods of a wrapped axis, from where the ray is at most at height 1. */
static inline void cut_periods(batch *b, int axis, const hc_fast_axis *a)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double down  = (1.0 - b->origin[2][i]) / b->direction[2][i];
        const double start = b->direction[2][i] < 0.0 ? greater(b->from[i], down) : b->from[i];
        const double run   = HC_PERIODS_MAX * a->cells * fabs(b->inverse[axis][i]);
        b->to[i]           = lesser(start + run, b->to[i]);
    }
}

/* Cut to the heights below the highest sample. */
static inline void cut_top(batch *b, double top)
{
    HC_ROW(double) enter[HC_LANES];
    HC_ROW(double) leave[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        const double direction = b->direction[2][i];
        const double origin    = b->origin[2][i];
        const double t         = (top - origin) / direction;
        const bool   over      = (direction == 0.0) & (origin > top);
        const double never     = over ? INFINITY : -INFINITY;
        enter[i]               = direction < 0.0 ? t : never;
        leave[i]               = direction > 0.0 ? t : INFINITY;
    }
    cut(b, enter, leave);
}

/* `columns`: the rays' words, each in all lanes. */
static inline void prepare(batch *b, const hc_fast *fast, float columns[HC_ROW_WORDS][HC_LANES])
{
    place_rays(b, fast, columns);
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
}

/* Those of `rays` that are named. */
static inline void prepare_some(batch *b, const hc_fast *fast, const hc_ray *rays,
                                const int32_t *which)
{
    float columns[HC_ROW_WORDS][HC_LANES];
    hc_columns(columns, rays, which);
    prepare(b, fast, columns);
}

/* The first of `rays`, and its last again in other lanes. */
static inline void prepare_next(batch *b, const hc_fast *fast, const hc_ray *rays, int count)
{
    float columns[HC_ROW_WORDS][HC_LANES];
    if (count == HC_LANES) {
        hc_columns(columns, rays, hc_lane);
    } else {
        int32_t which[HC_LANES];
        hc_i_store(which, hc_i_min(hc_i_load(hc_lane), hc_i_set(count - 1)));
        hc_columns(columns, rays, which);
    }
    prepare(b, fast, columns);
}

/* Along a repeating axis it begins or ends too far away to know its place. */
static inline bool goes_far(const batch *b, int axis, const hc_fast_axis *a, int i)
{
    const double way = greater(fabs(b->from[i]), fabs(b->to[i])) * fabs(b->direction[axis][i]);
    return a->wrapped && fabs(b->origin[axis][i]) + way > FAR_PERIODS * a->cells;
}

/* Ray i of a batch, which is `ray`. `inside` needs the sides, but not the top: a ray that comes
 * from above starts in the open. */
static inline hc_fast_fate take_ray(hc_fast_ray *r, const hc_fast *fast, const batch *b, int i,
                                    const hc_ray *ray)
{
    const bool inside = b->from[i] == (double)ray->tmin;
    if ((fast->open_sides && !inside) || goes_far(b, 0, &fast->x, i)
        || goes_far(b, 1, &fast->y, i)) {
        return hc_fast_enter(r, fast, ray);
    }
    *r = (hc_fast_ray){ .origin    = { b->origin[0][i], b->origin[1][i], b->origin[2][i] },
                        .direction = { b->direction[0][i], b->direction[1][i], b->direction[2][i] },
                        .inverse   = { b->inverse[0][i], b->inverse[1][i] },
                        .from      = b->from[i],
                        .to        = b->to[i],
                        .inside    = inside };
    return b->from[i] <= b->to[i] ? HC_FAST_MARCHES : HC_FAST_MISSES;
}

#endif
