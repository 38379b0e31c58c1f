/* Rays in the ground's uppermost layer, where details are cut. docs/algorithms.md, section 22.9. */
#include "terrain.h"

#include "quartic.h"

#include <math.h>
#include <string.h>

enum { GROUND = HC_DETAILS_MAX, GRIDS }; /* grids 0 .. are those of details */
enum { BISECTIONS = 8 };

/* Steps look no farther than if the ray fell by so much in one across. */
static const double LEAST_FALL = 1.0 / 16.0;
/* In cells of the ground: what rounding of places may do in a shader. */
static const double INTO_FACE = 0x1p-10;
/* What comes up is looked for so far behind the root, of the way to the next wall. */
static const double CAME_UP = 0x1p-22;
/* So far above the ground, in heights, a ray has come out of it: what rounding of t may do. */
static const double EMERGED = 0x1p-20;

/* A ray in the cells of a grid: cell k lies between the coordinates k and k + 1. */
typedef struct grid {
    double place[2], along[2];
    double pace[2]; /* 1 / along */
    int    cell[2];
    bool   used;
} grid;

typedef struct block {
    int    low[2], high[2]; /* cells low .. high - 1 */
    double top;             /* no patch in it is higher */
} block;

typedef struct walk {
    const hc_terrain *terrain;
    double            left;
    double            z, rise; /* in heights */
    grid              grids[GRIDS];
    hc_bilinear       shares[HC_DETAILS_MAX]; /* of the mask, in this cell of the ground */
    int               level;                  /* of blocks of texels; 0: texels           */
    block             blocks[HC_DETAILS_MAX]; /* that the ray is in, above level 0        */
    double            begin, leave;           /* t where the ray begins and ends, or the field */
    uint32_t          steps;
    bool              emerged;
    bool              rising;      /* the ray is under the detail, and has not hit it */
    bool              tops, faced; /* faced: the ray has come to another top just now */
    double            zero;        /* place of the first sample among the ground's cells */
} walk;

/* ---- grids ----------------------------------------------------------------------------------- */

static double place_at(const grid *g, int axis, double t)
{
    return g->place[axis] + t * g->along[axis];
}

static double wall_of(const grid *g, int axis)
{
    const int next = g->cell[axis] + (g->along[axis] > 0.0 ? 1 : 0);
    return g->along[axis] == 0.0 ? INFINITY : (next - g->place[axis]) * g->pace[axis];
}

static double next_wall(const grid *g)
{
    return fmin(wall_of(g, 0), wall_of(g, 1));
}

static void enter(grid *g, double t)
{
    for (int k = 0; k < 2; k++) {
        const double place = place_at(g, k, t);
        g->cell[k]         = (int)(g->along[k] < 0.0 ? ceil(place) - 1.0 : floor(place));
    }
}

/* The index goes by the wall that is crossed, as everywhere: a position may be rounded back. */
static bool cross(grid *g, double t)
{
    bool crossed = false;
    for (int k = 0; k < 2; k++) {
        if (wall_of(g, k) <= t) {
            g->cell[k] += g->along[k] > 0.0 ? 1 : -1;
            crossed = true;
        }
    }
    return crossed;
}

/* ---- blocks ---------------------------------------------------------------------------------- */

static int block_span(block *b, int axis, int cell, int size, int level, int level_side)
{
    const int rest  = cell % size;
    const int index = rest < 0 ? rest + size : rest;
    const int which = index >> level < level_side ? index >> level : level_side - 1;
    b->low[axis]    = cell - index + (which << level);
    b->high[axis]   = cell - index + (which < level_side - 1 ? (which + 1) << level : size);
    return which;
}

static block block_of(const grid *g, const hc_pyramid *tops, int level)
{
    int          wide, high;
    const int    most   = level < tops->levels ? level : tops->levels - 1;
    const float *values = hc_pyramid_level(tops, most, &wide, &high);
    block        b;
    const int    x = block_span(&b, 0, g->cell[0], tops->width, most, wide);
    const int    y = block_span(&b, 1, g->cell[1], tops->height, most, high);
    b.top          = (double)values[(size_t)y * (size_t)wide + (size_t)x];
    return b;
}

static double block_wall(const grid *g, const block *b, int axis)
{
    const int next = g->along[axis] > 0.0 ? b->high[axis] : b->low[axis];
    return g->along[axis] == 0.0 ? INFINITY : (next - g->place[axis]) * g->pace[axis];
}

