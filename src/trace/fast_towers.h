/* Rays over towers. On sparse ground a ray that is above the floor meets nothing but towers, few
 * of which stand near its way. So it is not marched there, but glides from bin to bin of the
 * towers, as far as it can hit none. Rays side by side glide together: towers near their swath are
 * found sixteen at a time, and each is held against all of them. The swath of a ray on its own is
 * its way.
 *
 * A tower is below a box with a tent around it: (1 - p)(1 - q) of its height, where p and q are the
 * distances from the box along the axes. docs/algorithms.md has how high that is along a line.
 *
 * Lengths are in half cells, on which the middles of boxes lie. */
#ifndef HC_TRACE_FAST_TOWERS_H
#define HC_TRACE_FAST_TOWERS_H

#include "fast_march.h"

/* Rays whose ways are farther apart than so many half cells do not glide together. */
static const float SWATH_WIDTH = 96.0F;

/* Cells from a tower that was not hit to where a ray may glide on. */
static const float GLIDE_AFTER = 6.0F;

/* Sixteen rays, for towers. */
typedef struct glides {
    hc_v dx, dy, up_x, up_y; /* up: 1 or -1                                              */
    hc_v aside, along;       /* of the origin: across the direction, and as s is counted */
    hc_v z, rate, fall;      /* above the floor; per half cell; its size                 */
    hc_v uneven;             /* 2 ||dx| - |dy||                                          */
    hc_v straight, bent;     /* 1 / (2 max(|dx|, |dy|)), 1 / (16 |dx| |dy|)              */
    hc_v from, to;           /* gone sideways                                            */
} glides;

/* What holds the ways of rays that glide together, over the axis that they go along faster. */
typedef struct swath {
    const float *along, *aside; /* places of towers: on that axis, on the other one */
    bool         turned;        /* that axis is y                                   */
    float        sign;          /* of the rays along it                             */
    float        from, to;      /* places on it times the sign                      */
    float        low, high;     /* its sides at `from`                              */
    float        low_rate, high_rate, steepest;
    float        z, z_rate; /* of the lowest ray, above the floor */
} swath;

/* One instruction each, unlike fmaxf and fminf. */
static inline float at_least(float a, float least)
{
    return a > least ? a : least;
}

static inline float at_most(float a, float most)
{
    return a < most ? a : most;
}

static inline hc_v cross(hc_v x, hc_v y, hc_v dx, hc_v dy)
{
    return hc_v_sub(hc_v_mul(x, dy), hc_v_mul(y, dx));
}

/* s up to which rays stay above the floor, and before their ends; 0 for those below it. */
static inline hc_v find_floor(const hc_fast *fast, const runners *q)
{
    const hc_v none  = hc_v_set(0.0F);
    const hc_v above = hc_v_sub(hc_v_load(q->z), hc_v_set(fast->towers.floor));
    const hc_v down  = hc_v_sub(none, hc_v_load(q->dz));
    const hc_v fall  = hc_v_max(down, hc_v_set(0x1p-60F));
    const hc_v way   = hc_v_mul(hc_v_div(above, fall), hc_v_set(1.0F - 0x1p-20F));
    const hc_v until = hc_v_pick(hc_v_greater(down, none), way, hc_v_set(0x1p60F));
    return hc_v_keep(hc_v_greater(above, none), hc_v_min(until, hc_v_load(q->end)));
}

static inline hc_v sign_of(const int32_t *ahead)
{
    const unsigned up = hc_i_differ(hc_i_load(ahead), hc_i_set(0));
    return hc_v_pick(up, hc_v_set(1.0F), hc_v_set(-1.0F));
}

