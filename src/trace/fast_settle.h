/* What becomes of lanes that stand on single cells, or at their end: they go on, are answered, or
 * are put on trial, where sixteen are decided together. */
#ifndef HC_TRACE_FAST_SETTLE_H
#define HC_TRACE_FAST_SETTLE_H

#include "fast_queue.h"

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
    int32_t               x[HC_LANES];
    int32_t               y[HC_LANES];
    hc_hit                other; /* of lanes that are not asked for */
    hc_hit               *to[HC_LANES];
    hc_hit *const         out   = j->answer.hits;
    hc_hit *const         first = &out[which[0]];
    hc_i_store(x, hc_i_add(hc_i_load(v->cell_x), hc_i_set(j->fast->x.first)));
    hc_i_store(y, hc_i_add(hc_i_load(v->cell_y), hc_i_set(j->fast->y.first)));
    const void *const columns[HC_ROW_WORDS] = { v->t, v->u, v->v, v->height, x, y, flags, steps };
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
    const trials *c     = &j->trials;
    const bool    clear = (v->clear >> i & 1) != 0;
    bool          hit   = (v->hit >> i & 1) != 0;
    if (!hit && !clear) {
        const leftover from = { c->which[i], c->steps[i], c->crossings[i], c->from[i] };
        hit                 = walk_cells(j, b, i, &from, c->s[i], c->span[i]);
    }
    const float s = clear ? v->s[i] : c->s[i] + c->span[i]; /* nothing before it */
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

static void decide(job *j)
{
    trials   *c     = &j->trials;
    const int count = c->count < HC_LANES ? c->count : HC_LANES;
    batch     b;
    verdict   v;
    v.hit   = 0;
    v.clear = 0;
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
    const unsigned hits = v.hit & rest;
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
    hc_pack_words(c->cell_x + n, lanes, &seen->cell_x);
    hc_pack_words(c->cell_y + n, lanes, &seen->cell_y);
    hc_pack_words(c->steps + n, lanes, p->ray.steps);
    hc_pack_words(c->crossings + n, lanes, p->ray.crossings);
    hc_pack_words(c->s + n, lanes, p->s);
    hc_pack_words(c->span + n, lanes, &seen->span);
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
    unsigned       hits  = v.hit & p->held;
    const unsigned clear = v.clear & p->held & ~hits;
    answer_found(j, &v, hits, p->ray.which, p->ray.steps, p->ray.crossings, true);
    for (unsigned rest = p->held & ~hits & ~clear; rest != 0; rest &= rest - 1) {
        const int      i    = __builtin_ctz(rest);
        const leftover from = { p->ray.which[i], p->ray.steps[i], p->ray.crossings[i], b->from[i] };
        hits |= (unsigned)walk_cells(j, b, i, &from, p->s[i], p->span[i]) << i;
    }
    const unsigned on = p->held & ~hits;
    if (on != 0) {
        const hc_v ahead = hc_v_add(hc_v_load(p->s), hc_v_load(p->span));
        hc_v_put(p->s, on, hc_v_pick(clear, hc_v_load(v.s), ahead));
        count_up(p->ray.crossings, on);
    }
    p->active &= ~hits;
    p->held = 0;
}

/* Lanes of a group wait until none goes on. */
static void hold(pack *p, const sight *seen, unsigned lanes)
{
    hc_i_put(p->cell_x, lanes, seen->cell_x);
    hc_i_put(p->cell_y, lanes, seen->cell_y);
    hc_v_put(p->span, lanes, seen->span);
    hc_v_put(p->heights[0], lanes, seen->patch.h00);
    hc_v_put(p->heights[1], lanes, seen->patch.h10);
    hc_v_put(p->heights[2], lanes, seen->patch.h01);
    hc_v_put(p->heights[3], lanes, seen->patch.h11);
    p->held |= lanes;
}

/* Lanes that hit nothing on their cells go on to the next ones. */
static ALWAYS_INLINE void go_on_clear(pack *p, const sight *seen)
{
    const hc_v ahead = hc_v_add(hc_v_load(p->s), seen->span);
    hc_v_put(p->s, seen->clear, ahead);
    count_up(p->ray.crossings, seen->clear);
    p->near = seen->clear & hc_v_greater(hc_v_load(p->until), ahead);
}

/* The lanes of a group that stand on single cells. */
static ALWAYS_INLINE void see_group(const hc_fast *fast, pack *p)
{
    sight          seen;
    const unsigned lanes = p->near;
    look(fast, p, lanes, p->together ? NEAR_ONE_CELL : NEAR_EACH_OTHER, &seen);
    go_on_clear(p, &seen);
    hold(p, &seen, lanes & ~seen.clear);
}

/* Likewise of rays of any kind. */
static APART void see_near(job *j, pack *p)
{
    sight          seen;
    const unsigned lanes = p->near;
    look(j->fast, p, lanes, NEAR_NOTHING, &seen);
    go_on_clear(p, &seen);
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

/* Lanes so few that they had better go on among those of other groups: a pack takes as long for one
 * as for sixteen. Over towers they do not go on for long. */
static inline bool are_few(const job *j, unsigned lanes)
{
    return !j->fast->sparse && __builtin_popcount(lanes) <= FEW_LANES
           && j->stragglers.rays.count <= CROWD - HC_LANES;
}

/* Of a group whose other lanes are done, or wait. */
static inline void leave_stragglers(job *j, pack *p)
{
    const unsigned ahead = p->active & ~p->held;
    if (ahead != 0 && are_few(j, ahead)) {
        set_aside(&j->stragglers, p, ahead, p->group->b.from);
    }
}

/* A pack of rays of any kind gives way to a group: its trials do without it. */
static APART void break_up(job *j, pack *p, unsigned ahead)
{
    const int32_t first = (int32_t)(p - j->own) * HC_LANES;
    set_aside(&j->stragglers, p, ahead, p->from);
    for (int i = 0; i < j->trials.count; i++) {
        const bool its    = j->trials.lane[i] >= first && j->trials.lane[i] < first + HC_LANES;
        j->trials.lane[i] = its ? -1 : j->trials.lane[i];
    }
    p->active = 0;
    p->held   = 0;
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
    hc_v_put(p->again, off, next);
    hc_v_put(p->until, l.above, l.s);
    p->near |= l.above;
}

#endif