/* To t, in the block or over its walls; never back. */
static void cross_block(grid *g, const block *b, double t)
{
    for (int k = 0; k < 2; k++) {
        const int there = (int)floor(place_at(g, k, t));
        if (block_wall(g, b, k) <= t) {
            g->cell[k] = g->along[k] > 0.0 ? b->high[k] : b->low[k] - 1;
        } else if (g->along[k] > 0.0 && there > g->cell[k]) {
            g->cell[k] = there < b->high[k] ? there : b->high[k] - 1;
        } else if (g->along[k] < 0.0 && there < g->cell[k]) {
            g->cell[k] = there > b->low[k] ? there : b->low[k];
        }
    }
}

/* Which details there are in the ground's cell. */
static void choose_details(walk *w, double t)
{
    for (int i = 0; i < w->terrain->details.count; i++) {
        const hc_bilinear mask = hc_mask_patch(w->terrain, i, w->grids[GROUND].cell, w->tops);
        const bool        none =
            mask.base == 0.0 && mask.slope[0] == 0.0 && mask.slope[1] == 0.0 && mask.twist == 0.0;
        if (!none && !w->grids[i].used) {
            enter(&w->grids[i], t);
        }
        w->shares[i]     = mask;
        w->grids[i].used = !none;
    }
}

/* ---- rays ------------------------------------------------------------------------------------ */

static void set_grid(grid *g, const hc_terrain *terrain, const hc_ray *ray, const double rate[2],
                     const double first[2])
{
    const double corner[2] = { terrain->low[0], terrain->high[1] };
    for (int k = 0; k < 2; k++) {
        const double towards = k == 0 ? rate[k] : -rate[k]; /* rows go against y */
        g->place[k]          = towards * ((double)ray->origin[k] - corner[k]) - first[k];
        g->along[k]          = towards * (double)ray->direction[k];
        g->pace[k]           = 1.0 / g->along[k];
    }
}

static double field_begin(const grid *g, int axis, double size, double first)
{
    const double begin = g->along[axis] > 0.0 ? -first : size - first;
    return g->along[axis] == 0.0 ? -INFINITY : (begin - g->place[axis]) / g->along[axis];
}

static double field_end(const grid *g, int axis, double size, double first)
{
    const double end = g->along[axis] > 0.0 ? size - first : -first;
    return g->along[axis] == 0.0 ? INFINITY : (end - g->place[axis]) / g->along[axis];
}

/* Above all ground or below all details: there is nothing farther on, though an upright ray comes
 * to no wall. */
static double layer_end(const walk *w)
{
    double deep = 1.0;
    for (int i = 0; i < w->terrain->details.count; i++) {
        deep += w->terrain->details.cut[i];
    }
    return w->rise > 0.0   ? (2.0 - w->z) / w->rise
           : w->rise < 0.0 ? (-deep - w->z) / w->rise
                           : INFINITY;
}

static walk start(const hc_terrain *terrain, const hc_ray *ray, bool tops)
{
    const hc_field *field   = &terrain->scene.field;
    const double    zero    = (field->registration == HC_GRID ? 0.0 : 0.5) - (tops ? 0.5 : 0.0);
    const double    half[2] = { 0.5, 0.5 }, first[2] = { zero, zero };
    const double    rate[2] = { 1.0 / terrain->scene.spacing[0], 1.0 / terrain->scene.spacing[1] };
    walk            w       = { .terrain = terrain, .tops = tops, .zero = zero };
    w.z    = ((double)ray->origin[2] - terrain->placement.offset[2]) / terrain->placement.scale_z;
    w.rise = (double)ray->direction[2] / terrain->placement.scale_z;
    set_grid(&w.grids[GROUND], terrain, ray, rate, first);
    w.grids[GROUND].used = true;
    for (int i = 0; i < terrain->details.count; i++) {
        const double own[2] = { terrain->details.rate[i], terrain->details.rate[i] };
        set_grid(&w.grids[i], terrain, ray, own, half);
    }
    w.leave = fmin((double)ray->tmax, layer_end(&w));
    w.begin = (double)ray->tmin;
    for (int k = 0; k < 2; k++) {
        const double size = (terrain->high[k] - terrain->low[k]) * rate[k];
        w.begin           = fmax(w.begin, field_begin(&w.grids[GROUND], k, size, zero));
        w.leave           = fmin(w.leave, field_end(&w.grids[GROUND], k, size, zero));
    }
    return w;
}

/* ---- gaps ------------------------------------------------------------------------------------ */

/* A patch along the ray, from t: a + b r + c r^2. */
static void along_ray(double out[3], const hc_bilinear *patch, const grid *g, double t)
{
    const double x = place_at(g, 0, t) - g->cell[0];
    const double y = place_at(g, 1, t) - g->cell[1];
    out[0]         = hc_bilinear_at(patch, x, y);
    out[1]         = g->along[0] * (patch->slope[0] + y * patch->twist)
             + g->along[1] * (patch->slope[1] + x * patch->twist);
    out[2] = g->along[0] * g->along[1] * patch->twist;
}

