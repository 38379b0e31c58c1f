/* The work of one call: the rays and their answers, those that are ready for lanes, and the lanes.
 *
 * A ray that is to be marched on from some t, for whatever reason, is one of those that are
 * left. */
#ifndef HC_TRACE_FAST_QUEUE_H
#define HC_TRACE_FAST_QUEUE_H

#include "fast_ask.h"
#include "fast_beams.h"
#include "fast_crowd.h"
#include "fast_decide.h"
#include "fast_towers.h"

#include <math.h>

/* What is done once for many steps: within the loop over the packs it would take registers from
 * these. */
#define APART __attribute__((noinline))

/* Packs take turns, so that one computes while the others wait for memory. */
enum {
    ALL_LANES = (1 << HC_LANES) - 1,
    PACKS     = HC_LANES < 16 ? 1 : 4,
    LEFT_MAX  = (PACKS + 4) * HC_LANES
};

/* Rays that go less far, in cells, are walked at once: vertical ones above all. */
static const float MARCH_FROM = 2.0F;

/* Rays to be marched on from t. */
typedef struct leftover {
    int32_t which;
    int32_t steps, crossings;
    double  t;
} leftover;

/* Lanes to gather before they are looked at together, and before they take new rays; rounds of
 * marching before lanes are seen to, of rays of any kind that ask for their nearest hit, and of
 * others, which have shorter ways or wait for each other. */
typedef struct pace {
    int near, done, rounds, few_rounds;
} pace;

/* How many places rays that ask for any hit are looked at in, before sixteen of those that are left
 * are looked at in the others. */
enum { FIRST_PLACES = 5 };

/* So few lanes of a pack do not go on by themselves. */
enum { FEW_LANES = 6 };

typedef struct job {
    const hc_fast *fast;
    pace           pace;
    hc_fast_answer answer;
    const hc_ray  *rays;
    int32_t        count, taken;
    bool           plain; /* hc_fast_plain */
    runners        queue; /* rays ready for lanes */
    double         queue_from[2 * HC_LANES], queue_next[2 * HC_LANES];
    int            queued, next;
    crowd          suspects; /* that have been looked at in the first places */
    stragglers     stragglers;
    trials         trials;
    leftover       left[LEFT_MAX];
    int            left_count;
    pack          *packs[PACKS]; /* those in lanes: `own`, or a group's */
    pack           own[PACKS];
    group          groups[HC_LANES + PACKS]; /* of beams and in lanes */
    unsigned       used;                     /* of the groups         */
    beams          beams;
    group         *waiting[HC_LANES]; /* whose beams have been marched */
    int            group_count, next_group;
} job;

/* ---- answers --------------------------------------------------------------------------------- */

static void answer_miss(const job *j, int32_t which, int32_t steps, int32_t crossings)
{
    if (j->answer.any != NULL) {
        j->answer.any[which] = 0;
        return;
    }
    j->answer.hits[which] =
        (hc_hit){ .t = INFINITY, .steps = (uint32_t)steps, .crossings = (uint32_t)crossings };
}

/* Of those in question, that something is hit. */
static void answer_any(const job *j, const int32_t *which, unsigned hits)
{
    for (; hits != 0; hits &= hits - 1) {
        j->answer.any[which[__builtin_ctz(hits)]] = 1;
    }
}

static void answer_hit(const job *j, int32_t which, const hc_fast_ray *r,
                       const hc_fast_found *found, int32_t steps, int32_t crossings)
{
    if (j->answer.any != NULL) {
        j->answer.any[which] = 1;
        return;
    }
    hc_hit *hit    = &j->answer.hits[which];
    *hit           = (hc_hit){ .t = INFINITY };
    hit->steps     = (uint32_t)steps;
    hit->crossings = (uint32_t)crossings;
    hc_fast_fill(j->fast, hit, r, found);
}

/* ---- rays into the queue --------------------------------------------------------------------- */

/* Start of the period that holds the ray at t, and the time at which it leaves it. */
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

/* What follows from rates along an axis. Returns which rays go down. */
static inline unsigned turn_along(float *over, int32_t *ahead, const float *rate)
{
    const hc_v     rates = hc_v_load(rate);
    const unsigned down  = hc_v_greater(hc_v_set(0.0F), rates);
    const unsigned moves = hc_v_greater(hc_v_abs(rates), hc_v_set(0x1p-60F));
    const hc_v     most  = hc_v_pick(down, hc_v_set(-0x1p60F), hc_v_set(0x1p60F));
    hc_v_store(over, hc_v_pick(moves, hc_v_div(hc_v_set(1.0F), rates), most));
    hc_i_store(ahead, hc_i_pick(down, hc_i_set(0), hc_i_set(1)));
    return down;
}

