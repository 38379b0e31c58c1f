/* All rays through lanes: made ready, marched, decided, answered. Included once per instruction
 * set, with HC_FAST_KERNEL the name of what it defines.
 *
 * A lane that is done takes the next ray. What a look at a patch leaves open goes to the trials,
 * which are decided together; where the outcome is all but sure the lane does not wait for it. The
 * rays of a beam stay together instead, and are decided where they stand. */
#include "fast_groups.h"

static const pace marching = { .near = 4, .done = 2, .rounds = 4, .few_rounds = 2 };

/* Over towers: the more rays glide together the better. */
static const pace gliding = { .near = 6, .done = 4, .rounds = 1, .few_rounds = 1 };

static const pace single = { .near = 1, .done = 1, .rounds = 4, .few_rounds = 4 };

/* Are there rays that are not in lanes? */
static inline bool has_more(const job *j)
{
    return j->next != j->queued || has_new(j) || j->next_group != j->group_count
           || j->left_count != 0 || j->stragglers.rays.count != 0;
}

/* Stragglers fill idle lanes beside others, but have lanes for themselves only if there are enough
 * of them, or nothing else is left. */
static inline bool calls_back(const job *j, const pack *p)
{
    const int  count = j->stragglers.rays.count;
    const bool last  = j->next_group == j->group_count && !has_new(j);
    return count >= HC_LANES || (count > 0 && (p->active != 0 || last));
}

/* A pack of rays of any kind of which few go on, while groups wait and nothing else fills it. */
static inline bool gives_way(const job *j, const pack *p)
{
    return p->active != 0 && j->next_group != j->group_count && j->next == j->queued
           && are_few(j, p->active & ~p->held);
}

/* Give idle lanes of a pack rays from the queue, or stragglers; where all are, a group may take
 * their place. */
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
            } else if (calls_back(j, p)) {
                idle = call_back(&j->stragglers, p, idle);
                continue;
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
        const unsigned lanes = choose_lanes(idle, j->queued - j->next);
        spread_rays(p, lanes, (const int32_t *)&j->queue + j->next, HC_LANES * sizeof(int32_t),
                    j->queue_from + j->next);
        if (!j->plain) {
            hc_spread_doubles(p->next, lanes, j->queue_next + j->next);
        }
        hc_v_put(p->s, lanes, hc_v_set(0.0F));
        hc_i_put(p->level, lanes, hc_i_set(j->fast->first_level));
        j->next += __builtin_popcount(lanes);
        idle &= ~lanes;
    }
}

/* ---- all together ---------------------------------------------------------------------------- */

static APART void see_apart(const hc_fast *fast, pack *p)
{
    see_group(fast, p);
}

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
        if (p->group != NULL) {
            see_apart(j->fast, p);
        } else {
            see_near(j, p);
        }
    }
    if (p->group != NULL) {
        leave_stragglers(j, p);
        if (p->held != 0 && p->held == p->active) {
            decide_group(j, p);
        }
    } else if (gives_way(j, p)) {
        break_up(j, p, p->active & ~p->held);
    }
    const unsigned idle = ~p->active & ALL_LANES;
    if (__builtin_popcount(idle) >= (p->group != NULL ? HC_LANES : j->pace.done) && has_more(j)) {
        refill(j, slot, idle);
    }
    if (j->fast->towers.listed) {
        glide_on(j, j->packs[slot]); /* refill may have put another there */
    }
}

/* Lanes to be marched. Not those at the end: how often a ray is marched must not depend on when it
 * is seen to. */
static inline unsigned find_ready(const pack *p)
{
    const unsigned before = hc_v_greater(hc_v_load(p->ray.end), hc_v_load(p->s));
    return p->active & ~p->near & ~p->held & before;
}

/* All blocks are asked for before any is waited for. False if there are none. */
static inline bool march_all(job *j, ground kind)
{
    standing on[PACKS];
    unsigned ready[PACKS];
    unsigned some = 0;
    for (int k = 0; k < PACKS; k++) {
        ready[k] = find_ready(j->packs[k]);
        if (ready[k] != 0) {
            on[k] = find_blocks(j->fast, j->packs[k], ready[k]);
        } else if (PACKS == 1) {
            return false;
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
    j->taken                 = 0;
    j->queued                = 0;
    j->next                  = 0;
    j->left_count            = 0;
    j->trials.count          = 0;
    j->group_count           = 0;
    j->next_group            = 0;
    j->used                  = 0;
    j->suspects.count        = 0;
    j->stragglers.rays.count = 0;
    memset(j->suspects.words, 0, sizeof j->suspects.words);
    memset(&j->beams, 0, sizeof j->beams);
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
