/* Quick cone maps by the sets of the paper's listings, spelled out texel by texel.
 * After: Quick cone map generation, 2022, algorithms 1 and 2; docs/algorithms.md, section 9.
 *
 * A field that wraps is the plane tiled with it: texels and blocks of the nine periods around the
 * apex are counted on from the middle one, so that texel -1 is the image of the last. */
#include "reference.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

typedef struct axis {
    int    size;
    double step;
    int    first, last; /* texels of all periods */
} axis;

static axis axis_of(const hc_field *field, bool vertical)
{
    const bool wraps = (field->wrap & (vertical ? HC_WRAP_V : HC_WRAP_U)) != 0;
    axis       a     = { .size = vertical ? field->height : field->width };
    a.step           = vertical ? hc_field_step_v(field) : hc_field_step_u(field);
    a.first          = wraps ? -a.size : 0;
    a.last           = wraps ? 2 * a.size - 1 : a.size - 1;
    return a;
}

static int period_of(const axis *a, int texel)
{
    return texel < 0 ? -1 : texel >= a->size ? 1 : 0;
}

static int block_at(const axis *a, int level, int texel)
{
    const int period = period_of(a, texel);
    return hc_ref_block_of(texel - period * a->size, level, a->size)
           + period * hc_ref_level_size(a->size, level);
}

/* Whether two texels' blocks on a level are the same or next to each other along the axis. */
static bool is_near(const axis *a, int level, int texel, int other)
{
    return abs(block_at(a, level, texel) - block_at(a, level, other)) <= 1;
}

typedef struct search {
    const hc_field    *field;
    const hc_ref_cone *cone;
    hc_ref_quick       variant;
    axis               u, v;
    int                px, py;
} search;

/* Whether the levels before `level` have seen the texel; the apex counts as seen at the start. */
static bool is_visited(const search *s, int level, int x, int y)
{
    bool seen = x == s->px && y == s->py;
    for (int k = 0; k < level; k++) {
        seen = seen || (is_near(&s->u, k, x, s->px) && is_near(&s->v, k, y, s->py));
    }
    return seen;
}

/* Whether a texel belongs to the part of its block that counts. The own block is no neighbour; what
 * the level below left over of it at an odd size counts in both variants, or nobody saw it. */
static bool counts(const search *s, int level, int x, int y)
{
    const bool in_own_block = block_at(&s->u, level, x) == block_at(&s->u, level, s->px)
                              && block_at(&s->v, level, y) == block_at(&s->v, level, s->py);
    return !is_visited(s, level, x, y) || (s->variant == HC_REF_QUICK_NAIVE && !in_own_block);
}

/* Least distances to the texels that count, of each of the 3 x 3 blocks; INFINITY where none do. */
static void find_nearest(double nearest[3][3], const search *s, int level)
{
    for (int i = 0; i < 9; i++) {
        nearest[i / 3][i % 3] = INFINITY;
    }
    for (int y = s->v.first; y <= s->v.last; y++) {
        const int down = block_at(&s->v, level, y) - block_at(&s->v, level, s->py);
        for (int x = s->u.first; x <= s->u.last && abs(down) <= 1; x++) {
            const int across = block_at(&s->u, level, x) - block_at(&s->u, level, s->px);
            if (abs(across) <= 1 && counts(s, level, x, y)) {
                const double distance = hc_ref_length(s->field, s->cone, x - s->px, y - s->py);
                nearest[down + 1][across + 1] = fmin(nearest[down + 1][across + 1], distance);
            }
        }
    }
}

/* Middle of a block's texels along one axis, as seen from the apex at `p`: of all that lie on the
 * side looked at (-1, 1; 0 is both), or of those among them whose coordinate the level before did
 * not see. NAN if there are none. */
static double middle_of(const axis *a, int level, int p, int block, int side, bool unseen)
{
    int first = INT_MAX;
    int last  = INT_MIN;
    for (int texel = a->first; texel <= a->last; texel++) {
        const bool seen = level > 0 ? is_near(a, level - 1, texel, p) : texel == p;
        if (block_at(a, level, texel) == block && (texel - p) * side >= 0 && !(unseen && seen)) {
            first = texel < first ? texel : first;
            last  = texel > last ? texel : last;
        }
    }
    return first <= last ? 0.5 * (first + last) - p : NAN;
}

