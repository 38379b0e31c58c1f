/* Blocks of the fast caster: bounds and quadrant slopes on every level, in O(N) after the pyramid.
 *
 * A diagonal of a quadrant is the set of blocks i to the side and j ahead with i + j the same; the
 * maximum over a diagonal, over its least distance, bounds the slope of what stands on it. Ten
 * diagonals are looked at on each level, what lies beyond them is the next level's, corrected for
 * the difference of the tops. docs/algorithms.md has the distances. */
#include "fast_data.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIAGONALS = 10, TILE = 64, BASE = 1 << HC_FAST_BASE_BITS, RATIO = 1 << HC_FAST_RATIO_BITS };

/* Least height that marching keeps above a block: more than its rounding [height]. */
static const float CLEARANCE = 0x1p-20F;

/* A level while it is made. Tops stand in a frame of zeros DIAGONALS wide, and a tile more at the
 * right. */
typedef struct level {
    int            width, height, side; /* blocks; cells a side */
    size_t         pitch;
    float         *frame, *tops;
    float         *edges; /* four frames, on sparse ground: what stands a cell behind each side */
    float         *far;   /* four slopes a block: of what lies beyond the first diagonal */
    hc_fast_block *blocks;
} level;

typedef struct builder {
    const hc_fast *fast;
    const float   *heights; /* of the field */
    int            field_width;
    level          levels[HC_FAST_LEVELS];
    float         *steepest; /* of each row of cells: largest difference of neighbouring samples */
    int           *stops;    /* of each row of the finest blocks: stop_free's count */
    float          stray;    /* by which the surface may rise on thrice the blur */
    int            current;
    bool           sparse;
} builder;

static float larger(float a, float b)
{
    return a > b ? a : b;
}

static int sample_of(const hc_fast_axis *axis, int corner)
{
    const int sample = corner + axis->first;
    if (axis->wrapped) {
        return sample % axis->samples;
    }
    return sample < 0 ? 0 : sample < axis->samples ? sample : axis->samples - 1;
}

static void copy_heights(void *context, int y, int worker)
{
    const builder *b       = context;
    const hc_fast *fast    = b->fast;
    const size_t   width   = (size_t)b->field_width;
    const float   *from    = b->heights + (size_t)sample_of(&fast->y, y) * width;
    const float   *below   = b->heights + (size_t)sample_of(&fast->y, y + 1) * width;
    float         *to      = fast->heights + hc_fast_corner(fast, 0, y);
    float          largest = 0.0F;
    (void)worker;
    for (int x = 0; x <= fast->x.cells; x++) {
        const int i                  = sample_of(&fast->x, x);
        const int next               = sample_of(&fast->x, x + 1);
        to[x << HC_FAST_HEIGHT_BITS] = from[i];
        largest = larger(largest, larger(fabsf(below[i] - from[i]), fabsf(from[next] - from[i])));
    }
    b->steepest[y] = largest;
}

/* Tops of blocks of the finest level, from their cells' corners; on steps, from their samples. */
static void top_cells(void *context, int y, int worker)
{
    const builder *b     = context;
    const hc_fast *fast  = b->fast;
    const int      side  = fast->steps ? 0 : 1;
    const int      above = y * BASE;
    const int      last  = hc_fast_lesser(above + BASE, fast->y.cells);
    float         *tops  = b->levels[0].tops + (size_t)y * b->levels[0].pitch;
    (void)worker;
    for (int j = above; j < last + side; j++) {
        const float *row = fast->heights + hc_fast_corner(fast, 0, j);
        for (int x = 0; x < fast->x.cells; x++) {
            const float left  = row[x << HC_FAST_HEIGHT_BITS];
            const float right = row[(x + side) << HC_FAST_HEIGHT_BITS];
            tops[x / BASE]    = larger(tops[x / BASE], larger(left, right));
        }
    }
}

static void top_blocks(void *context, int y, int worker)
{
    const builder *b      = context;
    const level   *fine   = &b->levels[b->current - 1];
    const level   *coarse = &b->levels[b->current];
    float         *tops   = coarse->tops + (size_t)y * coarse->pitch;
    const int      rows   = hc_fast_lesser(fine->height - y * RATIO, RATIO);
    (void)worker;
    for (int x = 0; x < coarse->width; x++) {
        float top = 0.0F;
        for (int j = 0; j < rows; j++) {
            const float *row = fine->tops + (size_t)(y * RATIO + j) * fine->pitch + x * RATIO;
            top              = larger(top, larger(larger(row[0], row[1]), larger(row[2], row[3])));
        }
        tops[x] = top;
    }
}

