/* Sixteen rays in lanes, each at its own block on its own level.
 *
 * A lane counts s, the cells gone sideways (|du| + |dv|), so that a slope times s is a rise. On its
 * block it sees whether it stays above the top until it leaves; then it goes on to where the cone
 * around the block, from there on, would let it down, and otherwise one level deeper. On single
 * cells the patch is looked at; what that leaves in doubt is decided in double precision.
 *
 * Everything here is float and only has to err on the safe side: fast_build.c has raised tops and
 * slopes by what rounding can misplace. */
#ifndef HC_TRACE_FAST_MARCH_H
#define HC_TRACE_FAST_MARCH_H

#include "base/lanes.h"
#include "fast_data.h"

/* What a ray brings into a lane; words all. */
typedef struct runners {
    HC_ROW(float) x[HC_LANES];                        /* where the segment starts             */
    float   y[HC_LANES], z[HC_LANES];                 /* likewise                             */
    float   dx[HC_LANES], dy[HC_LANES], dz[HC_LANES]; /* per s; |dx| + |dy| = 1               */
    float   rx[HC_LANES], ry[HC_LANES];               /* 1 / dx, 1 / dy                       */
    float   end[HC_LANES];                            /* s                                    */
    int32_t ahead_x[HC_LANES], ahead_y[HC_LANES];     /* 1: the ray goes up along the axis    */
    int32_t quadrant[HC_LANES];                       /* where its blocks stand               */
    int32_t which[HC_LANES];                          /* of the rays                          */
    int32_t steps[HC_LANES], crossings[HC_LANES];
} runners;

enum { RUNNER_WORDS = sizeof(runners) / (HC_LANES * sizeof(int32_t)) };

typedef struct group group;

typedef struct pack {
    runners  ray;
    double   from[HC_LANES], next[HC_LANES]; /* t at the segment's start and end */
    float    s[HC_LANES];
    float    until[HC_LANES]; /* s at which a near lane leaves its block */
    float    again[HC_LANES]; /* s from which on a lane may glide        */
    int32_t  level[HC_LANES];
    unsigned active;   /* lanes with a ray                        */
    unsigned near;     /* of them: waiting on a cell to be looked at */
    unsigned held;     /* of them: waiting to be decided          */
    bool     together; /* most often they all stand on one cell   */

    /* Whose rays these are: then they keep their lanes until all are done, and where they wait is
     * kept here. NULL: rays of any kind, which are replaced one by one. */
    const group *group;
    HC_ROW(int32_t) cell_x[HC_LANES];
    int32_t cell_y[HC_LANES];
    float   span[HC_LANES];
    float   heights[4][HC_LANES]; /* of corners: h00, h10, h01, h11 */
} pack;

typedef struct place {
    hc_v s, x, y, z;
    hc_i cell_x, cell_y;
} place;

static inline place find_place(const pack *p)
{
    place at;
    at.s      = hc_v_load(p->s);
    at.x      = hc_v_about_muladd(at.s, hc_v_load(p->ray.dx), hc_v_load(p->ray.x));
    at.y      = hc_v_about_muladd(at.s, hc_v_load(p->ray.dy), hc_v_load(p->ray.y));
    at.z      = hc_v_about_muladd(at.s, hc_v_load(p->ray.dz), hc_v_load(p->ray.z));
    at.cell_x = hc_i_from_v(at.x);
    at.cell_y = hc_i_from_v(at.y);
    return at;
}

/* s to the wall behind the block. */
static inline hc_v to_wall(hc_v x, hc_i block, hc_i shift, const int32_t *ahead,
                           const float *reciprocal)
{
    const hc_i wall = hc_i_left(hc_i_add(block, hc_i_load(ahead)), shift);
    return hc_v_mul(hc_v_sub(hc_v_from_i(wall), x), hc_v_load(reciprocal));
}

