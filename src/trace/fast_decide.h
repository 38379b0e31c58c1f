/* Sixteen cells, each with a ray that may hit it, decided at once in double precision, by the very
 * operations of fast_exact.h: the bits do not depend on which of the two has decided. Where the
 * marching may have been on the wrong side of a wall it is left to that. */
#ifndef HC_TRACE_FAST_DECIDE_H
#define HC_TRACE_FAST_DECIDE_H

#include "fast_look.h"
#include "fast_rays.h"

/* Cells in question. Twice the lanes: lanes are added sixteen at a time, and decided likewise. */
typedef struct trials {
    HC_ROW(int32_t) which[2 * HC_LANES];
    int32_t lane[2 * HC_LANES]; /* -1: it has been given to another ray */
    int32_t cell_x[2 * HC_LANES], cell_y[2 * HC_LANES];
    int32_t steps[2 * HC_LANES], crossings[2 * HC_LANES];
    float   s[2 * HC_LANES], span[2 * HC_LANES];
    double  from[2 * HC_LANES + HC_LANES];
    int     count;
} trials;

enum { TRIAL_WORDS = offsetof(trials, from) / (2 * HC_LANES * sizeof(int32_t)) };

/* Sixteen of them, or lanes that have stopped: the cells and their corners (h00, h10, h01, h11),
 * and where the rays are known to be in the open, at s from t. */
typedef struct question {
    const int32_t *cell_x, *cell_y;
    const float (*heights)[HC_LANES];
    const float  *s;
    const double *from;
} question;

/* What is found out about them. Neither hit nor clear: it could not be told. */
typedef struct verdict {
    HC_ROW(float) t[HC_LANES];
    float    u[HC_LANES], v[HC_LANES], height[HC_LANES];
    float    s[HC_LANES];                        /* clear: up to there */
    int32_t  cell_x[HC_LANES], cell_y[HC_LANES]; /* that is hit        */
    unsigned hit, clear;
} verdict;

/* Cells on their own: the first root, when the ray leaves, and when it would leave through the
 * other side. */
typedef struct test {
    HC_ROW(double) t[HC_LANES];
    double   leave[HC_LANES], other[HC_LANES];
    unsigned hit, open;
    unsigned across; /* leaves along v */
} test;

/* A ray's way over the cells of a column, or a row. */
static inline ways cut_slab(const batch *b, int axis, int lane, hc_d cell)
{
    return find_slab(cell, cell + hc_d_set(1.0), hc_d_load(b->origin[axis] + lane),
                     hc_d_load(b->inverse[axis] + lane));
}

static inline void store_corners(float out[4][HC_LANES], const corners *h)
{
    hc_v_store(out[0], h->h00);
    hc_v_store(out[1], h->h10);
    hc_v_store(out[2], h->h01);
    hc_v_store(out[3], h->h11);
}

static inline void read_corners(float out[4][HC_LANES], const hc_fast *fast, const int32_t *cell_x,
                                const int32_t *cell_y)
{
    const corners h = find_corners(fast, hc_i_load(cell_x), hc_i_load(cell_y), 0xffff);
    store_corners(out, &h);
}

/* Where rays are at t along an axis. */
static inline hc_d go_along(const batch *b, int axis, int lane, hc_d t)
{
    return hc_d_load(b->origin[axis] + lane) + t * hc_d_load(b->direction[axis] + lane);
}

/* The height above the patch, and the time after which it comes to be 0. */
typedef struct gaps {
    hc_d height, root;
} gaps;

/* gap_on() and first_root() of fast_exact.h at once, for rays at `enter`. */
static inline gaps solve(const batch *b, int lane, hc_d cell_x, hc_d cell_y,
                         const float heights[4][HC_LANES], hc_d enter)
{
    const hc_d none   = hc_d_set(0.0);
    const hc_d two    = hc_d_set(2.0);
    const hc_d dx     = hc_d_load(b->direction[0] + lane);
    const hc_d dy     = hc_d_load(b->direction[1] + lane);
    const hc_d dz     = hc_d_load(b->direction[2] + lane);
    const hc_d x      = go_along(b, 0, lane, enter) - cell_x;
    const hc_d y      = go_along(b, 1, lane, enter) - cell_y;
    const hc_d z      = go_along(b, 2, lane, enter);
    const hc_d h00    = hc_d_of_floats(heights[0] + lane);
    const hc_d h10    = hc_d_of_floats(heights[1] + lane);
    const hc_d along  = h10 - h00;
    const hc_d across = hc_d_of_floats(heights[2] + lane) - h00;
    const hc_d twist  = hc_d_of_floats(heights[3] + lane) - h10 - across;
    const hc_d qa     = -twist * dx * dy;
    const hc_d qb     = dz - along * dx - across * dy - twist * (x * dy + y * dx);
    const hc_d qc     = z - (h00 + along * x + across * y + twist * x * y);
    const hc_d root   = hc_d_sqrt(qb * qb - hc_d_set(4.0) * qa * qc);
    const hc_d over   = hc_d_if_less(none, qb, qb + root, two * qc);
    const hc_d under  = hc_d_if_less(none, qb, -two * qa, root - qb);
    return (gaps){ qc, hc_d_if_less(none, under, over / under, hc_d_set(INFINITY)) };
}