static inline glides find_glides(const hc_fast *fast, const runners *q, hc_v from, hc_v to)
{
    const hc_v two     = hc_v_set(2.0F);
    const hc_v less    = hc_v_set(1.0F - 0x1p-20F); /* so that rounding raises tents */
    const hc_v dx      = hc_v_load(q->dx);
    const hc_v dy      = hc_v_load(q->dy);
    const hc_v x       = hc_v_mul(hc_v_load(q->x), two);
    const hc_v y       = hc_v_mul(hc_v_load(q->y), two);
    const hc_v a       = hc_v_abs(dx);
    const hc_v b       = hc_v_abs(dy);
    const hc_v product = hc_v_mul(hc_v_max(hc_v_mul(a, b), hc_v_set(0x1p-60F)), less);
    glides     g       = { .dx = dx, .dy = dy };
    g.up_x             = sign_of(q->ahead_x);
    g.up_y             = sign_of(q->ahead_y);
    g.aside            = cross(x, y, dx, dy);
    g.along            = hc_v_add(hc_v_mul(x, g.up_x), hc_v_mul(y, g.up_y));
    g.z                = hc_v_sub(hc_v_load(q->z), hc_v_set(fast->towers.floor));
    g.rate             = hc_v_mul(hc_v_load(q->dz), hc_v_set(0.5F));
    g.fall             = hc_v_abs(g.rate);
    g.uneven           = hc_v_mul(hc_v_abs(hc_v_sub(a, b)), two);
    g.straight         = hc_v_mul(hc_v_div(hc_v_set(0.5F), hc_v_max(a, b)), less);
    g.bent             = hc_v_div(hc_v_set(0.0625F), product);
    g.from             = hc_v_mul(from, two);
    g.to               = hc_v_mul(to, two);
    return g;
}

/* Where rays are that may hit a tower: before it, and beside its middle. */
typedef struct stops {
    hc_v before, middle;
} stops;

/* Those that are held up by a tower before they would be otherwise. */
static inline stops hold_up(const hc_fast *fast, uint32_t tower, const glides *g, unsigned lanes,
                            stops other)
{
    const hc_fast_towers *all      = &fast->towers;
    const float           size     = all->size[tower];
    const float           margin   = 8.0F * fast->blur;
    const hc_v            none     = hc_v_set(0.0F);
    const hc_v            x        = hc_v_set(all->x[tower]);
    const hc_v            y        = hc_v_set(all->y[tower]);
    const hc_v            reach    = hc_v_set(2.0F * size + 4.0F + margin);
    const hc_v            at       = hc_v_add(hc_v_mul(x, g->up_x), hc_v_mul(y, g->up_y));
    const hc_v            along    = hc_v_sub(at, g->along);
    const hc_v            aside    = hc_v_abs(hc_v_sub(cross(x, y, g->dx, g->dy), g->aside));
    const hc_v            apart    = hc_v_max(hc_v_sub(aside, hc_v_set(size + margin)), none);
    const hc_v            inner    = hc_v_max(hc_v_sub(hc_v_set(2.0F), apart), none);
    const hc_v            bent     = hc_v_mul(hc_v_mul(inner, inner), g->bent);
    const hc_v            straight = hc_v_sub(hc_v_set(1.0F), hc_v_mul(apart, g->straight));
    const hc_v            part     = hc_v_pick(hc_v_greater(g->uneven, apart), straight, bent);
    const hc_v            top      = hc_v_mul(part, hc_v_set(all->rise[tower]));
    const hc_v            z        = hc_v_about_muladd(along, g->rate, g->z);
    const hc_v            low      = hc_v_sub(z, hc_v_mul(reach, g->fall));
    const unsigned        passes =
        hc_v_greater(along, hc_v_sub(g->from, reach)) & hc_v_greater(g->to, hc_v_sub(along, reach));
    const unsigned hits = hc_v_greater(top, low) & hc_v_greater(inner, none) & passes & lanes;
    /* As high as the ray is at least the tent is this near to its box. */
    const hc_v     height = hc_v_about_over(hc_v_max(low, none), hc_v_set(all->rise[tower]));
    const hc_v     root   = hc_v_about_sqrt(height);
    const hc_v     within = hc_v_about_muladd(root, hc_v_set(-4.0F), reach);
    const hc_v     before = hc_v_sub(along, within);
    const unsigned sooner = hits & hc_v_greater(other.before, before);
    return (stops){ hc_v_pick(sooner, before, other.before),
                    hc_v_pick(sooner, along, other.middle) };
}

static inline stops nowhere(void)
{
    return (stops){ hc_v_set(INFINITY), hc_v_set(INFINITY) };
}

static inline unsigned find_stopped(const stops *s)
{
    return hc_v_greater(hc_v_set(INFINITY), s->before);
}

static inline float least_of(unsigned lanes, hc_v values)
{
    return hc_v_lowest(hc_v_pick(lanes, values, hc_v_set(INFINITY)));
}

static inline float most_of(unsigned lanes, hc_v values)
{
    return hc_v_highest(hc_v_pick(lanes, values, hc_v_set(-INFINITY)));
}

