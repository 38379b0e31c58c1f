/* All rays through lanes: made ready, marched, decided, answered. Included once per instruction
 * set, with HC_FAST_KERNEL the name of what it defines.
 *
 * A lane that is done takes the next ray. What a look at a patch leaves open goes to the trials,
 * which are decided together; where the outcome is all but sure the lane does not wait for it. A
 * ray that is to be marched on from some t, for whatever reason, is one of those that are left. */
#include "base/simd.h"
#include "fast_decide.h"
#include "fast_march.h"

#include <math.h>

/* Packs take turns, so that one computes while the others wait for memory. */
enum { ALL_LANES = 0xffff, PACKS = 4, LEFT_MAX = (PACKS + 4) * HC_LANES };

/* Lanes to gather before they are looked at together, and before they take new rays. */
enum { NEAR_MIN = 6, DONE_MIN = 4 };

/* Rays that go less far, in cells, are walked at once: vertical ones above all. */
static const double MARCH_FROM = 2.0;

/* Rays to be marched on from t. */
typedef struct leftover {
    int32_t which;
    int32_t steps, crossings;
    double  t;
} leftover;

typedef struct job {
    const hc_fast *fast;
    hc_fast_answer answer;
    const hc_ray  *rays;
    int32_t        count, taken;
    bool           plain; /* one period, closed sides, patches: nothing to see to on the way */
    runners        queue; /* rays ready for lanes */
    double         queue_from[2 * HC_LANES], queue_next[2 * HC_LANES];
    int            queued, next;
    trials         trials;
    leftover       left[LEFT_MAX];
    int            left_count;
    pack           packs[PACKS];
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

/* A ray along one axis as a lane has it. */
typedef struct lane_axis {
    float   at, rate, over;
    int32_t ahead;
} lane_axis;

static inline lane_axis turn_axis(double origin, double direction, double t, double start,
                                  double scale)
{
    const float rate = (float)(direction * scale);
    const bool  up   = !(direction < 0.0);
    const float most = up ? 0x1p60F : -0x1p60F;
    return (lane_axis){ .at    = (float)(origin + t * direction - start),
                        .rate  = rate,
                        .over  = fabsf(rate) > 0x1p-60F ? 1.0F / rate : most,
                        .ahead = up };
}

static inline int32_t shift_to_quadrant(int32_t ahead_x, int32_t ahead_y)
{
    return 8 * (1 - ahead_x) + 16 * (1 - ahead_y);
}

/* A segment from t to `next`, in cells from `start`, at place k of the queue. */
static void enqueue_segment(job *j, int k, const hc_fast_ray *r, const double start[2], double t,
                            double next)
{
    runners        *q     = &j->queue;
    const double    run   = hc_fast_run(r);
    const double    scale = 1.0 / run;
    const lane_axis x     = turn_axis(r->origin[0], r->direction[0], t, start[0], scale);
    const lane_axis y     = turn_axis(r->origin[1], r->direction[1], t, start[1], scale);
    q->x[k]               = x.at;
    q->y[k]               = y.at;
    q->dx[k]              = x.rate;
    q->dy[k]              = y.rate;
    q->rx[k]              = x.over;
    q->ry[k]              = y.over;
    q->ahead_x[k]         = x.ahead;
    q->ahead_y[k]         = y.ahead;
    q->quadrant[k]        = shift_to_quadrant(x.ahead, y.ahead);
    q->z[k]               = (float)(r->origin[2] + t * r->direction[2]);
    q->dz[k]              = (float)(r->direction[2] * scale);
    q->end[k]             = (float)((next - t) * run) + 2.0F * j->fast->blur;
    j->queue_from[k]      = t;
    j->queue_next[k]      = next;
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
        if ((next - t) * run >= MARCH_FROM) {
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
    prepare(&b, j->fast, j->rays, which);
    for (int i = 0; i < count; i++) {
        hc_fast_ray r;
        (void)take_ray(&r, j->fast, &b, i, &j->rays[which[i]]);
        go_on(j, &r, left[i].t, &left[i]);
    }
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
}

/* A batch in the lanes' coordinates. Returns those that are to be marched. */
static unsigned turn_batch(const hc_fast *fast, const batch *b, runners *q)
{
    float *const   at[2]    = { q->x, q->y };
    float *const   rate[2]  = { q->dx, q->dy };
    float *const   over[2]  = { q->rx, q->ry };
    int32_t *const ahead[2] = { q->ahead_x, q->ahead_y };
    double         scale[HC_LANES];
    float          good[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        const double way = (b->to[i] - b->from[i]) * b->run[i];
        scale[i]         = 1.0 / b->run[i];
        q->end[i]        = (float)way + 2.0F * fast->blur;
        good[i]          = ((b->meets[i] != 0) & (way >= MARCH_FROM)) ? 1.0F : 0.0F;
    }
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < HC_LANES; i++) {
            const lane_axis a =
                turn_axis(b->origin[k][i], b->direction[k][i], b->from[i], 0.0, scale[i]);
            at[k][i]    = a.at;
            rate[k][i]  = a.rate;
            over[k][i]  = a.over;
            ahead[k][i] = a.ahead;
        }
    }
    for (int i = 0; i < HC_LANES; i++) {
        q->quadrant[i]  = shift_to_quadrant(q->ahead_x[i], q->ahead_y[i]);
        q->z[i]         = (float)(b->origin[2][i] + b->from[i] * b->direction[2][i]);
        q->dz[i]        = (float)(b->direction[2][i] * scale[i]);
        q->steps[i]     = 0;
        q->crossings[i] = 0;
    }
    return hc_v_greater(hc_v_load(good), hc_v_set(0.0F));
}

