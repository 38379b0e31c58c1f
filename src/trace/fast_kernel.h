/* All rays through lanes: made ready, marched, decided, answered. Included once per instruction
 * set, with HC_FAST_KERNEL the name of what it defines.
 *
 * A lane that is done takes the next ray. What a look at a patch leaves open goes to the trials,
 * which are decided together; where the outcome is all but sure the lane does not wait for it. The
 * rays of a beam stay together instead, and are decided where they stand. */
#include "fast_queue.h"

static const pace marching = { .near = 4, .done = 2, .rounds = 4, .few_rounds = 2 };

/* Over towers: the more rays glide together the better. */
static const pace gliding = { .near = 6, .done = 4, .rounds = 1, .few_rounds = 1 };

static const pace single = { .near = 1, .done = 1, .rounds = 4, .few_rounds = 4 };

/* ---- lanes in and out ------------------------------------------------------------------------ */

/* A group's rays, from where their beam has come to. */
static void load_group(job *j, group *g)
{
    const int  k     = g->beam;
    pack      *p     = &g->p;
    const hc_v ahead = hc_v_sub(hc_v_set(j->beams.s[k]), hc_v_load(g->s));
    hc_v_store(p->s, hc_v_keep(g->lanes, hc_v_max(ahead, hc_v_set(0.0F))));
    hc_v_store(p->again, hc_v_set(-1.0F));
    hc_i_store(p->level, hc_i_set(j->beams.level[k]));
    p->active   = g->lanes;
    p->near     = 0;
    p->held     = 0;
    p->together = false;
    p->group    = g;
    g->begun    = true;
    memset(p->cell_x, 0, sizeof p->cell_x); /* lanes that do not wait are looked at, too */
    memset(p->cell_y, 0, sizeof p->cell_y);
    memset(p->heights, 0, sizeof p->heights);
}

