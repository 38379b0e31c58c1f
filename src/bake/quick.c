/* Quick cone maps: the 3 x 3 blocks around a texel on every level of a max pyramid.
 * After: Quick Cone Map Generation, 2022, section 3, algorithms 1 (naive) and 2 (improved) and the
 * texel centre heuristic. Extended to any size, to borders that wrap, to quadrants and to
 * elongated diamonds.
 *
 * Texel x lies in block b of level k; the blocks b - 1, b, b + 1 are looked at, per axis, those
 * beyond a wrapped border as images shifted by the period. What they cover, from the first sample
 * to the last, is what level k leaves visited; level 0 starts with texel x alone. A sample of a
 * block is unvisited if its column or its row is outside the visited interval of its axis, so the
 * nearest unvisited one is at
 *     min(out_u + full_v, full_u + out_v)
 * with `full` the reach to the block's interval on one axis and `out` the reach to its part
 * outside the visited interval (infinite if there is none). Each depends on one coordinate only
 * and is computed once for a tile's columns and once for its rows.
 *
 * Never wider than brute force: the visited intervals grow from level to level, and on the last
 * level, one block, they are the whole axis, with both its neighbouring images if it wraps. So
 * each sample's nearest image (the nearest in each quadrant too) is unvisited in exactly one step;
 * there the block's maximum is no lower and its nearest unvisited sample no farther, and the
 * canonical steepness is monotone in both, rounding included.
 *
 * Odd sizes: a level's last block may have three children, one of which can be beyond the visited
 * two. Then the block in the middle counts too, with its unvisited part, in the naive variant as
 * well. The paper's textures are powers of two and have no such part.
 *
 * Centres, where the paper leaves room: the naive variant measures to the middle of the block's
 * interval on each axis, the improved one to the middle of the interval's unvisited part, or of all
 * of it on an axis where everything is visited. So a corner block, whose unvisited part is an L, is
 * measured to the middle of the rectangle beyond both inner edges. */
#include "cone_job.h"
#include "highest.h"
#include "span.h"
#include "steeper.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <stdlib.h>

enum { TILE = 128, BLOCKS_MAX = 3, SIDES_MAX = 2 };

/* Where a texel's three blocks (in a quadrant: two) of one level lie on one axis. */
typedef struct beside {
    float full[BLOCKS_MAX];
    float out[BLOCKS_MAX];
    float onwards; /* least `out` of this level and all coarser ones */
    int   block[BLOCKS_MAX];
} beside;

/* Which samples count: all, or those from the texel on in one direction. */
typedef enum side { BOTH = 0, UPWARDS, DOWNWARDS } side;

typedef struct axis {
    int   size;
    bool  wraps;
    float half_step; /* reaches are taken in halves, for the middles of even intervals */
} axis;

typedef struct quick {
    const hc_cone_job *job;
    axis               u, v;
    bool               improved, centre;
    int                sides, blocks; /* directions of an axis to look in, blocks for each */
    hc_highest         highest;
    float              top;
    beside            *scratch; /* per worker: TILE columns and one row */
} quick;

/* The part of `s` beyond `visited`; there is only one, for both are intervals and `visited` reaches
 * beyond the middle of `s` or its end. */
static hc_span beyond(hc_span s, hc_span visited)
{
    if (s.first < visited.first) {
        return hc_span_common(s, (hc_span){ s.first, visited.first - 1 });
    }
    return hc_span_common(s, (hc_span){ visited.last + 1, s.last });
}

/* Samples of a block; indices -1 and `count` are the images across a wrapped border. */
static hc_span image_samples(const axis *along, int level, int block)
{
    const int     count = hc_level_side(along->size, level);
    const int     shift = block < 0 ? -along->size : block >= count ? along->size : 0;
    const hc_span own   = hc_block_samples(along->size, level, (block + count) % count);
    return (hc_span){ own.first + shift, own.last + shift };
}

static bool exists(const axis *along, int level, int block)
{
    return along->wraps || (block >= 0 && block < hc_level_side(along->size, level));
}

static hc_span visited_after(const axis *along, int level, int place)
{
    const int     block = hc_block_above(along->size, level, place);
    const int     first = exists(along, level, block - 1) ? block - 1 : block;
    const int     last  = exists(along, level, block + 1) ? block + 1 : block;
    const hc_span low   = image_samples(along, level, first);
    const hc_span high  = image_samples(along, level, last);
    return (hc_span){ low.first, high.last };
}