/* s until the block is left, and a little more: no lane stands still. */
static inline hc_v to_leave(const hc_fast *fast, const pack *p, const place *at, hc_i block_x,
                            hc_i block_y, hc_i shift)
{
    const hc_v wall_x = to_wall(at->x, block_x, shift, p->ray.ahead_x, p->ray.rx);
    const hc_v wall_y = to_wall(at->y, block_y, shift, p->ray.ahead_y, p->ray.ry);
    const hc_v wall   = hc_v_max(hc_v_min(wall_x, wall_y), hc_v_set(0.0F));
    return hc_v_add(wall, hc_v_set(fast->blur));
}

/* hc_fast_corner, hc_fast_block_at */
static inline hc_i index_of(hc_i x, hc_i y, hc_i stride, int bits)
{
    const hc_i row  = hc_i_mul(hc_i_right(y, hc_i_set(bits)), stride);
    const hc_i rest = hc_i_and(y, hc_i_set((1 << bits) - 1));
    return hc_i_or(hc_i_left(hc_i_add(row, x), hc_i_set(bits)), rest);
}

static inline hc_i code_of(hc_i block)
{
    return hc_i_and(block, hc_i_set(HC_FAST_CODE));
}

/* Where lanes stand, and what is known of their blocks. */
typedef struct standing {
    place at;
    hc_i  level, shift;
    hc_i  block_x, block_y;
    hc_i  block;
} standing;

/* The index that lanes have in common, or -1. */
static inline int32_t common_index(hc_i index, unsigned lanes)
{
    const int32_t first = hc_i_first(index, lanes);
    return (hc_i_differ(index, hc_i_set(first)) & lanes) == 0 ? first : -1;
}

/* Read once for all lanes where these stand on one block, which is sooner done than gathered. */
static inline hc_i read_blocks(const hc_fast_block *blocks, hc_i index, unsigned lanes,
                               bool together)
{
    const int32_t one = together ? common_index(index, lanes) : -1;
    return one < 0 ? hc_v_bits(hc_v_gather(blocks, index, lanes)) : hc_i_set((int32_t)blocks[one]);
}

static inline standing find_blocks(const hc_fast *fast, const pack *p, unsigned active)
{
    standing on;
    on.at            = find_place(p);
    on.level         = hc_i_load(p->level);
    on.shift         = hc_i_add(hc_i_add(on.level, on.level), hc_i_set(HC_FAST_BASE_BITS));
    on.block_x       = hc_i_right(on.at.cell_x, on.shift);
    on.block_y       = hc_i_right(on.at.cell_y, on.shift);
    const hc_i row   = hc_i_lookup(fast->stride, on.level);
    const hc_i start = hc_i_add(hc_i_lookup(fast->start, on.level), hc_i_load(p->ray.quadrant));
    const hc_i index = index_of(on.block_x, on.block_y, row, HC_FAST_BLOCK_BITS);
    on.block         = read_blocks(fast->blocks, hc_i_add(index, start), active, p->together);
    return on;
}

/* How far a lane has come into its block along one axis. */
static inline hc_v come_in(hc_v x, hc_i block, hc_i shift, const int32_t *ahead)
{
    const hc_i ahead_of = hc_i_load(ahead);
    const hc_i wall     = hc_i_left(hc_i_add(block, hc_i_xor(ahead_of, hc_i_set(1))), shift);
    return hc_v_abs(hc_v_sub(x, hc_v_from_i(wall)));
}

/* How far it will have come along the side by which it leaves. */
static inline hc_v come_aside(const pack *p, const standing *on, hc_v out)
{
    const hc_v x    = come_in(on->at.x, on->block_x, on->shift, p->ray.ahead_x);
    const hc_v y    = come_in(on->at.y, on->block_y, on->shift, p->ray.ahead_y);
    const hc_v side = hc_v_from_i(hc_i_left(hc_i_set(1), on->shift));
    return hc_v_sub(hc_v_add(hc_v_add(x, y), out), side);
}

/* Lanes so near to a wall that they run along it, or cut a corner, that rounding may have put them
 * on the wrong side. It matters on steps alone, which jump there: blocks of patches are raised. */