/* ---- edges ----------------------------------------------------------------------------------- */

/* Sides of blocks. What a ray meets that strays over one of them lies between the samples on it,
 * which are the neighbour's as well, and those a cell behind it. */
enum { LEFT, RIGHT, ABOVE, BELOW, SIDES };

static size_t frame_size(const level *l)
{
    return l->pitch * (size_t)(l->height + 2 * DIAGONALS + 1);
}

static float *edge_of(const level *l, int side, int x, int y)
{
    const ptrdiff_t row = (ptrdiff_t)y * (ptrdiff_t)l->pitch;
    return l->edges + (size_t)side * frame_size(l) + (l->tops - l->frame) + row + x;
}

/* In the finest blocks what stands a cell behind one side stands as far behind the other. */
static void edge_cells(void *context, int y, int worker)
{
    const builder *b    = context;
    const hc_fast *fast = b->fast;
    const level   *l    = &b->levels[0];
    const int      last = hc_fast_lesser(y * BASE + BASE, fast->y.cells);
    (void)worker;
    for (int x = 0; x < l->width; x++) {
        const int end    = hc_fast_lesser(x * BASE + BASE, fast->x.cells);
        float     column = 0.0F;
        float     row    = 0.0F;
        for (int j = y * BASE; j <= last; j++) {
            column = larger(column, fast->heights[hc_fast_corner(fast, x * BASE + 1, j)]);
        }
        for (int i = x * BASE; i <= end; i++) {
            row = larger(row, fast->heights[hc_fast_corner(fast, i, y * BASE + 1)]);
        }
        *edge_of(l, LEFT, x, y)  = column;
        *edge_of(l, RIGHT, x, y) = column;
        *edge_of(l, ABOVE, x, y) = row;
        *edge_of(l, BELOW, x, y) = row;
    }
}

/* From those of the blocks along the side. */
static void edge_blocks(void *context, int y, int worker)
{
    const builder *b      = context;
    const level   *fine   = &b->levels[b->current - 1];
    const level   *coarse = &b->levels[b->current];
    const int      high   = hc_fast_lesser(fine->height - y * RATIO, RATIO);
    (void)worker;
    for (int x = 0; x < coarse->width; x++) {
        const int wide = hc_fast_lesser(fine->width - x * RATIO, RATIO);
        for (int side = 0; side < SIDES; side++) {
            const bool upright = side == LEFT || side == RIGHT;
            float      most    = 0.0F;
            for (int k = 0; k < (upright ? high : wide); k++) {
                const int i = upright ? (side == LEFT ? 0 : wide - 1) : k;
                const int j = upright ? k : (side == ABOVE ? 0 : high - 1);
                most        = larger(most, *edge_of(fine, side, x * RATIO + i, y * RATIO + j));
            }
            *edge_of(coarse, side, x, y) = most;
        }
    }
}

/* Beyond the ends of a repeating field everything may stand. */
static void close_ends(const hc_fast *fast, const level *l)
{
    for (int y = -1; fast->x.wrapped && y <= l->height; y++) {
        *edge_of(l, RIGHT, -1, y)      = 1.0F;
        *edge_of(l, LEFT, l->width, y) = 1.0F;
    }
    for (int x = -1; fast->y.wrapped && x <= l->width; x++) {
        *edge_of(l, BELOW, x, -1)        = 1.0F;
        *edge_of(l, ABOVE, x, l->height) = 1.0F;
    }
}

/* True if nothing up to a cell beyond the block is higher. */
static bool is_open(const level *l, int x, int y)
{
    float around = larger(*edge_of(l, BELOW, x, y - 1), *edge_of(l, ABOVE, x, y + 1));
    for (int j = y - 1; j <= y + 1; j++) {
        around = larger(around, *edge_of(l, RIGHT, x - 1, j));
        around = larger(around, *edge_of(l, LEFT, x + 1, j));
    }
    return around <= l->tops[(size_t)y * l->pitch + (size_t)x];
}

/* ---- slopes ---------------------------------------------------------------------------------- */

