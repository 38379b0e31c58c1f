/* Relaxed cones by ray sampling.
 * After: Policarpo, Oliveira. Relaxed Cone Stepping for Relief Mapping. GPU Gems 3, chapter 18,
 * 2007.
 *
 * For texel p and each higher sample q (at its nearest image), a ray starts at height 1 above p,
 * enters the surface at q and goes on down to height 0 in `gems_steps` equal steps. The first step
 * that is above the bilinear surface again is where the ray has come out; if that is above p, the
 * cone may not reach beyond it. Only the one ray through q's top is tried, so other rays inside the
 * cone may still cross the surface twice: wider than "one crossing at most" asks for, NOT safe.
 * Where q is at height 1 the ray is level and never comes out below; then q itself is the limit.
 *
 * A place on the ray beyond q is lower and farther than q: it never counts for more than q's own
 * steepness, and less with every step. So hc_may_be_steeper can drop samples and end rays early. */
#include "quadrant_search.h"

#include "base/parallel.h"

#include <stdlib.h>

/* Two neighbouring samples along one axis and the weight of the second. */
typedef struct tap {
    int   low, high;
    float weight;
} tap;

static tap tap_at(float place, int side, bool wraps)
{
    const float size = (float)side;
    float       kept = wraps ? place - size * floorf(place / size) : place;
    if (wraps) {
        kept = kept >= 0.0F && kept < size ? kept : 0.0F; /* rounding can leave the period */
    } else {
        kept = kept < 0.0F ? 0.0F : kept > size - 1.0F ? size - 1.0F : kept;
    }
    const int low  = (int)kept;
    const int next = low + 1 < side ? low + 1 : wraps ? 0 : low;
    return (tap){ low, next, kept - (float)low };
}

static float mix(float a, float b, float weight)
{
    return a + (b - a) * weight;
}

static float surface(const hc_cone_job *job, float column, float row)
{
    const tap    u     = tap_at(column, job->width, job->wrap_u);
    const tap    v     = tap_at(row, job->height, job->wrap_v);
    const float *upper = job->heights + (size_t)v.low * (size_t)job->width;
    const float *lower = job->heights + (size_t)v.high * (size_t)job->width;
    return mix(mix(upper[u.low], upper[u.high], u.weight),
               mix(lower[u.low], lower[u.high], u.weight), v.weight);
}

static int wrapped(int place, int side)
{
    return place < 0 ? place + side : place >= side ? place - side : place;
}

static hc_steepest march(const void *context, int x, int y, int column, int row, hc_steepest best)
{
    const hc_cone_job *job   = context;
    const size_t       width = (size_t)job->width;
    const float        apex  = job->heights[(size_t)y * width + (size_t)x];
    const float        entry = job->heights[(size_t)wrapped(y + row, job->height) * width
                                     + (size_t)wrapped(x + column, job->width)];
    const float reach = hc_reach(true, column, job->step_u) + hc_reach(true, row, job->step_v);
    if (entry >= 1.0F) {
        return hc_steeper(true, entry - apex, reach, best);
    }
    const float steps   = (float)job->gems_steps;
    const float stretch = entry / ((1.0F - entry) * steps); /* of the way from p to q, per step */
    for (int step = 1; step <= job->gems_steps; step++) {
        const float height = entry - entry * ((float)step / steps);
        const float way    = 1.0F + (float)step * stretch;
        const float beyond = reach * (way * way);
        if (height <= apex || !hc_may_be_steeper(true, height - apex, beyond, best)) {
            break;
        }
        if (surface(job, (float)x + (float)column * way, (float)y + (float)row * way) < height) {
            return hc_steeper(true, height - apex, beyond, best);
        }
    }
    return best;
}

static void bake_row(void *context, int y, int worker)
{
    (void)worker;
    const hc_quadrant_search *search = context;
    const hc_cone_job        *job    = search->job;
    for (int x = 0; x < job->width; x++) {
        hc_steepest best = { 0.0F, 0.0F };
        for (int quadrant = 0; quadrant < 4; quadrant++) {
            best = hc_search_quadrant(search, x, y, quadrant, best);
        }
        job->ratios[(size_t)y * (size_t)job->width + (size_t)x] = hc_ratio(best.value);
    }
}

hc_result hc_cone_gems(const hc_cone_job *job)
{
    /* halves of a wrapped axis, so that every sample has one nearest image */
    hc_quadrant_search search = {
        .job   = job,
        .limit = { job->wrap_u ? job->width / 2 : job->width - 1,
                   job->wrap_u ? (job->width - 1) / 2 : job->width - 1,
                   job->wrap_v ? job->height / 2 : job->height - 1,
                   job->wrap_v ? (job->height - 1) / 2 : job->height - 1 },
        .judge   = march,
        .context = job,
    };
    hc_result result = hc_highest_allocate(&search.highest, job->width, job->height, job->log);
    if (result == HC_OK) {
        hc_highest_fill(&search.highest, job->heights);
        result =
            hc_parallel_for(job->height, job->threads, bake_row, &search, job->progress, job->log);
    }
    free(search.highest.values);
    return result;
}
