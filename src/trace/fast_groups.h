/* Rays of a beam once it has been marched: they stay together, are looked at, and are decided where
 * they stand. */
#ifndef HC_TRACE_FAST_GROUPS_H
#define HC_TRACE_FAST_GROUPS_H

#include "fast_settle.h"

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

/* How wide the box of a beam may be, in cells along both axes together: its rays most often stand
 * on one cell; they are looked at before they are marched. */
static const float TOGETHER_WIDTH  = 0.25F;
static const float LOOKED_AT_WIDTH = 4.0F;

/* Cells that they are looked at before they are marched again; groups that are looked at in
 * turns. */
enum { TOGETHER_LOOKS = 8, ABREAST = 2 };

/* Every so many-th ray of a group asks for its corners: those beside it need the same lines. */
enum { ASKED = 5 };

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
        see_group(j->fast, p);
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
                count_up(p->ray.steps, p->near);
                look_before_end(j, p);
                more |= p->near != 0;
            }
        }
    }
    for (int i = 0; i < count; i++) {
        some[i]->p.near = 0;
    }
}

/* Where no cache holds the ground, groups that are too wide to be looked at ask for it from where
 * their beam has come to; the others' looks come at once. */
static void ask_for_groups(job *j)
{
    for (int k = 0; k < j->group_count; k++) {
        group *g = j->waiting[k];
        if (width_of(&j->beams, g->beam, 0.0F) >= LOOKED_AT_WIDTH) {
            load_group(j, g);
            ask_for_ground(j->fast, &g->p.ray, hc_v_load(g->p.s));
        }
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
        const spot at = find_spot(j->fast, &g->p.ray, hc_v_load(g->p.s));
        ask_for_corners(j->fast, &at, ASKED);
    }
    for (int k = 0; k < j->group_count; k++) {
        group      *g = j->waiting[k];
        pack       *p = &g->p;
        const float s = p->s[__builtin_ctz(p->active)];
        p->together   = width_of(&j->beams, g->beam, s) < TOGETHER_WIDTH;
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
        if (j->fast->ask == HC_FAST_ASK_CLIMBING) {
            ask_for_groups(j);
        }
        look_at_groups(j);
    }
    for (int k = 0; k < j->group_count; k++) {
        group *g = j->waiting[k];
        if (g->begun) {
            leave_stragglers(j, &g->p);
        }
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

#endif
