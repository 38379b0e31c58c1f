/* Rays on their way into lanes, sixteen at a time: in cell coordinates, cut to where they can hit.
 * What comes out of a ray does not depend on the others. */
#ifndef HC_TRACE_FAST_RAYS_H
#define HC_TRACE_FAST_RAYS_H

#include "base/doubles.h"
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
    /* from > to, or `to` is NaN: it cannot hit anything. What cuts a ray stands first in hc_d_max()
     * and hc_d_min(), so that this stays as it is. */
    double from[HC_LANES], to[HC_LANES];
} batch;

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

/* Parts of rays' ways, by the times of their ends. */
typedef struct ways {
    hc_d from, to;
} ways;

/* Between two walls across an axis. A ray that runs along them comes in and leaves at infinity, or
 * never; where it is on one of them, at NaN. */
static inline ways find_slab(hc_d low_wall, hc_d high_wall, hc_d origin, hc_d inverse)
{
    const hc_d none = hc_d_set(0.0);
    const hc_d low  = (low_wall - origin) * inverse;
    const hc_d high = (high_wall - origin) * inverse;
    return (ways){ hc_d_if_less(none, inverse, low, high), hc_d_if_less(none, inverse, high, low) };
}

/* NaN cuts nothing. */
static inline ways cut(ways w, ways within)
{
    return (ways){ hc_d_max(within.from, w.from), hc_d_min(within.to, w.to) };
}

/* Cut to the field's ends along an unwrapped axis. */
static inline ways cut_sides(ways w, const hc_fast_axis *a, hc_d origin, hc_d inverse)
{
    return cut(w, find_slab(hc_d_set(a->low), hc_d_set(a->high), origin, inverse));
}

/* Cut to HC_PERIODS_MAX periods of a wrapped axis, from where the ray is at most at height 1. */
static inline ways cut_periods(ways w, const hc_fast_axis *a, hc_d inverse, hc_d z, hc_d dz)
{
    const hc_d down  = hc_d_max(w.from, (hc_d_set(1.0) - z) / dz);
    const hc_d start = hc_d_if_less(dz, hc_d_set(0.0), down, w.from);
    const hc_d run   = hc_d_set((double)HC_PERIODS_MAX * a->cells) * hc_d_abs(inverse);
    return (ways){ w.from, hc_d_min(start + run, w.to) };
}

/* Cut to the heights below the highest sample. */
static inline ways cut_top(ways w, double highest, hc_d z, hc_d dz)
{
    const hc_d none   = hc_d_set(0.0);
    const hc_d never  = hc_d_set(INFINITY);
    const hc_d always = hc_d_set(-INFINITY);
    const hc_d top    = hc_d_set(highest);
    const hc_d t      = (top - z) / dz;
    const hc_d level  = hc_d_if_less(top, z, never, always);
    const hc_d rising = hc_d_if_less(none, dz, always, level);
    return cut(w, (ways){ hc_d_if_less(dz, none, t, rising), hc_d_if_less(none, dz, t, never) });
}

/* Lanes from `lane` on of a batch. */
static inline void prepare_part(batch *b, int lane, const hc_fast *fast,
                                float columns[HC_ROW_WORDS][HC_LANES])
{
    const hc_d none      = hc_d_set(0.0); /* -0 becomes 0 */
    const hc_d scale[3]  = { hc_d_set(fast->x.scale), hc_d_set(fast->y.scale),
                             hc_d_set(fast->scale_z) };
    const hc_d x         = hc_d_of_floats(columns[0] + lane) * scale[0] + hc_d_set(fast->x.shift);
    const hc_d y         = hc_d_of_floats(columns[1] + lane) * scale[1] + hc_d_set(fast->y.shift);
    const hc_d z         = hc_d_of_floats(columns[2] + lane) * scale[2] + hc_d_set(fast->shift_z);
    const hc_d dx        = hc_d_of_floats(columns[4] + lane) * scale[0] + none;
    const hc_d dy        = hc_d_of_floats(columns[5] + lane) * scale[1] + none;
    const hc_d dz        = hc_d_of_floats(columns[6] + lane) * scale[2] + none;
    const hc_d inverse_x = hc_d_set(1.0) / dx;
    const hc_d inverse_y = hc_d_set(1.0) / dy;
    const hc_d last      = hc_d_of_floats(columns[7] + lane);
    ways       w = { hc_d_of_floats(columns[3] + lane), hc_d_min(hc_d_set(HC_FAST_T_MAX), last) };
    if (!fast->x.wrapped) {
        w = cut_sides(w, &fast->x, x, inverse_x);
    }
    if (!fast->y.wrapped) {
        w = cut_sides(w, &fast->y, y, inverse_y);
    }
    if (fast->x.wrapped) {
        w = cut_periods(w, &fast->x, inverse_x, z, dz);
    }
    if (fast->y.wrapped) {
        w = cut_periods(w, &fast->y, inverse_y, z, dz);
    }
    w = cut_top(w, fast->highest + HEADROOM, z, dz);
    hc_d_store(b->origin[0] + lane, x);
    hc_d_store(b->origin[1] + lane, y);
    hc_d_store(b->origin[2] + lane, z);
    hc_d_store(b->direction[0] + lane, dx);
    hc_d_store(b->direction[1] + lane, dy);
    hc_d_store(b->direction[2] + lane, dz);
    hc_d_store(b->inverse[0] + lane, inverse_x);
    hc_d_store(b->inverse[1] + lane, inverse_y);
    hc_d_store(b->run + lane, hc_d_abs(dx) + hc_d_abs(dy));
    hc_d_store(b->from + lane, w.from);
    hc_d_store(b->to + lane, w.to);
}

/* `columns`: the rays' words, each in all lanes. */
static inline void prepare(batch *b, const hc_fast *fast, float columns[HC_ROW_WORDS][HC_LANES])
{
    const unsigned good = find_good(columns);
    hc_v_store(columns[3], hc_v_pick(good, hc_v_load(columns[3]), hc_v_set(INFINITY)));
    for (int lane = 0; lane < HC_LANES; lane += HC_D_LANES) {
        prepare_part(b, lane, fast, columns);
    }
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