static inline swath begin_swath(const hc_fast *fast, bool turned, float sign)
{
    const hc_fast_towers *t = &fast->towers;
    return (swath){
        .along = turned ? t->y : t->x, .aside = turned ? t->x : t->y, .turned = turned, .sign = sign
    };
}

/* Between lines that hold the rays at both ends, since the ways are straight. False if they are not
 * narrow, or if some go slowly along the axis. */
static inline bool find_swath(swath *w, const hc_fast *fast, const runners *q, const glides *g,
                              unsigned lanes)
{
    const int          one     = __builtin_ctz(lanes);
    const bool         turned  = fabsf(q->dy[one]) > fabsf(q->dx[one]);
    const float *const rate[2] = { turned ? q->dy : q->dx, turned ? q->dx : q->dy };
    const float *const at[2]   = { turned ? q->y : q->x, turned ? q->x : q->y };
    const float        sign    = rate[0][one] > 0.0F ? 1.0F : -1.0F;
    const hc_v         quick   = hc_v_mul(hc_v_load(rate[0]), hc_v_set(sign));
    if (!(least_of(lanes, quick) >= 0.25F)) {
        return false;
    }
    const hc_v start  = hc_v_mul(hc_v_load(at[0]), hc_v_set(2.0F * sign));
    const hc_v side   = hc_v_mul(hc_v_load(at[1]), hc_v_set(2.0F));
    const hc_v over   = hc_v_div(hc_v_set(1.0F), quick);
    const hc_v slope  = hc_v_mul(hc_v_load(rate[1]), over);
    const hc_v climb  = hc_v_mul(g->rate, over);
    *w                = begin_swath(fast, turned, sign);
    w->from           = least_of(lanes, hc_v_about_muladd(g->from, quick, start));
    w->to             = most_of(lanes, hc_v_about_muladd(g->to, quick, start));
    const hc_v  back  = hc_v_sub(hc_v_set(w->from), start);
    const hc_v  ahead = hc_v_sub(hc_v_set(w->to), start);
    const hc_v  begin = hc_v_about_muladd(back, slope, side);
    const hc_v  end   = hc_v_about_muladd(ahead, slope, side);
    const float low   = least_of(lanes, end);
    const float high  = most_of(lanes, end);
    const float z     = least_of(lanes, hc_v_about_muladd(back, climb, g->z));
    const float z_end = least_of(lanes, hc_v_about_muladd(ahead, climb, g->z));
    const float part  = 1.0F / at_least(w->to - w->from, 0x1p-6F);
    w->low            = least_of(lanes, begin);
    w->high           = most_of(lanes, begin);
    w->low_rate       = (low - w->low) * part;
    w->high_rate      = (high - w->high) * part;
    w->steepest       = at_least(fabsf(w->low_rate), fabsf(w->high_rate));
    w->z              = z - 0x1p-20F * (fabsf(z) + fabsf(z_end)); /* below what rounding may lose */
    w->z_rate         = (z_end - z) * part;
    return w->high - w->low <= SWATH_WIDTH && high - low <= SWATH_WIDTH;
}

/* The way of ray i. */
static inline swath find_way(const hc_fast *fast, const runners *q, int i, float from, float to)
{
    const bool  turned = fabsf(q->dy[i]) > fabsf(q->dx[i]);
    const float rate   = turned ? q->dy[i] : q->dx[i];
    const float over   = fabsf(turned ? q->ry[i] : q->rx[i]);
    const float sign   = rate > 0.0F ? 1.0F : -1.0F;
    const float start  = 2.0F * sign * (turned ? q->y[i] : q->x[i]);
    const float gone   = 2.0F * from * fabsf(rate);
    swath       w      = begin_swath(fast, turned, sign);
    w.from             = start + gone;
    w.to               = start + 2.0F * to * fabsf(rate);
    w.low_rate         = (turned ? q->dx[i] : q->dy[i]) * over;
    w.high_rate        = w.low_rate;
    w.steepest         = fabsf(w.low_rate);
    w.low              = 2.0F * (turned ? q->x[i] : q->y[i]) + gone * w.low_rate;
    w.high             = w.low;
    w.z_rate           = 0.5F * q->dz[i] * over;
    w.z                = q->z[i] - fast->towers.floor + gone * w.z_rate;
    return w;
}