/* Lanes from `lane` on. They are known to be in the open s cells after the time `since`. */
static inline void test_part(test *out, int lane, const batch *b, const int32_t *cell_x,
                             const int32_t *cell_y, const float heights[4][HC_LANES],
                             const double *since, const float *s)
{
    const hc_d     run     = hc_d_load(b->run + lane);
    const hc_d     to      = hc_d_load(b->to + lane);
    const hc_d     i       = hc_d_of_ints(cell_x + lane);
    const hc_d     j       = hc_d_of_ints(cell_y + lane);
    const ways     x       = cut_slab(b, 0, lane, i);
    const ways     y       = cut_slab(b, 1, lane, j);
    const hc_d     begin   = hc_d_load(since + lane) * run + hc_d_of_floats(s + lane);
    const hc_d     first   = hc_d_max(y.from, hc_d_load(b->from + lane));
    const hc_d     enter   = hc_d_max(x.from, first);
    const hc_d     leave   = hc_d_min(x.to, hc_d_min(y.to, to));
    const gaps     gap     = solve(b, lane, i, j, heights, enter);
    const hc_d     t       = enter + gap.root;
    const unsigned on_x    = hc_d_most(enter, x.to);
    const unsigned on_y    = hc_d_most(enter, y.to);
    const unsigned ahead   = on_x & on_y & hc_d_most(enter, to);
    const unsigned outside = hc_d_less(hc_d_set(0.0), gap.height);
    const unsigned in      = hc_d_most(enter * run, begin) & outside & ahead;
    hc_d_store(out->t + lane, t);
    hc_d_store(out->leave + lane, leave);
    hc_d_store(out->other + lane, hc_d_max(x.to, y.to));
    out->hit |= (in & hc_d_most(t, leave)) << lane;
    out->open |= (in & hc_d_less(leave, t)) << lane;
    out->across |= hc_d_less(y.to, x.to) << lane;
}

static inline void test_cells(test *out, const batch *b, const int32_t *cell_x,
                              const int32_t *cell_y, const float heights[4][HC_LANES],
                              const double *since, const float *s)
{
    out->hit    = 0;
    out->open   = 0;
    out->across = 0;
    for (int lane = 0; lane < HC_LANES; lane += HC_D_LANES) {
        test_part(out, lane, b, cell_x, cell_y, heights, since, s);
    }
}

/* Where hits are on an axis that does not repeat, as texture() says. */
static inline hc_d place_hits(const hc_fast_axis *axis, hc_d at)
{
    const hc_d u = (at - hc_d_set(axis->zero)) * hc_d_set(axis->step);
    return hc_d_min(hc_d_max(u, hc_d_set(0.0)), hc_d_set(1.0));
}

/* Hits at t, if they are any. */
typedef struct landed {
    hc_d t, u, v, height;
} landed;

static ALWAYS_INLINE landed land(const hc_fast *fast, const batch *b, int lane, hc_d t)
{
    return (landed){ t, place_hits(&fast->x, go_along(b, 0, lane, t)),
                     place_hits(&fast->y, go_along(b, 1, lane, t)), go_along(b, 2, lane, t) };
}

/* One cell further along an axis, for those in `lanes`. */
static inline hc_i step_cells(const batch *b, int axis, hc_i cell, unsigned lanes)
{
    unsigned up = 0;
    for (int lane = 0; lane < HC_LANES; lane += HC_D_LANES) {
        up |= hc_d_less(hc_d_set(0.0), hc_d_load(b->direction[axis] + lane)) << lane;
    }
    const hc_i step = hc_i_pick(up, hc_i_set(1), hc_i_set(-1));
    return hc_i_pick(lanes, hc_i_add(cell, step), cell);
}

