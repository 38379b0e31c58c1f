/* Rays at single cells: the corners of these, and how far above the patches rays are.
 *
 * Everything here is float, as the marching is, and allows for its rounding. */
#ifndef HC_TRACE_FAST_LOOK_H
#define HC_TRACE_FAST_LOOK_H

#include "fast_march.h"

typedef struct corners {
    hc_v h00, h10, h01, h11;
} corners;

/* Eight columns of eight rows of heights, from a row on that is the first of those that stand
 * together. */
typedef struct window {
    int          x, y;
    const float *upper, *lower; /* four rows each: value by value, and so a table of thirty-two */
} window;

enum { WINDOW_ROWS = 1 << HC_FAST_HEIGHT_BITS };

/* With a cell in its middle, as far as the field and the rows that stand together let it. False in
 * fields that are smaller. */
static inline bool open_window(window *w, const hc_fast *fast, int32_t x, int32_t y)
{
    enum { BEFORE_X = HC_FAST_WINDOW / 2 - 1, BEFORE_Y = 2 }; /* and up to three rows more */
    const int row = y > BEFORE_Y ? y - BEFORE_Y : 0;
    w->x          = hc_fast_lesser(x > BEFORE_X ? x - BEFORE_X : 0, fast->last_window[0]);
    w->y          = hc_fast_lesser(row & ~(WINDOW_ROWS - 1), fast->last_window[1]);
    if ((fast->last_window[0] | fast->last_window[1]) < 0) {
        return false;
    }
    w->upper = fast->heights + hc_fast_corner(fast, w->x, w->y);
    w->lower = w->upper + (ptrdiff_t)fast->stride_heights * WINDOW_ROWS;
    return true;
}

/* A corner of each lane's cell, so many columns and rows into a window. */
static inline hc_v look_up(const window *w, hc_i x, hc_i y)
{
    const hc_i     rows  = hc_i_set(WINDOW_ROWS);
    const hc_i     row   = hc_i_and(y, hc_i_set(WINDOW_ROWS - 1));
    const hc_i     index = hc_i_or(hc_i_left(x, hc_i_set(HC_FAST_HEIGHT_BITS)), row);
    const unsigned low   = hc_i_differ(hc_i_and(y, rows), hc_i_set(0));
    return hc_v_pick(low, hc_v_lookup(w->lower, index), hc_v_lookup(w->upper, index));
}

/* What is known of where lanes stand: those of a group on cells next to each other, most often;
 * those that stay together on one. */
typedef enum nearness { NEAR_NOTHING, NEAR_EACH_OTHER, NEAR_ONE_CELL } nearness;

/* The corners of a cell, for all lanes. False outside the field. */
static inline bool find_corners_of(corners *h, const hc_fast *fast, int32_t x, int32_t y)
{
    if ((uint32_t)x >= (uint32_t)fast->x.cells || (uint32_t)y >= (uint32_t)fast->y.cells) {
        return false;
    }
    const float *const upper = fast->heights + hc_fast_corner(fast, x, y);
    const float *const lower = fast->heights + hc_fast_corner(fast, x, y + 1);
    const int          right = 1 << HC_FAST_HEIGHT_BITS;
    *h = (corners){ hc_v_set(upper[0]), hc_v_set(upper[right]), hc_v_set(lower[0]),
                    hc_v_set(lower[right]) };
    return true;
}

/* The corners of cells that are one, or next to each other. False if they are not, or if one is
 * outside the field. */
static inline bool find_corners_near(corners *h, const hc_fast *fast, hc_i x, hc_i y,
                                     unsigned lanes, nearness near)
{
    window        w;
    const int32_t first_x = hc_i_first(x, lanes);
    const int32_t first_y = hc_i_first(y, lanes);
    if (near == NEAR_ONE_CELL) {
        const unsigned on_x = ~hc_i_differ(x, hc_i_set(first_x));
        const unsigned on_y = ~hc_i_differ(y, hc_i_set(first_y));
        if ((lanes & ~(on_x & on_y)) == 0) {
            return find_corners_of(h, fast, first_x, first_y);
        }
    }
    if (!HC_LOOKUPS || !open_window(&w, fast, first_x, first_y)) {
        return false;
    }
    const hc_i one     = hc_i_set(1);
    const hc_i left    = hc_i_add(x, hc_i_set(-w.x));
    const hc_i above   = hc_i_add(y, hc_i_set(-w.y));
    const hc_i right   = hc_i_add(left, one);
    const hc_i below   = hc_i_add(above, one);
    const hc_i all     = hc_i_or(hc_i_or(left, right), hc_i_or(above, below));
    const hc_i outside = hc_i_and(all, hc_i_set(~(HC_FAST_WINDOW - 1)));
    if ((hc_i_differ(outside, hc_i_set(0)) & lanes) != 0) {
        return false;
    }
    *h = (corners){ look_up(&w, left, above), look_up(&w, right, above), look_up(&w, left, below),
                    look_up(&w, right, below) };
    return true;
}

