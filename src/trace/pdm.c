/* The walk of the 2009 paper as it is described there: all that it remembers is a place on the ray
 * and a level. The texel is the one at that place, looked up a little ahead so that it is the next
 * one once its border is reached; a patch's root counts if it lies in the patch. So rays slip past
 * what lies within that little of a corner, and between two patches where rounding puts the root of
 * each in the other: maxmip.c, the same walk, counts walls instead.
 * Source: GPU terrain ray casting, WSCG 2009, sections 4.1, 5.1 and 5.4, figure 12. */
#include "nodes.h"
#include "surface.h"

/* In texels: as float32 can tell it on a map of 8192. */
static const double AHEAD = 1.0 / 1024.0;

static void look_up(int cell[2], const hc_path *path, double s)
{
    for (int i = 0; i < 2; i++) {
        const double ahead = path->along[i] > 0.0 ? AHEAD : path->along[i] < 0.0 ? -AHEAD : 0.0;
        cell[i]            = (int)floor(hc_path_at(path, i, s) + ahead);
    }
}

static double in_patch(double root, double length)
{
    return root >= 0.0 && root <= length ? root : INFINITY;
}

/* Equation (1), and the smaller of its roots that is in the patch. */
static double first_root(const hc_gap *gap, double length)
{
    const double square = gap->slope * gap->slope - 4.0 * gap->bend * gap->value;
    if (square < 0.0) {
        return INFINITY;
    }
    const double half = -0.5 * (gap->slope + copysign(sqrt(square), gap->slope));
    const double one  = half != 0.0 ? gap->value / half : INFINITY;
    const double two  = gap->bend != 0.0 ? half / gap->bend : INFINITY;
    return fmin(in_patch(one, length), in_patch(two, length));
}

static bool meets_patch(const hc_tracer *tracer, const hc_path *path, const int cell[2], double s,
                        double leave, hc_found *found)
{
    const hc_patch patch = hc_patch_of(tracer, path, cell);
    const hc_gap   gap   = hc_gap_of(&patch, path, s);
    const double   root  = first_root(&gap, leave - s);
    found->cell[0]       = cell[0];
    found->cell[1]       = cell[1];
    found->s             = root < INFINITY ? s + root : INFINITY;
    return root < INFINITY;
}

void hc_march_pdm(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const int top   = tracer->bounds.levels - 1;
    int       level = top;
    for (double s = path->from;;) {
        int cell[2];
        look_up(cell, path, s);
        const hc_node n = hc_node_of(tracer, cell, level);
        const double  leave =
            fmin(fmin(hc_node_wall(&n, path, 0, s), hc_node_wall(&n, path, 1, s)), path->end);
        bool inside = hc_path_at(path, 2, s) <= n.bound;
        found->steps++;
        if (!inside && path->along[2] < 0.0) { /* down to the bound, if that is in this texel */
            const double bound = hc_path_reaches(path, 2, n.bound);
            inside             = bound < leave;
            s                  = inside ? fmax(bound, s) : s;
        }
        if (inside && level > 0) {
            level--;
            continue;
        }
        if (inside && meets_patch(tracer, path, cell, s, leave, found)) {
            return;
        }
        if (leave >= path->end) {
            return;
        }
        found->crossings++;
        s = leave;
        level += level < top ? 1 : 0;
    }
}
