/* Sixteen rays in lanes, each at its own block on its own level; a lane that is done takes the next
 * ray. Included once per instruction set, with HC_FAST_KERNEL the name of what it defines.
 *
 * A lane marches in cell coordinates mirrored so that both grow along the ray, and counts s, the
 * cells gone sideways (|du| + |dv|), so that a slope times s is a rise. On its block it sees
 * whether it stays above the top until it leaves; then it goes on to where the cone around the
 * block, from there on, would let it down, and otherwise one level deeper. On single cells the
 * patch is looked at; where that leaves a doubt, hc_fast_walk decides.
 *
 * Everything here is float and only has to err on the safe side: fast_build.c has raised tops and
 * slopes by what rounding can misplace. */
#include "base/simd.h"
#include "fast_exact.h"

#include <math.h>

/* Packs take turns, so that one computes while the other waits for memory. */
enum { ALL_LANES = 0xffff, PACKS = 2 };

/* Lanes to gather before they are looked at together, and before they take new rays. */
enum { NEAR_MIN = 6, DONE_MIN = 4 };

/* Rays that go less far, in cells, are walked at once: vertical ones above all. */
static const double MARCH_FROM = 2.0;

/* Blocks that a step must have crossed for the next one to try the coarser level. */
static const float RISE = 2.0F;

typedef struct pack {
    float       x[HC_LANES], y[HC_LANES], z[HC_LANES];    /* where the segment starts */
    float       dx[HC_LANES], dy[HC_LANES], dz[HC_LANES]; /* per s; dx + dy = 1       */
    float       rx[HC_LANES], ry[HC_LANES];               /* 1 / dx, 1 / dy           */
    float       s[HC_LANES], end[HC_LANES];
    int32_t     flip_x[HC_LANES], add_x[HC_LANES]; /* cell = (mirrored cell ^ flip) + add */
    int32_t     flip_y[HC_LANES], add_y[HC_LANES];
    int32_t     quadrant[HC_LANES]; /* bits to shift a slope down */
    int32_t     level[HC_LANES];
    int32_t     steps[HC_LANES], crossings[HC_LANES];
    hc_fast_ray rays[HC_LANES];
    double      from[HC_LANES], scale[HC_LANES]; /* t = from + scale * s */
    double      next[HC_LANES];                  /* t at the segment's end */
    size_t      which[HC_LANES];
    unsigned    active, near; /* lanes with a ray; of them, waiting on a cell */
} pack;

/* Rays on their way into lanes, made ready sixteen at a time. */
typedef struct batch {
    double  origin[3][HC_LANES], direction[3][HC_LANES], inverse[2][HC_LANES];
    double  from[HC_LANES], to[HC_LANES], scale[HC_LANES];
    float   start[3][HC_LANES], rate[3][HC_LANES], reciprocal[2][HC_LANES], end[HC_LANES];
    int32_t meets[HC_LANES], long_enough[HC_LANES], inside[HC_LANES];
    int     next, count;
} batch;

typedef struct job {
    const hc_fast *fast;
    hc_fast_answer answer;
    const hc_ray  *rays;
    size_t         count, taken;
    batch          ready;
} job;

/* ---- rays in and out of lanes ---------------------------------------------------------------- */

static void answer_ray(const job *j, size_t which, const hc_fast_ray *r, const hc_fast_found *found,
                       int32_t steps, int32_t crossings)
{
    if (j->answer.any != NULL) {
        j->answer.any[which] = found != NULL;
        return;
    }
    hc_hit *hit    = &j->answer.hits[which];
    *hit           = (hc_hit){ .t = INFINITY };
    hit->steps     = (uint32_t)steps;
    hit->crossings = (uint32_t)crossings;
    if (found != NULL) {
        hc_fast_fill(j->fast, hit, r, found);
    }
}