/* Which towers, from the k-th on, stand under the swath or beside it. */
static inline unsigned sift(const hc_fast *fast, const swath *w, uint32_t k)
{
    const hc_v reach  = hc_v_set(2.0F + 16.0F * fast->blur);
    const hc_v size   = hc_v_add(hc_v_load(fast->towers.size + k), reach);
    const hc_v sign   = hc_v_set(w->sign);
    const hc_v along  = hc_v_about_muladd(hc_v_load(w->along + k), sign, hc_v_set(-w->from));
    const hc_v aside  = hc_v_load(w->aside + k);
    const hc_v around = hc_v_mul(size, hc_v_set(1.0F + w->steepest));
    const hc_v low    = hc_v_about_muladd(along, hc_v_set(w->low_rate), hc_v_set(w->low));
    const hc_v high   = hc_v_about_muladd(along, hc_v_set(w->high_rate), hc_v_set(w->high));
    const hc_v z      = hc_v_about_muladd(along, hc_v_set(w->z_rate), hc_v_set(w->z));
    const hc_v least  = hc_v_sub(z, hc_v_mul(size, hc_v_set(fabsf(w->z_rate))));
    return hc_v_greater(hc_v_add(aside, around), low) & hc_v_greater(hc_v_add(high, around), aside)
           & hc_v_greater(hc_v_load(fast->towers.rise + k), least);
}

/* Where lanes stop for towers of a bin, or before. */
static inline stops look_at_bin(const hc_fast *fast, const glides *g, const swath *w,
                                const uint32_t *bin, unsigned lanes, stops first)
{
    const uint32_t end = bin[1];
    for (uint32_t k = bin[0]; k < end; k += HC_LANES) {
        const unsigned listed = end - k < HC_LANES ? (1U << (end - k)) - 1 : (1U << HC_LANES) - 1;
        unsigned       towers = sift(fast, w, k) & listed;
        for (; towers != 0; towers &= towers - 1) {
            first = hold_up(fast, k + (uint32_t)__builtin_ctz(towers), g, lanes, first);
        }
    }
    return first;
}

static inline int bin_at(float at, int bins)
{
    const int bin = (int)(at * (0.5F / (float)HC_FAST_BIN) + 1.0F);
    return bin < 0 ? 0 : bin < bins ? bin : bins - 1;
}

/* The bins of one column under a swath. */
static inline stops look_at_column(const hc_fast *fast, const glides *g, const swath *w, int column,
                                   float leave, unsigned lanes)
{
    const hc_fast_towers *t      = &fast->towers;
    const float           slack  = 16.0F * fast->blur;
    const float           way    = w->to - w->from;
    const float           a      = at_least(leave - 2.0F * (float)HC_FAST_BIN, 0.0F);
    const float           b      = at_most(leave, way);
    const float           low    = w->low + (w->low_rate > 0.0F ? a : b) * w->low_rate;
    const float           high   = w->high + (w->high_rate > 0.0F ? b : a) * w->high_rate;
    const int             bins   = w->turned ? t->bins_x : t->bins_y;
    const int             stride = w->turned ? 1 : t->bins_x;
    const int             last   = bin_at(high + slack, bins);
    const uint32_t       *first  = t->bins + (ptrdiff_t)column * (w->turned ? t->bins_x : 1);
    stops                 near   = nowhere();
    for (int k = bin_at(low - slack, bins); k <= last; k++) {
        near = look_at_bin(fast, g, w, first + (ptrdiff_t)k * stride, lanes, near);
    }
    return near;
}

/* Where rays stop, at `to` at the latest. Where they leave a column in which they have been stopped
 * they stop in any case: what stands behind it has not been seen. */
static inline stops glide_together(const hc_fast *fast, runners *q, const glides *g, const swath *w,
                                   unsigned lanes)
{
    const hc_fast_towers *t     = &fast->towers;
    const int             bins  = w->turned ? t->bins_y : t->bins_x;
    const int             step  = w->sign > 0.0F ? 1 : -1;
    const int             last  = bin_at(w->to * w->sign, bins);
    const hc_v            at    = hc_v_mul(hc_v_load(w->turned ? q->y : q->x), hc_v_set(2.0F));
    const hc_v            over  = hc_v_load(w->turned ? q->ry : q->rx);
    stops                 all   = { g->to, g->to };
    hc_i                  steps = hc_i_load(q->steps);
    for (int k = bin_at(w->from * w->sign, bins); lanes != 0; k += step) {
        const float    wall  = 2.0F * (float)((k - (step > 0 ? 0 : 1)) * HC_FAST_BIN);
        const stops    first = look_at_column(fast, g, w, k, wall * w->sign - w->from, lanes);
        const unsigned some  = find_stopped(&first);
        const hc_v     out   = hc_v_mul(hc_v_sub(hc_v_set(wall), at), over);
        all.before           = hc_v_pick(some, hc_v_min(first.before, out), all.before);
        all.middle           = hc_v_pick(some, first.middle, all.middle);
        steps                = hc_i_pick(lanes, hc_i_add(steps, hc_i_set(1)), steps);
        lanes &= k == last ? 0 : ~some;
    }
    hc_i_store(q->steps, steps);
    return all;
}

