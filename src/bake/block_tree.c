#include "block_tree.h"

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 4, ENTRIES = SIDE * SIDE };

/* Fields that use less of 0..1 than this are searched with their own range. */
static const float SMALL_RANGE = 1.0F / 64.0F;

/* Fewer nodes than this are gathered sooner than threads are started. */
enum { FEW_NODES = 4096 };

static size_t lay_out(hc_block_tree *tree)
{
    size_t floats  = 0;
    int    columns = tree->width;
    int    rows    = tree->height;
    tree->count    = 0;
    do {
        columns                     = (columns + SIDE - 1) / SIDE;
        rows                        = (rows + SIDE - 1) / SIDE;
        tree->levels[tree->count++] = (hc_tree_level){ .columns = columns, .rows = rows };
        floats += (size_t)columns * (size_t)rows * ENTRIES;
    } while (columns > 1 || rows > 1);
    return floats;
}

/* False if places take more than 32 bits. */
static bool number_places(hc_block_tree *tree)
{
    tree->row_shift = 0;
    while (1 << tree->row_shift < tree->levels[0].columns) {
        tree->row_shift++;
    }
    for (int i = 0; i < ENTRIES; i++) {
        tree->children[i] = i % SIDE + (i / SIDE << tree->row_shift);
    }
    return (uint64_t)tree->levels[0].rows << tree->row_shift <= (uint64_t)UINT32_MAX + 1;
}

static void place_levels(hc_block_tree *tree)
{
    float *next = tree->store;
    for (int k = 0; k < tree->count; k++) {
        tree->levels[k].entries = next;
        next += (size_t)tree->levels[k].columns * (size_t)tree->levels[k].rows * ENTRIES;
    }
}

typedef struct range {
    float low, high;
} range;

static range wider(range a, range b)
{
    return (range){ a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high };
}

static range range_of(const float *heights, size_t count)
{
    range all = { heights[0], heights[0] };
    float lows[ENTRIES], highs[ENTRIES]; /* sixteen chains, so that the loop becomes vectors */
    for (int i = 0; i < ENTRIES; i++) {
        lows[i] = highs[i] = heights[0];
    }
    for (size_t first = 0; first + ENTRIES <= count; first += ENTRIES) {
        for (int i = 0; i < ENTRIES; i++) {
            lows[i] = heights[first + (size_t)i] < lows[i] ? heights[first + (size_t)i] : lows[i];
            highs[i] =
                heights[first + (size_t)i] > highs[i] ? heights[first + (size_t)i] : highs[i];
        }
    }
    for (size_t i = count - count % ENTRIES; i < count; i++) {
        all = wider(all, (range){ heights[i], heights[i] });
    }
    for (int i = 0; i < ENTRIES; i++) {
        all = wider(all, (range){ lows[i], highs[i] });
    }
    return all;
}

static void copy_block(const hc_block_tree *tree, const float *heights, int block_x, int block_y)
{
    float *entries = hc_tree_node(&tree->levels[0], block_x, block_y);
    if ((block_x + 1) * SIDE <= tree->width && (block_y + 1) * SIDE <= tree->height) {
        const size_t stride = (size_t)tree->width;
        const float *row    = heights + (size_t)block_y * SIDE * stride + (size_t)block_x * SIDE;
        for (int r = 0; r < SIDE; r++) {
            memcpy(entries + (size_t)r * SIDE, row + (size_t)r * stride, SIDE * sizeof(float));
        }
        return;
    }
    for (int i = 0; i < ENTRIES; i++) {
        const int x = block_x * SIDE + i % SIDE;
        const int y = block_y * SIDE + i / SIDE;
        entries[i]  = x < tree->width && y < tree->height
                          ? heights[(size_t)y * (size_t)tree->width + (size_t)x]
                          : HC_TREE_OUTSIDE;
    }
}

static float higher(float a, float b)
{
    return a > b ? a : b;
}

/* Columns first, for vector code. */
static float highest(const float *entries)
{
    float columns[SIDE];
    for (int i = 0; i < SIDE; i++) {
        columns[i] = higher(higher(entries[i], entries[i + SIDE]),
                            higher(entries[i + 2 * SIDE], entries[i + 3 * SIDE]));
    }
    return higher(higher(columns[0], columns[1]), higher(columns[2], columns[3]));
}

/* Entries of one node of level `k` >= 1 from the nodes below it. */
static void gather_node(const hc_block_tree *tree, int k, int x, int y)
{
    const hc_tree_level *fine    = &tree->levels[k - 1];
    const float          lift    = k == 1 ? tree->base : 0.0F; /* level 0 holds plain heights */
    float               *entries = hc_tree_node(&tree->levels[k], x, y);
    for (int i = 0; i < ENTRIES; i++) {
        const int child_x = x * SIDE + i % SIDE;
        const int child_y = y * SIDE + i / SIDE;
        entries[i]        = child_x < fine->columns && child_y < fine->rows
                                ? highest(hc_tree_node(fine, child_x, child_y)) - lift
                                : HC_TREE_OUTSIDE;
    }
}