/* Start of the period that holds cell `cell`, and the time at which the ray leaves it. */
static double leave_period(const hc_fast_ray *r, int axis, const hc_fast_axis *a, double t,
                           double *start)
{
    *start = 0.0;
    if (!a->wrapped || r->direction[axis] == 0.0) {
        if (a->wrapped) {
            *start = a->cells * floor(r->origin[axis] / a->cells);
        }
        return INFINITY;
    }
    const double sign  = r->direction[axis] > 0.0 ? 1.0 : -1.0;
    double       first = a->cells * floor((r->origin[axis] + t * r->direction[axis]) / a->cells);
    double       leave;
    do { /* a ray that stands on the seam is already beyond it */
        const double wall = sign > 0.0 ? first + a->cells : first;
        leave             = (wall - r->origin[axis]) * r->inverse[axis];
        *start            = first;
        first += sign * a->cells;
    } while (leave <= t);
    return leave;
}

static void set_axis(float *x, float *dx, float *rx, int32_t *flip, int32_t *add, double at,
                     double direction, int32_t mirror)
{
    const bool back = direction < 0.0;
    *x              = (float)(back ? mirror - at : at);
    *dx             = (float)fabs(direction);
    *rx             = *dx > 0x1p-60F ? 1.0F / *dx : 0x1p60F;
    *flip           = back ? -1 : 0;
    *add            = back ? mirror : 0;
}

/* Begin the segment at t in lane i. False: it is too short for marching and has been walked, up to
 * p->next, without a hit; true with *hit: with one. */
static bool begin_segment(const job *j, pack *p, int i, double t, hc_fast_found *found, bool *hit)
{
    const hc_fast     *fast = j->fast;
    const hc_fast_ray *r    = &p->rays[i];
    double             start_x, start_y;
    const double       leave_x = leave_period(r, 0, &fast->x, t, &start_x);
    const double       leave_y = leave_period(r, 1, &fast->y, t, &start_y);
    const double       next    = fmin(r->to, fmin(leave_x, leave_y));
    const double       run     = fabs(r->direction[0]) + fabs(r->direction[1]);
    p->next[i]                 = next;
    *hit                       = false;
    if (!((next - t) * run >= MARCH_FROM)) {
        *hit = hc_fast_walk(fast, r, found, t, next);
        return *hit;
    }
    const double scale = 1.0 / run;
    const double x     = r->origin[0] + t * r->direction[0] - start_x;
    const double y     = r->origin[1] + t * r->direction[1] - start_y;
    set_axis(&p->x[i], &p->dx[i], &p->rx[i], &p->flip_x[i], &p->add_x[i], x,
             r->direction[0] * scale, fast->mirror_x);
    set_axis(&p->y[i], &p->dy[i], &p->ry[i], &p->flip_y[i], &p->add_y[i], y,
             r->direction[1] * scale, fast->mirror_y);
    p->z[i]        = (float)(r->origin[2] + t * r->direction[2]);
    p->dz[i]       = (float)(r->direction[2] * scale);
    p->quadrant[i] = (r->direction[0] < 0.0 ? 8 : 0) + (r->direction[1] < 0.0 ? 16 : 0);
    p->s[i]        = 0.0F;
    p->end[i]      = (float)((next - t) * run) + 2.0F * fast->blur;
    p->level[i]    = fast->first_level;
    p->from[i]     = t;
    p->scale[i]    = scale;
    return true;
}

/* Segments from t on until one is to be marched; false: the ray is answered. */
static bool go_on(const job *j, pack *p, int i, double t)
{
    hc_fast_found found;
    bool          hit = false;
    while (!begin_segment(j, p, i, t, &found, &hit)) {
        t = p->next[i];
        if (t >= p->rays[i].to) {
            answer_ray(j, p->which[i], NULL, NULL, p->steps[i], p->crossings[i]);
            return false;
        }
    }
    if (hit) {
        answer_ray(j, p->which[i], &p->rays[i], &found, p->steps[i], p->crossings[i]);
    }
    return !hit;
}