/* Walls between bins that a ray crosses, by the way to them in 2^-24 cells: integers are chosen
 * between without a branch. */
typedef struct walls {
    int64_t next, more;
    int     step;
} walls;

static inline int64_t in_fractions(float cells)
{
    return (int64_t)(at_most(cells, 0x1p30F) * 0x1p24F);
}

static inline walls find_walls(float at, float over, int bin, bool up, int step)
{
    const float wall = (float)((bin - (up ? 0 : 1)) * HC_FAST_BIN);
    return (walls){ .next = in_fractions((wall - at) * over),
                    .more = in_fractions((float)HC_FAST_BIN * fabsf(over)),
                    .step = up ? step : -step };
}

/* The same for lane i alone. */
static inline stops glide_alone(const hc_fast *fast, runners *q, const glides *g, const swath *w,
                                int i, float from, float to)
{
    const hc_fast_towers *t     = &fast->towers;
    const int             bin_x = bin_at(2.0F * (q->x[i] + from * q->dx[i]), t->bins_x);
    const int             bin_y = bin_at(2.0F * (q->y[i] + from * q->dy[i]), t->bins_y);
    const uint32_t       *bin   = t->bins + (ptrdiff_t)bin_y * t->bins_x + bin_x;
    const int64_t         end   = in_fractions(to);
    walls                 x     = find_walls(q->x[i], q->rx[i], bin_x, q->ahead_x[i] != 0, 1);
    walls                 y = find_walls(q->y[i], q->ry[i], bin_y, q->ahead_y[i] != 0, t->bins_x);
    stops                 first = look_at_bin(fast, g, w, bin, 1U << i, nowhere());
    int64_t               leave = x.next < y.next ? x.next : y.next;
    int                   steps = 1;
    while (leave < end && find_stopped(&first) == 0) {
        const bool across = x.next < y.next;
        bin += across ? x.step : y.step;
        x.next += across ? x.more : 0;
        y.next += across ? 0 : y.more;
        leave = x.next < y.next ? x.next : y.next;
        first = look_at_bin(fast, g, w, bin, 1U << i, nowhere());
        steps++;
    }
    q->steps[i] += steps;
    if (find_stopped(&first) == 0) {
        return (stops){ g->to, g->to };
    }
    first.before = hc_v_min(first.before, hc_v_set((float)leave * 0x1p-23F));
    return first;
}

/* What lanes have come to. */
typedef struct landing {
    hc_v     s, middle; /* middle: beside what has stopped them */
    unsigned above;     /* that were above the floor            */
} landing;

/* Lanes from s on, as far as they hit nothing for certain. */
static inline landing glide(const hc_fast *fast, runners *q, const float *s, unsigned lanes)
{
    const hc_v     half  = hc_v_set(0.5F);
    const hc_v     from  = hc_v_load(s);
    const hc_v     to    = find_floor(fast, q);
    const glides   g     = find_glides(fast, q, from, to);
    const unsigned above = lanes & hc_v_greater(to, from);
    stops          all   = { g.from, g.from };
    swath          w;
    if ((above & (above - 1)) != 0 && find_swath(&w, fast, q, &g, above)) {
        all = glide_together(fast, q, &g, &w, above);
    } else {
        float ends[HC_LANES];
        hc_v_store(ends, to);
        for (unsigned rest = above; rest != 0; rest &= rest - 1) {
            const int i     = __builtin_ctz(rest);
            w               = find_way(fast, q, i, s[i], ends[i]);
            const stops one = glide_alone(fast, q, &g, &w, i, s[i], ends[i]);
            all.before      = hc_v_pick(1U << i, one.before, all.before);
            all.middle      = hc_v_pick(1U << i, one.middle, all.middle);
        }
    }
    const hc_v ahead = hc_v_max(hc_v_mul(all.before, half), from);
    return (landing){ hc_v_pick(above, ahead, from), hc_v_mul(all.middle, half), above };
}

#endif