static inline corners find_corners(const hc_fast *fast, hc_i x, hc_i y, unsigned lanes)
{
    const hc_i   stride = hc_i_set(fast->stride_heights);
    const hc_i   upper  = index_of(x, y, stride, HC_FAST_HEIGHT_BITS);
    const hc_i   lower  = index_of(x, hc_i_add(y, hc_i_set(1)), stride, HC_FAST_HEIGHT_BITS);
    const float *right  = fast->heights + (1 << HC_FAST_HEIGHT_BITS);
    return (corners){ hc_v_gather(fast->heights, upper, lanes), hc_v_gather(right, upper, lanes),
                      hc_v_gather(fast->heights, lower, lanes), hc_v_gather(right, lower, lanes) };
}

static inline hc_v gap_at(const corners *h, hc_v x, hc_v y, hc_v z)
{
    const hc_v upper = hc_v_about_muladd(x, hc_v_sub(h->h10, h->h00), h->h00);
    const hc_v lower = hc_v_about_muladd(x, hc_v_sub(h->h11, h->h01), h->h01);
    return hc_v_sub(z, hc_v_about_muladd(y, hc_v_sub(lower, upper), upper));
}

/* The cells of an axis that are next to these, which may be beyond its ends. */
static inline hc_i keep_inside(hc_i cell, const hc_fast_axis *axis)
{
    return hc_i_max(hc_i_min(cell, hc_i_set(axis->cells - 1)), hc_i_set(0));
}

/* Where rays are at s, and on which cell. */
typedef struct spot {
    hc_v x, y, z;
    hc_i i, j;
} spot;

static inline spot find_spot(const hc_fast *fast, const runners *ray, hc_v s)
{
    const hc_v x = hc_v_about_muladd(s, hc_v_load(ray->dx), hc_v_load(ray->x));
    const hc_v y = hc_v_about_muladd(s, hc_v_load(ray->dy), hc_v_load(ray->y));
    const hc_v z = hc_v_about_muladd(s, hc_v_load(ray->dz), hc_v_load(ray->z));
    return (spot){ x, y, z, keep_inside(hc_i_from_v(x), &fast->x),
                   keep_inside(hc_i_from_v(y), &fast->y) };
}

/* How far above the patches rays are at s, but for what fast->slack allows. */
static inline hc_v gap_after(const hc_fast *fast, const runners *ray, hc_v s, unsigned lanes)
{
    const spot    at = find_spot(fast, ray, s);
    const corners h  = find_corners(fast, at.i, at.j, lanes);
    const hc_v    u  = hc_v_sub(at.x, hc_v_from_i(at.i));
    const hc_v    v  = hc_v_sub(at.y, hc_v_from_i(at.j));
    return gap_at(&h, u, v, at.z);
}

/* How far above the lowest height around them rays are at s, but for what fast->slack allows. */
static inline hc_v gap_to_low(const hc_fast *fast, const runners *ray, hc_v s, unsigned lanes)
{
    const spot at     = find_spot(fast, ray, s);
    const hc_i bits   = hc_i_set(fast->low_bits);
    const hc_i i      = hc_i_right(at.i, bits);
    const hc_i column = hc_i_right(i, hc_i_set(1));
    const hc_i index  = index_of(column, hc_i_right(at.j, bits), hc_i_set(fast->stride_lows), 0);
    const hc_i half   = hc_i_left(hc_i_and(i, hc_i_set(1)), hc_i_set(4));
    const hc_i words  = hc_v_bits(hc_v_gather(fast->lows, index, lanes));
    const hc_i low    = hc_i_and(hc_i_right(words, half), hc_i_set(0xffff));
    return hc_v_about_muladd(hc_v_from_i(low), hc_v_set(-0x1p-16F), at.z);
}

/* Where rays that ask for any hit are looked at, as shares of their way: those from ground to
 * ground, and those that climb a quarter of the field's height, as to the sun, which are hidden by
 * what is near. Each place is the one that finds most of what the places before it leave. */
enum { PLACES = 20 };
static const float LEVEL_PLACES[PLACES] = { 0.836F, 0.164F, 0.492F, 0.039F, 0.961F, 0.664F, 0.305F,
                                            0.914F, 0.086F, 0.398F, 0.023F, 0.773F, 0.977F, 0.57F,
                                            0.227F, 0.008F, 0.992F, 0.945F, 0.117F, 0.727F };
