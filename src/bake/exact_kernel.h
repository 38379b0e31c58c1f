/* The exact search: for each sample of a tile, the largest rise * weight over all samples of the
 * field. Included by exact_scalar.c, exact_avx2.c and exact_avx512.c, which define HC_EXACT_TILE.
 *
 * Two numbers belong to each sample p while it is searched: S(p), the largest canonical steepness
 * found so far, and a threshold T(p) that is at most the true maximum. A node may be left out only
 * if no sample below it can beat T. Everything that decides about leaving out carries a margin;
 * everything that reaches S is the canonical formula. So the result does not depend on the order of
 * the search, on first guesses or on the instruction set. (docs/algorithms.md, "Exact search".) */
#include "exact_blocks.h"

/* The least of height(p) + T(p) * distance is a concave function of the distance: between two ends
 * it lies above its chord. So one multiply-add bounds many samples at once, and far more tightly
 * than the lowest height with the least T would. The last piece is level: no slope is negative. */
INLINE envelope draw_envelope(const tile *t)
{
    const hc_exact_pass *pass    = t->pass;
    const hc_v           start   = hc_v_load(PIECE_ENDS);
    const hc_v           end     = hc_v_load(PIECE_ENDS + 1);
    const hc_v           most    = hc_v_set(2.0F * pass->tree->range); /* keeps chords precise */
    hc_v                 lows[4] = { most, most, most, most }; /* short chains: min takes a while */
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        float heights[HC_LANES], rises[HC_LANES];
        hc_v_store(heights, t->lifted[part]);
        hc_v_store(rises, hc_v_mul(t->T[part], hc_v_set(pass->step_u)));
        for (int p = 0; p < HC_LANES; p++) {
            const hc_v line = hc_v_about_muladd(start, hc_v_set(rises[p]), hc_v_set(heights[p]));
            lows[p % 4]     = hc_v_min(line, lows[p % 4]);
        }
    }
    const hc_v low = hc_v_min(hc_v_min(lows[0], lows[1]), hc_v_min(lows[2], lows[3]));
    float      least[HC_LANES + 1];
    hc_v_store(least, low);
    least[HC_LANES]   = least[HC_LANES - 1];
    const hc_v high   = hc_v_load(least + 1);
    const hc_v margin = hc_v_set(pass->tree->range * 0x1p-19F);
    envelope   drawn;
    drawn.slopes  = hc_v_div(hc_v_sub(high, low), hc_v_sub(end, start));
    drawn.offsets = hc_v_sub(hc_v_sub(low, hc_v_mul(drawn.slopes, start)), margin);
    return drawn;
}

/* Which of sixteen squares, `side` samples large, may hold something for the tile. across, down:
 * from its first sample to the squares' first ones; tops: the squares' highest samples, minus
 * base. */
INLINE unsigned promising(kind k, const tile *t, hc_v across, hc_v down, hc_v tops, int side)
{
    /* gaps: from the tile's last samples to the squares' first, and from the squares' last to the
     * tile's first; one of them is negative */
    const hc_v zero   = hc_v_set(0.0F);
    const hc_v last   = hc_v_set((float)(HC_TILE_SIDE - 1));
    const hc_v reach  = hc_v_set((float)(1 - side));
    const hc_v after  = hc_v_sub(across, last);
    const hc_v before = hc_v_sub(reach, across);
    const hc_v below  = hc_v_sub(down, last);
    const hc_v above  = hc_v_sub(reach, down);
    const hc_v gap_u  = hc_v_max(hc_v_max(after, before), zero);
    const hc_v gap_v  = hc_v_mul(hc_v_max(hc_v_max(below, above), zero), hc_v_set(t->aspect));
    const hc_v size   = measure(k, gap_u, gap_v);
    const hc_v bound =
        hc_v_about_line(t->hull.offsets, t->hull.slopes, k.diamond ? size : hc_v_about_sqrt(size),
                        PIECE_SHIFT, PIECE_FIRST);
    unsigned found = hc_v_greater(tops, bound);
    if (k.quadrant) {
        found &= ~hc_v_greater(t->pass->sign_u > 0 ? before : after, zero);
        found &= ~hc_v_greater(t->pass->sign_v > 0 ? above : below, zero);
    }
    return found;
}