/* A quadrant as TILE blocks see it. `edges`, on sparse ground, are those of the two rows of blocks
 * beside it, so that no ray strays out of what is known. */
typedef struct view {
    const float *tops, *edges[2];
    ptrdiff_t    dx, dy;
    int          side;
} view;

static view view_from(const builder *b, const level *l, int x, int y, int quadrant)
{
    const bool back = (quadrant & 1) != 0;
    const bool up   = (quadrant & 2) != 0;
    view       v    = { .tops = l->tops + (size_t)y * l->pitch + x,
                        .dx   = back ? -1 : 1,
                        .dy   = up ? -(ptrdiff_t)l->pitch : (ptrdiff_t)l->pitch,
                        .side = l->side };
    if (b->sparse) {
        v.edges[0] = edge_of(l, back ? LEFT : RIGHT, back ? x + 1 : x - 1, y);
        v.edges[1] = edge_of(l, up ? ABOVE : BELOW, x, up ? y + 1 : y - 1);
    }
    return v;
}

static void keep_higher(float *highest, const float *row)
{
    for (int x = 0; x < TILE; x++) {
        highest[x] = larger(highest[x], row[x]);
    }
}

/* Highest on diagonal m of each of TILE blocks: tops[x + dx * i], i columns and m - i rows away. */
static void diagonal_top(float *highest, const view *v, int m)
{
    memcpy(highest, v->tops + v->dy * m, TILE * sizeof *highest);
    for (int i = 1; i <= m; i++) {
        keep_higher(highest, v->tops + v->dx * i + v->dy * (m - i));
    }
    if (v->edges[0] != NULL) {
        keep_higher(highest, v->edges[0] + v->dy * m);
        keep_higher(highest, v->edges[1] + v->dx * m);
    }
}

/* One more diagonal, after so many: is none so far higher than the block? */
static void count_open(float *ways, const float *highest, const float *tops, int after)
{
    const float before = (float)after;
    for (int x = 0; x < TILE; x++) {
        ways[x] += ways[x] == before && highest[x] <= tops[x] ? 1.0F : 0.0F;
    }
}

/* Steepest slope from each of TILE blocks to diagonals first .. DIAGONALS; a diagonal of blocks as
 * wide as `side` is at least (m - 2) * side + 2 cells away, and `least`. `ways`, unless NULL,
 * counts the diagonals from the first up to which none is higher than the block. */
static void near_slopes(float *slopes, float *ways, const view *v, int first, float least)
{
    float highest[TILE];
    memset(slopes, 0, TILE * sizeof *slopes);
    if (ways != NULL) {
        memset(ways, 0, TILE * sizeof *ways);
    }
    for (int m = first; m <= DIAGONALS; m++) {
        const float distance = larger((float)((m - 2) * v->side + 2), least);
        const float weight   = 1.0F / distance;
        diagonal_top(highest, v, m);
        for (int x = 0; x < TILE; x++) {
            slopes[x] = larger(slopes[x], (highest[x] - v->tops[x]) * weight);
        }
        if (ways != NULL) {
            count_open(ways, highest, v->tops, m - first);
        }
    }
}

/* What lies beyond the diagonals, from the next level: its slope there, steeper by the difference
 * of the tops over the least distance. */
static void add_far(float *slopes, const builder *b, int k, int x, int y, int quadrant, int count)
{
    if (k + 1 == b->fast->levels) {
        return;
    }
    const level *fine   = &b->levels[k];
    const level *coarse = &b->levels[k + 1];
    const float  weight = 1.0F / (float)((DIAGONALS - 1) * fine->side + 2);
    const float *tops   = fine->tops + (size_t)y * fine->pitch;
    const float *above  = coarse->tops + (size_t)(y / RATIO) * coarse->pitch;
    const float *far    = coarse->far + (size_t)(y / RATIO) * (size_t)coarse->width * 4;
    for (int i = 0; i < count; i++) {
        const int   parent = (x + i) / RATIO;
        const float slope  = far[4 * parent + quadrant] + (above[parent] - tops[x + i]) * weight;
        slopes[i]          = larger(slopes[i], slope);
    }
}

static int tile_count(const level *l, int x)
{
    return l->width - x < TILE ? l->width - x : TILE;
}

