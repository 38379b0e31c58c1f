/* Cone ratios by expanding squares with an early exit.
 * After: Dummer. Cone Step Mapping: An Iterative Ray-Heightfield Intersection Algorithm. 2006,
 * section "The Preprocessor". Its scan of wrapped borders leaves out what lies past a corner, and
 * its exit tests the radius against the best cone with a factor of 1.1; here every sample is seen
 * at its nearest image, and the exit is exact.
 *
 * Why the exit misses nothing: all samples at radius r or beyond have a column distance >= r or a
 * row distance >= r, so a reach of at least the smaller of the two axes' reaches at r (an axis that
 * ends before r drops out), and none rises more than 1 - h. What hc_may_be_steeper denies for that
 * rise and reach it denies for all of them. */
#include "cone_job.h"
#include "steeper.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <stdlib.h>

/* The samples along one axis as a texel sees them: each at one offset, its nearest image's. */
typedef struct axis {
    int    side;
    bool   wraps;
    float *store;
    float *reach; /* by offset, -(side - 1) .. side - 1 */
} axis;

typedef struct ring {
    const hc_cone_job *job;
    axis               u, v;
} ring;

/* Offsets from one texel: first .. last along an axis. */
typedef struct offsets {
    int first, last;
} offsets;

static hc_result make_axis(axis *made, int side, bool wraps, float step, bool l2, hc_log *log)
{
    *made       = (axis){ .side = side, .wraps = wraps };
    made->store = malloc(sizeof(float) * (2 * (size_t)side - 1));
    if (made->store == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for the distances of %d samples", side);
    }
    made->reach = made->store + (side - 1);
    for (int i = 0; i < side; i++) {
        made->reach[i] = made->reach[-i] = hc_reach(l2, i, step);
    }
    return HC_OK;
}

static offsets offsets_from(const axis *along, int place)
{
    return along->wraps ? (offsets){ -((along->side - 1) / 2), along->side / 2 }
                        : (offsets){ -place, along->side - 1 - place };
}

static bool holds(offsets range, int offset)
{
    return offset >= range.first && offset <= range.last;
}

static offsets clipped(offsets range, int radius)
{
    return (offsets){ range.first > -radius ? range.first : -radius,
                      range.last < radius ? range.last : radius };
}

static int index_at(const axis *along, int place, int offset)
{
    const int index = place + offset;
    return index < 0 ? index + along->side : index >= along->side ? index - along->side : index;
}

/* The steepest of `best` and a line of samples: `places` along one axis, `across` fixed on the
 * other. Runs end where the line passes the border and goes on at the other side. */
static inline hc_steepest scan(const axis *along, int place, offsets run, const float *line,
                               ptrdiff_t stride, float across, float height, bool l2,
                               hc_steepest best)
{
    int offset = run.first;
    while (offset <= run.last) {
        const int    index = index_at(along, place, offset);
        const int    fits  = offset + (along->side - 1 - index);
        const int    last  = fits < run.last ? fits : run.last;
        const float *at    = line + index * stride;
        for (; offset <= last; offset++, at += stride) {
            best = hc_steeper(l2, *at - height, along->reach[offset] + across, best);
        }
    }
    return best;
}

static inline hc_steepest scan_square(const ring *self, int x, int y, offsets columns, offsets rows,
                                      int radius, bool l2, hc_steepest best)
{
    const float    *heights = self->job->heights;
    const ptrdiff_t width   = self->job->width;
    const float     height  = heights[y * width + x];
    const offsets   inner   = clipped(rows, radius - 1); /* the rows' runs have the corners */
    const offsets   outer   = clipped(columns, radius);
    for (int side = -radius; side <= radius; side += 2 * radius) {
        if (holds(columns, side)) {
            const float *line = heights + index_at(&self->u, x, side);
            best = scan(&self->v, y, inner, line, width, self->u.reach[side], height, l2, best);
        }
    }
    for (int side = -radius; side <= radius; side += 2 * radius) {
        if (holds(rows, side)) {
            const float *line = heights + index_at(&self->v, y, side) * width;
            best = scan(&self->u, x, outer, line, 1, self->v.reach[side], height, l2, best);
        }
    }
    return best;
}

static int farthest(offsets range)
{
    return range.last > -range.first ? range.last : -range.first;
}

static inline hc_steepest steepest(const ring *self, int x, int y, bool l2)
{
    const float   headroom = 1.0F - self->job->heights[(ptrdiff_t)y * self->job->width + x];
    const offsets columns  = offsets_from(&self->u, x);
    const offsets rows     = offsets_from(&self->v, y);
    hc_steepest   best     = { 0.0F, 0.0F };
    for (int radius = 1; headroom > 0.0F; radius++) {
        const float reach_u = radius <= farthest(columns) ? self->u.reach[radius] : INFINITY;
        const float reach_v = radius <= farthest(rows) ? self->v.reach[radius] : INFINITY;
        if (!hc_may_be_steeper(l2, headroom, reach_u < reach_v ? reach_u : reach_v, best)) {
            break;
        }
        best = scan_square(self, x, y, columns, rows, radius, l2, best);
    }
    return best;
}

static void bake_row(void *context, int y, int worker)
{
    (void)worker;
    const ring *self   = context;
    const int   width  = self->job->width;
    float      *ratios = self->job->ratios + (ptrdiff_t)y * width;
    for (int x = 0; x < width; x++) {
        const hc_steepest best = self->job->cones == HC_CONES_L2 ? steepest(self, x, y, true)
                                                                 : steepest(self, x, y, false);
        ratios[x]              = hc_ratio(best.value);
    }
}

hc_result hc_cone_ring(const hc_cone_job *job)
{
    ring       self   = { .job = job };
    const bool l2     = job->cones == HC_CONES_L2;
    hc_result  result = make_axis(&self.u, job->width, job->wrap_u, job->step_u, l2, job->log);
    if (result == HC_OK) {
        result = make_axis(&self.v, job->height, job->wrap_v, job->step_v, l2, job->log);
    }
    if (result == HC_OK) {
        result =
            hc_parallel_for(job->height, job->threads, bake_row, &self, job->progress, job->log);
    }
    free(self.u.store);
    free(self.v.store);
    return result;
}
