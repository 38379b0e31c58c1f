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
    HC_ROW(double) t[HC_LANES];
    float   u[HC_LANES], v[HC_LANES], height[HC_LANES];
    float   s[HC_LANES]; /* clear: up to there */
    int32_t hit[HC_LANES], clear[HC_LANES];
    int32_t cell_x[HC_LANES], cell_y[HC_LANES]; /* that is hit */
} verdict;

/* Cells on their own: the first root, when and through which side the ray leaves, and when it would
 * leave through the other one. */
typedef struct test {
    HC_ROW(double) t[HC_LANES];
    double  leave[HC_LANES], other[HC_LANES];
    int32_t hit[HC_LANES], open[HC_LANES];
    int32_t across[HC_LANES]; /* leaves along v */
} test;

typedef struct slab {
    HC_ROW(double) enter[HC_LANES];
    double leave[HC_LANES];
} slab;

/* A ray that runs along the cells enters and leaves at infinity, or never; where it is on their
 * border, at NaN. */
static inline void cut_slab(slab *way, const batch *b, int axis, const int32_t *cells)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double origin  = b->origin[axis][i];
        const double inverse = b->inverse[axis][i];
        const double cell    = cells[i];
        const double low     = (cell - origin) * inverse;
        const double high    = (cell + 1.0 - origin) * inverse;
        const bool   up      = inverse > 0.0;
        way->enter[i]        = up ? low : high;
        way->leave[i]        = up ? high : low;
    }
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
    const corners h =
        find_corners(fast, hc_i_load(cell_x), hc_i_load(cell_y), 0xffff, NEAR_NOTHING);
    store_corners(out, &h);
}

/* `begin` is where the ray is known to be in the open, in cells gone sideways since t = 0. */
static inline void test_cells(const batch *b, const int32_t *cell_x, const int32_t *cell_y,
                              const float heights[4][HC_LANES], const double *begin, test *out)
{
    slab x;
    slab y;
    cut_slab(&x, b, 0, cell_x);
    cut_slab(&y, b, 1, cell_y);
    for (int i = 0; i < HC_LANES; i++) {
        const patch     p  = { (double)heights[0][i], (double)heights[1][i], (double)heights[2][i],
                               (double)heights[3][i] };
        const double    dx = b->direction[0][i];
        const double    dy = b->direction[1][i];
        const double    dz = b->direction[2][i];
        const double    enter = greater(x.enter[i], greater(y.enter[i], b->from[i]));
        const double    leave = lesser(x.leave[i], lesser(y.leave[i], b->to[i]));
        const quadratic q     = gap_on(&p, b->origin[0][i] + enter * dx - (double)cell_x[i],
                                       b->origin[1][i] + enter * dy - (double)cell_y[i],
                                       b->origin[2][i] + enter * dz, dx, dy, dz);
        const double    t     = enter + first_root(q);
        const bool      ahead = (x.leave[i] >= enter) & (y.leave[i] >= enter) & (b->to[i] >= enter);
        const int32_t   in    = (begin[i] >= enter * b->run[i]) & (q.c > 0.0) & ahead;
        out->t[i]             = t;
        out->leave[i]         = leave;
        out->other[i]         = greater(x.leave[i], y.leave[i]);
        out->hit[i]           = in & (t <= leave);
        out->open[i]          = in & (t > leave);
        out->across[i]        = y.leave[i] < x.leave[i];
    }
}

static inline void place_hits(float *out, const hc_fast_axis *axis, const double *origin,
                              const double *direction, const double *t)
{
    for (int i = 0; i < HC_LANES; i++) {
        out[i] = (float)texture(axis, origin[i] + t[i] * direction[i], 0.0);
    }
}

/* The next cells of those that are open; any cell for the others. Returns which have one. */
static inline unsigned next_cells(const hc_fast *fast, const batch *b, const test *first,
                                  verdict *v)
{
    float more[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        const int32_t step_x = b->direction[0][i] > 0.0 ? 1 : -1;
        const int32_t step_y = b->direction[1][i] > 0.0 ? 1 : -1;
        const int32_t x      = v->cell_x[i] + (first->across[i] != 0 ? 0 : step_x);
        const int32_t y      = v->cell_y[i] + (first->across[i] != 0 ? step_y : 0);
        const int32_t on =
            (first->open[i] != 0) & (x >= 0) & (x < fast->x.cells) & (y >= 0) & (y < fast->y.cells);
        v->cell_x[i] = on != 0 ? x : v->cell_x[i];
        v->cell_y[i] = on != 0 ? y : v->cell_y[i];
        more[i]      = on != 0 ? 1.0F : 0.0F;
    }
    return hc_v_greater(hc_v_load(more), hc_v_set(0.0F));
}

/* An open cell is followed by the next one, so that a lane that stands on a wall gets away from it.
 * It goes on a hair behind the wall: there the ray rises faster than the ground, or what the
 * marching allows for rounding is more than the ground rises. Where the hair might hold a whole
 * cell, near a corner, nothing is told. */
static inline void test_next(const hc_fast *fast, const batch *b, const question *c,
                             const test *first, verdict *v)
{
    test           next;
    float          heights[4][HC_LANES];
    double         begin[HC_LANES];
    const unsigned on = next_cells(fast, b, first, v);
    for (int i = 0; i < HC_LANES; i++) {
        begin[i] = first->leave[i] * b->run[i];
    }
    read_corners(heights, fast, v->cell_x, v->cell_y);
    test_cells(b, v->cell_x, v->cell_y, heights, begin, &next);
    for (int i = 0; i < HC_LANES; i++) {
        const double  way  = (next.leave[i] - c->from[i]) * b->run[i];
        const float   s    = (float)(way * (1.0 + 0x1p-22)); /* not before */
        const int32_t also = (int32_t)(on >> i & 1);
        const int32_t past = (next.other[i] - next.leave[i]) * b->run[i] > 0x1p-21 * way;
        v->s[i]            = s;
        v->clear[i]        = also & past & next.open[i] & (s > c->s[i] + 0.25F * fast->blur);
        v->t[i]            = (also & next.hit[i]) != 0 ? next.t[i] : v->t[i];
        v->hit[i] |= also & next.hit[i];
    }
}

static inline void decide_cells(const hc_fast *fast, const batch *b, const question *c,
                                unsigned lanes, verdict *v)
{
    test   first;
    double begin[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        begin[i] = c->from[i] * b->run[i] + (double)c->s[i];
    }
    test_cells(b, c->cell_x, c->cell_y, c->heights, begin, &first);
    memset(v->clear, 0, sizeof v->clear);
    memcpy(v->t, first.t, sizeof v->t);
    memcpy(v->hit, first.hit, sizeof v->hit);
    memcpy(v->cell_x, c->cell_x, sizeof v->cell_x);
    memcpy(v->cell_y, c->cell_y, sizeof v->cell_y);
    if ((hc_i_differ(hc_i_load(first.open), hc_i_set(0)) & lanes) != 0) {
        test_next(fast, b, c, &first, v);
    }
    place_hits(v->u, &fast->x, b->origin[0], b->direction[0], v->t);
    place_hits(v->v, &fast->y, b->origin[1], b->direction[1], v->t);
    for (int i = 0; i < HC_LANES; i++) {
        v->height[i] = (float)(b->origin[2][i] + v->t[i] * b->direction[2][i]);
    }
}

#endif
