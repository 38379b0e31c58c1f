/* The exact search: for each sample of a tile, the largest rise * weight over all samples of the
 * field. Included by exact_scalar.c, exact_avx2.c and exact_avx512.c, which define HC_EXACT_TILE.
 *
 * Two numbers belong to each sample p while it is searched: S(p), the largest canonical steepness
 * found so far, and a threshold T(p) that is at most the true maximum. A node may be left out only
 * if no sample below it can beat T. Everything that decides about leaving out carries a margin;
 * everything that reaches S is the canonical formula. So the result does not depend on the order of
 * the search, on first guesses or on the instruction set. (docs/algorithms.md, "Exact search".) */
#include "exact_around.h"
#include "exact_blocks.h"

/* First guesses: those that were useful a moment ago, then those of the others that the envelope
 * does not rule out. */
INLINE void guess(kind k, tile *t)
{
    hc_exact_scratch *scratch = t->scratch;
    const unsigned    first   = scratch->recent.useful;
    unsigned          useful  = guess_from_all(k, t, first);
    unsigned          others  = 0;
    t->hull                   = draw_envelope(t, 0, HC_TILE_PARTS);
    for (int i = 0; i < HC_RECENT; i += HC_LANES) {
        const hc_v across =
            hc_v_sub(hc_v_load(scratch->recent.x + i), hc_v_set((float)t->x + MIDDLE));
        const hc_v down =
            hc_v_sub(hc_v_load(scratch->recent.y + i), hc_v_set((float)t->y + MIDDLE));
        const hc_v tops =
            hc_v_sub(hc_v_load(scratch->recent.height + i), hc_v_set(t->pass->tree->base));
        others |= promising(k, t, &t->hull, MIDDLE, across, down, tops) << i;
    }
    const unsigned more    = guess_from_all(k, t, others & ~first);
    scratch->recent.useful = useful | more;
    t->stale               = more != 0;
}

/* ---- the tree ---- */

/* From as many waiting nodes on, guesses from them pay, and chords in the directions of squares
 * (nodes of level 1). */
enum { GUESSING_NODES = 24, MANY_SQUARES = 9 };

INLINE void list_children(const tile *t, hc_node_list *list, unsigned found, int32_t place,
                          const float *entries)
{
    const int32_t first = (int32_t)(4 * (uint32_t)place);
    const int     at    = list->count;
    (void)hc_pack_v(list->top + at, found, hc_v_load(entries));
    list->count += hc_pack_lanes(list->place + at, found, t->pass->tree->children, first);
}

/* Blocks that the tables of all parts cover, by the offsets of their middles. Images of a wrapped
 * field may be out of step with them. */
INLINE unsigned near_lanes(const tile *t, hc_v across, hc_v down)
{
    const hc_v reach = hc_v_set(((t->x | t->y) & 3) == 0 ? HC_NEAR_REACH - 1.0F : -1.0F);
    return hc_v_greater(reach, hc_v_max(hc_v_abs(across), hc_v_abs(down)));
}

/* Nodes that lie in the quadrant of all samples of the tile, by the offsets of their middles. */
INLINE unsigned sure_lanes(kind k, const tile *t, hc_v across, hc_v down, float half)
{
    if (!k.quadrant) {
        return 0xFFFFU;
    }
    const hc_v apart = hc_v_set(half + MIDDLE);
    return ~(hc_v_greater(apart, hc_v_mul(across, hc_v_set((float)t->pass->sign_u)))
             | hc_v_greater(apart, hc_v_mul(down, hc_v_set((float)t->pass->sign_v))))
           & 0xFFFFU;
}

/* Middles of nodes, as seen from the tile's, and their highest samples. */
typedef struct node_places {
    _Alignas(64) float across[HC_LIST_ROOM];
    float down[HC_LIST_ROOM], top[HC_LIST_ROOM];
} node_places;

/* A node's highest sample is no farther away than its farthest corner: its steepness there is a
 * threshold. Few nodes are high enough for that to be above the envelope. */
INLINE void guess_from_places(kind k, tile *t, int part, const node_places *from, int count,
                              float half)
{
    const hc_v aspect  = hc_v_set(t->aspect);
    const hc_v halves  = hc_v_set(half);
    const hc_v columns = hc_v_add(hc_v_load(COLUMN), hc_v_set((float)(4 * (part & 1)) - MIDDLE));
    const hc_v rows    = hc_v_add(hc_v_load(ROW), hc_v_set((float)(4 * (part >> 1)) - MIDDLE));
    hc_v       best    = hc_v_set(0.0F);
    for (int i = 0; i < count; i++) {
        const hc_v across = hc_v_abs(hc_v_sub(hc_v_set(from->across[i]), columns));
        const hc_v down   = hc_v_abs(hc_v_sub(hc_v_set(from->down[i]), rows));
        const hc_v size =
            measure(k, hc_v_add(across, halves), hc_v_mul(hc_v_add(down, halves), aspect));
        const hc_v rise = hc_v_sub(hc_v_set(from->top[i]), t->lifted[part]);
        const hc_v weight =
            k.diamond ? hc_v_about_over(hc_v_set(1.0F), size) : hc_v_about_rsqrt(size);
        best = hc_v_max(hc_v_mul(rise, weight), best);
    }
    t->T[part] = hc_v_max(hc_v_mul(best, hc_v_set(LOWER / t->pass->step_u)), t->T[part]);
}