static void far_row(void *context, int y, int worker)
{
    const builder *b     = context;
    const level   *l     = &b->levels[b->current];
    const float    least = 0.75F * (float)l->side + 2.0F;
    float          slopes[TILE];
    (void)worker;
    for (int x = 0; x < l->width; x += TILE) {
        float    *out   = l->far + ((size_t)y * (size_t)l->width + (size_t)x) * 4;
        const int count = tile_count(l, x);
        for (int q = 0; q < 4; q++) {
            const view v = view_from(b, l, x, y, q);
            near_slopes(slopes, NULL, &v, 2, least);
            add_far(slopes, b, b->current, x, y, q, count);
            for (int i = 0; i < count; i++) {
                out[4 * i + q] = slopes[i];
            }
        }
    }
}

static float decode(bool sparse, uint8_t code)
{
    const uint32_t bits = sparse ? ((uint32_t)(code >> HC_FAST_FREE_BITS) << HC_FAST_SPARSE_SHIFT)
                                       + HC_FAST_SPARSE_BIAS
                                 : ((uint32_t)code << HC_FAST_SLOPE_SHIFT) + HC_FAST_SLOPE_BIAS;
    float          slope;
    memcpy(&slope, &bits, sizeof slope);
    return slope;
}

/* The least code whose slope is not below. */
static uint8_t encode(float slope, int shift, int bias, int most)
{
    const float padded = slope * (1.0F + 0x1p-12F);
    int32_t     bits;
    memcpy(&bits, &padded, sizeof bits);
    const int32_t above = bits - bias + (1 << shift) - 1;
    const int32_t code  = above < 0 ? 0 : above >> shift;
    return (uint8_t)(code > most ? most : code);
}

static uint8_t slope_of(const builder *b, int k, int x, int y, int quadrant)
{
    const size_t at =
        (size_t)quadrant * (size_t)b->fast->plane + hc_fast_block_at(b->fast, k, x, y);
    return (uint8_t)(b->levels[k].blocks[at] & HC_FAST_CODE);
}

/* Steepest of the blocks one level below that stand at the two sides facing the quadrant. */
static float child_slope(const builder *b, int k, int x, int y, int quadrant)
{
    const level *fine   = &b->levels[k - 1];
    const int    right  = (x + 1) * RATIO < fine->width ? (x + 1) * RATIO : fine->width;
    const int    below  = (y + 1) * RATIO < fine->height ? (y + 1) * RATIO : fine->height;
    const int    edge_x = (quadrant & 1) != 0 ? x * RATIO : right - 1;
    const int    edge_y = (quadrant & 2) != 0 ? y * RATIO : below - 1;
    uint8_t      code   = 0;
    for (int i = x * RATIO; i < right; i++) {
        const uint8_t c = slope_of(b, k - 1, i, edge_y, quadrant);
        code            = c > code ? c : code;
    }
    for (int j = y * RATIO; j < below; j++) {
        const uint8_t c = slope_of(b, k - 1, edge_x, j, quadrant);
        code            = c > code ? c : code;
    }
    return decode(b->sparse, code);
}

/* The lowest float of at least `top` that ends with `code`. */
static hc_fast_block join_block(float top, uint8_t code)
{
    uint32_t bits;
    memcpy(&bits, &top, sizeof bits);
    const uint32_t below = (bits & ~(uint32_t)HC_FAST_CODE) | code;
    return below < bits ? below + HC_FAST_CODE + 1 : below;
}

/* A ray may be up to three blurs from where it is marched: what stands there is seen with this
 * weight from any quadrant. */
static void store_block(const hc_fast *fast, hc_fast_block *block, float top, const float slopes[4])
{
    const float steepest = larger(larger(slopes[0], slopes[1]), larger(slopes[2], slopes[3]));
    const float bound    = top + 6.0F * fast->blur * steepest + CLEARANCE;
    for (int q = 0; q < 4; q++, block += fast->plane) {
        *block = join_block(bound, encode(slopes[q] + 3.0F * fast->blur * steepest,
                                          HC_FAST_SLOPE_SHIFT, HC_FAST_SLOPE_BIAS, HC_FAST_CODE));
    }
}

/* On sparse ground what stands next to a block, if it is higher, may be met with the steepest slope
 * of all. If nothing is, up to a cell away, whatever is higher stands two cells away. */