/* What follows from all lanes' rates. */
static inline void find_ahead(runners *q, const hc_fast *fast)
{
    const hc_i     none  = hc_i_set(0);
    const unsigned left  = turn_along(q->rx, q->ahead_x, q->dx);
    const unsigned back  = turn_along(q->ry, q->ahead_y, q->dy);
    const hc_i     along = hc_i_pick(left, hc_i_set(fast->plane), none);
    hc_i_store(q->quadrant, hc_i_add(along, hc_i_pick(back, hc_i_set(2 * fast->plane), none)));
}

/* A segment from t to `next`, in cells from `start`, at place k of the queue; find_ahead() does the
 * rest. */
static void enqueue_segment(job *j, int k, const hc_fast_ray *r, const double start[2], double t,
                            double next)
{
    runners     *q     = &j->queue;
    const double run   = hc_fast_run(r);
    const double scale = 1.0 / run;
    q->x[k]            = (float)(r->origin[0] + t * r->direction[0] - start[0]);
    q->y[k]            = (float)(r->origin[1] + t * r->direction[1] - start[1]);
    q->z[k]            = (float)(r->origin[2] + t * r->direction[2]);
    q->dx[k]           = (float)(r->direction[0] * scale);
    q->dy[k]           = (float)(r->direction[1] * scale);
    q->dz[k]           = (float)(r->direction[2] * scale);
    q->end[k]          = (float)((next - t) * run) + 2.0F * j->fast->blur;
    j->queue_from[k]   = t;
    j->queue_next[k]   = next;
}

/* Segments from t on until one is to be marched, which is enqueued. */
static void go_on(job *j, const hc_fast_ray *r, double t, const leftover *from)
{
    const double run = hc_fast_run(r);
    do {
        double        start[2];
        hc_fast_found found;
        const double  leave_x = leave_period(r, 0, &j->fast->x, t, &start[0]);
        const double  leave_y = leave_period(r, 1, &j->fast->y, t, &start[1]);
        const double  next    = fmin(r->to, fmin(leave_x, leave_y));
        if ((next - t) * run > (double)MARCH_FROM) {
            const int k           = j->queued++;
            j->queue.which[k]     = from->which;
            j->queue.steps[k]     = from->steps;
            j->queue.crossings[k] = from->crossings;
            enqueue_segment(j, k, r, start, t, next);
            return;
        }
        if (hc_fast_walk(j->fast, r, &found, t, next)) {
            answer_hit(j, from->which, r, &found, from->steps, from->crossings);
            return;
        }
        t = next;
    } while (t < r->to);
    answer_miss(j, from->which, from->steps, from->crossings);
}

/* Rays that are left, one by one. */
static void enqueue_left(job *j)
{
    int32_t   which[HC_LANES];
    batch     b;
    const int count = j->left_count < HC_LANES ? j->left_count : HC_LANES;
    j->left_count -= count;
    const leftover *left = j->left + j->left_count;
    for (int i = 0; i < HC_LANES; i++) {
        which[i] = left[i < count ? i : 0].which;
    }
    prepare_some(&b, j->fast, j->rays, which);
    for (int i = 0; i < count; i++) {
        hc_fast_ray r;
        (void)take_ray(&r, j->fast, &b, i, &j->rays[which[i]]);
        go_on(j, &r, left[i].t, &left[i]);
    }
    find_ahead(&j->queue, j->fast);
}

/* New rays that need care: periods, open sides. */
static void enqueue_one_by_one(job *j, const batch *b, const int32_t *which, unsigned lanes)
{
    for (; lanes != 0; lanes &= lanes - 1) {
        const int      i    = __builtin_ctz(lanes);
        const leftover from = { .which = which[i] };
        hc_fast_ray    r;
        switch (take_ray(&r, j->fast, b, i, &j->rays[which[i]])) {
        case HC_FAST_MISSES: answer_miss(j, which[i], 0, 0); break;
        case HC_FAST_HITS: answer_hit(j, which[i], &r, &r.at_once, 0, 0); break;
        case HC_FAST_MARCHES: go_on(j, &r, r.from, &from); break;
        }
    }
    find_ahead(&j->queue, j->fast);
}

/* Lanes of a batch in the lanes' coordinates, before they are rounded. */
typedef struct turned {
    hc_d x, y, z, dx, dy, dz, end;
} turned;

static ALWAYS_INLINE turned turn_part(const batch *b, int lane)
{
    const hc_d run   = hc_d_load(b->run + lane);
    const hc_d from  = hc_d_load(b->from + lane);
    const hc_d scale = hc_d_set(1.0) / run;
    const hc_d dx    = hc_d_load(b->direction[0] + lane);
    const hc_d dy    = hc_d_load(b->direction[1] + lane);
    const hc_d dz    = hc_d_load(b->direction[2] + lane);
    return (turned){ .x   = hc_d_load(b->origin[0] + lane) + from * dx,
                     .y   = hc_d_load(b->origin[1] + lane) + from * dy,
                     .z   = hc_d_load(b->origin[2] + lane) + from * dz,
                     .dx  = dx * scale,
                     .dy  = dy * scale,
                     .dz  = dz * scale,
                     .end = (hc_d_load(b->to + lane) - from) * run };
}