INLINE void guess_from_nodes(kind k, tile *t, int level, const hc_node_list *list)
{
    const float side  = (float)(4 << (2 * level));
    const float half  = 0.5F * (side - 1.0F);
    int         count = 0;
    node_places from;
    for (int first = 0; first < list->count; first += HC_LANES) {
        const hc_v across   = hc_v_about_muladd(columns_of(t, list->place + first), hc_v_set(side),
                                                hc_v_set(half - (float)t->x - MIDDLE));
        const hc_v down     = hc_v_about_muladd(rows_of(t, list->place + first), hc_v_set(side),
                                                hc_v_set(half - (float)t->y - MIDDLE));
        const hc_v tops     = hc_v_load(list->top + first);
        const unsigned sure = sure_lanes(k, t, across, down, half) & lanes_left(list->count - first)
                              & promising(k, t, &t->hull, MIDDLE - half, across, down, tops);
        (void)hc_pack_v(from.across + count, sure, across);
        (void)hc_pack_v(from.down + count, sure, down);
        count += hc_pack_v(from.top + count, sure, tops);
    }
    if (count == 0) {
        return;
    }
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        guess_from_places(k, t, part, &from, count, half);
    }
    t->stale = true;
}

/* Nodes of one level, and the middles of node (0, 0)'s children as seen from the tile's. */
typedef struct raster {
    hc_tree_level nodes;
    int           side; /* of a child [samples] */
    hc_v          columns, rows;
} raster;

/* The sixteen children of a node: their entries, and their middles as seen from the tile's. */
typedef struct children {
    const float *entries;
    hc_v         across, down;
} children;

INLINE raster raster_of(const tile *t, int level)
{
    const int  side  = 1 << (2 * level);
    const hc_v size  = hc_v_set((float)side);
    const hc_v shift = hc_v_set(0.5F * (float)(side - HC_TILE_SIDE)); /* of middles */
    return (raster){ .nodes   = t->pass->tree->levels[level],
                     .side    = side,
                     .columns = hc_v_about_muladd(hc_v_load(COLUMN), size, shift),
                     .rows    = hc_v_about_muladd(hc_v_load(ROW), size, shift) };
}

INLINE children children_at(const tile *t, raster r, int32_t place)
{
    const int x = hc_place_x(t->pass->tree, place);
    const int y = hc_place_y(t->pass->tree, place);
    return (children){ .entries = hc_tree_node(&r.nodes, x, y),
                       .across  = hc_v_add(r.columns, hc_v_set((float)(4 * x * r.side - t->x))),
                       .down    = hc_v_add(r.rows, hc_v_set((float)(4 * y * r.side - t->y))) };
}

/* Blocks of a square to the lists of near and of distant ones. */
INLINE void list_blocks(const tile *t, unsigned found, int32_t place, children c)
{
    const unsigned near = near_lanes(t, c.across, c.down);
    list_children(t, &t->scratch->near, found & near, place, c.entries);
    list_children(t, &t->scratch->lists[0], found & ~near, place, c.entries);
}

/* Search the waiting nodes of one level, from number `done` on, while the list below has room:
 * those of their sixteen children that may hold something join it. Returns how many are done. */
INLINE int search_level(kind k, const tile *t, int level, int done)
{
    const hc_node_list *list  = &t->scratch->lists[level];
    hc_node_list       *below = &t->scratch->lists[level - 1];
    const raster        r     = raster_of(t, level);
    const float         reach = MIDDLE + 0.5F * (float)(r.side - 1);
    for (; done < list->count && below->count <= HC_LIST; done++) {
        const int32_t  place = list->place[done];
        const children c     = children_at(t, r, place);
        const unsigned found =
            promising(k, t, &t->hull, reach, c.across, c.down, hc_v_load(c.entries));
        if (level == 1) {
            list_blocks(t, found, place, c);
        } else {
            list_children(t, below, found, place, c.entries);
        }
    }
    return done;
}

/* Squares that wait again as the list below is full: the near ones from number `near` on and the
 * far ones from number `far` on. */
static __attribute__((noinline)) void keep_squares(hc_node_list *list, const square_choice *chosen,
                                                   int near, int far)
{
    const hc_node_list all = *list;
    list->count            = 0;
    for (int i = near; i < chosen->near.count; i++) {
        list->place[list->count] = all.place[chosen->near.number[i]];
        list->top[list->count++] = all.top[chosen->near.number[i]];
    }
    for (int i = far; i < chosen->far.count; i++) {
        list->place[list->count] = all.place[chosen->far.number[i]];
        list->top[list->count++] = all.top[chosen->far.number[i]];
    }
}

