/* Beams: sixteen rays each that start in nearly one place and go in nearly one direction. A beam
 * is marched like a ray, sixteen of them in lanes, as far as none of its rays can hit anything; the
 * rays go on from there.
 *
 * All rays of a beam go the same way up or down along both axes, so that those that have gone s
 * sideways stand in a box, whose sides and bottom move along lines. The blocks under the box are
 * four at most, on a level whose blocks are wide enough; the highest top and the steepest slope of
 * them hold for each ray. */
#ifndef HC_TRACE_FAST_BEAMS_H
#define HC_TRACE_FAST_BEAMS_H

#include "fast_decide.h"

/* Sixteen new rays, in lanes as far as they are to be marched. */
struct group {
    batch    b;
    pack     p;
    float    s[HC_LANES]; /* of the beam, where rays begin */
    unsigned lanes;
    int      beam;  /* whose rays they are       */
    bool     begun; /* its rays have left the beam */
};

typedef struct beams {
    HC_ROW(float) low[2][HC_LANES];
    float   high[2][HC_LANES], z[HC_LANES]; /* of the box, where s is 0 */
    float   low_rate[2][HC_LANES], high_rate[2][HC_LANES], dz[HC_LANES]; /* per s       */
    float   over[2][HC_LANES];                      /* 1 / rate of the side ahead */
    int32_t ahead[2][HC_LANES], quadrant[HC_LANES]; /* as of runners              */
    float   s[HC_LANES], end[HC_LANES];
    int32_t level[HC_LANES];
} beams;

/* Rays farther apart than so many cells, or than this per cell gone, are no beam; nor are fewer
 * than so many. */
enum { BEAM_RAYS = 8 };
static const float BEAM_WIDTH = 32.0F;
static const float BEAM_ANGLE = 0.125F;

/* What a beam's box is made of: where the rays would be at the beam's beginning, how fast they go,
 * and s where they begin and end. */
enum { AT_X, AT_Y, AT_Z, RATE_X, RATE_Y, RATE_Z, BEGIN, END, BOX };

static inline hc_v go_back(const group *g, const float *from, hc_v rate)
{
    const hc_v s = hc_v_sub(hc_v_set(0.0F), hc_v_load(g->s));
    return hc_v_about_muladd(s, rate, hc_v_load(from));
}

static inline void find_box(float low[BOX], float high[BOX], const group *g)
{
    const runners *const q            = &g->p.ray;
    const hc_v           s            = hc_v_load(g->s);
    const hc_v           dx           = hc_v_load(q->dx);
    const hc_v           dy           = hc_v_load(q->dy);
    const hc_v           dz           = hc_v_load(q->dz);
    const hc_v           x            = go_back(g, q->x, dx);
    const hc_v           y            = go_back(g, q->y, dy);
    const hc_v           z            = go_back(g, q->z, dz);
    const hc_v           end          = hc_v_add(hc_v_load(q->end), s);
    const hc_v           of_rays[BOX] = { x, y, z, dx, dy, dz, s, end };
    const hc_v           least        = hc_v_set(-INFINITY);
    hc_v                 rows[2 * BOX];
    float                highest[2 * BOX];
    for (int k = 0; k < BOX; k++) {
        rows[k]       = hc_v_pick(g->lanes, of_rays[k], least);
        rows[BOX + k] = hc_v_pick(g->lanes, hc_v_sub(hc_v_set(0.0F), of_rays[k]), least);
    }
    hc_highest_of(highest, rows);
    for (int k = 0; k < BOX; k++) {
        high[k] = highest[k];
        low[k]  = -highest[BOX + k];
    }
}

/* Beam k along an axis. False if its rays do not all go up, or all down, or are too far apart. */
static inline bool join_axis(beams *b, int k, int axis, const float low[BOX], const float high[BOX])
{
    const int   at        = AT_X + axis;
    const int   rate      = RATE_X + axis;
    const bool  up        = low[rate] > 0.0F;
    const float fastest   = up ? high[rate] : -low[rate];
    const float over      = 1.0F / (fastest > 0x1p-60F ? fastest : 0x1p-60F);
    b->low[axis][k]       = low[at];
    b->high[axis][k]      = high[at];
    b->low_rate[axis][k]  = low[rate];
    b->high_rate[axis][k] = high[rate];
    b->over[axis][k]      = up ? over : -over;
    b->ahead[axis][k]     = up;
    return (up || high[rate] < 0.0F) && high[at] - low[at] <= BEAM_WIDTH
           && high[rate] - low[rate] <= BEAM_ANGLE;
}