static void enqueue_new(job *j)
{
    int32_t        which[HC_LANES];
    batch          b;
    const int      left  = j->count - j->taken;
    const int      count = left < HC_LANES ? left : HC_LANES;
    const unsigned all   = ALL_LANES >> (HC_LANES - count);
    for (int i = 0; i < HC_LANES; i++) {
        which[i] = j->taken + (i < count ? i : 0);
    }
    j->taken += count;
    prepare(&b, j->fast, j->rays, which);
    if (!j->plain) {
        enqueue_one_by_one(j, &b, which, all);
        return;
    }
    runners        made;
    const bool     any         = j->answer.any != NULL && !j->fast->sparse;
    const unsigned long_enough = turn_batch(j->fast, &b, &made) & all;
    const unsigned sure        = any ? probe(j->fast, &made, long_enough) : 0;
    const unsigned marched     = long_enough & ~sure;
    answer_any(j, which, sure);
    memcpy(made.which, which, sizeof which);
    for (int k = 0; k < RUNNER_WORDS; k++) {
        hc_pack_words((char *)&j->queue + k * (int)sizeof which, marched,
                      (const char *)&made + k * (int)sizeof which);
    }
    hc_pack_doubles(j->queue_from, marched, b.from);
    j->queued = __builtin_popcount(marched);
    if (long_enough != all) {
        enqueue_one_by_one(j, &b, which, all & ~long_enough);
    }
}

/* ---- lanes in and out ------------------------------------------------------------------------ */

/* Give lanes of a pack rays from the queue. */
static void refill(job *j, pack *p, unsigned idle)
{
    while (idle != 0) {
        if (j->next == j->queued) {
            j->next   = 0;
            j->queued = 0;
            if (j->left_count > 0) {
                enqueue_left(j);
            } else if (j->taken < j->count) {
                enqueue_new(j);
            } else {
                return;
            }
        }
        unsigned lanes = idle;
        while (__builtin_popcount(lanes) > j->queued - j->next) {
            lanes &= ~(1U << (31 - __builtin_clz(lanes)));
        }
        for (int k = 0; k < RUNNER_WORDS; k++) {
            const size_t row = (size_t)k * HC_LANES * sizeof(int32_t);
            hc_spread_words((char *)&p->ray + row, lanes,
                            (const char *)&j->queue + row + (size_t)j->next * sizeof(int32_t));
        }
        hc_spread_doubles(p->from, lanes, j->queue_from + j->next);
        if (!j->plain) {
            hc_spread_doubles(p->next, lanes, j->queue_next + j->next);
        }
        hc_v_store(p->s, hc_v_pick(lanes, hc_v_set(0.0F), hc_v_load(p->s)));
        hc_i_store(p->level, hc_i_pick(lanes, hc_i_set(j->fast->first_level), hc_i_load(p->level)));
        j->next += __builtin_popcount(lanes);
        p->active |= lanes;
        idle &= ~lanes;
    }
}