/* The loops over lanes below become vector code: they choose, but never branch. */
static void place_rays(batch *b, const hc_fast *fast, const hc_ray *rays)
{
    const double scale[3] = { fast->x.scale, fast->y.scale, fast->scale_z };
    const double shift[3] = { fast->x.shift, fast->y.shift, fast->shift_z };
    for (int i = 0; i < HC_LANES; i++) {
        const hc_ray *ray = &rays[i < b->count ? i : 0];
        for (int k = 0; k < 3; k++) {
            b->origin[k][i]    = (double)ray->origin[k];
            b->direction[k][i] = (double)ray->direction[k];
        }
        b->from[i] = (double)ray->tmin;
        b->to[i]   = (double)ray->tmax;
    }
    for (int i = 0; i < HC_LANES; i++) {
        const double sum = b->origin[0][i] + b->origin[1][i] + b->origin[2][i] + b->from[i]
                           + b->direction[0][i] + b->direction[1][i] + b->direction[2][i];
        const double length =
            fabs(b->direction[0][i]) + fabs(b->direction[1][i]) + fabs(b->direction[2][i]);
        b->meets[i] = (sum * 0.0 == 0.0) & (length > 0.0) & (b->to[i] >= b->from[i]);
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < HC_LANES; i++) {
            b->origin[k][i]    = b->origin[k][i] * scale[k] + shift[k];
            b->direction[k][i] = b->direction[k][i] * scale[k];
        }
    }
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < HC_LANES; i++) {
            b->inverse[k][i] = 1.0 / b->direction[k][i];
        }
    }
}

/* Cut to the field's ends along an unwrapped axis. */
static void cut_sides(batch *b, int axis, const hc_fast_axis *a)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double origin = b->origin[axis][i];
        const double low    = (a->low - origin) * b->inverse[axis][i];
        const double high   = (a->high - origin) * b->inverse[axis][i];
        const bool   along  = b->direction[axis][i] == 0.0;
        const bool   beyond = (origin < a->low) | (origin > a->high);
        const double enter  = along ? -INFINITY : lesser(low, high);
        const double leave  = along ? INFINITY : greater(low, high);
        b->from[i]          = greater(b->from[i], enter);
        b->to[i]            = lesser(b->to[i], leave);
        b->meets[i] &= !(along & beyond);
    }
}

/* Cut to HC_PERIODS_MAX periods of a wrapped axis, from where the ray is over the field. */
static void cut_periods(batch *b, int axis, const hc_fast_axis *a, double highest)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double down  = (highest - b->origin[2][i]) / b->direction[2][i];
        const double start = b->direction[2][i] < 0.0 ? greater(b->from[i], down) : b->from[i];
        const double run   = HC_PERIODS_MAX * a->cells * fabs(b->inverse[axis][i]);
        b->to[i]           = lesser(b->to[i], start + run);
    }
}

/* Cut to the heights below the highest sample. */
static void cut_top(batch *b, double top)
{
    for (int i = 0; i < HC_LANES; i++) {
        const double direction = b->direction[2][i];
        const double t         = (top - b->origin[2][i]) / direction;
        b->from[i]             = direction < 0.0 ? greater(b->from[i], t) : b->from[i];
        b->to[i]               = direction > 0.0 ? lesser(b->to[i], t) : b->to[i];
        b->meets[i] &= !((direction == 0.0) & (b->origin[2][i] > top));
    }
}

/* In the lanes' coordinates, if the ray stays in one period. */
static void mirror_rays(batch *b, const hc_fast *fast)
{
    const double mirror[2] = { fast->mirror_x, fast->mirror_y };
    for (int i = 0; i < HC_LANES; i++) {
        const double run  = fabs(b->direction[0][i]) + fabs(b->direction[1][i]);
        const double way  = (b->to[i] - b->from[i]) * run;
        b->scale[i]       = 1.0 / run;
        b->end[i]         = (float)way + 2.0F * fast->blur;
        b->long_enough[i] = way >= MARCH_FROM;
    }
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < HC_LANES; i++) {
            const double direction = b->direction[k][i];
            const double at        = b->origin[k][i] + b->from[i] * direction;
            const float  rate      = (float)fabs(direction * b->scale[i]);
            b->start[k][i]         = (float)(direction < 0.0 ? mirror[k] - at : at);
            b->rate[k][i]          = rate;
            b->reciprocal[k][i]    = rate > 0x1p-60F ? 1.0F / rate : 0x1p60F;
        }
    }
    for (int i = 0; i < HC_LANES; i++) {
        b->start[2][i] = (float)(b->origin[2][i] + b->from[i] * b->direction[2][i]);
        b->rate[2][i]  = (float)(b->direction[2][i] * b->scale[i]);
    }
}