/* Make beam k of a group. False if its rays are too far apart, or begin far from each other, or so
 * high that rounding would lose more of their heights than of those in the field. */
static inline bool join_beam(beams *b, int k, const group *g, const hc_fast *fast)
{
    float low[BOX];
    float high[BOX];
    find_box(low, high, g);
    b->z[k]          = low[AT_Z];
    b->dz[k]         = low[RATE_Z];
    b->s[k]          = low[BEGIN];
    b->end[k]        = high[END];
    b->quadrant[k]   = g->p.ray.quadrant[__builtin_ctz(g->lanes)];
    b->level[k]      = fast->first_level;
    const float most = 0.0625F * (float)(fast->x.cells + fast->y.cells);
    return join_axis(b, k, 0, low, high) && join_axis(b, k, 1, low, high) && high[AT_Z] <= 2.0F
           && high[BEGIN] - low[BEGIN] <= most;
}

/* Along one axis: the blocks under the box, and s until its side ahead leaves its own. */
typedef struct footing {
    hc_i block[2];
    hc_v out;
} footing;

static inline footing find_footing(const beams *b, int axis, hc_v s, hc_i shift, int cells)
{
    const hc_v nowhere = hc_v_set(0.0F);
    const hc_v end     = hc_v_set((float)cells);
    const hc_v low  = hc_v_about_muladd(s, hc_v_load(b->low_rate[axis]), hc_v_load(b->low[axis]));
    const hc_v high = hc_v_about_muladd(s, hc_v_load(b->high_rate[axis]), hc_v_load(b->high[axis]));
    const hc_v in_low  = hc_v_min(hc_v_max(low, nowhere), end);
    const hc_v in_high = hc_v_min(hc_v_max(high, nowhere), end);
    const hc_i first   = hc_i_right(hc_i_from_v(in_low), shift);
    const hc_i last    = hc_i_right(hc_i_from_v(in_high), shift);
    const hc_i ahead   = hc_i_load(b->ahead[axis]);
    const unsigned up  = hc_i_differ(ahead, hc_i_set(0));
    return (footing){ { first, last },
                      to_wall(hc_v_pick(up, in_high, in_low), hc_i_pick(up, last, first), shift,
                              b->ahead[axis], b->over[axis]) };
}

/* True where a box lies on more than two blocks along an axis. */
static inline unsigned is_wide(const footing *f)
{
    const hc_i minus_first = hc_i_xor(f->block[0], hc_i_set(-1)); /* less 1 */
    const hc_i between     = hc_i_max(hc_i_add(f->block[1], minus_first), hc_i_set(0));
    return hc_i_differ(between, hc_i_set(0));
}

/* What holds for all blocks under the box; the code as of one. */
typedef struct cover {
    hc_v top;
    hc_i code;
} cover;

static inline hc_i worse_code(hc_i a, hc_i b, ground kind)
{
    if (kind != GROUND_SPARSE) {
        return hc_i_max(a, b);
    }
    const hc_i free = hc_i_set((1 << HC_FAST_FREE_BITS) - 1);
    const hc_i rest = hc_i_set(~((1 << HC_FAST_FREE_BITS) - 1));
    return hc_i_or(hc_i_max(hc_i_and(a, rest), hc_i_and(b, rest)),
                   hc_i_min(hc_i_and(a, free), hc_i_and(b, free)));
}

static inline cover cover_box(const hc_fast *fast, const beams *b, const footing *x,
                              const footing *y, hc_i level, unsigned lanes, ground kind)
{
    const hc_i stride = hc_i_lookup(fast->stride, level);
    const hc_i start  = hc_i_add(hc_i_lookup(fast->start, level), hc_i_load(b->quadrant));
    cover      all    = { .top = hc_v_set(0.0F) };
    for (int k = 0; k < 4; k++) {
        const hc_i index = hc_i_add(
            index_of(x->block[k & 1], y->block[k >> 1], stride, HC_FAST_BLOCK_BITS), start);
        const hc_v top  = hc_v_gather(fast->blocks, index, lanes);
        const hc_i code = code_of(hc_v_bits(top));
        all.top         = k == 0 ? top : hc_v_max(all.top, top);
        all.code        = k == 0 ? code : worse_code(all.code, code, kind);
    }
    return all;
}