/* A batch in the lanes' coordinates. */
static inline void turn_batch(runners *q, const hc_fast *fast, const batch *b)
{
    for (int lane = 0; lane < HC_LANES; lane += HC_D_BOTH) {
        const turned some = turn_part(b, lane);
        const turned more = turn_part(b, lane + HC_D_MORE);
        hc_d_round(q->x + lane, some.x, more.x);
        hc_d_round(q->y + lane, some.y, more.y);
        hc_d_round(q->z + lane, some.z, more.z);
        hc_d_round(q->dx + lane, some.dx, more.dx);
        hc_d_round(q->dy + lane, some.dy, more.dy);
        hc_d_round(q->dz + lane, some.dz, more.dz);
        hc_d_round(q->end + lane, some.end, more.end);
    }
    find_ahead(q, fast);
    hc_v_store(q->end, hc_v_add(hc_v_load(q->end), hc_v_set(2.0F * fast->blur)));
    hc_i_store(q->steps, hc_i_set(0));
    hc_i_store(q->crossings, hc_i_set(0));
}

/* Rays that hit nothing, as their way is none. */
static unsigned find_misses(const batch *b)
{
    unsigned misses = 0;
    for (int lane = 0; lane < HC_LANES; lane += HC_D_LANES) {
        misses |= hc_d_less(hc_d_load(b->to + lane), hc_d_load(b->from + lane)) << lane;
    }
    return misses;
}

/* Rays to be marched, others than those to be walked. */
static unsigned find_marched(const runners *q)
{
    return hc_v_greater(hc_v_load(q->end), hc_v_set(MARCH_FROM));
}

/* Rays that start at `from`, for any lanes. */
static void enqueue_rays(job *j, const runners *rays, const double *from, unsigned lanes)
{
    pack_rays(&j->queue, HC_LANES * sizeof(int32_t), rays, lanes);
    hc_pack_doubles(j->queue_from, lanes, from);
    j->queued = __builtin_popcount(lanes);
}

/* Lanes that are not marched become 0, so that what is computed there is bounded. */
static void clear_lanes(runners *q, unsigned lanes)
{
    float *const rows[] = { q->x, q->y, q->z, q->dx, q->dy, q->dz, q->rx, q->ry, q->end };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        hc_v_store(rows[k], hc_v_keep(lanes, hc_v_load(rows[k])));
    }
}

/* Make a group's rays a beam, if they can be one; over towers they glide instead. s counts
 * from about where t is 0; where no beam is marched each ray goes on from its own beginning. Lanes
 * without a beam are computed too. */
static bool join_group(job *j, group *g)
{
    if (__builtin_popcount(g->lanes) < BEAM_RAYS) {
        return false;
    }
    const batch *b     = &g->b;
    const int    one   = __builtin_ctz(g->lanes);
    const double first = b->from[one] * b->run[one];
    float        s[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        s[i] = (float)(b->from[i] * b->run[i] - first);
    }
    memcpy(g->s, s, sizeof s);
    if (!join_beam(&j->beams, j->group_count, g, j->fast)) {
        return false;
    }
    if (g->lanes != ALL_LANES) {
        clear_lanes(&g->p.ray, g->lanes);
    }
    j->used |= 1U << (g - j->groups);
    g->beam                      = j->group_count;
    g->begun                     = false;
    j->waiting[j->group_count++] = g;
    return true;
}

/* The last sixteen suspects, or all: those that no place finds are to be marched. */
static void search_suspects(job *j)
{
    crowd         *s     = &j->suspects;
    const int      count = s->count < HC_LANES ? s->count : HC_LANES;
    const unsigned all   = ALL_LANES >> (HC_LANES - count);
    runners        rays;
    s->count -= count;
    for (int k = 0; k < RUNNER_WORDS; k++) {
        hc_i_store((int32_t *)&rays + k * HC_LANES, hc_i_load(s->words[k] + s->count));
    }
    const unsigned below = probe_lows(j->fast, &rays, all, FIRST_PLACES, PLACES);
    answer_any(j, rays.which, below);
    enqueue_rays(j, &rays, s->from + s->count, all & ~below);
}

/* Rays that ask for any hit. Where the first places find none of sixteen, as under the open sky,
 * the others are left out. */
static void suspect(job *j, const runners *rays, const double *from, unsigned lanes)
{
    const unsigned below = probe_lows(j->fast, rays, lanes, 0, FIRST_PLACES);
    const unsigned rest  = lanes & ~below;
    answer_any(j, rays->which, below);
    if (below == 0) {
        enqueue_rays(j, rays, from, rest);
        return;
    }
    join_crowd(&j->suspects, rays, from, rest);
    if (j->suspects.count >= HC_LANES) {
        search_suspects(j);
    }
}