static inline unsigned find_outside(hc_i cell, const hc_fast_axis *axis)
{
    return hc_i_differ(keep_inside(cell, axis), cell);
}

/* The next cells of those that are open; any cell for the others. Returns which have one. */
static inline unsigned next_cells(const hc_fast *fast, const batch *b, const test *first,
                                  verdict *v)
{
    const hc_i     x       = hc_i_load(v->cell_x);
    const hc_i     y       = hc_i_load(v->cell_y);
    const hc_i     next_x  = step_cells(b, 0, x, ~first->across);
    const hc_i     next_y  = step_cells(b, 1, y, first->across);
    const unsigned outside = find_outside(next_x, &fast->x) | find_outside(next_y, &fast->y);
    const unsigned on      = first->open & ~outside;
    hc_i_store(v->cell_x, hc_i_pick(on, next_x, x));
    hc_i_store(v->cell_y, hc_i_pick(on, next_y, y));
    return on;
}

/* An open cell is followed by the next one, so that a lane that stands on a wall gets away from it.
 * It goes on a hair behind the wall: there the ray rises faster than the ground, or what the
 * marching allows for rounding is more than the ground rises. Where the hair might hold a whole
 * cell, near a corner, nothing is told. */
static __attribute__((noinline)) void test_next(const hc_fast *fast, const batch *b,
                                                const question *c, test *first, verdict *v)
{
    static const float none[HC_LANES] = { 0.0F };
    HC_ROW(double) ahead[HC_LANES]; /* s, not before the end of the next cells */
    test           next;
    float          heights[4][HC_LANES];
    unsigned       past = 0;
    const unsigned on   = next_cells(fast, b, first, v);
    read_corners(heights, fast, v->cell_x, v->cell_y);
    test_cells(&next, b, v->cell_x, v->cell_y, heights, first->leave, none);
    for (int lane = 0; lane < HC_LANES; lane += HC_D_LANES) {
        const hc_d leave = hc_d_load(next.leave + lane);
        const hc_d run   = hc_d_load(b->run + lane);
        const hc_d aside = (hc_d_load(next.other + lane) - leave) * run;
        const hc_d t     = hc_d_load(first->t + lane);
        const hc_d way   = (leave - hc_d_load(c->from + lane)) * run;
        past |= hc_d_less(hc_d_set(0x1p-21) * way, aside) << lane;
        hc_d_store(ahead + lane, way * hc_d_set(1.0 + 0x1p-22));
        hc_d_store(first->t + lane,
                   hc_d_pick((on & next.hit) >> lane, hc_d_load(next.t + lane), t));
    }
    for (int lane = 0; lane < HC_LANES; lane += HC_D_BOTH) {
        hc_d_round(v->s + lane, hc_d_load(ahead + lane), hc_d_load(ahead + lane + HC_D_MORE));
    }
    const hc_v least = hc_v_add(hc_v_load(c->s), hc_v_set(0.25F * fast->blur));
    v->clear         = on & past & next.open & hc_v_greater(hc_v_load(v->s), least);
    v->hit |= on & next.hit;
}

static ALWAYS_INLINE void decide_cells(const hc_fast *fast, const batch *b, const question *c,
                                       unsigned lanes, verdict *v)
{
    test first;
    test_cells(&first, b, c->cell_x, c->cell_y, c->heights, c->from, c->s);
    v->hit   = first.hit;
    v->clear = 0;
    memcpy(v->cell_x, c->cell_x, sizeof v->cell_x);
    memcpy(v->cell_y, c->cell_y, sizeof v->cell_y);
    if ((first.open & lanes) != 0) {
        test_next(fast, b, c, &first, v);
    }
    for (int lane = 0; lane < HC_LANES; lane += HC_D_BOTH) {
        const landed some = land(fast, b, lane, hc_d_load(first.t + lane));
        const landed more = land(fast, b, lane + HC_D_MORE, hc_d_load(first.t + lane + HC_D_MORE));
        hc_d_round(v->t + lane, some.t, more.t);
        hc_d_round(v->u + lane, some.u, more.u);
        hc_d_round(v->v + lane, some.v, more.v);
        hc_d_round(v->height + lane, some.height, more.height);
    }
}

#endif
