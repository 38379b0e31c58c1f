/* Single rays: what the lanes do, by the same formulas, but one thing after the other. Rays that
 * need care on their way, through periods, open sides and over steps, go through a single lane. */
#define HC_LANES 1
#define HC_FAST_KERNEL march_lane

#include "fast_data.h"

static hc_fast_march march_lane;

#include "fast_kernel.h"

/* As march() does with lanes. True where the ray stands on a single cell that it may hit. */
static inline bool step_single(const hc_fast *fast, pack *p, ground kind)
{
    const standing     on    = find_blocks(fast, p, 1);
    const place *const at    = &on.at;
    const float        top   = hc_v_of_bits(on.block);
    const float        down  = -p->ray.dz[0];
    const float        fall  = hc_v_max(down, 0x1p-60F);
    const float        out   = to_leave(fast, p, at, on.block_x, on.block_y, on.shift);
    const float        leave = at->z - out * down;
    p->ray.steps[0]++;
    if (hc_v_min(at->z, leave) > top) {
        const int32_t code   = code_of(on.block);
        const float   aside  = kind == GROUND_SPARSE ? come_aside(p, &on, out) : 0.0F;
        const float   beyond = go_beyond(fast, code, on.shift, leave - top, down, aside, kind);
        const float   step   = out + beyond;
        p->s[0]              = at->s + step;
        p->level[0]          = level_after(fast, p, at, step, on.level, on.shift, kind);
        p->ray.crossings[0]++;
        return false;
    }
    p->until[0] = at->s + out;
    p->s[0]     = at->z > top ? at->s + hc_v_about_over(at->z - top, fall) : at->s;
    p->level[0] = on.level == 0 ? 0 : on.level - 1;
    return on.level == 0;
}

/* Look at the cells up to where the block is left. True if one of them is in doubt. */
static inline bool look_single(const hc_fast *fast, pack *p, sight *seen)
{
    do {
        look(fast, p, 1, NEAR_NOTHING, seen);
        if (seen->clear == 0) {
            return true;
        }
        p->s[0] += seen->span;
        p->ray.crossings[0]++;
    } while (p->until[0] > p->s[0]);
    return false;
}

/* Where towers are listed: over them, to the cell where one may stand in the way. False below the
 * floor, and where the ray has glided to already. */
static inline bool glide_single(const hc_fast *fast, pack *p)
{
    if (!fast->towers.listed || !(p->s[0] > p->again[0])) {
        return false;
    }
    const landing l = glide(fast, &p->ray, p->s, 1);
    p->s[0]         = l.s;
    p->until[0]     = l.s;
    p->again[0]     = l.above != 0 ? l.s + GLIDE_AFTER : INFINITY;
    return l.above != 0;
}

/* The first hit from the beginning on. */
static inline bool march_single(const hc_fast *fast, pack *p, const hc_fast_ray *r, bool any,
                                hc_fast_found *found, ground kind)
{
    const double over = 1.0 / hc_fast_run(r);
    while (p->ray.end[0] > p->s[0]) {
        sight      seen;
        const bool near = glide_single(fast, p) || step_single(fast, p, kind);
        if (!near || !(p->ray.end[0] > p->s[0]) || !look_single(fast, p, &seen)) {
            continue;
        }
        const double first = r->from + (double)p->s[0] * over;
        const double last  = r->from + (double)(p->s[0] + seen.span) * over;
        if ((any && seen.below != 0) || hc_fast_walk(fast, r, found, first, last)) {
            return true;
        }
        p->s[0] += seen.span;
        p->ray.crossings[0]++;
    }
    return false;
}

static bool cast_single(const hc_fast *fast, const hc_ray *ray, bool any, hc_hit *hit)
{
    const int32_t which = 0;
    batch         b;
    pack          p;
    hc_fast_ray   r;
    hc_fast_found found;
    prepare_some(&b, fast, ray, &which);
    if (take_ray(&r, fast, &b, 0, ray) == HC_FAST_MISSES) {
        return false;
    }
    turn_batch(&p.ray, fast, &b);
    p.s[0]     = 0.0F;
    p.again[0] = -1.0F;
    p.together = false;
    p.group    = NULL;
    p.level[0] = fast->first_level;
    bool hits  = false;
    if (find_marched(&p.ray) == 0) {
        hits = hc_fast_walk(fast, &r, &found, r.from, r.to);
    } else if (any && probe(fast, &p.ray, 1) != 0) {
        return true;
    } else {
        hits = fast->sparse ? march_single(fast, &p, &r, any, &found, GROUND_SPARSE)
                            : march_single(fast, &p, &r, any, &found, GROUND_PATCHES);
    }
    hit->steps     = (uint32_t)p.ray.steps[0];
    hit->crossings = (uint32_t)p.ray.crossings[0];
    if (hits && !any) {
        hc_fast_fill(fast, hit, &r, &found);
    }
    return hits;
}

void hc_fast_march_one(const hc_fast *fast, hc_fast_answer answer, const hc_ray *rays, size_t count)
{
    if (!hc_fast_plain(fast)) {
        march_lane(fast, answer, rays, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        hc_hit     hit  = { .t = INFINITY };
        const bool hits = cast_single(fast, &rays[i], answer.any != NULL, &hit);
        if (answer.any != NULL) {
            answer.any[i] = hits ? 1 : 0;
        } else {
            answer.hits[i] = hit;
        }
    }
}