/* Are there rays that are not in lanes? */
static inline bool has_more(const job *j)
{
    return j->next != j->queued || has_new(j) || j->next_group != j->group_count
           || j->left_count != 0;
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

/* What could not be told of ray i of a batch: walk over the cells from s on. False: that hits
 * nothing. */
static bool walk_cells(const job *j, const batch *b, int i, const leftover *from, float s,
                       float span)
{
    hc_fast_ray r;
    (void)take_ray(&r, j->fast, b, i, &j->rays[from->which]);
    const double run = hc_fast_run(&r);
    /* On steps a lane that cut a corner may have left out the cell that it cut. */
    const double  back  = j->fast->steps ? 6.0 * (double)j->fast->blur : 0.0;
    const double  first = from->t + ((double)s - back) / run;
    const double  last  = from->t + (double)(s + span) / run; /* as the lane counts */
    hc_fast_found found;
    const bool    hit = hc_fast_walk(j->fast, &r, &found, first, last);
    if (hit) {
        answer_hit(j, from->which, &r, &found, from->steps, from->crossings);
    }
    return hit;
}

/* The answers to those in question that hit. Those of a whole group, `in_turn`, stand one behind
 * the other. */
static void answer_hits(const job *j, const verdict *v, unsigned hits, const int32_t *which,
                        const int32_t *steps, const int32_t *crossings, bool in_turn)
{
    static const uint32_t flags[HC_LANES] = { 0 };
    float                 t[HC_LANES];
    int32_t               x[HC_LANES];
    int32_t               y[HC_LANES];
    hc_hit                other; /* of lanes that are not asked for */
    hc_hit               *to[HC_LANES];
    hc_hit *const         out   = j->answer.hits;
    hc_hit *const         first = &out[which[0]];
    for (int i = 0; i < HC_LANES; i++) {
        t[i] = (float)v->t[i];
    }
    hc_i_store(x, hc_i_add(hc_i_load(v->cell_x), hc_i_set(j->fast->x.first)));
    hc_i_store(y, hc_i_add(hc_i_load(v->cell_y), hc_i_set(j->fast->y.first)));
    const void *const columns[HC_ROW_WORDS] = { t, v->u, v->v, v->height, x, y, flags, steps };
    if (in_turn && hits == ALL_LANES) {
        hc_rows_apart(first, sizeof *first, columns);
        for (int i = 0; i < HC_LANES; i++) {
            first[i].crossings = (uint32_t)crossings[i];
        }
        return;
    }
    for (int i = 0; i < HC_LANES; i++) {
        to[i] = (hits >> i & 1) != 0 ? &out[which[i]] : &other;
    }
    hc_rows((void *const *)to, columns);
    for (int i = 0; i < HC_LANES; i++) {
        to[i]->crossings = (uint32_t)crossings[i];
    }
}

static void answer_found(const job *j, const verdict *v, unsigned hits, const int32_t *which,
                         const int32_t *steps, const int32_t *crossings, bool in_turn)
{
    if (j->answer.any != NULL) {
        answer_any(j, which, hits);
    } else if (hits != 0) {
        answer_hits(j, v, hits, which, steps, crossings, in_turn);
    }
}

static void settle(job *j, const batch *b, const verdict *v, int i)
{
    const trials *c   = &j->trials;
    bool          hit = v->hit[i] != 0;
    if (!hit && v->clear[i] == 0) {
        const leftover from = { c->which[i], c->steps[i], c->crossings[i], c->from[i] };
        hit                 = walk_cells(j, b, i, &from, c->s[i], c->span[i]);
    }
    const float s = v->clear[i] != 0 ? v->s[i] : c->s[i] + c->span[i]; /* nothing before it */
    if (c->lane[i] >= 0) {
        pack          *p    = &j->own[c->lane[i] / HC_LANES];
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

static unsigned find_set(const int32_t *flags)
{
    return hc_i_differ(hc_i_load(flags), hc_i_set(0));
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
    prepare_some(&b, j->fast, j->rays, c->which);
    if (j->plain) {
        float          heights[4][HC_LANES];
        const question what = { c->cell_x, c->cell_y, heights, c->s, c->from };
        read_corners(heights, j->fast, c->cell_x, c->cell_y);
        decide_cells(j->fast, &b, &what, ALL_LANES, &v);
    }
    unsigned       rest = ALL_LANES >> (HC_LANES - count);
    const unsigned hits = find_set(v.hit) & rest;
    answer_found(j, &v, hits, c->which, c->steps, c->crossings, false);
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
    const int32_t first = (int32_t)(p - j->own) * HC_LANES;
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

/* The lanes of a group that wait, on their own. */
static void decide_group(job *j, pack *p)
{
    const batch   *b    = &p->group->b;
    const question what = { p->cell_x, p->cell_y, p->heights, p->s, b->from };
    verdict        v;
    hc_v_store(v.s, hc_v_set(0.0F)); /* read where nothing is clear, too */
    decide_cells(j->fast, b, &what, p->held, &v);
    unsigned       hits  = find_set(v.hit) & p->held;
    const unsigned clear = find_set(v.clear) & p->held & ~hits;
    answer_found(j, &v, hits, p->ray.which, p->ray.steps, p->ray.crossings, true);
    for (unsigned rest = p->held & ~hits & ~clear; rest != 0; rest &= rest - 1) {
        const int      i    = __builtin_ctz(rest);
        const leftover from = { p->ray.which[i], p->ray.steps[i], p->ray.crossings[i], b->from[i] };
        hits |= (unsigned)walk_cells(j, b, i, &from, p->s[i], p->span[i]) << i;
    }
    const unsigned on    = p->held & ~hits;
    const hc_v     s     = hc_v_load(p->s);
    const hc_v     next  = hc_v_pick(clear, hc_v_load(v.s), hc_v_add(s, hc_v_load(p->span)));
    const hc_i     moves = hc_i_load(p->ray.crossings);
    hc_v_store(p->s, hc_v_pick(on, next, s));
    hc_i_store(p->ray.crossings, hc_i_pick(on, hc_i_add(moves, hc_i_set(1)), moves));
    p->active &= ~hits;
    p->held = 0;
}

/* Lanes of a group wait until none goes on. */
static void hold(pack *p, const sight *seen, unsigned lanes)
{
    const hc_i x    = hc_i_pick(lanes, hc_i_load(seen->cell_x), hc_i_load(p->cell_x));
    const hc_i y    = hc_i_pick(lanes, hc_i_load(seen->cell_y), hc_i_load(p->cell_y));
    const hc_v span = hc_v_pick(lanes, hc_v_load(seen->span), hc_v_load(p->span));
    hc_i_store(p->cell_x, x);
    hc_i_store(p->cell_y, y);
    hc_v_store(p->span, span);
    const corners h = { hc_v_pick(lanes, seen->patch.h00, hc_v_load(p->heights[0])),
                        hc_v_pick(lanes, seen->patch.h10, hc_v_load(p->heights[1])),
                        hc_v_pick(lanes, seen->patch.h01, hc_v_load(p->heights[2])),
                        hc_v_pick(lanes, seen->patch.h11, hc_v_load(p->heights[3])) };
    store_corners(p->heights, &h);
    p->held |= lanes;
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
    if (p->group != NULL) {
        hold(p, &seen, lanes & ~seen.clear);
        return;
    }
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

/* Lanes that have just begun, or have come past what stopped them. What stops them now stands in
 * the cell that they have come to. */
static inline void glide_on(job *j, pack *p)
{
    const hc_v     s     = hc_v_load(p->s);
    const hc_v     again = hc_v_load(p->again);
    const unsigned off   = hc_v_greater(s, again) & p->active & ~p->held & ~p->near;
    if (off == 0) {
        return;
    }
    const landing l    = glide(j->fast, &p->ray, p->s, off);
    const hc_v    past = hc_v_add(l.s, hc_v_set(GLIDE_AFTER));
    const hc_v    next = hc_v_pick(l.above, past, hc_v_set(INFINITY));
    hc_v_store(p->s, l.s);
    hc_v_store(p->again, hc_v_pick(off, next, again));
    hc_v_store(p->until, hc_v_pick(l.above, l.s, hc_v_load(p->until)));
    p->near |= l.above;
}

/* ---- groups ---------------------------------------------------------------------------------- */

/* How wide the box of a beam may be, in cells along both axes together: its rays most often stand
 * on one cell; they are looked at before they are marched. */
static const float TOGETHER_WIDTH  = 0.25F;
static const float LOOKED_AT_WIDTH = 4.0F;

/* Cells that they are looked at before they are marched again; groups that are looked at in
 * turns. */
enum { TOGETHER_LOOKS = 8, ABREAST = 2 };

/* Of a beam's box, `ahead` of it. */
static float width_of(const beams *b, int k, float ahead)
{
    float width = 0.0F;
    for (int axis = 0; axis < 2; axis++) {
        width += b->high[axis][k] - b->low[axis][k]
                 + (b->s[k] + ahead) * (b->high_rate[axis][k] - b->low_rate[axis][k]);
    }
    return width;
}

/* Look at the cells of those that are near, before their end. */
static void look_before_end(job *j, pack *p)
{
    p->near &= hc_v_greater(hc_v_load(p->ray.end), hc_v_load(p->s));
    if (p->near != 0) {
        see_near(j, p);
    }
}

/* Cell by cell, in turns, so that one group computes while the other waits; each counts as a step,
 * in place of its block. */
static void look_along(job *j, group *const *some, int count)
{
    bool more = true;
    for (int k = 0; k < TOGETHER_LOOKS && more; k++) {
        more = false;
        for (int i = 0; i < count; i++) {
            pack *p = &some[i]->p;
            if (p->near != 0) {
                const hc_i steps = hc_i_load(p->ray.steps);
                hc_i_store(p->ray.steps, hc_i_pick(p->near, hc_i_add(steps, hc_i_set(1)), steps));
                look_before_end(j, p);
                more |= p->near != 0;
            }
        }
    }
    for (int i = 0; i < count; i++) {
        some[i]->p.near = 0;
    }
}

/* Of the groups those that are narrow and have come down to cells, from where their beam has come
 * to. */
static void look_at_groups(job *j)
{
    group *some[ABREAST];
    int    count = 0;
    for (int k = 0; k < j->group_count; k++) {
        group      *g     = j->waiting[k];
        pack       *p     = &g->p;
        const float width = width_of(&j->beams, g->beam, 0.0F);
        if (j->beams.level[g->beam] == 0 && width < LOOKED_AT_WIDTH) {
            load_group(j, g);
            p->together = width < TOGETHER_WIDTH;
            p->near     = p->active;
            hc_v_store(p->until, hc_v_set(INFINITY));
            some[count++] = g;
        }
        if (count == ABREAST || k == j->group_count - 1) {
            look_along(j, some, count);
            count = 0;
        }
    }
}

/* To where a tower may stand in the way, all of them before any is looked at. */
static void glide_groups(job *j)
{
    for (int k = 0; k < j->group_count; k++) {
        group *g = j->waiting[k];
        load_group(j, g);
        glide_on(j, &g->p);
        ask_for_corners(j->fast, &g->p.ray, hc_v_load(g->p.s));
    }
    for (int k = 0; k < j->group_count; k++) {
        const group *g = j->waiting[k];
        pack        *p = &j->waiting[k]->p;
        const float  s = p->s[__builtin_ctz(p->active)];
        p->together    = width_of(&j->beams, g->beam, s) < TOGETHER_WIDTH;
        look_before_end(j, p);
    }
}

/* Groups that stay together, or glide, come to their answers here, all of them to where they are
 * decided first, so that one decision need not wait for the other. The others, and those that go
 * on, are left for lanes. */
static APART void finish_groups(job *j)
{
    group *ready[HC_LANES];
    int    ready_count = 0;
    int    left        = 0;
    if (j->fast->towers.listed) {
        glide_groups(j);
    } else {
        look_at_groups(j);
    }
    for (int k = 0; k < j->group_count; k++) {
        group *g = j->waiting[k];
        if (g->begun && g->p.held != 0 && g->p.held == g->p.active) {
            ready[ready_count++] = g;
        } else {
            j->waiting[left++] = g;
        }
    }
    for (int k = 0; k < ready_count; k++) {
        group *g = ready[k];
        decide_group(j, &g->p);
        if (g->p.active == 0) {
            j->used &= ~(1U << (g - j->groups));
        } else {
            j->waiting[left++] = g;
        }
    }
    j->group_count = left;
}

/* Give idle lanes of a pack rays from the queue; where all are, a group may take their place. */
static APART void refill(job *j, int slot, unsigned idle)
{
    pack *p = j->packs[slot];
    if (p->group != NULL) {
        j->used &= ~(1U << (p->group - j->groups));
        p              = &j->own[slot];
        j->packs[slot] = p;
    }
    while (idle != 0) {
        if (j->next == j->queued) {
            j->next   = 0;
            j->queued = 0;
            if (j->left_count > 0) {
                enqueue_left(j);
            } else if (j->next_group < j->group_count) {
                if (p->active == 0) {
                    group *g = j->waiting[j->next_group++];
                    if (!g->begun) {
                        load_group(j, g);
                    }
                    j->packs[slot] = &g->p;
                }
                return;
            } else if (has_new(j)) {
                take_new(j);
                finish_groups(j);
                continue;
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
        hc_v_store(p->again, hc_v_pick(lanes, hc_v_set(-1.0F), hc_v_load(p->again)));
        hc_i_store(p->level, hc_i_pick(lanes, hc_i_set(j->fast->first_level), hc_i_load(p->level)));
        j->next += __builtin_popcount(lanes);
        p->active |= lanes;
        idle &= ~lanes;
    }
}

/* ---- all together ---------------------------------------------------------------------------- */

static inline void see_to(job *j, int slot)
{
    pack          *p     = j->packs[slot];
    const hc_v     end   = hc_v_load(p->ray.end);
    const unsigned ended = p->active & ~p->held & ~hc_v_greater(end, hc_v_load(p->s));
    if (ended != 0) {
        p->near &= ~ended;
        end_segments(j, p, ended);
    }
    const unsigned ready  = p->active & ~p->held;
    const int      enough = p->group != NULL ? 1 : j->pace.near;
    if (__builtin_popcount(p->near) >= enough || (p->near != 0 && p->near == ready)) {
        see_near(j, p);
    }
    if (p->group != NULL && p->held != 0 && p->held == p->active) {
        decide_group(j, p);
    }
    const unsigned idle = ~p->active & ALL_LANES;
    if (__builtin_popcount(idle) >= (p->group != NULL ? HC_LANES : j->pace.done) && has_more(j)) {
        refill(j, slot, idle);
    }
    if (j->fast->towers.listed) {
        glide_on(j, j->packs[slot]); /* refill may have put another there */
    }
}

/* Not those at the end: how often a ray is marched must not depend on when it is seen to. All
 * blocks are asked for before any is waited for. False if there are none. */
static inline bool march_all(job *j, ground kind)
{
    standing on[PACKS];
    unsigned ready[PACKS];
    unsigned some = 0;
    for (int k = 0; k < PACKS; k++) {
        const pack    *p      = j->packs[k];
        const unsigned before = hc_v_greater(hc_v_load(p->ray.end), hc_v_load(p->s));
        ready[k]              = p->active & ~p->near & ~p->held & before;
        if (ready[k] != 0) { /* of a single ray's packs, one */
            on[k] = find_blocks(j->fast, p, ready[k]);
        }
        some |= ready[k];
    }
    for (int k = 0; k < PACKS; k++) {
        if (ready[k] != 0) {
            march(j->fast, j->packs[k], ready[k], &on[k], kind);
        }
    }
    return some != 0;
}

static inline void march_on(job *j, ground kind)
{
    const bool few    = j->answer.any != NULL || j->group_count > 0;
    const int  rounds = few ? j->pace.few_rounds : j->pace.rounds;
    for (int k = 0; k < rounds && march_all(j, kind); k++) {
    }
}

static inline unsigned busy_lanes(const job *j)
{
    unsigned busy = 0;
    for (int k = 0; k < PACKS; k++) {
        busy |= j->packs[k]->active & ~j->packs[k]->held;
    }
    return busy;
}

/* Idle lanes are computed too. */
static void start(job *j)
{
    j->taken          = 0;
    j->queued         = 0;
    j->next           = 0;
    j->left_count     = 0;
    j->trials.count   = 0;
    j->group_count    = 0;
    j->next_group     = 0;
    j->used           = 0;
    j->suspects.count = 0;
    memset(j->suspects.words, 0, sizeof j->suspects.words);
    for (int k = 0; k < PACKS; k++) {
        j->packs[k] = &j->own[k];
        memset(j->packs[k], 0, sizeof *j->packs[k]);
    }
}

static void go_through(job *j)
{
    for (;;) {
        for (int k = 0; k < PACKS; k++) {
            see_to(j, k);
        }
        if (busy_lanes(j) == 0) {
            if (j->trials.count > 0) {
                decide(j);
            } else if (!has_more(j)) {
                return;
            }
        } else if (j->fast->steps) {
            march_on(j, GROUND_STEPS);
        } else if (j->fast->sparse) {
            march_on(j, GROUND_SPARSE);
        } else {
            march_on(j, GROUND_PATCHES);
        }
    }
}

void HC_FAST_KERNEL(const hc_fast *fast, hc_fast_answer answer, const hc_ray *rays, size_t count)
{
    job j;
    start(&j);
    j.fast   = fast;
    j.pace   = HC_LANES == 1 ? single : fast->towers.listed ? gliding : marching;
    j.answer = answer;
    j.rays   = rays;
    j.count  = (int32_t)count;
    j.plain  = hc_fast_plain(fast);
    go_through(&j);
}