static inline unsigned find_unsure(const hc_fast *fast, const pack *p, const standing *on, hc_v out)
{
    const place *const at      = &on->at;
    const hc_v         close   = hc_v_set(6.0F * fast->blur);
    const hc_v         side    = hc_v_from_i(hc_i_left(hc_i_set(1), on->shift));
    const hc_v         low_x   = come_in(at->x, on->block_x, on->shift, p->ray.ahead_x);
    const hc_v         low_y   = come_in(at->y, on->block_y, on->shift, p->ray.ahead_y);
    const hc_v         end_x   = hc_v_about_muladd(out, hc_v_abs(hc_v_load(p->ray.dx)), low_x);
    const hc_v         end_y   = hc_v_about_muladd(out, hc_v_abs(hc_v_load(p->ray.dy)), low_y);
    const hc_v         far     = hc_v_sub(side, close);
    const unsigned     from_x  = hc_v_greater(close, low_x);
    const unsigned     from_y  = hc_v_greater(close, low_y);
    const unsigned     start   = ~hc_v_greater(at->s, hc_v_set(0.0F));
    const unsigned     over_x  = hc_v_greater(end_x, far);
    const unsigned     over_y  = hc_v_greater(end_y, far);
    const unsigned     along_x = hc_v_greater(close, end_x);
    const unsigned     along_y = hc_v_greater(close, end_y);
    return (from_x & from_y) | (start & (from_x | from_y)) | (over_x & (over_y | along_y))
           | (over_y & along_x);
}

/* Lanes that are so near to a wall which they leave so slowly that they may be behind it for
 * long. */
static inline unsigned find_slow(const hc_fast *fast, const pack *p, const standing *on)
{
    const hc_v     close = hc_v_set(6.0F * fast->blur);
    const hc_v     slow  = hc_v_set(0.25F);
    const unsigned from_x =
        hc_v_greater(close, come_in(on->at.x, on->block_x, on->shift, p->ray.ahead_x));
    const unsigned from_y =
        hc_v_greater(close, come_in(on->at.y, on->block_y, on->shift, p->ray.ahead_y));
    const unsigned slow_x = hc_v_greater(slow, hc_v_abs(hc_v_load(p->ray.dx)));
    const unsigned slow_y = hc_v_greater(slow, hc_v_abs(hc_v_load(p->ray.dy)));
    return (from_x & slow_x) | (from_y & slow_y);
}

/* What of the ground the marching has to see to; always constant, so that each has its own code. */
typedef enum ground { GROUND_PATCHES, GROUND_SPARSE, GROUND_STEPS } ground;

/* s that a ray goes from where it leaves its block, at most: on to the cone around the block, or,
 * on sparse ground, as far as nothing is higher than the block. `down` is its fall per s, `aside`
 * how far it has come along the side by which it leaves, and no more than the block is wide. */
static inline hc_v go_beyond(const hc_fast *fast, hc_i code, hc_i shift, hc_v above, hc_v down,
                             hc_v aside, ground kind)
{
    if (kind == GROUND_STEPS) {
        return hc_v_set(0.0F);
    }
    const bool sparse = kind == GROUND_SPARSE;
    const hc_i number = sparse ? hc_i_right(code, hc_i_set(HC_FAST_FREE_BITS)) : code;
    const hc_i digits = hc_i_set(sparse ? HC_FAST_SPARSE_SHIFT : HC_FAST_SLOPE_SHIFT);
    const hc_i bias   = hc_i_set(sparse ? HC_FAST_SPARSE_BIAS : HC_FAST_SLOPE_BIAS);
    const hc_v slope  = hc_v_of_bits(hc_i_add(hc_i_left(number, digits), bias));
    const hc_v least  = hc_v_set(0x1p-60F);
    const hc_v cone   = hc_v_about_over(above, hc_v_max(hc_v_add(slope, down), least));
    if (!sparse) {
        return cone;
    }
    const hc_i blocks = hc_i_and(code, hc_i_set((1 << HC_FAST_FREE_BITS) - 1));
    const hc_v gone   = hc_v_add(aside, hc_v_set(8.0F * fast->blur));
    const hc_v way    = hc_v_sub(hc_v_from_i(hc_i_left(blocks, shift)), gone);
    return hc_v_max(cone, hc_v_min(way, hc_v_about_over(above, hc_v_max(down, least))));
}

