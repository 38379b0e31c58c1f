/* Sixteen cells, each with a ray that may hit it, decided at once in double precision, by the very
 * operations of fast_exact.h: the bits do not depend on which of the two has decided. Where the
 * marching may have been on the wrong side of a wall it is left to that. */
#ifndef HC_TRACE_FAST_DECIDE_H
#define HC_TRACE_FAST_DECIDE_H

#include "fast_march.h"
#include "fast_rays.h"

#include <float.h>

/* Cells in question. Twice the lanes: lanes are added sixteen at a time, and decided likewise. */
typedef struct trials {
    int32_t which[2 * HC_LANES], lane[2 * HC_LANES]; /* lane -1: it has been given to another ray */
    int32_t cell_x[2 * HC_LANES], cell_y[2 * HC_LANES];
    int32_t steps[2 * HC_LANES], crossings[2 * HC_LANES];
    float   s[2 * HC_LANES], span[2 * HC_LANES];
    double  from[2 * HC_LANES + HC_LANES];
    int     count;
} trials;

/* What is found out about them. Neither hit nor clear: it could not be told. */
typedef struct verdict {
    double  t[HC_LANES];
    float   u[HC_LANES], v[HC_LANES], height[HC_LANES];
    int32_t hit[HC_LANES], clear[HC_LANES];
} verdict;

typedef struct passage {
    double enter[HC_LANES], leave[HC_LANES];
} passage;

/* A ray that runs along the cell without being in it never enters. */
static inline void cut_to_cells(passage *way, const double *origin, const double *direction,
                                const double *inverse, const int32_t *cells)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double cell  = cells[i];
        const double low   = (cell - origin[i]) * inverse[i];
        const double high  = (cell + 1.0 - origin[i]) * inverse[i];
        const bool   along = direction[i] == 0.0;
        const bool   in    = (origin[i] >= cell) & (origin[i] < cell + 1.0);
        const bool   up    = direction[i] > 0.0;
        const double first = up ? low : high;
        const double last  = up ? high : low;
        way->enter[i]      = greater(way->enter[i], along ? (in ? -INFINITY : INFINITY) : first);
        way->leave[i]      = lesser(way->leave[i], along ? INFINITY : last);
    }
}

static inline void place_hits(float *out, const hc_fast_axis *axis, const double *origin,
                              const double *direction, const double *t)
{
    for (int i = 0; i < HC_LANES; i++) {
        out[i] = (float)texture(axis, origin[i] + t[i] * direction[i]);
    }
}

static inline void decide_cells(const hc_fast *fast, const batch *b, const trials *c, verdict *v)
{
    passage       way;
    float         corner[4][HC_LANES];
    const corners h = find_corners(fast, hc_i_load(c->cell_x), hc_i_load(c->cell_y), 0xffff);
    hc_v_store(corner[0], h.h00);
    hc_v_store(corner[1], h.h10);
    hc_v_store(corner[2], h.h01);
    hc_v_store(corner[3], h.h11);
    memcpy(way.enter, b->from, sizeof way.enter);
    memcpy(way.leave, b->to, sizeof way.leave);
    cut_to_cells(&way, b->origin[0], b->direction[0], b->inverse[0], c->cell_x);
    cut_to_cells(&way, b->origin[1], b->direction[1], b->inverse[1], c->cell_y);
    const double blur  = 6.0 * (double)fast->blur;
    const double slack = (double)fast->slack;
    for (int i = 0; i < HC_LANES; i++) {
        const patch     p     = { (double)corner[0][i], (double)corner[1][i], (double)corner[2][i],
                                  (double)corner[3][i] };
        const double    dx    = b->direction[0][i];
        const double    dy    = b->direction[1][i];
        const double    dz    = b->direction[2][i];
        const double    enter = way.enter[i];
        const double    leave = way.leave[i];
        const quadratic q     = gap_on(&p, b->origin[0][i] + enter * dx - (double)c->cell_x[i],
                                       b->origin[1][i] + enter * dy - (double)c->cell_y[i],
                                       b->origin[2][i] + enter * dz, dx, dy, dz);
        const double    t     = enter + first_root(q);
        const double    last  = leave - enter;
        const double    gap   = q.c + last * (q.b + last * q.a);
        const double    run   = fabs(dx) + fabs(dy);
        const double    begin = c->from[i] * run + (double)c->s[i];
        const double    end   = begin + (double)c->span[i];
        /* the lane was in the cell all the time, and above the surface when it came in */
        const int32_t in   = (begin >= enter * run) & (q.c > 0.0) & (leave >= enter);
        const int32_t left = (leave * run >= end - blur) & ((gap - slack) * run > blur * fabs(dz));
        v->t[i]            = t;
        v->hit[i]          = in & (t <= leave) & (t <= (double)FLT_MAX);
        v->clear[i]        = in & left & (t > leave);
    }
    place_hits(v->u, &fast->x, b->origin[0], b->direction[0], v->t);
    place_hits(v->v, &fast->y, b->origin[1], b->direction[1], v->t);
    for (int i = 0; i < HC_LANES; i++) {
        v->height[i] = (float)(b->origin[2][i] + v->t[i] * b->direction[2][i]);
    }
}

#endif