/* ---- the tree ---- */

INLINE void list_children(hc_node_list *list, unsigned found, int x, int y, const float *entries)
{
    const int at = list->count;
    (void)hc_pack_lanes(list->x + at, found, COLUMN_INDEX, 4 * x);
    (void)hc_pack_v(list->top + at, found, hc_v_load(entries));
    list->count += hc_pack_lanes(list->y + at, found, ROW_INDEX, 4 * y);
}

/* Blocks that the tables of all parts cover. Images of a wrapped field may be out of step with
 * them. */
INLINE unsigned near_lanes(const tile *t, hc_v across, hc_v down)
{
    const hc_v middle = hc_v_set((float)(HC_TILE_SIDE / 2 - 2));
    const hc_v reach  = hc_v_set(((t->x | t->y) & 3) == 0 ? HC_NEAR_REACH - 1.0F : -1.0F);
    return hc_v_greater(
        reach, hc_v_max(hc_v_abs(hc_v_sub(across, middle)), hc_v_abs(hc_v_sub(down, middle))));
}

/* Search the waiting nodes of one level, from number `done` on, while the list below has room:
 * those of their sixteen children that may hold something join it. Returns how many are done. */
INLINE int search_level(kind k, const tile *t, int level, int done)
{
    const hc_tree_level nodes   = t->pass->tree->levels[level];
    const hc_node_list *list    = &t->scratch->lists[level];
    hc_node_list       *below   = &t->scratch->lists[level - 1];
    const int           side    = 1 << (2 * level);
    const hc_v          columns = hc_v_mul(hc_v_load(COLUMN), hc_v_set((float)side));
    const hc_v          rows    = hc_v_mul(hc_v_load(ROW), hc_v_set((float)side));
    for (; done < list->count && below->count <= HC_LIST; done++) {
        const int      x       = list->x[done];
        const int      y       = list->y[done];
        const float   *entries = hc_tree_node(&nodes, x, y);
        const hc_v     across  = hc_v_add(columns, hc_v_set((float)(4 * x * side - t->x)));
        const hc_v     down    = hc_v_add(rows, hc_v_set((float)(4 * y * side - t->y)));
        const unsigned found   = promising(k, t, across, down, hc_v_load(entries), side);
        const unsigned near    = level == 1 ? near_lanes(t, across, down) : 0;
        if ((found & near) != 0) {
            list_children(&t->scratch->near, found & near, x, y, entries);
        }
        list_children(below, found & ~near, x, y, entries);
    }
    return done;
}

/* Level by level while the lists have room, so that loops are long and their branches predictable;
 * deeper first when one is full, so that memory is bounded. */
INLINE void search_tree(kind k, tile *t)
{
    hc_node_list *lists                    = t->scratch->lists;
    const int     root                     = t->pass->tree->count - 1;
    int           done[HC_TREE_LEVELS_MAX] = { 0 };
    int           level                    = root;
    lists[root].count                      = 1;
    lists[root].x[0] = lists[root].y[0] = 0;
    lists[root].top[0]                  = t->pass->tree->range;
    while (level <= root) {
        if (level == 0) {
            search_blocks(k, t);
            level = 1;
            continue;
        }
        hc_node_list *list  = &lists[level];
        hc_node_list *below = &lists[level - 1];
        if (t->stale && done[level] < list->count) {
            t->hull  = draw_envelope(t);
            t->stale = false;
        }
        done[level] = search_level(k, t, level, done[level]);
        if (below->count > 0 || (level == 1 && t->scratch->near.count > 0)) {
            level--;
        } else {
            list->count = done[level] = 0;
            level++;
        }
    }
}

/* ---- a tile ---- */