static const float CLIMB_PLACES[PLACES] = { 0.068F, 0.248F, 0.024F, 0.452F, 0.148F, 0.011F, 0.695F,
                                            0.35F,  0.041F, 0.192F, 0.105F, 0.586F, 0.9F,   0.017F,
                                            0.294F, 0.053F, 0.381F, 0.007F, 0.032F, 0.537F };

/* Rays that climb a quarter of the field's height, unless they hit something. */
static inline unsigned find_climbing(const hc_fast *fast, const runners *ray)
{
    const hc_v rise = hc_v_mul(hc_v_load(ray->end), hc_v_load(ray->dz));
    return hc_v_greater(rise, hc_v_set(0.25F * (float)fast->highest));
}

/* Rays below the lowest heights, or below the patches, at one of the places from `first` on, before
 * `end`. Rays that have been found are looked at again, so that no place waits for the one before
 * it. */
static inline unsigned find_below(const hc_fast *fast, const runners *ray, unsigned lanes,
                                  int first, int end, bool low)
{
    const hc_v     slack  = hc_v_set(-fast->slack);
    const hc_v     way    = hc_v_sub(hc_v_load(ray->end), hc_v_set(4.0F * fast->blur));
    const unsigned climbs = find_climbing(fast, ray);
    unsigned       below  = 0;
    for (int k = first; k < end && below != lanes; k++) {
        const hc_v part = hc_v_pick(climbs, hc_v_set(CLIMB_PLACES[k]), hc_v_set(LEVEL_PLACES[k]));
        const hc_v s    = hc_v_mul(way, part);
        const hc_v gap  = low ? gap_to_low(fast, ray, s, lanes) : gap_after(fast, ray, s, lanes);
        below |= hc_v_greater(slack, gap) & lanes;
    }
    return below;
}

static inline unsigned probe_lows(const hc_fast *fast, const runners *ray, unsigned lanes,
                                  int first, int end)
{
    return find_below(fast, ray, lanes, first, end, true);
}

/* Fewer places, as these cost more, and only if a few of them find something. None on sparse
 * ground, where little is under anything. */
static __attribute__((noinline)) unsigned probe_patches(const hc_fast *fast, const runners *ray,
                                                        unsigned lanes)
{
    enum { COARSE = 3, FEW = 7 };
    if (fast->sparse) {
        return 0;
    }
    const unsigned below = find_below(fast, ray, lanes, 0, COARSE, false);
    return below != 0 ? below | find_below(fast, ray, lanes & ~below, COARSE, FEW, false) : 0;
}

/* Rays that are certainly below the surface somewhere on their way, and so have hit it. */
static inline unsigned probe(const hc_fast *fast, const runners *ray, unsigned lanes)
{
    return fast->stride_lows > 0 ? probe_lows(fast, ray, lanes, 0, PLACES)
                                 : probe_patches(fast, ray, lanes);
}

/* What looking at the patches under lanes has shown. */
typedef struct sight {
    hc_v     span; /* s until the cell is left */
    hc_i     cell_x, cell_y;
    corners  patch;
    unsigned clear; /* hit nothing on the cell                                     */
    unsigned below; /* are certainly below the surface when they leave, before the end: told of
                       rays on their own alone */
} sight;

static inline hc_v steepest_on(const corners *h)
{
    const hc_v along =
        hc_v_max(hc_v_abs(hc_v_sub(h->h10, h->h00)), hc_v_abs(hc_v_sub(h->h11, h->h01)));
    const hc_v across =
        hc_v_max(hc_v_abs(hc_v_sub(h->h01, h->h00)), hc_v_abs(hc_v_sub(h->h11, h->h10)));
    return hc_v_max(along, across);
}

/* What looking at cells allows for rounding. On sparse ground most cells are level and some next to
 * them are not: where a lane is sure to be in its cell, that cell alone counts. */
static inline hc_v slack_at(const hc_fast *fast, const pack *p, const place *at, hc_v out,
                            const corners *h, unsigned lanes)
{
    const hc_v slack = hc_v_set(fast->slack);
    if (!fast->sparse) {
        return slack;
    }
    const hc_i     fine = hc_i_set(0);
    const standing on = { .at = *at, .shift = fine, .block_x = at->cell_x, .block_y = at->cell_y };
    const unsigned unsure = find_unsure(fast, p, &on, out) | find_slow(fast, p, &on);
    const hc_v     own =
        hc_v_about_muladd(steepest_on(h), hc_v_set(6.0F * fast->blur), hc_v_set(fast->least));
    return hc_v_pick(unsure & lanes, slack, own);
}

/* Lanes whose gap is above `slack` on all of a way: at its ends, and between them, where it is a
 * parabola that hangs `sag` / 4 below their mean. With both ends less the slack, e and l, its
 * lowest point is above 0 if sqrt(e) + sqrt(l) > sqrt(sag). */