/* Make the next rays ready. */
static void make_ready(job *j)
{
    const hc_fast *fast = j->fast;
    batch         *b    = &j->ready;
    const hc_ray  *rays = j->rays + j->taken;
    const size_t   left = j->count - j->taken;
    b->next             = 0;
    b->count            = left < HC_LANES ? (int)left : HC_LANES;
    j->taken += (size_t)b->count;
    place_rays(b, fast, rays);
    if (!fast->x.wrapped) {
        cut_sides(b, 0, &fast->x);
    }
    if (!fast->y.wrapped) {
        cut_sides(b, 1, &fast->y);
    }
    if (fast->x.wrapped) {
        cut_periods(b, 0, &fast->x, fast->highest);
    }
    if (fast->y.wrapped) {
        cut_periods(b, 1, &fast->y, fast->highest);
    }
    for (int i = 0; i < b->count; i++) {
        b->inside[i] = b->from[i] == (double)rays[i].tmin;
    }
    cut_top(b, fast->highest + HEADROOM);
    for (int i = 0; i < HC_LANES; i++) {
        b->meets[i] &= b->from[i] <= b->to[i];
    }
    mirror_rays(b, fast);
}

static void load_ray(hc_fast_ray *r, const batch *b, int k)
{
    *r = (hc_fast_ray){ .origin    = { b->origin[0][k], b->origin[1][k], b->origin[2][k] },
                        .direction = { b->direction[0][k], b->direction[1][k], b->direction[2][k] },
                        .inverse   = { b->inverse[0][k], b->inverse[1][k] },
                        .from      = b->from[k],
                        .to        = b->to[k],
                        .inside    = b->inside[k] };
}

static void load_lane(const hc_fast *fast, pack *p, int i, const batch *b, int k)
{
    const bool back_x = b->direction[0][k] < 0.0;
    const bool back_y = b->direction[1][k] < 0.0;
    p->x[i]           = b->start[0][k];
    p->y[i]           = b->start[1][k];
    p->z[i]           = b->start[2][k];
    p->dx[i]          = b->rate[0][k];
    p->dy[i]          = b->rate[1][k];
    p->dz[i]          = b->rate[2][k];
    p->rx[i]          = b->reciprocal[0][k];
    p->ry[i]          = b->reciprocal[1][k];
    p->flip_x[i]      = -(int)back_x;
    p->flip_y[i]      = -(int)back_y;
    p->add_x[i]       = back_x ? fast->mirror_x : 0;
    p->add_y[i]       = back_y ? fast->mirror_y : 0;
    p->quadrant[i]    = (back_x ? 8 : 0) + (back_y ? 16 : 0);
    p->s[i]           = 0.0F;
    p->end[i]         = b->end[k];
    p->level[i]       = fast->first_level;
    p->from[i]        = b->from[k];
    p->scale[i]       = b->scale[k];
    p->next[i]        = b->to[k];
}

/* Give lane i the next ray that needs marching; false: there is none. */
static bool take_ray(job *j, pack *p, int i)
{
    batch *b = &j->ready;
    while (b->next < b->count || j->taken < j->count) {
        if (b->next == b->count) {
            make_ready(j);
        }
        const int k     = b->next++;
        p->which[i]     = j->taken - (size_t)b->count + (size_t)k;
        p->steps[i]     = 0;
        p->crossings[i] = 0;
        if (b->meets[k] == 0) {
            answer_ray(j, p->which[i], NULL, NULL, 0, 0);
            continue;
        }
        load_ray(&p->rays[i], b, k);
        if (j->fast->open_sides && !p->rays[i].inside && !hc_fast_emerge(j->fast, &p->rays[i])) {
            answer_ray(j, p->which[i], NULL, NULL, 0, 0);
            continue;
        }
        if (b->long_enough[k] != 0 && !p->rays[i].emerged && !j->fast->x.wrapped
            && !j->fast->y.wrapped) {
            load_lane(j->fast, p, i, b, k);
            return true;
        }
        if (go_on(j, p, i, p->rays[i].from)) {
            return true;
        }
    }
    return false;
}

