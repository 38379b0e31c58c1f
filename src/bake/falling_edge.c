/* Exact relaxed cones: only samples behind which the surface falls limit a cone.
 * After: Robust Cone Step Mapping. EGSR 2024.
 *
 * In each quadrant of texel p, sample v != p limits the cone if one of the four edges of the cell
 * on v's outward side falls outwards: v to its two outward neighbours, and these to the far corner.
 * Where none falls the surface does not fall along any ray away from p, so a ray of the cone that
 * has entered it stays inside. Whether v limits depends on v and on the quadrant's direction, not
 * on p: each quadrant has a pyramid of its own limiting samples, made when its turn comes. At a
 * border the cell goes on with the edge value, or with the other side where it wraps; then v is
 * taken at its nearest image within the quadrant. */
#include "quadrant_search.h"

#include "base/parallel.h"

#include <stdlib.h>

enum { QUADRANTS = 4 };

typedef struct falling {
    hc_quadrant_search search;
    int                quadrant;
} falling;

/* Below every height: never rises over anything. */
static const float no_limit = -1.0F;

static int outward(int place, int side, bool wraps, bool backwards)
{
    if (backwards) {
        return place > 0 ? place - 1 : wraps ? side - 1 : 0;
    }
    return place < side - 1 ? place + 1 : wraps ? 0 : side - 1;
}

static void keep_limiting(float *limiting, const hc_cone_job *job, int y, int quadrant)
{
    const bool   leftwards = (quadrant & 1) != 0;
    const size_t width     = (size_t)job->width;
    const int    beyond    = outward(y, job->height, job->wrap_v, (quadrant & 2) != 0);
    const float *row       = job->heights + (size_t)y * width;
    const float *next      = job->heights + (size_t)beyond * width;
    for (int x = 0; x < job->width; x++) {
        const int  out = outward(x, job->width, job->wrap_u, leftwards);
        const bool falls =
            row[x] > row[out] || row[x] > next[x] || row[out] > next[out] || next[x] > next[out];
        limiting[(size_t)y * width + (size_t)x] = falls ? row[x] : no_limit;
    }
}

/* The ratios hold the largest steepness so far until the last quadrant is done. */
static void search_row(void *context, int y, int worker)
{
    (void)worker;
    const falling *self  = context;
    const int      width = self->search.job->width;
    float         *known = self->search.job->ratios + (size_t)y * (size_t)width;
    for (int x = 0; x < width; x++) {
        const float       before = self->quadrant > 0 ? known[x] : 0.0F;
        const hc_steepest best =
            hc_search_quadrant(&self->search, x, y, self->quadrant, hc_steepest_of(true, before));
        known[x] = self->quadrant < QUADRANTS - 1 ? best.value : hc_ratio(best.value);
    }
}

/* Only samples of the quadrant's pyramid come here: they limit. */
static hc_steepest judge(const void *context, int x, int y, int column, int row, hc_steepest best)
{
    const falling     *self   = context;
    const hc_cone_job *job    = self->search.job;
    const size_t       width  = (size_t)job->width;
    const int          at_x   = (x + column + job->width) % job->width;
    const int          at_y   = (y + row + job->height) % job->height;
    const float        height = job->heights[(size_t)y * width + (size_t)x];
    const float        limit  = job->heights[(size_t)at_y * width + (size_t)at_x];
    const float reach = hc_reach(true, column, job->step_u) + hc_reach(true, row, job->step_v);
    return hc_steeper(true, limit - height, reach, best);
}

/* A quarter of the caller's progress. */
static bool report_quarter(void *user, double fraction)
{
    falling          *self  = user;
    const hc_progress outer = self->search.job->progress;
    return outer.report(outer.user, (self->quadrant + fraction) / QUADRANTS);
}

static hc_result search_quadrants(falling *self)
{
    const hc_cone_job *job      = self->search.job;
    const hc_progress  progress = { job->progress.report != NULL ? report_quarter : NULL, self };
    hc_result          result   = HC_OK;
    for (int quadrant = 0; result == HC_OK && quadrant < QUADRANTS; quadrant++) {
        self->quadrant = quadrant;
        for (int y = 0; y < job->height; y++) {
            keep_limiting(self->search.highest.values, job, y, quadrant);
        }
        hc_highest_fill(&self->search.highest, self->search.highest.values);
        result = hc_parallel_for(job->height, job->threads, search_row, self, progress, job->log);
    }
    return result;
}

hc_result hc_cone_falling_edge(const hc_cone_job *job)
{
    falling self        = { .search = { .job   = job,
                                        .limit = { job->width - 1, job->width - 1, job->height - 1,
                                                   job->height - 1 },
                                        .judge = judge } };
    self.search.context = &self;
    hc_result result = hc_highest_allocate(&self.search.highest, job->width, job->height, job->log);
    if (result == HC_OK) {
        result = search_quadrants(&self);
    }
    free(self.search.highest.values);
    return result;
}