/* Halves of a sample distance from `place` to an interval: to its nearest sample or its middle. */
static int halves_to(hc_span s, int place, bool centre)
{
    if (centre) {
        return abs(s.first + s.last - 2 * place);
    }
    return 2 * (s.first > place ? s.first - place : s.last < place ? place - s.last : 0);
}

static float reach_to(const quick *self, const axis *along, hc_span s, int place)
{
    if (hc_span_empty(s)) {
        return INFINITY;
    }
    const bool l2 = self->job->cones == HC_CONES_L2;
    return hc_reach(l2, halves_to(s, place, self->centre), along->half_step);
}

/* One block: `slot` of `made`, `offset` blocks away. */
static void measure(const quick *self, const axis *along, int level, int place, int offset,
                    side looking, beside *made, int slot)
{
    const int block   = hc_block_above(along->size, level, place);
    made->block[slot] = block;
    made->full[slot] = made->out[slot] = INFINITY;
    if (!exists(along, level, block + offset)) {
        return;
    }
    const hc_span seen = { looking == UPWARDS ? place : -2 * along->size,
                           looking == DOWNWARDS ? place : 3 * along->size };
    const hc_span whole = hc_span_common(image_samples(along, level, block + offset), seen);
    const hc_span visited =
        level > 0 ? visited_after(along, level - 1, place) : (hc_span){ place, place };
    const hc_span left  = beyond(whole, visited);
    const int     count = hc_level_side(along->size, level);
    made->block[slot]   = (block + offset + count) % count;
    made->out[slot]     = reach_to(self, along, left, place);
    made->full[slot]    = reach_to(self, along, whole, place);
    if (!self->improved && offset != 0) {
        made->out[slot] = made->full[slot];
    } else if (self->improved && self->centre && !hc_span_empty(left)) {
        made->full[slot] = made->out[slot];
    }
}

/* All levels of one coordinate in one direction. */
static void measure_levels(const quick *self, const axis *along, int place, side looking,
                           beside *made)
{
    const int first = looking == UPWARDS ? 0 : -1;
    float     least = INFINITY;
    for (int level = self->highest.levels - 1; level >= 0; level--) {
        for (int slot = 0; slot < self->blocks; slot++) {
            measure(self, along, level, place, first + slot, looking, &made[level], slot);
            least = made[level].out[slot] < least ? made[level].out[slot] : least;
        }
        made[level].onwards = least;
    }
}

/* All directions of one coordinate: `sides` times `levels` entries. */
static void measure_place(const quick *self, const axis *along, int place, beside *made)
{
    if (self->sides == 1) {
        measure_levels(self, along, place, BOTH, made);
        return;
    }
    measure_levels(self, along, place, UPWARDS, made);
    measure_levels(self, along, place, DOWNWARDS, made + self->highest.levels);
}

static float lesser(float a, float b)
{
    return a < b ? a : b;
}

/* Steepest of all blocks by one metric, the axes' reaches scaled (by powers of two, which is
 * exact). Levels that cannot matter are left out, which changes no result. */
static inline float steepest(const quick *self, const beside *u, const beside *v, float height,
                             int blocks, bool l2, float scale_u, float scale_v)
{
    const float headroom = self->top - height;
    hc_steepest best     = { 0.0F, 0.0F };
    for (int k = 0; k < self->highest.levels && headroom > 0.0F; k++, u++, v++) {
        const float onwards = lesser(u->onwards * scale_u, v->onwards * scale_v);
        if (!hc_may_be_steeper(l2, headroom, onwards, best)) {
            break;
        }
        const size_t width = (size_t)hc_level_side(self->u.size, k);
        for (int r = 0; r < blocks; r++) {
            const float *row    = self->highest.level[k] + (size_t)v->block[r] * width;
            const float  full_v = v->full[r] * scale_v;
            const float  out_v  = v->out[r] * scale_v;
            for (int c = 0; c < blocks; c++) {
                const float rise = row[u->block[c]] - height;
                const float reach =
                    lesser(u->out[c] * scale_u + full_v, u->full[c] * scale_u + out_v);
                best = hc_steeper(l2, rise, reach, best);
            }
        }
    }
    return best.value;
}