/* Height of the ray over the ground, from t. */
static void ground_gap(double gap[3], const walk *w, double t)
{
    const hc_bilinear patch = hc_ground_patch(w->terrain, w->grids[GROUND].cell, w->tops);
    double            ground[3];
    along_ray(ground, &patch, &w->grids[GROUND], t);
    gap[0] = w->z + t * w->rise - ground[0];
    gap[1] = w->rise - ground[1];
    gap[2] = -ground[2];
}

/* Over what is left of it. */
static void detail_gap(double gap[HC_QUARTIC], const walk *w, double t)
{
    memset(gap, 0, HC_QUARTIC * sizeof *gap);
    ground_gap(gap, w, t);
    for (int i = 0; i < w->terrain->details.count; i++) {
        if (!w->grids[i].used) {
            continue;
        }
        const double      cut   = w->left * w->terrain->details.cut[i];
        const hc_bilinear patch = hc_detail_patch(w->terrain, i, w->grids[i].cell);
        double            share[3], low[3];
        along_ray(share, &w->shares[i], &w->grids[GROUND], t);
        along_ray(low, &patch, &w->grids[i], t);
        low[0] -= 1.0;
        for (int k = 0; k < 9; k++) {
            gap[k % 3 + k / 3] -= cut * share[k % 3] * low[k / 3];
        }
    }
}

/* Over the ground less a share of each detail's whole depth: Bernstein coefficients from t to
 * `end`. blocks: it is nowhere under the surface in them; else nowhere over it. */
static void bound_gap(double bounds[3], const walk *w, double t, double end, bool blocks)
{
    const double reach = fmax(end - t, 0.0);
    double       gap[3];
    ground_gap(gap, w, t);
    for (int i = 0; i < w->terrain->details.count; i++) {
        if (w->grids[i].used) {
            const double top  = blocks ? w->blocks[i].top : 0.0;
            const double deep = w->left * w->terrain->details.cut[i] * (1.0 - top);
            double       share[3];
            along_ray(share, &w->shares[i], &w->grids[GROUND], t);
            for (int k = 0; k < 3; k++) {
                gap[k] += deep * share[k];
            }
        }
    }
    bounds[0] = gap[0];
    bounds[1] = gap[0] + 0.5 * reach * gap[1];
    bounds[2] = gap[0] + reach * (gap[1] + reach * gap[2]);
}

static bool clears_blocks(const walk *w, double t, double end)
{
    double bounds[3];
    bound_gap(bounds, w, t, end, true);
    return fmin(bounds[0], fmin(bounds[1], bounds[2])) > 0.0;
}

/* ---- safe ------------------------------------------------------------------------------------ */

static void go_in(walk *w, double t)
{
    enter(&w->grids[GROUND], t);
    for (int i = 0; i < GROUND; i++) {
        w->grids[i].used = false;
    }
    w->level  = 0;
    w->faced  = false;
    w->rising = false;
    choose_details(w, t);
}

/* Over the walls at t. */
static void cross_all(walk *w, double t)
{
    for (int i = 0; i < GROUND; i++) {
        if (w->grids[i].used && w->level > 0) {
            cross_block(&w->grids[i], &w->blocks[i], t);
        } else if (w->grids[i].used) {
            (void)cross(&w->grids[i], t);
        }
    }
    w->faced = cross(&w->grids[GROUND], t);
    if (w->faced) {
        choose_details(w, t);
    }
}

/* Where the ray comes to the next wall of anything. */
static double next_end(walk *w)
{
    double end = fmin(w->leave, next_wall(&w->grids[GROUND]));
    for (int i = 0; i < w->terrain->details.count; i++) {
        const grid *g = &w->grids[i];
        if (g->used && w->level > 0) {
            w->blocks[i] = block_of(g, &w->terrain->details.tops[i], w->level);
            end = fmin(end, fmin(block_wall(g, &w->blocks[i], 0), block_wall(g, &w->blocks[i], 1)));
        } else if (g->used) {
            end = fmin(end, next_wall(g));
        }
    }
    return end;
}

/* Down in the cell of the ground, where there is no detail? Then *end is where it ends. */
static bool stays_deep(double *end, walk *w, double t)
{
    double       bounds[3];
    const double wall = fmax(fmin(w->leave, next_wall(&w->grids[GROUND])), t);
    bound_gap(bounds, w, t, wall, false);
    if (fmax(bounds[0], fmax(bounds[1], bounds[2])) >= 0.0) {
        return false;
    }
    for (int i = 0; i < GROUND; i++) {
        w->grids[i].used = false; /* it is left behind, and entered anew */
    }
    *end = wall;
    return true;
}

