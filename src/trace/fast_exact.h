/* The fast caster in double precision: where a ray can hit, and the first hit among a few cells.
 *
 * Walls are crossed at times that depend on the ray and the wall alone, and cells are tested whole,
 * so that a hit is the same wherever the search for it began. */
#ifndef HC_TRACE_FAST_EXACT_H
#define HC_TRACE_FAST_EXACT_H

#include "fast_data.h"

#include <math.h>

/* Height above the highest sample where rays enter, so that they enter in the open. */
static const double HEADROOM = 0x1p-20;

/* A ray that is known to be above the surface where it begins may seem so far below. */
static const double ROUNDING = 0x1p-45;

/* Unlike fmin and fmax these become one instruction; no NaN comes here. */
static inline double lesser(double a, double b)
{
    return a < b ? a : b;
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

typedef struct patch {
    double h00, h10, h01, h11;
} patch;

static inline int wrap_index(double cell, const hc_fast_axis *axis)
{
    const double last   = axis->cells - 1;
    const double period = axis->cells;
    const double inside = axis->wrapped ? cell - period * floor(cell / period) : cell;
    return (int)lesser(greater(inside, 0.0), last);
}

static inline patch patch_at(const hc_fast *fast, double cell_x, double cell_y)
{
    const int    i     = wrap_index(cell_x, &fast->x);
    const int    j     = wrap_index(cell_y, &fast->y);
    const float *upper = fast->heights + hc_fast_corner(fast, i, j);
    const float *lower = fast->heights + hc_fast_corner(fast, i, j + 1);
    if (fast->steps) {
        return (patch){ (double)*upper, (double)*upper, (double)*upper, (double)*upper };
    }
    const size_t right = (size_t)1 << HC_FAST_HEIGHT_BITS;
    return (patch){ (double)*upper, (double)upper[right], (double)*lower, (double)lower[right] };
}

static inline bool on_wall(const hc_fast_ray *r, int axis)
{
    return r->direction[axis] == 0.0 && r->origin[axis] == floor(r->origin[axis]);
}

/* Along a face between steps a ray touches both: the higher one counts. */
static inline patch patch_under(const hc_fast *fast, const hc_fast_ray *r, const double cell[2])
{
    const bool   walls[2] = { fast->steps && on_wall(r, 0), fast->steps && on_wall(r, 1) };
    const double x        = walls[0] ? r->origin[0] : cell[0];
    const double y        = walls[1] ? r->origin[1] : cell[1];
    patch        p        = patch_at(fast, x, y);
    for (int i = 1; i < 4 && (walls[0] || walls[1]); i++) {
        const patch other = patch_at(fast, x - (walls[0] ? i & 1 : 0), y - (walls[1] ? i >> 1 : 0));
        p                 = other.h00 > p.h00 ? other : p;
    }
    return p;
}

/* The ray's height above the patch, as a quadratic a s^2 + b s + c of the time s after t. */
typedef struct quadratic {
    double a, b, c;
} quadratic;

/* For a ray at (x, y, z), in the patch's coordinates. */
static inline quadratic gap_on(const patch *p, double x, double y, double z, double dx, double dy,
                               double dz)
{
    const double along  = p->h10 - p->h00;
    const double across = p->h01 - p->h00;
    const double twist  = p->h11 - p->h10 - across;
    return (quadratic){ -twist * dx * dy, dz - along * dx - across * dy - twist * (x * dy + y * dx),
                        z - (p->h00 + along * x + across * y + twist * x * y) };
}

static inline quadratic gap_over(const hc_fast_ray *r, const patch *p, double cell_x, double cell_y,
                                 double t)
{
    return gap_on(p, r->origin[0] + t * r->direction[0] - cell_x,
                  r->origin[1] + t * r->direction[1] - cell_y, r->origin[2] + t * r->direction[2],
                  r->direction[0], r->direction[1], r->direction[2]);
}

/* The first s > 0 where the quadratic comes down to 0 from c >= 0; INFINITY if it never does. Both
 * forms add what has one sign: the other root may be next to 0, where a ray has just come out of
 * the ground. Without a real root, `root` and `under` are NaN. */
static inline double first_root(quadratic q)
{
    const double root  = sqrt(q.b * q.b - 4.0 * q.a * q.c);
    const bool   up    = q.b > 0.0;
    const double over  = up ? q.b + root : 2.0 * q.c;
    const double under = up ? -2.0 * q.a : root - q.b;
    return under > 0.0 ? over / under : INFINITY;
}

typedef struct cursor {
    double cell[2];
    double enter, leave;
} cursor;

static inline double wall_time(const hc_fast_ray *r, int axis, double wall)
{
    return (wall - r->origin[axis]) * r->inverse[axis];
}

/* Times at which the ray comes into and out of a slab of cells; all times if it runs along it. */
static inline double slab_enter(const hc_fast_ray *r, int axis, double cell)
{
    return r->direction[axis] == 0.0
               ? -INFINITY
               : wall_time(r, axis, r->direction[axis] > 0.0 ? cell : cell + 1.0);
}

static inline double slab_leave(const hc_fast_ray *r, int axis, double cell)
{
    return r->direction[axis] == 0.0
               ? INFINITY
               : wall_time(r, axis, r->direction[axis] > 0.0 ? cell + 1.0 : cell);
}

static inline double clamp_cell(const hc_fast_axis *axis, double cell)
{
    return axis->wrapped ? cell : lesser(greater(cell, 0.0), (double)axis->cells - 1.0);
}

/* The cell at t by the times of its walls: rounding of the position must not choose it. */
static inline double cell_at(const hc_fast_ray *r, int axis, const hc_fast_axis *a, double t)
{
    const double step = r->direction[axis] > 0.0 ? 1.0 : -1.0;
    double       cell = clamp_cell(a, floor(r->origin[axis] + t * r->direction[axis]));
    while (slab_leave(r, axis, cell) <= t && clamp_cell(a, cell + step) != cell) {
        cell += step;
    }
    while (slab_enter(r, axis, cell) > t && clamp_cell(a, cell - step) != cell) {
        cell -= step;
    }
    return cell;
}

static inline void measure(const hc_fast_ray *r, cursor *c, double enter)
{
    c->enter = greater(r->from, enter);
    c->leave = lesser(r->to, lesser(slab_leave(r, 0, c->cell[0]), slab_leave(r, 1, c->cell[1])));
    c->leave = greater(c->leave, c->enter);
}

static inline cursor cursor_at(const hc_fast *fast, const hc_fast_ray *r, double t)
{
    cursor c = { .cell = { cell_at(r, 0, &fast->x, t), cell_at(r, 1, &fast->y, t) } };
    measure(r, &c, greater(slab_enter(r, 0, c.cell[0]), slab_enter(r, 1, c.cell[1])));
    return c;
}

static inline bool outside(const hc_fast_axis *axis, double cell)
{
    return !axis->wrapped && (cell < 0.0 || cell >= (double)axis->cells);
}

/* To the next cell; false behind the last. */
static inline bool step(const hc_fast *fast, const hc_fast_ray *r, cursor *c)
{
    const double tx   = slab_leave(r, 0, c->cell[0]);
    const double ty   = slab_leave(r, 1, c->cell[1]);
    const int    axis = ty < tx;
    if (!(lesser(tx, ty) <= r->to) || isinf(lesser(tx, ty))) {
        return false;
    }
    c->cell[axis] += r->direction[axis] > 0.0 ? 1.0 : -1.0;
    measure(r, c, lesser(tx, ty));
    return !outside(axis == 0 ? &fast->x : &fast->y, c->cell[axis]);
}

static inline bool hit_cell(const hc_fast *fast, const hc_fast_ray *r, hc_fast_found *found,
                            const cursor *c)
{
    const patch p      = patch_under(fast, r, c->cell);
    quadratic   q      = gap_over(r, &p, c->cell[0], c->cell[1], c->enter);
    const bool  starts = c->enter == r->from;
    if (starts && r->begun && q.c > -ROUNDING) {
        q.c = greater(q.c, 0.0); /* known to be above */
    } else if (q.c <= 0.0) {
        const uint32_t side = starts || fast->steps ? HC_HIT_SIDE : 0;
        *found              = (hc_fast_found){ c->enter, c->cell[0], c->cell[1],
                                  starts && r->inside ? HC_HIT_INSIDE : side };
        return true;
    }
    const double t = c->enter + first_root(q);
    if (!(t <= c->leave)) {
        return false;
    }
    *found = (hc_fast_found){ t, c->cell[0], c->cell[1], 0 };
    return true;
}

static inline bool hc_fast_walk(const hc_fast *fast, const hc_fast_ray *r, hc_fast_found *found,
                                double from, double to)
{
    cursor c    = cursor_at(fast, r, lesser(greater(from, r->from), r->to));
    bool   more = true;
    while (more) {
        if (hit_cell(fast, r, found, &c)) {
            return true;
        }
        more = c.leave <= to && step(fast, r, &c);
    }
    return false;
}

static inline double texture(const hc_fast_axis *axis, double coordinate, double turns)
{
    const double u = (coordinate - axis->zero) * axis->step;
    return axis->wrapped ? u + turns : lesser(greater(u, 0.0), 1.0);
}

static inline int32_t cell_index(const hc_fast *fast, const hc_fast_axis *axis, double cell)
{
    const int index = wrap_index(cell, axis) + axis->first;
    return fast->steps && index >= axis->samples ? axis->samples - 1 : index;
}

static inline void hc_fast_fill(const hc_fast *fast, hc_hit *hit, const hc_fast_ray *r,
                                const hc_fast_found *found)
{
    hit->t      = (float)(found->t + r->t0);
    hit->u      = (float)texture(&fast->x, r->origin[0] + found->t * r->direction[0], r->turns[0]);
    hit->v      = (float)texture(&fast->y, r->origin[1] + found->t * r->direction[1], r->turns[1]);
    hit->height = (float)(r->origin[2] + found->t * r->direction[2]);
    hit->cell_x = cell_index(fast, &fast->x, found->cell_x);
    hit->cell_y = cell_index(fast, &fast->y, found->cell_y);
    hit->flags  = found->flags;
}

#endif
