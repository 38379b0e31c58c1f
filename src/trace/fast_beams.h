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
    runners  ray;
    float    s[HC_LANES]; /* of the beam, where rays begin */
    unsigned lanes;
};

typedef struct beams {
    float   low[2][HC_LANES], high[2][HC_LANES], z[HC_LANES]; /* of the box, where s is 0 */
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

/* Lanes outside `lanes` like one of those inside. */
static inline hc_v fill_lanes(unsigned lanes, const float *values)
{
    return hc_v_pick(lanes, hc_v_load(values), hc_v_set(values[__builtin_ctz(lanes)]));
}

static inline void span_of(float *low, float *high, unsigned lanes, const float *values)
{
    const hc_v v = fill_lanes(lanes, values);
    *low         = hc_v_lowest(v);
    *high        = hc_v_highest(v);
}

/* Where rays would be at the beam's beginning. */
static inline void go_back(float *at, const group *g, const float *from, const float *rate)
{
    const hc_v s = hc_v_sub(hc_v_set(0.0F), hc_v_load(g->s));
    hc_v_store(at, hc_v_about_muladd(s, hc_v_load(rate), hc_v_load(from)));
}

/* Make beam k of a group. False if its rays are too far apart, or begin so high that rounding would
 * lose more of their heights than of those in the field. */
static inline bool join_beam(beams *b, int k, const group *g, int first_level)
{
    const runners *const q       = &g->ray;
    const float *const   from[2] = { q->x, q->y };
    const float *const   rate[2] = { q->dx, q->dy };
    const int            one     = __builtin_ctz(g->lanes);
    float                at[HC_LANES];
    float                unused, highest;
    for (int i = 0; i < 2; i++) {
        go_back(at, g, from[i], rate[i]);
        span_of(&b->low[i][k], &b->high[i][k], g->lanes, at);
        span_of(&b->low_rate[i][k], &b->high_rate[i][k], g->lanes, rate[i]);
        if (!(b->high[i][k] - b->low[i][k] <= BEAM_WIDTH)
            || !(b->high_rate[i][k] - b->low_rate[i][k] <= BEAM_ANGLE)) {
            return false;
        }
        const bool  up   = rate[i][one] > 0.0F;
        const float fast = up ? b->high_rate[i][k] : -b->low_rate[i][k];
        const float over = 1.0F / (fast > 0x1p-60F ? fast : 0x1p-60F);
        b->over[i][k]    = up ? over : -over;
        b->ahead[i][k]   = up;
    }
    go_back(at, g, q->z, q->dz);
    span_of(&b->z[k], &highest, g->lanes, at);
    span_of(&b->dz[k], &unused, g->lanes, q->dz);
    hc_v_store(at, hc_v_add(hc_v_load(q->end), hc_v_load(g->s)));
    span_of(&unused, &b->end[k], g->lanes, at);
    span_of(&b->s[k], &unused, g->lanes, g->s);
    b->quadrant[k] = q->quadrant[one];
    b->level[k]    = first_level;
    return highest <= 2.0F;
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

static inline cover cover_box(const hc_fast *fast, const beams *b, const footing *x,
                              const footing *y, hc_i level, unsigned lanes)
{
    const hc_i stride   = hc_i_lookup(fast->stride, level);
    const hc_i start    = hc_i_lookup(fast->start, level);
    const hc_i quadrant = hc_i_load(b->quadrant);
    cover      all      = { .top = hc_v_set(0.0F) };
    for (int k = 0; k < 4; k++) {
        const hc_i index = hc_i_add(
            index_of(x->block[k & 1], y->block[k >> 1], stride, HC_FAST_BLOCK_BITS), start);
        hc_i top;
        hc_i codes;
        hc_gather_pairs(&top, &codes, fast->blocks, index, lanes);
        const hc_i code = hc_i_and(hc_i_right(codes, quadrant), hc_i_set(255));
        all.top         = k == 0 ? hc_v_of_bits(top) : hc_v_max(all.top, hc_v_of_bits(top));
        all.code        = k == 0 ? code : hc_i_max(all.code, code);
    }
    return all;
}

/* One step, or one level up or down, of the beams in `active`. Returns those that go on. */
static inline unsigned step_beams(const hc_fast *fast, beams *b, unsigned active, unsigned *sinking)
{
    const hc_v     s     = hc_v_load(b->s);
    const hc_v     z     = hc_v_about_muladd(s, hc_v_load(b->dz), hc_v_load(b->z));
    const hc_v     down  = hc_v_sub(hc_v_set(0.0F), hc_v_load(b->dz));
    const hc_i     level = hc_i_load(b->level);
    const hc_i     shift = hc_i_add(hc_i_add(level, level), hc_i_set(HC_FAST_BASE_BITS));
    const footing  x     = find_footing(b, 0, s, shift, fast->x.cells);
    const footing  y     = find_footing(b, 1, s, shift, fast->y.cells);
    const unsigned wide  = is_wide(&x) | is_wide(&y);
    const unsigned fits  = active & ~wide;
    const cover    c     = cover_box(fast, b, &x, &y, level, fits);
    const hc_v     wall  = hc_v_max(hc_v_min(x.out, y.out), hc_v_set(0.0F));
    const hc_v     out   = hc_v_add(wall, hc_v_set(fast->blur));
    const hc_v     leave = hc_v_sub(z, hc_v_mul(out, down));
    const unsigned above = hc_v_greater(z, c.top) & fits;
    const unsigned clear = above & hc_v_greater(leave, c.top);
    const hc_v     side  = hc_v_from_i(hc_i_left(hc_i_set(1), shift));
    const hc_v     beyond =
        go_beyond(fast, c.code, shift, hc_v_sub(leave, c.top), down, side, GROUND_PATCHES);
    const hc_v descent = hc_v_max(down, hc_v_set(0x1p-60F));
    const hc_v part    = hc_v_about_over(hc_v_sub(z, c.top), descent);
    const hc_v step    = hc_v_pick(clear, hc_v_add(out, beyond), part);
    const hc_v ahead   = hc_v_pick(above, hc_v_add(s, step), s);
    hc_v_store(b->s, ahead);

    const unsigned rises   = clear | (wide & active & ~*sinking);
    const unsigned falls   = fits & ~clear;
    const hc_i     last    = hc_i_set(fast->levels - 1);
    const unsigned bottom  = ~hc_i_differ(level, hc_i_set(0));
    const unsigned ceiling = ~hc_i_differ(level, last);
    const hc_i     up      = hc_i_pick(rises, hc_i_add(level, hc_i_set(1)), level);
    const hc_i     next    = hc_i_pick(falls & ~bottom, hc_i_add(level, hc_i_set(-1)), up);
    hc_i_store(b->level, hc_i_min(next, last));
    const unsigned stops = (wide & (*sinking | ceiling)) | (falls & bottom);
    *sinking             = falls;
    return active & ~stops & hc_v_greater(hc_v_load(b->end), ahead);
}

/* Until few of the first `count` beams go on. */
static inline void march_beams(const hc_fast *fast, beams *b, int count)
{
    enum { FEW = 1, ROUNDS = 40 };
    unsigned active  = (1U << count) - 1;
    unsigned sinking = 0;
    for (int i = 0; i < ROUNDS && __builtin_popcount(active) > (count > FEW ? FEW : 0); i++) {
        active = step_beams(fast, b, active, &sinking);
    }
}

#endif