static double centre_of(const search *s, int level, int bx, int by)
{
    static const int sides_u[] = { 0, 1, -1, 1, -1 };
    static const int sides_v[] = { 0, 1, 1, -1, -1 };
    const int        side_u    = sides_u[s->cone->quadrant];
    const int        side_v    = sides_v[s->cone->quadrant];
    const double     all_u     = middle_of(&s->u, level, s->px, bx, side_u, false);
    const double     all_v     = middle_of(&s->v, level, s->py, by, side_v, false);
    const double     unseen_u  = middle_of(&s->u, level, s->px, bx, side_u, true);
    const double     unseen_v  = middle_of(&s->v, level, s->py, by, side_v, true);
    const bool own = bx == block_at(&s->u, level, s->px) && by == block_at(&s->v, level, s->py);
    if (isnan(all_u) || isnan(all_v)) {
        return INFINITY;
    }
    if (s->variant == HC_REF_QUICK_NAIVE_CENTRE && !own) {
        return hc_ref_length(s->field, s->cone, all_u, all_v);
    }
    if (s->variant == HC_REF_QUICK_CENTRE && !isnan(unseen_u) && !isnan(unseen_v)) {
        return hc_ref_length(s->field, s->cone, unseen_u, unseen_v);
    }
    const double beside =
        isnan(unseen_u) ? INFINITY : hc_ref_length(s->field, s->cone, unseen_u, all_v);
    const double below =
        isnan(unseen_v) ? INFINITY : hc_ref_length(s->field, s->cone, all_u, unseen_v);
    return fmin(beside, below);
}

/* Number of a block in its own period. */
static int folded(const axis *a, int level, int block)
{
    const int count = hc_ref_level_size(a->size, level);
    return (block + count) % count;
}

/* Highest sample of block (bx, by). */
static double highest_of(const search *s, int level, int bx, int by)
{
    const hc_field *f = s->field;
    return (double)hc_ref_block_extreme(f->heights, f->width, f->height, level,
                                        folded(&s->u, level, bx), folded(&s->v, level, by),
                                        HC_REF_MAXIMUM);
}

static bool exists(const axis *a, int level, int block)
{
    return block >= block_at(a, level, a->first) && block <= block_at(a, level, a->last);
}

static double level_ratio(const search *s, int level)
{
    const double apex  = (double)s->field->heights[s->py * s->field->width + s->px];
    const int    own_x = block_at(&s->u, level, s->px);
    const int    own_y = block_at(&s->v, level, s->py);
    double       ratio = INFINITY;
    double       nearest[3][3];
    find_nearest(nearest, s, level);
    for (int by = own_y - 1; by <= own_y + 1; by++) {
        for (int bx = own_x - 1; bx <= own_x + 1; bx++) {
            if (exists(&s->u, level, bx) && exists(&s->v, level, by)
                && highest_of(s, level, bx, by) > apex) {
                const double distance = s->variant >= HC_REF_QUICK_CENTRE
                                            ? centre_of(s, level, bx, by)
                                            : nearest[by - own_y + 1][bx - own_x + 1];
                ratio = fmin(ratio, distance / (highest_of(s, level, bx, by) - apex));
            }
        }
    }
    return ratio;
}

double hc_ref_quick_ratio(const hc_field *field, const hc_ref_cone *cone, hc_ref_quick variant,
                          int x, int y)
{
    const search s       = { .field   = field,
                             .cone    = cone,
                             .variant = variant,
                             .u       = axis_of(field, false),
                             .v       = axis_of(field, true),
                             .px      = x,
                             .py      = y };
    const int    longest = field->width > field->height ? field->width : field->height;
    double       ratio   = INFINITY;
    for (int level = 0; longest >> level > 0; level++) {
        ratio = fmin(ratio, level_ratio(&s, level));
    }
    return ratio;
}