static void leave_over(job *j, int32_t which, double t, int32_t steps, int32_t crossings)
{
    j->left[j->left_count++] =
        (leftover){ .which = which, .t = t, .steps = steps, .crossings = crossings };
}

/* Lanes at the end of their segment. */
static void end_segments(job *j, pack *p, unsigned ended)
{
    p->active &= ~ended;
    for (; ended != 0; ended &= ended - 1) {
        const int i = __builtin_ctz(ended);
        if (j->plain) {
            answer_miss(j, p->ray.which[i], p->ray.steps[i], p->ray.crossings[i]);
        } else {
            leave_over(j, p->ray.which[i], p->next[i], p->ray.steps[i], p->ray.crossings[i]);
        }
    }
}

/* ---- deciding -------------------------------------------------------------------------------- */

/* A trial that was not told: walk over the cells in question. False: that hits nothing. */
static bool walk_trial(const job *j, const hc_fast_ray *r, int i)
{
    const trials *c   = &j->trials;
    const double  run = hc_fast_run(r);
    /* On steps a lane that cut a corner may have left out the cell that it cut. */
    const double  back = j->fast->steps ? 6.0 * (double)j->fast->blur : 0.0;
    const double  from = c->from[i] + ((double)c->s[i] - back) / run;
    const double  to   = c->from[i] + (double)(c->s[i] + c->span[i]) / run; /* as the lane counts */
    hc_fast_found found;
    const bool    hit = hc_fast_walk(j->fast, r, &found, from, to);
    if (hit) {
        answer_hit(j, c->which[i], r, &found, c->steps[i], c->crossings[i]);
    }
    return hit;
}

/* The answers to trials that hit. */
static void answer_trials(const job *j, const verdict *v, unsigned hits)
{
    const trials *c = &j->trials;
    float         columns[HC_ROW_WORDS][HC_LANES];
    float         rows[HC_LANES][HC_ROW_WORDS]; /* hc_hit but for its last word */
    const hc_i    none = hc_i_set(0);
    for (int i = 0; i < HC_LANES; i++) {
        columns[0][i] = (float)v->t[i];
    }
    memcpy(columns[1], v->u, sizeof columns[1]);
    memcpy(columns[2], v->v, sizeof columns[2]);
    memcpy(columns[3], v->height, sizeof columns[3]);
    const hc_i x = hc_i_add(hc_i_load(v->cell_x), hc_i_set(j->fast->x.first));
    const hc_i y = hc_i_add(hc_i_load(v->cell_y), hc_i_set(j->fast->y.first));
    hc_v_store(columns[4], hc_v_of_bits(x));
    hc_v_store(columns[5], hc_v_of_bits(y));
    hc_v_store(columns[6], hc_v_of_bits(none)); /* flags */
    memcpy(columns[7], c->steps, sizeof columns[7]);
    hc_rows(rows, columns);
    for (; hits != 0; hits &= hits - 1) {
        const int i   = __builtin_ctz(hits);
        hc_hit   *hit = &j->answer.hits[c->which[i]];
        memcpy(hit, rows[i], sizeof rows[i]);
        hit->crossings = (uint32_t)c->crossings[i];
    }
}