/* ---- lanes ----------------------------------------------------------------------------------- */

typedef struct place {
    hc_v s, x, y, z;
    hc_i cell_x, cell_y; /* mirrored      */
    hc_i at_x, at_y;     /* as they are   */
} place;

static inline hc_i unmirror(hc_i cell, const int32_t *flip, const int32_t *add, int cells)
{
    const hc_i at = hc_i_add(hc_i_xor(cell, hc_i_load(flip)), hc_i_load(add));
    return hc_i_max(hc_i_min(at, hc_i_set(cells - 1)), hc_i_set(0));
}

static inline place find_place(const hc_fast *fast, const pack *p)
{
    place at;
    at.s      = hc_v_load(p->s);
    at.x      = hc_v_about_muladd(at.s, hc_v_load(p->dx), hc_v_load(p->x));
    at.y      = hc_v_about_muladd(at.s, hc_v_load(p->dy), hc_v_load(p->y));
    at.z      = hc_v_about_muladd(at.s, hc_v_load(p->dz), hc_v_load(p->z));
    at.cell_x = hc_i_from_v(at.x);
    at.cell_y = hc_i_from_v(at.y);
    at.at_x   = unmirror(at.cell_x, p->flip_x, p->add_x, fast->x.cells);
    at.at_y   = unmirror(at.cell_y, p->flip_y, p->add_y, fast->y.cells);
    return at;
}

/* s to the wall of the block whose cells have `inside` as their lower bits. */
static inline hc_v to_wall(hc_v x, hc_i cell, hc_i inside, const float *reciprocal)
{
    const hc_i wall = hc_i_add(hc_i_or(cell, inside), hc_i_set(1));
    return hc_v_mul(hc_v_sub(hc_v_from_i(wall), x), hc_v_load(reciprocal));
}

/* Lanes so near to a wall that they run along it, or cut a corner, that rounding may have put them
 * on the wrong side. It matters on steps alone, which jump there: blocks of patches are raised. */
static inline unsigned find_unsure(const hc_fast *fast, const pack *p, const place *at, hc_i inside,
                                   hc_v out)
{
    const hc_v     close   = hc_v_set(4.0F * fast->blur);
    const hc_v     side    = hc_v_add(hc_v_from_i(inside), hc_v_set(1.0F));
    const hc_i     within  = hc_i_xor(inside, hc_i_set(-1));
    const hc_v     low_x   = hc_v_sub(at->x, hc_v_from_i(hc_i_and(at->cell_x, within)));
    const hc_v     low_y   = hc_v_sub(at->y, hc_v_from_i(hc_i_and(at->cell_y, within)));
    const hc_v     end_x   = hc_v_about_muladd(out, hc_v_load(p->dx), low_x);
    const hc_v     end_y   = hc_v_about_muladd(out, hc_v_load(p->dy), low_y);
    const hc_v     far     = hc_v_sub(side, close);
    const unsigned from_x  = hc_v_greater(close, low_x);
    const unsigned from_y  = hc_v_greater(close, low_y);
    const unsigned start   = ~hc_v_greater(at->s, hc_v_set(0.0F));
    const unsigned over_x  = hc_v_greater(end_x, far);
    const unsigned over_y  = hc_v_greater(end_y, far);
    const unsigned along_x = hc_v_greater(close, end_x);
    const unsigned along_y = hc_v_greater(close, end_y);
    return (from_x & from_y) | (start & (from_x | from_y)) | (over_x & (over_y | along_y))
           | (over_y & along_x);
}

/* One block further, or one level deeper, for the lanes in `active`. Returns those that stand on a
 * single cell and may hit it; they have not moved. */