typedef struct build {
    hc_block_tree *tree;
    const float   *heights;
    int            level;
    range          seen[HC_THREADS_MAX]; /* by each worker */
} build;

static void copy_row(build *b, int row, int worker)
{
    const int    rows  = b->tree->height - row * SIDE < SIDE ? b->tree->height - row * SIDE : SIDE;
    const size_t width = (size_t)b->tree->width;
    const float *from  = b->heights + (size_t)row * SIDE * width;
    b->seen[worker]    = wider(b->seen[worker], range_of(from, (size_t)rows * width));
    for (int x = 0; x < b->tree->levels[0].columns; x++) {
        copy_block(b->tree, b->heights, x, row);
    }
}

static void gather_row(void *context, int row, int worker)
{
    (void)worker;
    const build *b = context;
    for (int x = 0; x < b->tree->levels[b->level].columns; x++) {
        gather_node(b->tree, b->level, x, row);
    }
}

/* One row of level 1 and the blocks below it, while they are in the cache. */
static void copy_and_gather(void *context, int row, int worker)
{
    build *b = context;
    for (int i = row * SIDE; i < (row + 1) * SIDE && i < b->tree->levels[0].rows; i++) {
        copy_row(b, i, worker);
    }
    if (b->tree->count > 1) {
        gather_row(b, row, worker);
    }
}

/* Differences of floats are exact where one is at most twice the other. */
static void set_range(hc_block_tree *tree, range all)
{
    const bool small = all.high - all.low < SMALL_RANGE;
    const bool close = all.low >= 0.5F * all.high;
    tree->base       = small && close ? all.low : 0.0F;
    tree->range      = small ? all.high - tree->base : 1.0F;
}

/* Level 1 is gathered at once as if the base were 0, and again in the rare case that it is not. */
static void build_levels(hc_block_tree *tree, const float *heights, int threads, hc_log *log)
{
    build     b    = { .tree = tree, .heights = heights, .level = 1 };
    range     all  = { heights[0], heights[0] };
    const int rows = (tree->levels[0].rows + SIDE - 1) / SIDE;
    for (int i = 0; i < threads; i++) {
        b.seen[i] = all;
    }
    (void)hc_parallel_for(rows, threads, copy_and_gather, &b, (hc_progress){ 0 }, log);
    for (int i = 0; i < threads; i++) {
        all = wider(all, b.seen[i]);
    }
    set_range(tree, all);
    for (b.level = tree->base == 0.0F ? 2 : 1; b.level < tree->count; b.level++) {
        const hc_tree_level *level = &tree->levels[b.level];
        const bool           few   = level->columns < FEW_NODES / level->rows;
        (void)hc_parallel_for(level->rows, few ? 1 : threads, gather_row, &b, (hc_progress){ 0 },
                              log);
    }
}

hc_result hc_tree_build(hc_block_tree *tree, const float *heights, int width, int height,
                        int threads, hc_log *log)
{
    *tree               = (hc_block_tree){ .width = width, .height = height };
    const size_t floats = lay_out(tree);
    if (number_places(tree)) {
        tree->store = hc_take_memory(floats * sizeof(float)); /* a node is one line */
    }
    if (tree->store == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY,
                       "no memory for the search tree of %d x %d samples (%zu bytes)", width,
                       height, floats * sizeof(float));
    }
    place_levels(tree);
    build_levels(tree, heights, threads, log);
    return HC_OK;
}

void hc_tree_free(hc_block_tree *tree)
{
    free(tree->store);
    *tree = (hc_block_tree){ 0 };
}

static bool within_range(const hc_block_tree *tree, const float *heights, hc_rect changed)
{
    for (int y = changed.y; y < changed.y + changed.height; y++) {
        for (int x = changed.x; x < changed.x + changed.width; x++) {
            const float lifted = heights[(size_t)y * (size_t)tree->width + (size_t)x] - tree->base;
            if (lifted < 0.0F || lifted > tree->range) {
                return false;
            }
        }
    }
    return true;
}

bool hc_tree_update(hc_block_tree *tree, const float *heights, hc_rect changed)
{
    int left   = changed.x / SIDE;
    int top    = changed.y / SIDE;
    int right  = (changed.x + changed.width - 1) / SIDE;
    int bottom = (changed.y + changed.height - 1) / SIDE;
    for (int k = 0; k < tree->count; k++) {
        for (int y = top; y <= bottom; y++) {
            for (int x = left; x <= right; x++) {
                if (k == 0) {
                    copy_block(tree, heights, x, y);
                } else {
                    gather_node(tree, k, x, y);
                }
            }
        }
        left /= SIDE;
        top /= SIDE;
        right /= SIDE;
        bottom /= SIDE;
    }
    return within_range(tree, heights, changed);
}
