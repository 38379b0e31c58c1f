/* Walking the pyramid of the bounding map. A node whose bound the ray stays above is crossed, and
 * the next one is looked for a level higher; else the ray goes down a level, first to the height of
 * the bound if it falls. In single cells the patch decides. On tops (steps, qdm) the pyramid is
 * that of the samples and single cells are flat.
 * Source: WSCG 2009, sections 3 to 5 (both directions, level raising; pdm.c has it as printed);
 * Tevs et al. 2008; Drobot 2009 (qdm). */
#include "nodes.h"
#include "surface.h"

typedef struct walk {
    const hc_tracer *tracer;
    const hc_path   *path;
    hc_cursor        at;
    int              level;
    bool             crossed; /* the ray is on a wall it has just crossed */
} walk;

/* A ray along a face of tops is under the bounds of both sides. */
static void bound_both_sides(const walk *w, hc_node *n)
{
    const int back_x = hc_path_on_wall(w->path, 0) ? 1 : 0;
    const int back_y = hc_path_on_wall(w->path, 1) ? 1 : 0;
    for (int i = 1; i < 4; i++) {
        const int cell[2] = { w->at.cell[0] - (i & 1) * back_x, w->at.cell[1] - (i >> 1) * back_y };
        n->bound          = fmax(n->bound, hc_node_of(w->tracer, cell, w->level).bound);
    }
}

/* Go to s in the node, or over its wall if that is where s is. */
static void move_in(walk *w, const hc_node *n, double s)
{
    const double walls[2] = { hc_node_wall(n, w->path, 0, w->at.s),
                              hc_node_wall(n, w->path, 1, w->at.s) };
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
        hc_node n = hc_node_of(tracer, w.at.cell, w.level);
        if (tracer->tops) {
            bound_both_sides(&w, &n);
        }
        const double exit = fmin(
            fmin(hc_node_wall(&n, path, 0, w.at.s), hc_node_wall(&n, path, 1, w.at.s)), path->end);
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
