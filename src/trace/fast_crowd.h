/* Rays that wait until there are enough of them to go on together, in rows as of runners. */
#ifndef HC_TRACE_FAST_CROWD_H
#define HC_TRACE_FAST_CROWD_H

#include "base/lanes.h"
#include "fast_march.h"

/* Sixteen may join as long as there are CROWD - HC_LANES at most. */
enum { CROWD = 4 * HC_LANES };

typedef struct crowd {
    HC_ROW(int32_t) words[RUNNER_WORDS][CROWD];
    double from[CROWD + HC_LANES]; /* t where they start */
    int    count;
} crowd;

/* Those of packs of which few are left: also how far they have come, and on which level. */
typedef struct stragglers {
    crowd   rays;
    float   s[CROWD];
    int32_t level[CROWD];
} stragglers;

/* The words of sixteen rays into rows so many bytes apart. */
static inline void pack_rays(void *to, size_t pitch, const runners *rays, unsigned lanes)
{
    for (size_t k = 0; k < RUNNER_WORDS; k++) {
        const char *row = (const char *)rays + k * HC_LANES * sizeof(int32_t);
        hc_pack_words((char *)to + k * pitch, lanes, row);
    }
}

/* The reverse: rays from rows into lanes of a pack, where they begin. */
static inline void spread_rays(pack *p, unsigned lanes, const void *rows, size_t pitch,
                               const double *from)
{
    for (size_t k = 0; k < RUNNER_WORDS; k++) {
        char *row = (char *)&p->ray + k * HC_LANES * sizeof(int32_t);
        hc_spread_words(row, lanes, (const char *)rows + k * pitch);
    }
    hc_spread_doubles(p->from, lanes, from);
    hc_v_put(p->again, lanes, hc_v_set(-1.0F));
    p->active |= lanes;
}

/* As many of the lanes as are asked for, if there are. */
static inline unsigned choose_lanes(unsigned lanes, int count)
{
    while (__builtin_popcount(lanes) > count) {
        lanes &= ~(1U << (31 - __builtin_clz(lanes)));
    }
    return lanes;
}

static inline void join_crowd(crowd *c, const runners *rays, const double *from, unsigned lanes)
{
    pack_rays(c->words[0] + c->count, sizeof c->words[0], rays, lanes);
    hc_pack_doubles(c->from + c->count, lanes, from);
    c->count += __builtin_popcount(lanes);
}

/* Lanes of a pack, whose rays start at `from`, are left to others. */
static inline void set_aside(stragglers *left, pack *p, unsigned lanes, const double *from)
{
    const int n = left->rays.count;
    hc_pack_words(left->s + n, lanes, p->s);
    hc_pack_words(left->level + n, lanes, p->level);
    join_crowd(&left->rays, &p->ray, from, lanes);
    p->active &= ~lanes;
    p->near &= ~lanes;
}

/* The last stragglers into idle lanes. Returns those that are idle still. */
static inline unsigned call_back(stragglers *left, pack *p, unsigned idle)
{
    crowd         *c     = &left->rays;
    const unsigned lanes = choose_lanes(idle, c->count);
    c->count -= __builtin_popcount(lanes);
    spread_rays(p, lanes, c->words[0] + c->count, sizeof c->words[0], c->from + c->count);
    hc_spread_words(p->s, lanes, left->s + c->count);
    hc_spread_words(p->level, lanes, left->level + c->count);
    return idle & ~lanes;
}

#endif
