/* Walking the pyramid of the bounding map. A node whose bound the ray stays above is crossed, and
 * the next one is looked for a level higher; else the ray goes down a level, first to the height of
 * the bound if it falls. In single cells the patch decides. On tops (steps, qdm) the pyramid is
 * that of the samples and single cells are flat.
 * Source: WSCG 2009, sections 3 to 5 (both directions, level raising); Tevs et al. 2008; Drobot
 * 2009 (qdm). */
#include "cursor.h"
#include "surface.h"

typedef struct node {
    int    low[2], high[2]; /* cells low .. high - 1 */
    double bound;
} node;

typedef struct walk {
    const hc_tracer *tracer;
    const hc_path   *path;
    hc_cursor        at;
    int              level;
    bool             crossed; /* the ray is on a wall it has just crossed */
} walk;

/* The node's index on its level, and its cells. Above single cells the first and the last one of an
 * unwrapped axis have what lies at the border, too. */
static int span_of(const hc_axis *axis, int cell, int level, int level_side, int *low, int *high)
{
    const int index = hc_axis_index(axis, cell);
    const int which = index >> level < level_side ? index >> level : level_side - 1;
    const int base  = cell - index; /* of the period, where there are some */
    *low            = base + (which << level);
    *high           = base + (which < level_side - 1 ? (which + 1) << level : axis->size);
    if (level == 0) {
        *low  = cell;
        *high = cell + 1;
    } else if (!axis->wraps) {
        *low  = which == 0 ? -2 : which << level;
        *high = which < level_side - 1 ? (which + 1) << level : axis->size + 1;
    }
    return which;
}

static node node_of(const walk *w, const int cell[2])
{
    int          wide, high;
    const float *values = hc_pyramid_level(&w->tracer->bounds, w->level, &wide, &high);
    node         n;
    const int    x = span_of(&w->tracer->axes[0], cell[0], w->level, wide, &n.low[0], &n.high[0]);
    const int    y = span_of(&w->tracer->axes[1], cell[1], w->level, high, &n.low[1], &n.high[1]);
    n.bound        = (double)values[(size_t)y * (size_t)wide + (size_t)x];
    return n;
}

/* A ray along a face of tops is under the bounds of both sides. */
static void bound_both_sides(const walk *w, node *n)
{
    const int back_x = hc_path_on_wall(w->path, 0) ? 1 : 0;
    const int back_y = hc_path_on_wall(w->path, 1) ? 1 : 0;
    for (int i = 1; i < 4; i++) {
        const int cell[2] = { w->at.cell[0] - (i & 1) * back_x, w->at.cell[1] - (i >> 1) * back_y };
        n->bound          = fmax(n->bound, node_of(w, cell).bound);
    }
}

static double node_wall(const walk *w, const node *n, int axis)
{
    const int wall = w->path->along[axis] > 0.0 ? n->high[axis] : n->low[axis];
    return fmax(hc_path_reaches(w->path, axis, wall), w->at.s);
}

/* Go to s in the node, or over its wall if that is where s is. */
static void move_in(walk *w, const node *n, double s)
{
    const double walls[2] = { node_wall(w, n, 0), node_wall(w, n, 1) };
    hc_cursor_jump(&w->at, w->path, s);
    for (int i = 0; i < 2; i++) {
        const bool forward = w->path->along[i] > 0.0;
        int       *cell    = &w->at.cell[i];
        *cell              = *cell < n->low[i] ? n->low[i] : *cell;
        *cell              = *cell < n->high[i] ? *cell : n->high[i] - 1;
        if (w->crossed && walls[i] <= s) {
            *cell = forward ? n->high[i] : n->low[i] - 1;
        }
    }
}

static bool contact_in_cell(const walk *w, double exit, hc_found *found)
{
    const hc_patch patch = hc_patch_of(w->tracer, w->path, w->at.cell);
    const hc_gap   gap   = hc_gap_of(&patch, w->path, w->at.s);
    const bool     face  = w->tracer->tops && w->crossed && gap.value <= 0.0;
    found->s       = w->at.s + (gap.value <= 0.0 ? 0.0 : hc_gap_contact(&gap, exit - w->at.s));
    found->cell[0] = w->at.cell[0];
    found->cell[1] = w->at.cell[1];
    found->flags   = face ? HC_HIT_SIDE : 0;
    return found->s < INFINITY;
}

void hc_march_maxmip(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    walk w = { tracer, path, { path->from, { path->cell[0], path->cell[1] } }, 0, false };
    for (w.level = tracer->bounds.levels - 1;;) {
        node n = node_of(&w, w.at.cell);
        if (tracer->tops) {
            bound_both_sides(&w, &n);
        }
        const double exit  = fmin(fmin(node_wall(&w, &n, 0), node_wall(&w, &n, 1)), path->end);
        const double enter = hc_path_at(path, 2, w.at.s);
        const bool   above = fmin(enter, hc_path_at(path, 2, exit)) > n.bound;
        found->steps++;
        if (!above && w.level > 0) {
            if (enter > n.bound) { /* it falls, and comes to the bound in this node */
                w.crossed = false;
                move_in(&w, &n, fmin(fmax(hc_path_reaches(path, 2, n.bound), w.at.s), exit));
            }
            w.level--;
            continue;
        }
        if (!above && contact_in_cell(&w, exit, found)) {
            return;
        }
        if (exit >= path->end) {
            return;
        }
        found->crossings++;
        w.crossed = true;
        move_in(&w, &n, exit);
        w.level += w.level < tracer->bounds.levels - 1 ? 1 : 0;
    }
}