/* Of rays that ask for any hit those that end in the air, or are below the tower that stops them
 * where they come past its middle. */
static unsigned ask_towers(job *j, const runners *ray, unsigned lanes)
{
    static const float start[HC_LANES] = { 0.0F };
    runners            q               = *ray;
    const landing      l               = glide(j->fast, &q, start, lanes);
    const hc_v         end             = hc_v_load(q.end);
    const hc_v         over            = hc_v_sub(end, hc_v_set(4.0F * j->fast->blur));
    const unsigned     on              = lanes & hc_v_greater(end, l.s);
    const unsigned     inside          = on & hc_v_greater(over, l.middle);
    const unsigned     before          = inside & hc_v_greater(l.middle, hc_v_set(0.0F));
    const hc_v         gap             = gap_after(j->fast, &q, l.middle, before);
    const unsigned     below           = before & hc_v_greater(hc_v_set(-j->fast->slack), gap);
    for (unsigned rest = lanes & ~on; rest != 0; rest &= rest - 1) {
        j->answer.any[q.which[__builtin_ctz(rest)]] = 0;
    }
    answer_any(j, q.which, below);
    return below | (lanes & ~on);
}

/* Rays that ask for any hit, of which many have their answer at once. Those that are left are too
 * different to stay together. */
static void take_any(job *j, const runners *rays, const double *from, unsigned lanes)
{
    if (j->fast->towers.listed) {
        enqueue_rays(j, rays, from, lanes & ~ask_towers(j, rays, lanes));
    } else if (j->fast->stride_lows > 0) {
        suspect(j, rays, from, lanes);
    } else {
        const unsigned below = probe_patches(j->fast, rays, lanes);
        answer_any(j, rays->which, below);
        enqueue_rays(j, rays, from, lanes & ~below);
    }
}

/* A batch: the rays that are to be marched, others are answered. */
static void take_group(job *j, group *g, const int32_t *which, unsigned all)
{
    const batch *b = &g->b;
    turn_batch(&g->p.ray, j->fast, b);
    memcpy(g->p.ray.which, which, sizeof g->p.ray.which);
    const unsigned marched = find_marched(&g->p.ray) & all;
    g->lanes               = marched;
    if (j->answer.any != NULL) {
        ask_for_way(j->fast, &g->p.ray, marched, true);
        take_any(j, &g->p.ray, b->from, marched);
    } else if (!join_group(j, g)) {
        ask_for_way(j->fast, &g->p.ray, marched, false);
        enqueue_rays(j, &g->p.ray, b->from, marched);
    }
    if (marched != all) {
        const unsigned misses = find_misses(b) & all & ~marched;
        const unsigned others = all & ~marched & ~misses;
        for (unsigned rest = misses; rest != 0; rest &= rest - 1) {
            answer_miss(j, which[__builtin_ctz(rest)], 0, 0);
        }
        if (others != 0) {
            enqueue_one_by_one(j, b, which, others);
        }
    }
}

/* Are there rays that have not been in the queue? */
static inline bool has_new(const job *j)
{
    return j->taken != j->count || j->suspects.count != 0;
}

/* The next rays: groups, as long as they are beams, or a queue. */
static APART void take_new(job *j)
{
    j->group_count = 0;
    j->next_group  = 0;
    while (j->taken < j->count && j->group_count < HC_LANES && j->queued == 0) {
        int32_t        which[HC_LANES];
        group         *g     = &j->groups[__builtin_ctz(~j->used)];
        const int      left  = j->count - j->taken;
        const int      count = left < HC_LANES ? left : HC_LANES;
        const unsigned all   = ALL_LANES >> (HC_LANES - count);
        hc_i_store(which, hc_i_add(hc_i_set(j->taken), hc_i_load(hc_lane)));
        ask_for(j->rays, sizeof *j->rays, j->taken + AHEAD * HC_LANES, true);
        if (j->answer.hits != NULL) {
            ask_for(j->answer.hits, sizeof *j->answer.hits, j->taken, false);
        }
        prepare_next(&g->b, j->fast, j->rays + j->taken, count);
        j->taken += count;
        if (j->plain) {
            take_group(j, g, which, all);
        } else {
            enqueue_one_by_one(j, &g->b, which, all);
        }
    }
    if (j->queued == 0 && j->suspects.count > 0) {
        search_suspects(j);
    }
    if (j->group_count > 0 && !j->fast->towers.listed) {
        march_beams(j->fast, &j->beams, j->group_count,
                    j->fast->sparse ? GROUND_SPARSE : GROUND_PATCHES);
    }
}

#endif