/* Least r in 0 .. reach where a gap comes to 0: from above, or, rising, from below. */
static double first_root(double gap[HC_QUARTIC], double reach, bool rising)
{
    for (int k = 0; k < HC_QUARTIC; k++) {
        gap[k] = rising ? -gap[k] : gap[k];
    }
    return hc_quartic_first(gap, reach);
}

/* Over the walls at the end. True: the ray has come out of the ground. */
static bool goes_over(walk *w, double *t, double end)
{
    double above[3];
    *t = end;
    cross_all(w, end);
    w->level += !w->rising && w->level < w->terrain->details.level_max ? 1 : 0;
    ground_gap(above, w, end);
    w->emerged = !w->rising && above[0] > EMERGED;
    return w->emerged;
}

/* From *t to the first contact; rising: to the first after the ray has come up out of the detail.
 * INFINITY: to where it has come out of the ground (w->emerged), or to the end. Blocks are walked
 * as nodes of the pyramid are (maxmip): up a level after each that the ray passes over, down a
 * level where it may not. Where it rises a root may be one that it only touches: it goes on behind
 * it, farther from time to time. */
static double walk_on(walk *w, double *t)
{
    double slip = CAME_UP;
    for (w->emerged = false;;) {
        double     gap[HC_QUARTIC];
        double     end  = INFINITY;
        const bool deep = w->rising && stays_deep(&end, w, *t);
        end             = deep ? end : fmax(next_end(w), *t);
        w->steps++;
        if (w->level > 0 && !clears_blocks(w, *t, end)) {
            w->level--;
            continue;
        }
        if (w->level == 0 && !deep) {
            detail_gap(gap, w, *t);
            w->rising        = w->rising && gap[0] <= 0.0;
            const double met = first_root(gap, end - *t, w->rising);
            if (!w->rising && met < INFINITY) {
                w->faced = w->faced && met == 0.0;
                return *t + met;
            }
            if (w->rising && met + slip * (end - *t) < end - *t) {
                *t += met + slip * (end - *t);
                slip *= 2.0;
                continue;
            }
        }
        if (end >= w->leave || goes_over(w, t, end)) {
            return INFINITY;
        }
        slip = CAME_UP;
    }
}

static void put_hit(hc_hit *hit, const walk *w, double t)
{
    const hc_field *field = &w->terrain->scene.field;
    const grid     *g     = &w->grids[GROUND];
    hit->t                = (float)t;
    hit->u                = (float)((place_at(g, 0, t) + w->zero) * hc_field_step_u(field));
    hit->v                = (float)((place_at(g, 1, t) + w->zero) * hc_field_step_v(field));
    hit->height           = (float)(w->z + t * w->rise);
    hit->cell_x           = g->cell[0];
    hit->cell_y           = g->cell[1];
    hit->flags            = w->tops && w->faced ? HC_HIT_SIDE : 0;
}

static double left_at(const hc_terrain *terrain, double left, const hc_hit *hit)
{
    return left >= 0.0 ? left : hc_details_left(terrain, (double)hit->t);
}

/* ---- open sides ------------------------------------------------------------------------------ */

/* Does the ray come in through a side, under the ground, where there is detail? Then *hit is its
 * beginning. */
static bool comes_in_below(hc_hit *hit, walk *w, const hc_ray *ray, double given)
{
    const hc_hit in = { .t = (float)w->begin };
    double       gap[3];
    if (!(w->begin > (double)ray->tmin && w->begin < w->leave)) {
        return false;
    }
    enter(&w->grids[GROUND], w->begin);
    ground_gap(gap, w, w->begin);
    if (gap[0] > 0.0 || !(left_at(w->terrain, given, &in) > 0.0)) {
        return false;
    }
    w->left = left_at(w->terrain, given, &in);
    *hit    = (hc_hit){ .t = ray->tmin };
    return true;
}