static void bake_texel(const quick *self, const beside *u, const beside *v, float height,
                       float *ratios)
{
    const int levels = self->highest.levels;
    float     best[HC_ANISO_COUNT];
    switch (self->job->cones) {
    case HC_CONES_L2:
        ratios[0] = hc_ratio(steepest(self, u, v, height, BLOCKS_MAX, true, 1.0F, 1.0F));
        break;
    case HC_CONES_L1:
        ratios[0] = hc_ratio(steepest(self, u, v, height, BLOCKS_MAX, false, 1.0F, 1.0F));
        break;
    case HC_CONES_QUAD:
        for (int quadrant = 0; quadrant < 4; quadrant++) {
            const beside *across = u + (quadrant & 1) * levels;
            const beside *down   = v + (quadrant >> 1) * levels;
            ratios[quadrant] =
                hc_ratio(steepest(self, across, down, height, BLOCKS_MAX - 1, false, 1.0F, 1.0F));
        }
        break;
    case HC_CONES_ANISO:
        for (int a = 0; a < HC_ANISO_COUNT; a++) {
            const float wide = hc_aniso_elongation[a];
            best[a]          = steepest(self, u, v, height, BLOCKS_MAX, false, wide, 1.0F / wide);
        }
        hc_aniso_choose(ratios, best);
        break;
    }
}

static int tiles(int size)
{
    return (size + TILE - 1) / TILE;
}

static void bake_tile(void *context, int item, int worker)
{
    const quick       *self   = context;
    const hc_cone_job *job    = self->job;
    const int          across = tiles(job->width);
    const int          x0     = item % across * TILE;
    const int          y0     = item / across * TILE;
    const int          x1     = x0 + TILE < job->width ? x0 + TILE : job->width;
    const int          y1     = y0 + TILE < job->height ? y0 + TILE : job->height;
    const int          each   = self->sides * self->highest.levels;
    beside            *rows   = self->scratch + (size_t)worker * (TILE + 1) * (size_t)each;
    beside            *cols   = rows + each;
    for (int x = x0; x < x1; x++) {
        measure_place(self, &self->u, x, cols + (x - x0) * each);
    }
    for (int y = y0; y < y1; y++) {
        measure_place(self, &self->v, y, rows);
        for (int x = x0; x < x1; x++) {
            const size_t texel = (size_t)y * (size_t)job->width + (size_t)x;
            bake_texel(self, cols + (x - x0) * each, rows, job->heights[texel],
                       job->ratios + texel * (size_t)job->channels);
        }
    }
}

/* With the pyramid allocated: the rest of the memory, and the search itself. */
static hc_result bake_all(quick *self)
{
    const hc_cone_job *job  = self->job;
    const size_t       each = (size_t)(self->sides * self->highest.levels);
    self->scratch           = malloc(sizeof(beside) * (TILE + 1) * each * (size_t)job->threads);
    if (self->scratch == NULL) {
        return hc_fail(job->log, HC_ERROR_MEMORY, "no memory for %d threads", job->threads);
    }
    hc_highest_fill(&self->highest, job->heights);
    self->top             = *self->highest.level[self->highest.levels - 1];
    const int       items = tiles(job->width) * tiles(job->height);
    const hc_result result =
        hc_parallel_for(items, job->threads, bake_tile, self, job->progress, job->log);
    free(self->scratch);
    return result;
}

hc_result hc_cone_quick(const hc_cone_job *job, bool improved, bool centre)
{
    const bool quad   = job->cones == HC_CONES_QUAD;
    quick      self   = { .job      = job,
                          .u        = { job->width, job->wrap_u, 0.5F * job->step_u },
                          .v        = { job->height, job->wrap_v, 0.5F * job->step_v },
                          .improved = improved,
                          .centre   = centre,
                          .sides    = quad ? SIDES_MAX : 1,
                          .blocks   = quad ? BLOCKS_MAX - 1 : BLOCKS_MAX };
    hc_result  result = hc_highest_allocate(&self.highest, job->width, job->height, job->log);
    if (result == HC_OK) {
        result = bake_all(&self);
    }
    free(self.highest.values);
    return result;
}