static void store_sparse(const builder *b, hc_fast_block *block, float top, bool open,
                         const float slopes[4], const float ways[4])
{
    const hc_fast *fast     = b->fast;
    const float    steepest = larger(larger(slopes[0], slopes[1]), larger(slopes[2], slopes[3]));
    const float    wide     = 3.0F * fast->blur;
    const float    bound    = top + (open ? fast->least : b->stray);
    for (int q = 0; q < 4; q++, block += fast->plane) {
        const float   slope = open ? slopes[q] * (1.0F + wide) : slopes[q] + wide * steepest;
        const uint8_t code  = encode(slope, HC_FAST_SPARSE_SHIFT, HC_FAST_SPARSE_BIAS, 15);
        *block = join_block(bound, (uint8_t)(code << HC_FAST_FREE_BITS | (int)ways[q]));
    }
}

/* Blocks with something high behind a wide free way: there cones are narrow, and the way is not. */
static int stop_free(const builder *b, const float *slopes, const float *ways, int count)
{
    const float high  = 0.25F * (float)b->fast->highest;
    int         stops = 0;
    for (int i = 0; i < count; i++) {
        stops += ways[i] >= 3.0F && slopes[i] * (ways[i] * BASE) >= high;
    }
    return stops;
}

/* One more block at the end of a row, and one more row. */
static void close_row(const builder *b, int y, hc_fast_block *row)
{
    const level *l                      = &b->levels[b->current];
    row[l->width << HC_FAST_BLOCK_BITS] = row[(l->width - 1) << HC_FAST_BLOCK_BITS];
    if (y == l->height - 1) {
        hc_fast_block *more = row + hc_fast_block_at(b->fast, b->current, 0, y + 1)
                              - hc_fast_block_at(b->fast, b->current, 0, y);
        for (int x = 0; x <= l->width; x++) {
            more[x << HC_FAST_BLOCK_BITS] = row[x << HC_FAST_BLOCK_BITS];
        }
    }
}

static void block_row(void *context, int y, int worker)
{
    const builder *b               = context;
    const int      k               = b->current;
    const level   *l               = &b->levels[k];
    float          slopes[4][TILE] = { { 0.0F } };
    float          ways[4][TILE]   = { { 0.0F } };
    int            stops           = 0;
    hc_fast_block *row             = l->blocks + hc_fast_block_at(b->fast, k, 0, y);
    (void)worker;
    for (int x = 0; x < l->width; x += TILE) {
        const float *tops  = l->tops + (size_t)y * l->pitch + x;
        const int    count = tile_count(l, x);
        for (int q = 0; q < 4 && !b->fast->steps; q++) {
            const view   v    = view_from(b, l, x, y, q);
            float *const open = k == 0 || b->sparse ? ways[q] : NULL;
            near_slopes(slopes[q], open, &v, 1, 1.0F);
            add_far(slopes[q], b, k, x, y, q, count);
            stops += k == 0 ? stop_free(b, slopes[q], ways[q], count) : 0;
        }
        for (int i = 0; i < count; i++) {
            float       slope[4];
            const float way[4] = { ways[0][i], ways[1][i], ways[2][i], ways[3][i] };
            for (int q = 0; q < 4; q++) {
                const float child = k == 0 ? slopes[q][i] : child_slope(b, k, x + i, y, q);
                slope[q]          = child < slopes[q][i] ? child : slopes[q][i];
            }
            hc_fast_block *const block = &row[(x + i) << HC_FAST_BLOCK_BITS];
            if (b->sparse) {
                store_sparse(b, block, tops[i], is_open(l, x + i, y), slope, way);
            } else {
                store_block(b->fast, block, tops[i], slope);
            }
        }
    }
    for (int q = 0; q < 4; q++, row += b->fast->plane) {
        close_row(b, y, row);
    }
    if (k == 0) {
        b->stops[y] = stops;
    }
}

static hc_result run(builder *b, int k, hc_parallel_body body, int rows, int threads, hc_log *log)
{
    b->current = k;
    return hc_parallel_for(rows, threads, body, b, (hc_progress){ 0 }, log);
}

static float steepest_of(const builder *b)
{
    float steepest = 0.0F;
    for (int y = 0; y <= b->fast->y.cells; y++) {
        steepest = larger(steepest, b->steepest[y]);
    }
    return steepest;
}