/* Where the detail is met at once the ground's own hit stands, a wall's, too. */
static void dig_safe(hc_hit *hit, walk *w, const hc_tracer *tracer, const hc_ray *ray, double given)
{
    const bool open  = w->terrain->scene.trace.open_sides;
    const bool below = open && comes_in_below(hit, w, ray, given);
    double     t     = below ? w->begin : (double)hit->t;
    if (!(t < INFINITY)) {
        return;
    }
    go_in(w, t);
    w->rising = below;
    while (w->left > 0.0) {
        const double met  = walk_on(w, &t);
        hc_ray       rest = *ray;
        hc_hit       next = { .t = INFINITY };
        if (met < INFINITY) {
            if (met > (double)hit->t) {
                put_hit(hit, w, met);
            }
            return;
        }
        rest.tmin = (float)t;
        if (w->emerged) {
            (void)hc_trace_nearest(tracer, &next, &rest);
        }
        w->steps += next.steps;
        if ((double)next.t <= t) { /* rounded: the tracer has it in the ground still */
            continue;
        }
        next.crossings += hit->crossings;
        *hit = next;
        if (!(next.t < INFINITY)) {
            return;
        }
        t       = (double)next.t;
        w->left = left_at(w->terrain, given, hit);
        go_in(w, t);
    }
}

/* ---- steps ----------------------------------------------------------------------------------- */

static double gap_at(walk *w, double t)
{
    double gap[HC_QUARTIC];
    go_in(w, t);
    detail_gap(gap, w, t);
    w->steps++;
    return gap[0];
}

/* How far it is from t through the layer that details are cut from, as if the ground went on as it
 * lies there, and a quarter more, since it does not. Published methods stop above it. 0: there are
 * no details. */
static double way_through(const walk *w, const hc_ray *ray, double t)
{
    double gap[3];
    double deep = 0.0, square = 0.0;
    ground_gap(gap, w, t);
    for (int i = 0; i < w->terrain->details.count; i++) {
        double share[3];
        along_ray(share, &w->shares[i], &w->grids[GROUND], t);
        deep += w->left * w->terrain->details.cut[i] * share[0];
    }
    for (int k = 0; k < 3; k++) {
        square += (double)ray->direction[k] * (double)ray->direction[k];
    }
    const double least = LEAST_FALL * sqrt(square) / w->terrain->placement.scale_z;
    return deep > 0.0 ? 1.25 * (deep + fmax(gap[0], 0.0)) / fmax(-gap[1], least) : 0.0;
}

/* From a face of a top on it is that top's detail, on whichever side of the face t was rounded
 * to. */
static double way_into_face(const walk *w, const hc_hit *hit)
{
    const double *along = w->grids[GROUND].along;
    return w->tops && (hit->flags & HC_HIT_SIDE) != 0
               ? INTO_FACE / fmax(fabs(along[0]), fabs(along[1]))
               : 0.0;
}

static void dig_by_steps(hc_hit *hit, walk *w, const hc_ray *ray)
{
    const double first = (double)hit->t + way_into_face(w, hit);
    const int    steps = w->terrain->scene.detail_steps;
    if (!(w->left > 0.0) || gap_at(w, first) <= 0.0) {
        return;
    }
    const double way   = way_through(w, ray, first);
    double       above = first, below = first;
    if (!(way > 0.0)) {
        return;
    }
    for (int i = 1; i <= steps && below == first; i++) {
        const double t = first + way * i / steps;
        if (t > w->leave) {
            break;
        }
        *(gap_at(w, t) > 0.0 ? &above : &below) = t;
    }
    if (below == first) {
        hit->flags |= HC_HIT_UNCONVERGED;
        return;
    }
    for (int i = 0; i < BISECTIONS; i++) {
        const double middle                          = 0.5 * (above + below);
        *(gap_at(w, middle) > 0.0 ? &above : &below) = middle;
    }
    go_in(w, above);
    const int before[2] = { w->grids[GROUND].cell[0], w->grids[GROUND].cell[1] };
    go_in(w, below);
    w->faced = memcmp(before, w->grids[GROUND].cell, sizeof before) != 0;
    put_hit(hit, w, below);
}

/* ---------------------------------------------------------------------------------------------- */

double hc_details_dig(hc_hit *hit, const hc_terrain *terrain, const hc_tracer *tracer,
                      const hc_ray *ray, hc_detail_method method, double left)
{
    const hc_trace_options *trace = &terrain->scene.trace;
    const bool              steps = trace->surface == HC_SURFACE_STEPS;
    const uint32_t          taken = hit->steps;
    if (!(hit->t < INFINITY) && !(trace->open_sides && method == HC_DETAIL_SAFE)) {
        return 0.0;
    }
    walk w =
        start(terrain, ray, steps || (trace->method == HC_TRACE_QDM && tracer != terrain->exact));
    w.left = left_at(terrain, left, hit);
    if (method == HC_DETAIL_SAFE) {
        dig_safe(hit, &w, tracer, ray, left);
    } else {
        dig_by_steps(hit, &w, ray);
    }
    hit->steps = taken + w.steps;
    return w.left;
}