INLINE void begin_tile(tile *t, int tile_x, int tile_y)
{
    const hc_block_tree *tree   = t->pass->tree;
    const hc_tree_level *blocks = &tree->levels[0];
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        const int x     = 2 * tile_x + (part & 1);
        const int y     = 2 * tile_y + (part >> 1);
        t->S[part]      = hc_v_set(0.0F);
        t->T[part]      = hc_v_set(0.0F);
        t->height[part] = hc_v_set(ABOVE_ALL);
        if (x < blocks->columns && y < blocks->rows) {
            const hc_v     samples = hc_v_load(hc_tree_node(blocks, x, y));
            const unsigned outside = hc_v_greater(hc_v_set(0.0F), samples);
            t->height[part]        = hc_v_add(hc_v_keep(~outside & 0xFFFFU, samples),
                                              hc_v_keep(outside, hc_v_set(ABOVE_ALL)));
        }
        /* Nothing limits the highest samples. Level lines at the top of the envelope would keep all
         * others that are as high promising. */
        const hc_v     lifted = hc_v_sub(t->height[part], hc_v_set(tree->base));
        const unsigned lower  = hc_v_greater(hc_v_set(tree->top), lifted);
        t->lifted[part] =
            hc_v_add(hc_v_keep(lower, lifted), hc_v_keep(~lower & 0xFFFFU, hc_v_set(ABOVE_ALL)));
    }
}

/* The nine blocks around each part: nearly always needed, and they make good thresholds. */
INLINE void search_neighbours(tile *t)
{
    const hc_tree_level *blocks = &t->pass->tree->levels[0];
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        const int x = t->x / 4 + (part & 1);
        const int y = t->y / 4 + (part >> 1);
        hc_v      S[4];
        begin_maxima(t, part, S);
        for (int dy = -1; dy <= 1; dy++) {
            for (int dx = -1; dx <= 1; dx++) {
                if (x + dx >= 0 && y + dy >= 0 && x + dx < blocks->columns
                    && y + dy < blocks->rows) {
                    take_near_block(S, t->height[part], t->pass->near,
                                    hc_tree_node(blocks, x + dx, y + dy), 4 * dx, 4 * dy);
                }
            }
        }
        end_maxima(t, part, S);
    }
}

INLINE void search_images(kind k, tile *t)
{
    const hc_exact_pass *pass   = t->pass;
    const int            home_x = t->x;
    const int            home_y = t->y;
    t->home_image               = false;
    for (int v = -(int)pass->wrap_v; v <= (int)pass->wrap_v; v++) {
        for (int u = -(int)pass->wrap_u; u <= (int)pass->wrap_u; u++) {
            if (u != 0 || v != 0) {
                t->x = home_x - u * pass->tree->width;
                t->y = home_y - v * pass->tree->height;
                search_tree(k, t);
            }
        }
    }
}

INLINE void search_tile(kind k, float *steepness, const hc_exact_pass *pass, int tile_x, int tile_y,
                        hc_exact_scratch *scratch)
{
    tile t = { .pass       = pass,
               .scratch    = scratch,
               .aspect     = pass->step_v / pass->step_u,
               .x          = tile_x * HC_TILE_SIDE,
               .y          = tile_y * HC_TILE_SIDE,
               .home_image = true,
               .stale      = true };
    begin_tile(&t, tile_x, tile_y);
    search_neighbours(&t);
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        guess_from_recent(k, &t, part, 0, HC_RECENT);
    }
    search_tree(k, &t);
    search_images(k, &t);
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        float lanes[HC_LANES];
        hc_v_store(lanes, t.S[part]);
        for (int r = 0; r < 4; r++) {
            float *row = steepness + (4 * (part >> 1) + r) * HC_TILE_SIDE + 4 * (part & 1);
            memcpy(row, lanes + 4 * r, 4 * sizeof(float));
        }
    }
}

void HC_EXACT_TILE(float *steepness, const hc_exact_pass *pass, int tile_x, int tile_y,
                   hc_exact_scratch *scratch)
{
    if (pass->sign_u != 0) {
        const kind quadrant = { .diamond = true, .quadrant = true };
        search_tile(quadrant, steepness, pass, tile_x, tile_y, scratch);
    } else if (pass->diamond) {
        const kind diamond = { .diamond = true };
        search_tile(diamond, steepness, pass, tile_x, tile_y, scratch);
    } else {
        const kind round = { .diamond = false };
        search_tile(round, steepness, pass, tile_x, tile_y, scratch);
    }
}