static inline unsigned march(const hc_fast *fast, pack *p, unsigned active, bool steps)
{
    const place at     = find_place(fast, p);
    const hc_i  level  = hc_i_load(p->level);
    const hc_i  shift  = hc_i_add(level, level);
    const hc_i  inside = hc_i_add(hc_i_left(hc_i_set(1), shift), hc_i_set(-1));
    const hc_v  wall_x = to_wall(at.x, at.cell_x, inside, p->rx);
    const hc_v  wall_y = to_wall(at.y, at.cell_y, inside, p->ry);
    const hc_v  out    = hc_v_max(hc_v_min(wall_x, wall_y), hc_v_set(fast->blur));
    const hc_i  row    = hc_i_mul(hc_i_right(at.at_y, shift), hc_i_lookup(fast->stride, level));
    const hc_i  index =
        hc_i_add(hc_i_add(row, hc_i_right(at.at_x, shift)), hc_i_lookup(fast->start, level));
    hc_i top_bits, codes;
    hc_gather_pairs(&top_bits, &codes, fast->blocks, index, active);
    const hc_i code  = hc_i_and(hc_i_right(codes, hc_i_load(p->quadrant)), hc_i_set(255));
    const hc_v slope = hc_v_of_bits(
        hc_i_add(hc_i_left(code, hc_i_set(HC_FAST_SLOPE_SHIFT)), hc_i_set(HC_FAST_SLOPE_BIAS)));
    const hc_v top   = hc_v_of_bits(top_bits);
    const hc_v dz    = hc_v_load(p->dz);
    const hc_v leave = hc_v_about_muladd(out, dz, at.z);

    const unsigned unsure = steps ? find_unsure(fast, p, &at, inside, out) : 0;
    const unsigned clear  = hc_v_greater(hc_v_min(at.z, leave), top) & active & ~unsure;
    const hc_v     fall   = hc_v_sub(slope, dz); /* of the ray towards the cone, per s */
    const hc_v     cone   = hc_v_div(hc_v_sub(leave, top), fall);
    const hc_v     free   = steps ? hc_v_set(0.0F) : cone;
    const unsigned away   = steps ? 0 : clear & ~hc_v_greater(fall, hc_v_set(0.0F));
    const hc_v     ahead  = hc_v_add(hc_v_add(at.s, out), free);
    const hc_v     past   = hc_v_pick(away, hc_v_load(p->end), ahead);
    const unsigned fine   = ~hc_v_greater(hc_v_from_i(level), hc_v_set(0.0F)) & active & ~clear;
    hc_v_store(p->s, hc_v_pick(clear, past, at.s));

    const unsigned deeper = active & ~clear & ~fine;
    const hc_v     far    = hc_v_mul(hc_v_from_i(inside), hc_v_set(RISE));
    const unsigned up     = clear & hc_v_greater(hc_v_sub(past, at.s), far);
    const hc_i     most   = hc_i_set(fast->levels - 1);
    const hc_i     risen  = hc_i_min(hc_i_add(level, hc_i_set(1)), most);
    const hc_i     sunk   = hc_i_add(level, hc_i_set(-1));
    hc_i_store(p->level, hc_i_pick(deeper, sunk, hc_i_pick(up, risen, level)));
    hc_i_store(p->steps,
               hc_i_add(hc_i_load(p->steps), hc_i_pick(active, hc_i_set(1), hc_i_set(0))));
    hc_i_store(p->crossings,
               hc_i_add(hc_i_load(p->crossings), hc_i_pick(clear, hc_i_set(1), hc_i_set(0))));
    return fine;
}

/* Lanes that rounding has put beyond the last cell. */
static inline unsigned find_outside(const pack *p, const place *at)
{
    const hc_i x = hc_i_add(hc_i_xor(at->at_x, hc_i_load(p->flip_x)), hc_i_load(p->add_x));
    const hc_i y = hc_i_add(hc_i_xor(at->at_y, hc_i_load(p->flip_y)), hc_i_load(p->add_y));
    return hc_i_differ(x, at->cell_x) | hc_i_differ(y, at->cell_y);
}

typedef struct corners {
    hc_v h00, h10, h01, h11; /* of the mirrored cell */
} corners;