/* Where beams are: s, and on which level; up to which s they stay there, as the blocks of the next
 * level have just been in the way; which of them came down last. */
typedef struct stand {
    hc_v     s, until;
    hc_i     level;
    unsigned sinking;
} stand;

/* One step, or one level up or down, of the beams in `active`. Returns those that go on. */
static inline unsigned step_beams(const hc_fast *fast, const beams *b, stand *at, unsigned active,
                                  ground kind)
{
    const hc_v     s     = at->s;
    const hc_v     z     = hc_v_about_muladd(s, hc_v_load(b->dz), hc_v_load(b->z));
    const hc_v     down  = hc_v_sub(hc_v_set(0.0F), hc_v_load(b->dz));
    const hc_i     level = at->level;
    const hc_i     shift = hc_i_add(hc_i_add(level, level), hc_i_set(HC_FAST_BASE_BITS));
    const footing  x     = find_footing(b, 0, s, shift, fast->x.cells);
    const footing  y     = find_footing(b, 1, s, shift, fast->y.cells);
    const unsigned wide  = is_wide(&x) | is_wide(&y);
    const unsigned fits  = active & ~wide;
    const cover    c     = cover_box(fast, b, &x, &y, level, fits, kind);
    const hc_v     wall  = hc_v_max(hc_v_min(x.out, y.out), hc_v_set(0.0F));
    const hc_v     out   = hc_v_add(wall, hc_v_set(fast->blur));
    const hc_v     leave = hc_v_sub(z, hc_v_mul(out, down));
    const unsigned above = hc_v_greater(z, c.top) & fits;
    const unsigned clear = above & hc_v_greater(leave, c.top);
    const hc_v     side  = hc_v_from_i(hc_i_left(hc_i_set(1), shift));
    const hc_v beyond    = go_beyond(fast, c.code, shift, hc_v_sub(leave, c.top), down, side, kind);
    const hc_v descent   = hc_v_max(down, hc_v_set(0x1p-60F));
    const hc_v part      = hc_v_about_over(hc_v_sub(z, c.top), descent);
    const hc_v step      = hc_v_pick(clear, hc_v_add(out, beyond), part);
    const hc_v ahead     = hc_v_pick(above, hc_v_add(s, step), s);

    const unsigned leaves  = clear & ~hc_v_greater(at->until, ahead);
    const unsigned rises   = leaves | (wide & active & ~at->sinking);
    const unsigned falls   = fits & ~clear;
    const hc_i     last    = hc_i_set(fast->levels - 1);
    const unsigned bottom  = ~hc_i_differ(level, hc_i_set(0));
    const unsigned ceiling = ~hc_i_differ(level, last);
    const hc_i     up      = hc_i_pick(rises, hc_i_add(level, hc_i_set(1)), level);
    const hc_i     next    = hc_i_pick(falls & ~bottom, hc_i_add(level, hc_i_set(-1)), up);
    const unsigned stops   = (wide & (at->sinking | ceiling)) | (falls & bottom);
    at->s                  = ahead;
    at->until              = hc_v_pick(falls, hc_v_add(s, hc_v_add(out, side)), at->until);
    at->level              = hc_i_min(next, last);
    at->sinking            = falls;
    return active & ~stops & hc_v_greater(hc_v_load(b->end), ahead);
}

/* Until few of the first `count` beams go on: the longer it takes, the more are few. */
static inline void march_beams(const hc_fast *fast, beams *b, int count, ground kind)
{
    enum { FEW = 1, PATIENCE = 32 };
    const int few    = count > FEW ? FEW : 0;
    unsigned  active = (1U << count) - 1;
    stand     at     = { .s = hc_v_load(b->s), .level = hc_i_load(b->level) };
    at.until         = at.s;
    for (int i = 0; __builtin_popcount(active) > few + i / PATIENCE; i++) {
        active = step_beams(fast, b, &at, active, kind);
    }
    hc_v_store(b->s, at.s);
    hc_i_store(b->level, at.level);
}

#endif