static void settle(job *j, const batch *b, const verdict *v, int i)
{
    const trials *c   = &j->trials;
    bool          hit = v->hit[i] != 0;
    if (!hit && v->clear[i] == 0) {
        hc_fast_ray r;
        (void)take_ray(&r, j->fast, b, i, &j->rays[c->which[i]]);
        hit = walk_trial(j, &r, i);
    }
    const float s = v->clear[i] != 0 ? v->s[i] : c->s[i] + c->span[i]; /* nothing before it */
    if (c->lane[i] >= 0) {
        pack          *p    = &j->packs[c->lane[i] / HC_LANES];
        const int      lane = c->lane[i] % HC_LANES;
        const unsigned bit  = 1U << lane;
        p->held &= ~bit;
        p->active &= ~(hit ? bit : 0U);
        p->s[lane] = s;
        p->ray.crossings[lane]++;
    } else if (!hit) {
        leave_over(j, c->which[i], c->from[i] + (double)s / b->run[i], c->steps[i],
                   c->crossings[i]);
    }
}

/* Keep what was added after the first sixteen. */
static void drop_trials(trials *c, int count)
{
    c->count -= count;
    if (c->count > 0) {
        for (int k = 0; k < TRIAL_WORDS; k++) {
            char *row = (char *)c + (size_t)k * sizeof c->which;
            memcpy(row, row + (size_t)count * sizeof *c->which, sizeof c->which / 2);
        }
        memcpy(c->from, c->from + count, HC_LANES * sizeof *c->from);
    }
}

/* Which of the first sixteen have lanes that wait. */
static unsigned waiting(const trials *c)
{
    unsigned lanes = 0;
    for (int i = 0; i < HC_LANES; i++) {
        lanes |= (unsigned)(c->lane[i] >= 0) << i;
    }
    return lanes;
}

static void decide(job *j)
{
    trials   *c     = &j->trials;
    const int count = c->count < HC_LANES ? c->count : HC_LANES;
    batch     b;
    verdict   v = { .hit = { 0 } };
    for (int i = count; i < HC_LANES; i++) {
        c->which[i]  = c->which[0];
        c->cell_x[i] = c->cell_x[0];
        c->cell_y[i] = c->cell_y[0];
    }
    prepare(&b, j->fast, j->rays, c->which);
    if (j->plain) {
        decide_cells(j->fast, &b, c, &v);
    }
    unsigned hits = 0;
    unsigned rest = ALL_LANES >> (HC_LANES - count);
    for (int i = 0; i < HC_LANES; i++) {
        hits |= (unsigned)(v.hit[i] != 0) << i;
    }
    hits &= rest;
    if (j->answer.any != NULL) {
        answer_any(j, c->which, hits);
    } else if (hits != 0) {
        answer_trials(j, &v, hits);
    }
    rest &= ~(hits & ~waiting(c)); /* others run on those lanes by now */
    for (; rest != 0; rest &= rest - 1) {
        settle(j, &b, &v, __builtin_ctz(rest));
    }
    drop_trials(c, count);
}

/* Lanes of a pack to be decided. `lane` is the first of the pack, or -1 if they do not wait. */
static void put_on_trial(job *j, const pack *p, const sight *seen, unsigned lanes, bool waits)
{
    trials       *c     = &j->trials;
    const int32_t first = (int32_t)(p - j->packs) * HC_LANES;
    const int     n     = c->count;
    int32_t       lane[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        lane[i] = waits ? first + i : -1;
    }
    hc_pack_words(c->lane + n, lanes, lane);
    hc_pack_words(c->which + n, lanes, p->ray.which);
    hc_pack_words(c->cell_x + n, lanes, seen->cell_x);
    hc_pack_words(c->cell_y + n, lanes, seen->cell_y);
    hc_pack_words(c->steps + n, lanes, p->ray.steps);
    hc_pack_words(c->crossings + n, lanes, p->ray.crossings);
    hc_pack_words(c->s + n, lanes, p->s);
    hc_pack_words(c->span + n, lanes, seen->span);
    hc_pack_doubles(c->from + n, lanes, p->from);
    c->count = n + __builtin_popcount(lanes);
}

