/* Rays that begin where those of the other methods do (clip.c), which take more care than sixteen
 * at a time can take. */
#include "fast_data.h"
#include "surface.h"

#include <math.h>

/* In the cells of `fast`, which are numbered from 0. */
static void begin_at(hc_fast_ray *r, const hc_path *path, const double shift[2])
{
    *r = (hc_fast_ray){ .from = path->from, .to = path->end, .t0 = path->t0, .begun = true };
    for (int i = 0; i < 2; i++) {
        r->origin[i]    = path->place[i] + shift[i];
        r->direction[i] = path->along[i];
        r->inverse[i]   = 1.0 / path->along[i];
    }
    r->origin[2]    = path->place[2];
    r->direction[2] = path->along[2];
}

/* Not before it comes into its cell by the time of the walls: through a face between steps it is
 * under the cell that it leaves, and above the one that it comes into. */
static void begin_in_cell(hc_fast_ray *r, const hc_path *path, const double shift[2])
{
    for (int i = 0; i < 2; i++) {
        const double wall  = path->cell[i] + shift[i] + (path->along[i] < 0.0 ? 1.0 : 0.0);
        const double enter = (wall - r->origin[i]) * r->inverse[i];
        r->from            = path->along[i] == 0.0 ? r->from : fmax(r->from, enter);
    }
}

/* Having come up at the wall of a cell a ray may be down again in the next one. */
static bool is_above(const hc_tracer *tracer, const hc_path *path)
{
    const hc_patch patch = hc_patch_of(tracer, path, path->cell);
    return hc_gap_of(&patch, path, path->from).value > 0.0;
}

static hc_found begin_path(const hc_tracer *tracer, hc_path *path, const hc_ray *ray, bool *marches)
{
    hc_found found;
    *marches = hc_path_begin(tracer, path, &found, ray);
    if (*marches && !is_above(tracer, path)) {
        *marches = false;
        found    = (hc_found){ .s = path->from, .cell = { path->cell[0], path->cell[1] } };
    }
    return found;
}

hc_fast_fate hc_fast_enter(hc_fast_ray *r, const hc_fast *fast, const hc_ray *ray)
{
    const double   shift[2] = { -fast->x.first, -fast->y.first };
    bool           marches;
    hc_path        path;
    const hc_found found = begin_path(fast->tracer, &path, ray, &marches);
    if (!marches && !(found.s < INFINITY)) {
        return HC_FAST_MISSES;
    }
    const double last = fmin((double)ray->tmax, HC_FAST_T_MAX) - path.t0;
    begin_at(r, &path, shift);
    for (int i = 0; i < 2; i++) {
        r->turns[i] = fast->tracer->axes[i].unit < 0.0 ? -path.turns[i] : path.turns[i];
    }
    if (!marches) {
        r->at_once = (hc_fast_found){ found.s, found.cell[0] + shift[0], found.cell[1] + shift[1],
                                      found.flags };
        return found.s <= last ? HC_FAST_HITS : HC_FAST_MISSES;
    }
    begin_in_cell(r, &path, shift);
    r->to = fmin(r->to, last);
    return r->from <= r->to ? HC_FAST_MARCHES : HC_FAST_MISSES;
}