static inline unsigned stay_above(hc_v enter, hc_v leave, hc_v sag, hc_v slack)
{
    const hc_v     none    = hc_v_set(0.0F);
    const hc_v     e       = hc_v_sub(enter, slack);
    const hc_v     l       = hc_v_sub(leave, slack);
    const hc_v     rest    = hc_v_sub(sag, hc_v_add(e, l));
    const hc_v     product = hc_v_mul(hc_v_mul(e, l), hc_v_set(4.0F));
    const unsigned ends    = hc_v_greater(hc_v_min(e, l), none);
    const unsigned hangs   = hc_v_greater(rest, none);
    const unsigned shallow = hc_v_greater(product, hc_v_mul(rest, rest));
    return ends & (~hangs | shallow);
}

/* By how much a lane has to be below its patch where it leaves the cell, to be below the surface
 * for certain. It is seen up to 2 `blur` behind the wall, where the ground may fall away: it has to
 * be below at the wall. The slack of other than sparse ground holds for the next cell, too. */
static inline hc_v depth_of(const hc_fast *fast, const pack *p, hc_v slack)
{
    if (!fast->sparse) {
        return slack;
    }
    const hc_v none = hc_v_set(0.0F);
    const hc_v fall = hc_v_max(hc_v_sub(none, hc_v_load(p->ray.dz)), none);
    return hc_v_about_muladd(fall, hc_v_set(3.0F * fast->blur), slack);
}

/* The cells that lanes stand on, and their corners; on steps there are none. Returns the lanes that
 * are in the field; others are given the cell next to them. */
static ALWAYS_INLINE unsigned find_cells(sight *seen, const hc_fast *fast, const place *at,
                                         unsigned lanes, nearness near)
{
    seen->cell_x = at->cell_x;
    seen->cell_y = at->cell_y;
    if (near != NEAR_NOTHING
        && find_corners_near(&seen->patch, fast, at->cell_x, at->cell_y, lanes, near)) {
        return lanes;
    }
    seen->cell_x = keep_inside(at->cell_x, &fast->x);
    seen->cell_y = keep_inside(at->cell_y, &fast->y);
    seen->patch  = fast->steps ? (corners){ .h00 = hc_v_set(0.0F) }
                               : find_corners(fast, seen->cell_x, seen->cell_y, lanes);
    return lanes & ~hc_i_differ(seen->cell_x, at->cell_x) & ~hc_i_differ(seen->cell_y, at->cell_y);
}

/* Lanes on single cells: which may hit their patch? */
static ALWAYS_INLINE void look(const hc_fast *fast, const pack *p, unsigned lanes, nearness near,
                               sight *seen)
{
    const place at        = find_place(p);
    const hc_i  fine      = hc_i_set(0);
    const hc_v  out       = to_leave(fast, p, &at, at.cell_x, at.cell_y, fine);
    seen->span            = out;
    seen->clear           = 0;
    seen->below           = 0;
    const unsigned inside = find_cells(seen, fast, &at, lanes, near);
    if (fast->steps) {
        return;
    }
    const corners h     = seen->patch;
    const hc_v    x     = hc_v_sub(at.x, hc_v_from_i(seen->cell_x));
    const hc_v    y     = hc_v_sub(at.y, hc_v_from_i(seen->cell_y));
    const hc_v    run_x = hc_v_mul(out, hc_v_load(p->ray.dx));
    const hc_v    run_y = hc_v_mul(out, hc_v_load(p->ray.dy));
    const hc_v    enter = gap_at(&h, x, y, at.z);
    const hc_v    leave = gap_at(&h, hc_v_add(x, run_x), hc_v_add(y, run_y),
                                 hc_v_about_muladd(out, hc_v_load(p->ray.dz), at.z));
    const hc_v    twist = hc_v_sub(hc_v_add(h.h00, h.h11), hc_v_add(h.h10, h.h01));
    const hc_v    sag   = hc_v_sub(hc_v_set(0.0F), hc_v_mul(twist, hc_v_mul(run_x, run_y)));
    const hc_v    slack = slack_at(fast, p, &at, out, &h, lanes);
    seen->clear         = stay_above(enter, leave, sag, slack) & inside;
    if (near == NEAR_NOTHING) {
        const hc_v over  = hc_v_sub(hc_v_load(p->ray.end), hc_v_set(4.0F * fast->blur));
        const hc_v depth = depth_of(fast, p, slack);
        seen->below      = hc_v_greater(hc_v_sub(hc_v_set(0.0F), depth), leave)
                      & hc_v_greater(over, hc_v_add(at.s, out)) & inside;
    }
}

#endif