static inline corners find_corners(const hc_fast *fast, const pack *p, const place *at,
                                   unsigned lanes)
{
    const unsigned flip_x = hc_i_differ(hc_i_load(p->flip_x), hc_i_set(0));
    const unsigned flip_y = hc_i_differ(hc_i_load(p->flip_y), hc_i_set(0));
    const hc_i     row    = hc_i_mul(at->at_y, hc_i_set(fast->stride_heights));
    const hc_i     index  = hc_i_add(row, at->at_x);
    hc_i           h00, h10, h01, h11;
    hc_gather_neighbours(&h00, &h10, fast->heights, index, lanes);
    hc_gather_neighbours(&h01, &h11, fast->heights + fast->stride_heights, index, lanes);
    const hc_i a00 = hc_i_pick(flip_x, h10, h00);
    const hc_i a10 = hc_i_pick(flip_x, h00, h10);
    const hc_i a01 = hc_i_pick(flip_x, h11, h01);
    const hc_i a11 = hc_i_pick(flip_x, h01, h11);
    return (corners){ hc_v_of_bits(hc_i_pick(flip_y, a01, a00)),
                      hc_v_of_bits(hc_i_pick(flip_y, a11, a10)),
                      hc_v_of_bits(hc_i_pick(flip_y, a00, a01)),
                      hc_v_of_bits(hc_i_pick(flip_y, a10, a11)) };
}

static inline hc_v gap_at(const corners *h, hc_v x, hc_v y, hc_v z)
{
    const hc_v upper = hc_v_about_muladd(x, hc_v_sub(h->h10, h->h00), h->h00);
    const hc_v lower = hc_v_about_muladd(x, hc_v_sub(h->h11, h->h01), h->h01);
    return hc_v_sub(z, hc_v_about_muladd(y, hc_v_sub(lower, upper), upper));
}

/* Lanes on single cells: which may hit their patch? The others go on to the next cell. `*span` is
 * the way over the cell. */
static inline unsigned look(const hc_fast *fast, pack *p, unsigned lanes, float span[HC_LANES])
{
    const place at     = find_place(fast, p);
    const hc_i  inside = hc_i_set(0);
    const hc_v  blur   = hc_v_set(fast->blur);
    const hc_v  wall_x = to_wall(at.x, at.cell_x, inside, p->rx);
    const hc_v  wall_y = to_wall(at.y, at.cell_y, inside, p->ry);
    const hc_v  out    = hc_v_max(hc_v_min(wall_x, wall_y), blur);
    hc_v_store(span, out);
    if (fast->steps) {
        return lanes;
    }
    const corners h     = find_corners(fast, p, &at, lanes);
    const hc_i    index = hc_i_add(hc_i_mul(at.at_y, hc_i_set(fast->stride[0])), at.at_x);
    hc_i          top_bits, codes;
    hc_gather_pairs(&top_bits, &codes, fast->blocks, index, lanes);

    const hc_v most   = hc_v_max(hc_v_max(h.h00, h.h10), hc_v_max(h.h01, h.h11));
    const hc_v least  = hc_v_min(hc_v_min(h.h00, h.h10), hc_v_min(h.h01, h.h11));
    const hc_v raised = hc_v_of_bits(top_bits);
    const hc_v blurred =
        hc_v_mul(hc_v_add(blur, blur), hc_v_sub(raised, least)); /* beyond the cell's walls */
    const hc_v slack = hc_v_add(blurred, hc_v_sub(raised, most));
    const hc_v x     = hc_v_sub(at.x, hc_v_from_i(at.cell_x));
    const hc_v y     = hc_v_sub(at.y, hc_v_from_i(at.cell_y));
    const hc_v run_x = hc_v_mul(out, hc_v_load(p->dx));
    const hc_v run_y = hc_v_mul(out, hc_v_load(p->dy));
    const hc_v enter = gap_at(&h, x, y, at.z);
    const hc_v leave = gap_at(&h, hc_v_add(x, run_x), hc_v_add(y, run_y),
                              hc_v_about_muladd(out, hc_v_load(p->dz), at.z));
    const hc_v twist = hc_v_sub(hc_v_add(h.h00, h.h11), hc_v_add(h.h10, h.h01));
    const hc_v bulge = hc_v_mul(hc_v_mul(hc_v_abs(twist), hc_v_set(0.25F)), hc_v_mul(run_x, run_y));
    const hc_v gap   = hc_v_sub(hc_v_min(enter, leave), bulge);
    const unsigned clear = hc_v_greater(gap, slack) & lanes & ~find_outside(p, &at);
    hc_v_store(p->s, hc_v_pick(clear, hc_v_add(at.s, out), at.s));
    hc_i_store(p->crossings,
               hc_i_add(hc_i_load(p->crossings), hc_i_pick(clear, hc_i_set(1), hc_i_set(0))));
    return lanes & ~clear;
}