/* Ground is sparse if a quarter of the ways over it are free and then stopped. */
static bool is_sparse(const builder *b)
{
    const level *l     = &b->levels[0];
    size_t       stops = 0;
    for (int y = 0; y < l->height; y++) {
        stops += (size_t)b->stops[y];
    }
    return stops >= (size_t)l->width * (size_t)l->height;
}

static void see_far(builder *b, int threads, hc_log *log)
{
    for (int k = b->fast->levels - 1; k > 0 && !b->fast->steps; k--) {
        (void)run(b, k, far_row, b->levels[k].height, threads, log);
    }
}

static void top_levels(builder *b, int threads, hc_log *log)
{
    for (int k = 1; k < b->fast->levels; k++) {
        (void)run(b, k, top_blocks, b->levels[k].height, threads, log);
    }
}

/* Once more, with what a ray may meet that strays; false if there is no memory for it. */
static bool see_edges(builder *b, int threads, hc_log *log)
{
    for (int k = 0; k < b->fast->levels; k++) {
        level *l = &b->levels[k];
        l->edges = calloc(SIDES * frame_size(l), sizeof(float));
        if (l->edges == NULL) {
            return false;
        }
        (void)run(b, k, k == 0 ? edge_cells : edge_blocks, l->height, threads, log);
        close_ends(b->fast, l);
    }
    see_far(b, threads, log);
    return true;
}

static bool fill(builder *b, hc_fast *fast, int threads, hc_log *log)
{
    (void)run(b, 0, copy_heights, fast->y.cells + 1, threads, log);
    const float steepest = steepest_of(b);
    fast->least          = 2.0F * fast->blur * fast->blur * steepest + CLEARANCE;
    fast->slack          = 4.0F * fast->blur * steepest + fast->least;
    b->stray             = 6.0F * fast->blur * steepest + fast->least;
    (void)run(b, 0, top_cells, b->levels[0].height, threads, log);
    top_levels(b, threads, log);
    see_far(b, threads, log);
    (void)run(b, 0, block_row, b->levels[0].height, threads, log);
    b->sparse    = is_sparse(b);
    fast->sparse = b->sparse;
    hc_fast_find_lows(fast, threads, log);
    if (b->sparse && !see_edges(b, threads, log)) {
        return false;
    }
    if (b->sparse && !fast->x.wrapped && !fast->y.wrapped && !fast->open_sides) {
        hc_fast_list_towers(fast);
    }
    for (int k = b->sparse ? 0 : 1; k < fast->levels; k++) {
        (void)run(b, k, block_row, b->levels[k].height, threads, log);
    }
    return true;
}

static bool take_level(level *l, const hc_fast *fast, int k)
{
    l->side   = hc_fast_block_side(k);
    l->width  = hc_fast_block_count(&fast->x, k);
    l->height = hc_fast_block_count(&fast->y, k);
    l->blocks = fast->blocks + fast->start[k];
    l->pitch  = (size_t)l->width + 2 * DIAGONALS + TILE;
    l->frame  = calloc(frame_size(l), sizeof(float));
    if (k > 0) {
        l->far = malloc((size_t)l->width * (size_t)l->height * 4 * sizeof(float));
    }
    if (l->frame == NULL) {
        return false;
    }
    l->tops = l->frame + DIAGONALS * l->pitch + DIAGONALS;
    return k == 0 || l->far != NULL;
}

hc_result hc_fast_build(hc_fast *fast, const hc_field *field, int threads, hc_log *log)
{
    const size_t rows  = (size_t)fast->y.cells + 1;
    builder      b     = { .fast        = fast,
                           .heights     = field->heights,
                           .field_width = field->width,
                           .steepest    = malloc(rows * sizeof(float)),
                           .stops       = malloc(rows * sizeof(int)) };
    bool         taken = b.steepest != NULL && b.stops != NULL;
    for (int k = 0; k < fast->levels; k++) {
        taken = take_level(&b.levels[k], fast, k) && taken;
    }
    taken = taken && fill(&b, fast, fast->levels > 4 ? threads : 1, log);
    for (int k = 0; k < fast->levels; k++) {
        free(b.levels[k].frame);
        free(b.levels[k].edges);
        free(b.levels[k].far);
    }
    free(b.steepest);
    free(b.stops);
    return taken ? HC_OK : hc_fail(log, HC_ERROR_MEMORY, "no memory for building a caster");
}