/* Blocks of a chosen square that rise above its plane, which may lie below what stands for places
 * outside the field. */
INLINE unsigned blocks_above(kind k, const tile *t, const square_choice *chosen, int square,
                             children c)
{
    const hc_v tops = hc_v_load(c.entries);
    return above_plane(&chosen->planes, square, tops) & hc_v_greater(tops, hc_v_set(-1.0F))
           & reached_lanes(k, t, c.across, c.down, MIDDLE + 1.5F);
}

/* The waiting squares, from number `done` on, by chords in the direction of each, which let far
 * fewer blocks pass than the envelope does. Most squares hold distant blocks alone. */
INLINE int search_squares(kind k, const tile *t, int done)
{
    hc_node_list *list  = &t->scratch->lists[1];
    hc_node_list *below = &t->scratch->lists[0];
    const raster  r     = raster_of(t, 1);
    int           near = 0, far = 0;
    square_choice chosen;
    choose_squares(k, t, list, done, &chosen);
    for (; near < chosen.near.count && below->count <= HC_LIST; near++) {
        const int      square = chosen.near.number[near];
        const children c      = children_at(t, r, list->place[square]);
        list_blocks(t, blocks_above(k, t, &chosen, square, c), list->place[square], c);
    }
    for (; far < chosen.far.count && below->count <= HC_LIST; far++) {
        const int      square = chosen.far.number[far];
        const children c      = children_at(t, r, list->place[square]);
        list_children(t, below, blocks_above(k, t, &chosen, square, c), list->place[square],
                      c.entries);
    }
    if (near == chosen.near.count && far == chosen.far.count) {
        return list->count;
    }
    keep_squares(list, &chosen, near, far);
    return 0;
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
    lists[root].place[0]                   = 0;
    lists[root].top[0]                     = t->pass->tree->range;
    while (level <= root) {
        if (level == 0) {
            search_blocks(k, t);
            level = 1;
            continue;
        }
        hc_node_list *list  = &lists[level];
        hc_node_list *below = &lists[level - 1];
        if (done[level] == 0 && list->count >= GUESSING_NODES) {
            guess_from_nodes(k, t, level, list);
        }
        const bool many = level == 1 && list->count - done[1] >= MANY_SQUARES;
        if (t->stale && !many && done[level] < list->count) {
            t->hull  = draw_envelope(t, 0, HC_TILE_PARTS);
            t->stale = false;
        }
        done[level] = many ? search_squares(k, t, done[1]) : search_level(k, t, level, done[level]);
        if (below->count > 0 || (level == 1 && t->scratch->near.count > 0)) {
            level--;
        } else {
            list->count = done[level] = 0;
            level++;
        }
    }
}

/* ---- a tile ---- */

INLINE void begin_tile(kind k, tile *t, int tile_x, int tile_y)
{
    const hc_block_tree *tree   = t->pass->tree;
    const hc_tree_level *blocks = &tree->levels[0];
    hc_around           *around = &t->scratch->around;
    if (!around->known || around->pair_x != tile_x / 2 || around->tile_y != tile_y) {
        look_around(k, t->pass, around, tile_x / 2, tile_y);
    }
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
            t->S[part] =
                hc_v_keep(~outside & 0xFFFFU, hc_v_load(around->steepness[tile_x % 2][part]));
            raise_threshold(t, part);
        }
        t->lifted[part] = hc_v_sub(t->height[part], hc_v_set(tree->base));
    }
}

INLINE void search_images(kind k, tile *t)
{
    const hc_exact_pass *pass   = t->pass;
    const int            home_x = t->x;
    const int            home_y = t->y;
    k.together    = false; /* images may be out of step with the tile, and close to it */
    t->home_image = false;
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
    tile t; /* an initializer would clear its vectors first */
    t.pass       = pass;
    t.scratch    = scratch;
    t.aspect     = pass->step_v / pass->step_u;
    t.x          = tile_x * HC_TILE_SIDE;
    t.y          = tile_y * HC_TILE_SIDE;
    t.home_image = true;
    begin_tile(k, &t, tile_x, tile_y);
    guess(k, &t);
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

/* Round cones need few distant blocks, and samples much farther apart along one axis would make the
 * tile's middle a poor place to look from. */
static bool even(const hc_exact_pass *pass)
{
    return pass->step_u <= 4.0F * pass->step_v && pass->step_v <= 4.0F * pass->step_u;
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
    } else if (even(pass)) {
        const kind round = { .together = true };
        search_tile(round, steepness, pass, tile_x, tile_y, scratch);
    } else {
        const kind stretched = { .diamond = false };
        search_tile(stretched, steepness, pass, tile_x, tile_y, scratch);
    }
}