/* The level after a step: the next coarser one where its block has been left, so that no lane stays
 * among small blocks for long. Over sparse ground, where small blocks see far, half the step's
 * exponent: level k, with blocks of 2 * 4^k cells, comes after steps four times as long. */
static inline hc_i level_after(const hc_fast *fast, const pack *p, const place *at, hc_v step,
                               hc_i level, hc_i shift, ground kind)
{
    const hc_i next = hc_i_min(hc_i_add(level, hc_i_set(1)), hc_i_set(fast->levels - 1));
    if (kind == GROUND_SPARSE) {
        const hc_i half = hc_i_right(hc_v_bits(step), hc_i_set(24));
        return hc_i_min(hc_i_max(hc_i_add(half, hc_i_set(-65)), hc_i_set(0)), next);
    }
    const hc_i     wide = hc_i_add(shift, hc_i_set(HC_FAST_RATIO_BITS));
    const hc_i     to_x = hc_i_from_v(hc_v_about_muladd(step, hc_v_load(p->ray.dx), at->x));
    const hc_i     to_y = hc_i_from_v(hc_v_about_muladd(step, hc_v_load(p->ray.dy), at->y));
    const unsigned left = hc_i_differ(hc_i_right(to_x, wide), hc_i_right(at->cell_x, wide))
                          | hc_i_differ(hc_i_right(to_y, wide), hc_i_right(at->cell_y, wide));
    return hc_i_pick(left, next, level);
}

/* One more for those in `lanes`. */
static inline void count_up(int32_t *counts, unsigned lanes)
{
    hc_i_put(counts, lanes, hc_i_add(hc_i_load(counts), hc_i_set(1)));
}

/* One block further, or one level deeper, for the lanes in `active`, which stand there. Those that
 * stand on a single cell and may hit it become `near`. */
static inline void march(const hc_fast *fast, pack *p, unsigned active, const standing *on,
                         ground kind)
{
    const place *const at    = &on->at;
    const hc_i         level = on->level;
    const hc_i         shift = on->shift;
    const hc_v         out   = to_leave(fast, p, at, on->block_x, on->block_y, shift);
    const hc_i         code  = code_of(on->block);
    const hc_v         top   = hc_v_of_bits(on->block);
    const hc_v         dz    = hc_v_load(p->ray.dz);
    const hc_v         leave = hc_v_about_muladd(out, dz, at->z);
    const hc_v         down  = hc_v_sub(hc_v_set(0.0F), dz);

    const bool     steps  = kind == GROUND_STEPS;
    const unsigned unsure = steps ? find_unsure(fast, p, on, out) : 0;
    const unsigned clear  = hc_v_greater(hc_v_min(at->z, leave), top) & active & ~unsure;
    const unsigned sinks  = hc_v_greater(at->z, top) & active & ~unsure & ~clear;
    const hc_v     aside  = kind == GROUND_SPARSE ? come_aside(p, on, out) : hc_v_set(0.0F);
    const hc_v     beyond = go_beyond(fast, code, shift, hc_v_sub(leave, top), down, aside, kind);
    const hc_v     fall   = hc_v_max(down, hc_v_set(0x1p-60F));
    const hc_v     part   = hc_v_about_over(hc_v_sub(at->z, top), fall);
    const hc_v     step   = hc_v_pick(sinks, part, hc_v_add(out, beyond));
    hc_v_put(p->s, clear | sinks, hc_v_add(at->s, step));

    const unsigned coarse = hc_i_differ(level, hc_i_set(0));
    const unsigned deeper = active & ~clear & coarse;
    const unsigned near   = active & ~clear & ~coarse;
    const hc_i     next   = level_after(fast, p, at, step, level, shift, kind);
    hc_v_put(p->until, near, hc_v_add(at->s, out));
    hc_i_store(p->level,
               hc_i_pick(deeper, hc_i_add(level, hc_i_set(-1)), hc_i_pick(clear, next, level)));
    p->near |= near;

    count_up(p->ray.steps, active);
    count_up(p->ray.crossings, clear);
}

#endif