/* ---- all together ---------------------------------------------------------------------------- */

/* Lanes that may hit the cell they stand on. Returns those that are done. */
static unsigned decide(const job *j, pack *p, unsigned doubtful, const float span[HC_LANES])
{
    unsigned done = 0;
    for (; doubtful != 0; doubtful &= doubtful - 1) {
        const int     i    = __builtin_ctz(doubtful);
        const double  from = p->from[i] + p->scale[i] * (double)p->s[i];
        const double  to   = p->from[i] + p->scale[i] * (double)(p->s[i] + span[i]);
        hc_fast_found found;
        if (hc_fast_walk(j->fast, &p->rays[i], &found, from, to)) {
            answer_ray(j, p->which[i], &p->rays[i], &found, p->steps[i], p->crossings[i]);
            done |= 1U << i;
        }
        p->s[i] += span[i];
        p->crossings[i]++;
    }
    return done;
}

static unsigned refill(job *j, pack *p, unsigned lanes)
{
    unsigned active = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        active |= (unsigned)take_ray(j, p, i) << i;
    }
    return active;
}

/* Lanes at the end of their segment: to the next one. Returns those that are done. */
static unsigned end_segments(const job *j, pack *p, unsigned ended)
{
    unsigned done = 0;
    for (; ended != 0; ended &= ended - 1) {
        const int i = __builtin_ctz(ended);
        if (p->next[i] >= p->rays[i].to) {
            answer_ray(j, p->which[i], NULL, NULL, p->steps[i], p->crossings[i]);
            done |= 1U << i;
        } else if (!go_on(j, p, i, p->next[i])) {
            done |= 1U << i;
        }
    }
    return done;
}

/* One round of a pack; false when it has no rays left. */
static inline bool round_of(job *j, pack *p)
{
    const unsigned ready = p->active & ~p->near;
    float          span[HC_LANES];
    if (ready != 0) {
        p->near |=
            j->fast->steps ? march(j->fast, p, ready, true) : march(j->fast, p, ready, false);
    }
    if (__builtin_popcount(p->near) >= NEAR_MIN || p->near == p->active) {
        p->active &= ~decide(j, p, look(j->fast, p, p->near, span), span);
        p->near = 0;
    }
    const unsigned ended = p->active & ~p->near & ~hc_v_greater(hc_v_load(p->end), hc_v_load(p->s));
    if (ended != 0) {
        p->active &= ~end_segments(j, p, ended);
    }
    const unsigned idle = ~p->active & ALL_LANES;
    if ((j->ready.next < j->ready.count || j->taken < j->count)
        && (__builtin_popcount(idle) >= DONE_MIN || p->active == 0)) {
        p->active |= refill(j, p, idle);
    }
    return p->active != 0;
}

void HC_FAST_KERNEL(const hc_fast *fast, hc_fast_answer answer, const hc_ray *rays, size_t count)
{
    job      j = { .fast = fast, .answer = answer, .rays = rays, .count = count };
    pack     packs[PACKS];
    unsigned busy = 0;
    for (int k = 0; k < PACKS; k++) {
        /* idle lanes are computed too: their levels must be some level */
        memset(&packs[k], 0, sizeof packs[k]);
        packs[k].active = refill(&j, &packs[k], ALL_LANES);
        busy |= (unsigned)(packs[k].active != 0) << k;
    }
    while (busy != 0) {
        for (int k = 0; k < PACKS; k++) {
            if ((busy >> k & 1) != 0 && !round_of(&j, &packs[k])) {
                busy &= ~(1U << k);
            }
        }
    }
}
