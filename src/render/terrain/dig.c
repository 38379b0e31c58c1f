/* Rays in the ground's uppermost layer, where details are cut. docs/algorithms.md, section 22.9. */
#include "terrain.h"

#include "quartic.h"

#include <math.h>
#include <string.h>

enum { GROUND = HC_DETAILS_MAX, GRIDS }; /* grids 0 .. are those of details */
enum { BISECTIONS = 8 };

/* Steps look no farther than if the ray fell by so much in one across. */
static const double LEAST_FALL = 1.0 / 16.0;
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
    double            leave;                  /* t where the ray ends, or the field */
    uint32_t          steps;
    bool              emerged;
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
        const hc_bilinear mask = hc_mask_patch(w->terrain, i, w->grids[GROUND].cell);
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

static double field_end(const grid *g, int axis, double size, double first)
{
    const double end = g->along[axis] > 0.0 ? size - first : -first;
    return g->along[axis] == 0.0 ? INFINITY : (end - g->place[axis]) / g->along[axis];
}

/* Above all ground or below all details: there is nothing farther on, though an upright ray comes to
 * no wall. */
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

static walk start(const hc_terrain *terrain, const hc_ray *ray)
{
    const hc_field *field   = &terrain->scene.field;
    const double    zero    = field->registration == HC_GRID ? 0.0 : 0.5;
    const double    half[2] = { 0.5, 0.5 }, first[2] = { zero, zero };
    const double    rate[2] = { 1.0 / terrain->scene.spacing[0], 1.0 / terrain->scene.spacing[1] };
    walk            w       = { .terrain = terrain };
    w.z    = ((double)ray->origin[2] - terrain->placement.offset[2]) / terrain->placement.scale_z;
    w.rise = (double)ray->direction[2] / terrain->placement.scale_z;
    set_grid(&w.grids[GROUND], terrain, ray, rate, first);
    w.grids[GROUND].used = true;
    for (int i = 0; i < terrain->details.count; i++) {
        const double own[2] = { terrain->details.rate[i], terrain->details.rate[i] };
        set_grid(&w.grids[i], terrain, ray, own, half);
    }
    const double across = (terrain->high[0] - terrain->low[0]) * rate[0];
    const double down   = (terrain->high[1] - terrain->low[1]) * rate[1];
    w.leave             = fmin(fmin((double)ray->tmax, layer_end(&w)),
                               fmin(field_end(&w.grids[GROUND], 0, across, zero),
                                    field_end(&w.grids[GROUND], 1, down, zero)));
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
    const hc_bilinear patch = hc_ground_patch(w->terrain, w->grids[GROUND].cell);
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

/* Over a surface that is nowhere under that one in the blocks: is it above 0 from t to `end`? */
static bool clears_blocks(const walk *w, double t, double end)
{
    const double reach = end - t;
    double       gap[3];
    ground_gap(gap, w, t);
    for (int i = 0; i < w->terrain->details.count; i++) {
        if (w->grids[i].used) {
            const double deep = w->left * w->terrain->details.cut[i] * (1.0 - w->blocks[i].top);
            double       share[3];
            along_ray(share, &w->shares[i], &w->grids[GROUND], t);
            for (int k = 0; k < 3; k++) {
                gap[k] += deep * share[k];
            }
        }
    }
    return gap[0] > 0.0
           && (!(reach > 0.0)
               || (gap[0] + 0.5 * reach * gap[1] > 0.0
                   && gap[0] + reach * (gap[1] + reach * gap[2]) > 0.0));
}

/* ---- safe ------------------------------------------------------------------------------------ */

static void go_in(walk *w, double t)
{
    enter(&w->grids[GROUND], t);
    for (int i = 0; i < GROUND; i++) {
        w->grids[i].used = false;
    }
    w->level = 0;
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
    if (cross(&w->grids[GROUND], t)) {
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

/* From *t to the first contact. INFINITY: to where it has come out of the ground (w->emerged), or to
 * the end. Blocks are walked as nodes of the pyramid are (maxmip): up a level after each that the ray
 * passes over, down a level where it may not. */
static double walk_on(walk *w, double *t)
{
    for (w->emerged = false;;) {
        double       gap[HC_QUARTIC], above[3];
        const double end = fmax(next_end(w), *t);
        w->steps++;
        if (w->level > 0 && !clears_blocks(w, *t, end)) {
            w->level--;
            continue;
        }
        if (w->level == 0) {
            detail_gap(gap, w, *t);
            const double met = hc_quartic_first(gap, end - *t);
            if (met < INFINITY) {
                return *t + met;
            }
        }
        if (end >= w->leave) {
            return INFINITY;
        }
        *t = end;
        cross_all(w, end);
        w->level += w->level < w->terrain->details.level_max ? 1 : 0;
        ground_gap(above, w, end);
        if (above[0] > EMERGED) {
            w->emerged = true;
            return INFINITY;
        }
    }
}

static void put_hit(hc_hit *hit, const walk *w, double t)
{
    const hc_field *field = &w->terrain->scene.field;
    const double    first = field->registration == HC_GRID ? 0.0 : 0.5;
    const grid     *g     = &w->grids[GROUND];
    hit->t                = (float)t;
    hit->u                = (float)((place_at(g, 0, t) + first) * hc_field_step_u(field));
    hit->v                = (float)((place_at(g, 1, t) + first) * hc_field_step_v(field));
    hit->height           = (float)(w->z + t * w->rise);
    hit->cell_x           = g->cell[0];
    hit->cell_y           = g->cell[1];
    hit->flags            = 0;
}

static double left_at(const hc_terrain *terrain, double left, const hc_hit *hit)
{
    return left >= 0.0 ? left : hc_details_left(terrain, (double)hit->t);
}

/* Where the detail is met at once the ground's own hit stands, a wall's, too. */
static void dig_safe(hc_hit *hit, walk *w, const hc_tracer *tracer, const hc_ray *ray, double given)
{
    double t = (double)hit->t;
    go_in(w, t);
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

static void dig_by_steps(hc_hit *hit, walk *w, const hc_ray *ray)
{
    const double first = (double)hit->t;
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
    put_hit(hit, w, below);
}

/* ---------------------------------------------------------------------------------------------- */

double hc_details_dig(hc_hit *hit, const hc_terrain *terrain, const hc_tracer *tracer,
                      const hc_ray *ray, hc_detail_method method, double left)
{
    const uint32_t steps = hit->steps;
    if (!(hit->t < INFINITY)) {
        return 0.0;
    }
    walk w = start(terrain, ray);
    w.left = left_at(terrain, left, hit);
    if (method == HC_DETAIL_SAFE) {
        dig_safe(hit, &w, tracer, ray, left);
    } else {
        dig_by_steps(hit, &w, ray);
    }
    hit->steps = steps + w.steps;
    return w.left;
}