/* The lanes of a pack that stand on single cells. */
static void see_near(job *j, pack *p)
{
    sight          seen;
    const unsigned lanes = p->near;
    look(j->fast, p, lanes, &seen);
    const hc_v s     = hc_v_load(p->s);
    const hc_v ahead = hc_v_add(s, hc_v_load(seen.span));
    hc_v_store(p->s, hc_v_pick(seen.clear, ahead, s));
    const hc_i moves = hc_i_load(p->ray.crossings);
    hc_i_store(p->ray.crossings, hc_i_pick(seen.clear, hc_i_add(moves, hc_i_set(1)), moves));
    p->near = seen.clear & hc_v_greater(hc_v_load(p->until), ahead);
    if (j->answer.any != NULL) {
        answer_any(j, p->ray.which, seen.below);
        p->active &= ~seen.below;
    } else if (seen.below != 0) {
        put_on_trial(j, p, &seen, seen.below, false);
        p->active &= ~seen.below;
        if (j->trials.count >= HC_LANES) {
            decide(j);
        }
    }
    const unsigned doubtful = lanes & ~seen.clear & ~seen.below;
    if (doubtful != 0) {
        put_on_trial(j, p, &seen, doubtful, true);
        p->held |= doubtful;
        if (j->trials.count >= HC_LANES) {
            decide(j);
        }
    }
}

/* ---- all together ---------------------------------------------------------------------------- */

static inline void see_to(job *j, pack *p)
{
    const hc_v     end   = hc_v_load(p->ray.end);
    const unsigned ended = p->active & ~p->held & ~hc_v_greater(end, hc_v_load(p->s));
    if (ended != 0) {
        p->near &= ~ended;
        end_segments(j, p, ended);
    }
    const unsigned ready = p->active & ~p->held;
    if (__builtin_popcount(p->near) >= NEAR_MIN || (p->near != 0 && p->near == ready)) {
        see_near(j, p);
    }
    const unsigned idle = ~p->active & ALL_LANES;
    if (__builtin_popcount(idle) >= DONE_MIN) {
        refill(j, p, idle);
    }
}

/* Not those at the end: how often a ray is marched must not depend on when it is seen to. */
static inline void march_all(job *j, ground kind)
{
    for (int k = 0; k < PACKS; k++) {
        pack          *p      = &j->packs[k];
        const unsigned before = hc_v_greater(hc_v_load(p->ray.end), hc_v_load(p->s));
        const unsigned ready  = p->active & ~p->near & ~p->held & before;
        if (ready != 0) { /* of a single ray's packs, one */
            march(j->fast, p, ready, kind);
        }
    }
}

static unsigned busy_lanes(const job *j)
{
    unsigned busy = 0;
    for (int k = 0; k < PACKS; k++) {
        busy |= j->packs[k].active & ~j->packs[k].held;
    }
    return busy;
}

/* Idle lanes are computed too: what they shift by must be some number of bits. */
static void start(job *j)
{
    j->taken        = 0;
    j->queued       = 0;
    j->next         = 0;
    j->left_count   = 0;
    j->trials.count = 0;
    for (int k = 0; k < PACKS; k++) {
        pack *p   = &j->packs[k];
        p->active = 0;
        p->near   = 0;
        p->held   = 0;
        memset(p->level, 0, sizeof p->level);
        memset(p->ray.quadrant, 0, sizeof p->ray.quadrant);
    }
}

void HC_FAST_KERNEL(const hc_fast *fast, hc_fast_answer answer, const hc_ray *rays, size_t count)
{
    job j;
    start(&j);
    j.fast   = fast;
    j.answer = answer;
    j.rays   = rays;
    j.count  = (int32_t)count;
    j.plain  = !fast->steps && !fast->open_sides && !fast->x.wrapped && !fast->y.wrapped;
    for (;;) {
        for (int k = 0; k < PACKS; k++) {
            see_to(&j, &j.packs[k]);
        }
        if (busy_lanes(&j) == 0) {
            if (j.trials.count > 0) {
                decide(&j);
            } else if (j.left_count == 0 && j.taken == j.count && j.next == j.queued) {
                return;
            }
            continue;
        }
        if (fast->steps) {
            march_all(&j, GROUND_STEPS);
        } else if (fast->sparse) {
            march_all(&j, GROUND_SPARSE);
        } else {
            march_all(&j, GROUND_PATCHES);
        }
    }
}
