/* Depth first through a max pyramid, nearest child first. A block whose maximum, put at the
 * block's nearest sample in the quadrant, cannot be steeper than the best is left out. */
#include "quadrant_search.h"

#include "span.h"

/* One texel's view of one image of the field: shifted by a period along the wrapped axes. */
typedef struct view {
    const hc_quadrant_search *search;
    int                       x, y;
    int                       shift_u, shift_v;
    bool                      leftwards, upwards;
    hc_span                   columns, rows; /* of the quadrant, in the texel's image */
    float                     height;
} view;

static hc_span shifted(hc_span samples, int by)
{
    return (hc_span){ samples.first + by, samples.last + by };
}

/* Offset of the sample of `seen` that is nearest to `place`, which is not inside it but at an end
 * or beyond. */
static int nearest(hc_span seen, int place, bool backwards)
{
    return (backwards ? seen.last : seen.first) - place;
}

static hc_steepest visit(const view *self, int level, int block_u, int block_v, hc_steepest best);

static hc_steepest visit_children(const view *self, int level, int block_u, int block_v,
                                  hc_steepest best)
{
    const hc_highest *highest = &self->search->highest;
    const hc_span     across  = hc_block_children(highest->width, level, block_u);
    const hc_span     down    = hc_block_children(highest->height, level, block_v);
    const int         wide    = across.last - across.first;
    const int         tall    = down.last - down.first;
    for (int j = 0; j <= tall; j++) {
        const int child_v = self->upwards ? down.last - j : down.first + j;
        for (int i = 0; i <= wide; i++) {
            const int child_u = self->leftwards ? across.last - i : across.first + i;
            best              = visit(self, level - 1, child_u, child_v, best);
        }
    }
    return best;
}

static hc_steepest visit(const view *self, int level, int block_u, int block_v, hc_steepest best)
{
    const hc_quadrant_search *search  = self->search;
    const hc_highest         *highest = &search->highest;
    const hc_span             u       = hc_block_samples(highest->width, level, block_u);
    const hc_span             v       = hc_block_samples(highest->height, level, block_v);
    const hc_span             columns = hc_span_common(shifted(u, self->shift_u), self->columns);
    const hc_span             rows    = hc_span_common(shifted(v, self->shift_v), self->rows);
    if (hc_span_empty(columns) || hc_span_empty(rows)) {
        return best;
    }
    const size_t width  = (size_t)hc_level_side(highest->width, level);
    const float  top    = highest->level[level][(size_t)block_v * width + (size_t)block_u];
    const float  rise   = top - self->height;
    const int    column = nearest(columns, self->x, self->leftwards);
    const int    row    = nearest(rows, self->y, self->upwards);
    const float  reach =
        hc_reach(true, column, search->job->step_u) + hc_reach(true, row, search->job->step_v);
    if (rise <= 0.0F || !hc_may_be_steeper(true, rise, reach, best)) {
        return best;
    }
    return level > 0 ? visit_children(self, level, block_u, block_v, best)
                     : search->judge(search->context, self->x, self->y, column, row, best);
}

hc_steepest hc_search_quadrant(const hc_quadrant_search *search, int x, int y, int quadrant,
                               hc_steepest best)
{
    const hc_cone_job *job       = search->job;
    const bool         leftwards = (quadrant & 1) != 0;
    const bool         upwards   = (quadrant & 2) != 0;
    const float        height    = job->heights[(size_t)y * (size_t)job->width + (size_t)x];
    view               self      = { .search    = search,
                                     .x         = x,
                                     .y         = y,
                                     .leftwards = leftwards,
                                     .upwards   = upwards,
                                     .height    = height };
    self.columns =
        leftwards ? (hc_span){ x - search->limit[1], x } : (hc_span){ x, x + search->limit[0] };
    self.rows =
        upwards ? (hc_span){ y - search->limit[3], y } : (hc_span){ y, y + search->limit[2] };
    const int period_u = leftwards ? -job->width : job->width;
    const int period_v = upwards ? -job->height : job->height;
    for (int j = 0; j <= (job->wrap_v ? 1 : 0); j++) {
        for (int i = 0; i <= (job->wrap_u ? 1 : 0); i++) {
            self.shift_u = i * period_u;
            self.shift_v = j * period_v;
            best         = visit(&self, search->highest.levels - 1, 0, 0, best);
        }
    }
    return best;
}
