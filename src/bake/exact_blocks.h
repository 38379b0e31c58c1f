/* Listed blocks against the parts of a tile: which blocks, and which of their samples, a part must
 * look at. Part of exact_kernel.h. (docs/algorithms.md, "Exact search".) */
#ifndef HC_BAKE_EXACT_BLOCKS_H
#define HC_BAKE_EXACT_BLOCKS_H

#include "exact_hull.h"
#include "exact_samples.h"

/* A square of 16 x 16 samples is a node of level 1: 4 x 4 blocks. */
#define SQUARE_SIDE 16.0F

/* What the samples of a part, or of all parts, say about places at a distance along a vector of at
 * most one unit, both measured from the samples' middle: to be useful, a place must rise above
 *   height + slope * distance + lean_u * unit_u + lean_v * unit_v
 * of one of them. */
typedef struct lines {
    _Alignas(64) float height[HC_TILE_PARTS * HC_LANES];
    float slope[HC_TILE_PARTS * HC_LANES];
    float lean_u[HC_TILE_PARTS * HC_LANES], lean_v[HC_TILE_PARTS * HC_LANES];
    float least_slope; /* of the samples that something can limit */
} lines;

INLINE void draw_lines(const tile *t, int first, int parts, lines *l)
{
    hc_v least = hc_v_set(0x1p60F);
    for (int i = 0; i < parts; i++) {
        const int      part   = first + i;
        const hc_v     slope  = hc_v_mul(t->T[part], hc_v_set(t->pass->step_u));
        const hc_v     rows   = hc_v_mul(slope, hc_v_set(t->aspect));
        const unsigned rising = hc_v_greater(slope, hc_v_set(0.0F)); /* level lines are exact */
        const hc_v     margin = hc_v_keep(rising, hc_v_set(t->pass->tree->range * 0x1p-19F));
        const float    u      = parts == 1 ? 1.5F : MIDDLE - (float)(4 * (part & 1));
        const float    v      = parts == 1 ? 1.5F : MIDDLE - (float)(4 * (part >> 1));
        hc_v_store(l->height + HC_LANES * i, hc_v_sub(t->lifted[part], margin));
        hc_v_store(l->slope + HC_LANES * i, slope);
        hc_v_store(l->lean_u + HC_LANES * i,
                   hc_v_mul(slope, hc_v_sub(hc_v_set(u), hc_v_load(COLUMN))));
        hc_v_store(l->lean_v + HC_LANES * i, hc_v_mul(rows, hc_v_sub(hc_v_set(v), hc_v_load(ROW))));
        const unsigned limited = hc_v_greater(hc_v_set(0.5F * ABOVE_ALL), t->lifted[part]);
        least                  = hc_v_min(hc_v_pick(limited, slope, hc_v_set(0x1p60F)), least);
    }
    l->least_slope = hc_v_lowest(least);
}

/* From the middle of the samples to sixteen places. */
typedef struct bearings {
    hc_v unit_u, unit_v, distance;
} bearings;

/* The lowest of `count` lines at sixteen places. Not inline: compilers would broadcast all lines
 * into memory before the loop over the list, which is short. */
static __attribute__((noinline)) hc_v lowest_lines(const lines *l, int count, const bearings *b)
{
    const hc_v above   = hc_v_set(ABOVE_ALL);
    hc_v       lows[2] = { above, above }; /* short chains: min takes a while */
    for (int first = 0; first < count; first += 4) {
        for (int i = 0; i < 4; i++) { /* of constant length, or minima would stay in memory */
            const int p = first + i;
            hc_v v = hc_v_about_muladd(b->distance, hc_v_set(l->slope[p]), hc_v_set(l->height[p]));
            v      = hc_v_about_muladd(b->unit_u, hc_v_set(l->lean_u[p]), v);
            v      = hc_v_about_muladd(b->unit_v, hc_v_set(l->lean_v[p]), v);
            lows[i % 2] = hc_v_min(v, lows[i % 2]);
        }
    }
    return hc_v_min(lows[0], lows[1]);
}

/* The lowest of a tile's lines at sixteen places, and how much higher it is at places `length`
 * farther away: the least of lines is concave, so that it lies above its chord between both. At
 * most `most`, which keeps chords precise. */
typedef struct chords {
    hc_v low, rise;
} chords;

static __attribute__((noinline)) chords draw_chords(const lines *l, const bearings *b, hc_v length,
                                                    float most)
{
    const hc_v above   = hc_v_set(most);
    hc_v       lows[2] = { above, above };
    hc_v       ends[2] = { above, above };
    for (int first = 0; first < HC_TILE_PARTS * HC_LANES; first += 4) {
        for (int i = 0; i < 4; i++) { /* as above */
            const int  p     = first + i;
            const hc_v slope = hc_v_set(l->slope[p]);
            hc_v       v     = hc_v_about_muladd(b->distance, slope, hc_v_set(l->height[p]));
            v                = hc_v_about_muladd(b->unit_u, hc_v_set(l->lean_u[p]), v);
            v                = hc_v_about_muladd(b->unit_v, hc_v_set(l->lean_v[p]), v);
            lows[i % 2]      = hc_v_min(v, lows[i % 2]);
            ends[i % 2]      = hc_v_min(hc_v_about_muladd(length, slope, v), ends[i % 2]);
        }
    }
    const hc_v low = hc_v_min(lows[0], lows[1]);
    return (chords){ low, hc_v_sub(hc_v_min(ends[0], ends[1]), low) };
}

/* Gaps from a part's middle to sixteen blocks, in columns or rows, by the blocks' columns or rows;
 * negative to the left and above. They are 0 or at least 1/2. */
INLINE hc_v block_gaps(hc_v index, float middle)
{
    const hc_v zero  = hc_v_set(0.0F);
    const hc_v four  = hc_v_set(4.0F);
    const hc_v first = hc_v_about_muladd(index, four, hc_v_set(-middle));
    const hc_v last  = hc_v_about_muladd(index, four, hc_v_set(3.0F - middle));
    return hc_v_add(hc_v_max(first, zero), hc_v_min(last, zero));
}

/* -1, 0 or 1. */
INLINE hc_v sign_of(hc_v gap)
{
    const hc_v one = hc_v_set(1.0F);
    return hc_v_max(hc_v_min(hc_v_mul(gap, hc_v_set(2.0F)), one), hc_v_sub(hc_v_set(0.0F), one));
}

INLINE bearings take_bearings(kind k, const tile *t, hc_v gap_u, hc_v gap_v)
{
    const hc_v across = k.diamond ? hc_v_abs(gap_u) : gap_u;
    const hc_v rows   = k.diamond ? hc_v_abs(gap_v) : gap_v;
    const hc_v down   = hc_v_mul(rows, hc_v_set(t->aspect));
    /* images of a wrapped field may lie above the part, without holding samples there */
    const hc_v size  = hc_v_max(measure(k, across, down), hc_v_set(0x1p-40F));
    const hc_v lower = hc_v_mul(size, hc_v_set(LOWER));
    const hc_v root  = hc_v_about_rsqrt(size);
    bearings   b;
    b.unit_u   = k.diamond ? sign_of(gap_u) : hc_v_mul(across, root);
    b.unit_v   = k.diamond ? sign_of(gap_v) : hc_v_mul(down, root);
    b.distance = k.diamond ? lower : hc_v_mul(lower, root);
    return b;
}

INLINE unsigned lanes_left(int left)
{
    return left >= HC_LANES ? 0xFFFFU : (1U << left) - 1;
}

/* Lanes that hold listed blocks which have not been searched before and lie on the right side. */
INLINE unsigned useful_lanes(kind k, const tile *t, hc_v gap_u, hc_v gap_v, int left)
{
    const hc_v known = hc_v_set(t->home_image ? 3.0F : -1.0F); /* the part's own and those around */
    unsigned   useful = lanes_left(left);
    useful &= ~hc_v_greater(known, hc_v_max(hc_v_abs(gap_u), hc_v_abs(gap_v)));
    if (k.quadrant) {
        const hc_v beyond = hc_v_set(-1.5F); /* the part's last samples */
        useful &= ~hc_v_greater(beyond, hc_v_mul(gap_u, hc_v_set((float)t->pass->sign_u)));
        useful &= ~hc_v_greater(beyond, hc_v_mul(gap_v, hc_v_set((float)t->pass->sign_v)));
    }
    return useful;
}

/* Planes over the 4 x 4 entries of sixteen squares or blocks: `low` at the nearest corner, rising
 * by `rise` from one entry to the next one straight ahead. */
INLINE void draw_planes(const tile *t, const bearings *b, hc_v low, hc_v rise, hc_planes *planes,
                        int first)
{
    const hc_v zero   = hc_v_set(0.0F);
    const hc_v rise_u = hc_v_mul(rise, b->unit_u);
    const hc_v rise_v = hc_v_mul(rise, hc_v_mul(b->unit_v, hc_v_set(t->aspect)));
    const hc_v back   = hc_v_add(hc_v_min(rise_u, zero), hc_v_min(rise_v, zero));
    hc_v_store(planes->start + first, hc_v_about_muladd(back, hc_v_set(-3.0F), low));
    hc_v_store(planes->rise_u + first, rise_u);
    hc_v_store(planes->rise_v + first, rise_v);
}

INLINE void take_lanes(hc_choice *chosen, unsigned lanes, int first)
{
    chosen->count += hc_pack_lanes(chosen->number + chosen->count, lanes, LANE_INDEX, first);
}

/* Choose what parts need of a list. From a block's nearest point on, no line rises less than the
 * least slope does. No branch depends on what is found; nobody could predict it. */
INLINE void choose_blocks(kind k, const tile *t, int part, int parts, const hc_node_list *list,
                          hc_choice *chosen, hc_planes *planes)
{
    const float middle = parts == 1 ? 1.5F : MIDDLE;
    const float u      = (float)(t->x + 4 * (part & 1)) + middle;
    const float v      = (float)(t->y + 4 * (part >> 1)) + middle;
    lines       l;
    draw_lines(t, part, parts, &l);
    chosen->count = 0;
    for (int first = 0; first < list->count; first += HC_LANES) {
        const hc_v     gap_u = block_gaps(columns_of(t, list->place + first), u);
        const hc_v     gap_v = block_gaps(rows_of(t, list->place + first), v);
        const bearings b     = take_bearings(k, t, gap_u, gap_v);
        const hc_v     low   = lowest_lines(&l, parts * HC_LANES, &b);
        const unsigned found = hc_v_greater(hc_v_load(list->top + first), low)
                               & useful_lanes(k, t, gap_u, gap_v, list->count - first);
        draw_planes(t, &b, low, hc_v_set(l.least_slope), planes, first);
        take_lanes(chosen, found, first);
    }
}

/* From the tile's middle to sixteen squares: towards their middles, in which direction alone their
 * blocks are measured. The distance, to the nearest corner, may be negative; that covers little, so
 * that vectors are shorter by more than all rounding. */
typedef struct headings {
    bearings to;
    hc_v     step; /* farther away for each block in both directions */
} headings;

INLINE headings take_headings(kind k, const tile *t, hc_v across, hc_v down)
{
    const hc_v shorter = hc_v_set(1.0F - 0x1p-16F);
    const hc_v aspect  = hc_v_set(t->aspect);
    const hc_v rows    = hc_v_mul(down, aspect);
    bearings   to;
    if (k.quadrant) {
        to.unit_u = hc_v_mul(hc_v_set((float)t->pass->sign_u), shorter);
        to.unit_v = hc_v_mul(hc_v_set((float)t->pass->sign_v), shorter);
    } else if (k.diamond) {
        const hc_v eighth = hc_v_set(0.125F);
        to.unit_u         = hc_v_mul(sign_of(hc_v_mul(across, eighth)), shorter);
        to.unit_v         = hc_v_mul(sign_of(hc_v_mul(down, eighth)), shorter);
    } else {
        const hc_v size = hc_v_max(measure(k, across, rows), hc_v_set(0x1p-40F));
        const hc_v root = hc_v_mul(hc_v_about_rsqrt(size), shorter);
        to.unit_u       = hc_v_mul(across, root);
        to.unit_v       = hc_v_mul(rows, root);
    }
    const hc_v v      = hc_v_mul(to.unit_v, aspect);
    const hc_v both   = hc_v_add(hc_v_abs(to.unit_u), hc_v_abs(v));
    const hc_v middle = hc_v_about_muladd(to.unit_u, across, hc_v_mul(v, down));
    to.distance       = hc_v_about_muladd(both, hc_v_set(-0.5F * (SQUARE_SIDE - 1)), middle);
    return (headings){ to, hc_v_max(hc_v_mul(both, hc_v_set(4.0F)), hc_v_set(0x1p-60F)) };
}

/* Squares that a tile needs: those that may hold near blocks, and those that hold distant ones
 * alone. */
typedef struct square_choice {
    hc_choice near, far;
    hc_planes planes;
} square_choice;

/* Choose what a tile needs of the waiting squares, from number `done` on. Level lines are exact
 * only if nothing is added to them. */
INLINE void choose_squares(kind k, const tile *t, const hc_node_list *list, int done,
                           square_choice *chosen)
{
    const hc_v  side = hc_v_set(SQUARE_SIDE);
    const hc_v  u    = hc_v_set(0.5F * (SQUARE_SIDE - 1) - MIDDLE - (float)t->x);
    const hc_v  v    = hc_v_set(0.5F * (SQUARE_SIDE - 1) - MIDDLE - (float)t->y);
    const float most = 2.0F * t->pass->tree->range;
    lines       l;
    draw_lines(t, 0, HC_TILE_PARTS, &l);
    const unsigned rising = l.least_slope > 0.0F ? 0xFFFFU : 0;
    const hc_v     reach  = hc_v_set(HC_NEAR_REACH + 0.5F * (SQUARE_SIDE - 4));
    chosen->near.count = chosen->far.count = 0;
    for (int first = done; first < list->count; first += HC_LANES) {
        const hc_v     across = hc_v_about_muladd(columns_of(t, list->place + first), side, u);
        const hc_v     down   = hc_v_about_muladd(rows_of(t, list->place + first), side, v);
        const headings h      = take_headings(k, t, across, down);
        const chords   c      = draw_chords(&l, &h.to, hc_v_mul(h.step, hc_v_set(3.0F)), most);
        const hc_v     rise   = hc_v_mul(hc_v_about_over(c.rise, h.step), hc_v_set(4.0F / 3.0F));
        const unsigned found =
            hc_v_greater(hc_v_load(list->top + first), c.low) & lanes_left(list->count - first);
        const unsigned near = hc_v_greater(reach, hc_v_max(hc_v_abs(across), hc_v_abs(down)));
        draw_planes(t, &h.to, c.low, hc_v_keep(rising, rise), &chosen->planes, first);
        take_lanes(&chosen->near, found & near, first);
        take_lanes(&chosen->far, found & ~near, first);
    }
}

/* Distant blocks that a part's own envelope does not rule out. Few are left as they are: drawing it
 * takes as long as two times sixteen blocks. For round cones it never pays. */
INLINE const hc_node_list *sift_distant(kind k, const tile *t, int part)
{
    const hc_node_list *list   = &t->scratch->lists[0];
    hc_node_list       *sifted = &t->scratch->sifted;
    if (!k.diamond || list->count <= 2 * HC_LANES) {
        return list;
    }
    const envelope hull = draw_envelope(t, part, 1);
    const hc_v     four = hc_v_set(4.0F);
    const hc_v     x    = hc_v_set((float)(t->x + 4 * (part & 1)));
    const hc_v     y    = hc_v_set((float)(t->y + 4 * (part >> 1)));
    int            n    = 0;
    for (int i = 0; i < list->count; i += HC_LANES) {
        const hc_v across = hc_v_sub(hc_v_mul(columns_of(t, list->place + i), four), x);
        const hc_v down   = hc_v_sub(hc_v_mul(rows_of(t, list->place + i), four), y);
        const hc_v tops   = hc_v_load(list->top + i);
        unsigned   found  = promising(k, t, &hull, 3.0F, across, down, tops);
        found &= lanes_left(list->count - i);
        (void)hc_pack_v(sifted->top + n, found, tops);
        n += hc_pack_lanes(sifted->place + n, found, list->place + i, 0);
    }
    sifted->count = n;
    return sifted;
}

INLINE const float *listed_samples(const tile *t, const hc_node_list *list, int b)
{
    const hc_block_tree *tree  = t->pass->tree;
    const int32_t        place = list->place[b];
    return hc_tree_node(&tree->levels[0], hc_place_x(tree, place), hc_place_y(tree, place));
}

/* Which entries of listed node b rise above its plane. */
INLINE unsigned above_plane(const hc_planes *planes, int b, hc_v tops)
{
    const hc_v row   = hc_v_about_muladd(hc_v_load(COLUMN), hc_v_set(planes->rise_u[b]),
                                         hc_v_set(planes->start[b]));
    const hc_v plane = hc_v_about_muladd(hc_v_load(ROW), hc_v_set(planes->rise_v[b]), row);
    return hc_v_greater(tops, plane);
}

INLINE unsigned samples_above(const tile *t, const hc_planes *planes, int b, const float *samples)
{
    return above_plane(planes, b, hc_v_sub(hc_v_load(samples), hc_v_set(t->pass->tree->base)));
}

/* From the weights of a block's first sample to those of the others. */
enum { NEAR_COLUMN = 4 * HC_NEAR_GROUPS };
static const int32_t NEAR_STEP[16] = {
    0,   NEAR_COLUMN,      2 * NEAR_COLUMN,      3 * NEAR_COLUMN,
    -4,  NEAR_COLUMN - 4,  2 * NEAR_COLUMN - 4,  3 * NEAR_COLUMN - 4,
    -8,  NEAR_COLUMN - 8,  2 * NEAR_COLUMN - 8,  3 * NEAR_COLUMN - 8,
    -12, NEAR_COLUMN - 12, 2 * NEAR_COLUMN - 12, 3 * NEAR_COLUMN - 12
};

/* Samples of all chosen near blocks in one list: its end is the only branch that is hard to
 * predict. */
INLINE void list_near_samples(const tile *t, int part, const hc_node_list *list,
                              const hc_choice *chosen, const hc_planes *planes,
                              hc_near_samples *wanted)
{
    const int x = t->x + 4 * (part & 1);
    const int y = t->y + 4 * (part >> 1);
    int       n = 0;
    for (int i = 0; i < chosen->count; i++) {
        const int      b       = chosen->number[i];
        const float   *samples = listed_samples(t, list, b);
        const unsigned found   = samples_above(t, planes, b, samples);
        const int      column  = 4 * hc_place_x(t->pass->tree, list->place[b]) - x;
        const int      row     = 4 * hc_place_y(t->pass->tree, list->place[b]) - y;
        const float   *weights = hc_near_weights(t->pass->near, column, row);
        (void)hc_pack_v(wanted->heights + n, found, hc_v_load(samples));
        n += hc_pack_lanes(wanted->weights + n, found, NEAR_STEP,
                           (int32_t)(weights - t->pass->near->sample[0][0]));
    }
    for (int i = 0; i < 4; i++) { /* to a multiple of four, with samples that change nothing */
        wanted->heights[n + i] = HC_TREE_OUTSIDE;
        wanted->weights[n + i] = 0;
    }
    wanted->count = n;
}

INLINE void take_near_samples(tile *t, int part, const hc_near_samples *wanted)
{
    const float *table = t->pass->near->sample[0][0];
    hc_v         S[4];
    begin_maxima(t, part, S);
    for (int first = 0; first < wanted->count; first += 4) {
        for (int i = 0; i < 4; i++) {
            S[i] = take_near(S[i], t->height[part], wanted->heights[first + i],
                             table + wanted->weights[first + i]);
        }
    }
    end_maxima(t, part, S);
}

/* Each stage for all parts before the next one begins, whose loops end where this one says: by then
 * that is known, and the processor has not run on for nothing. */
INLINE void search_near(kind k, tile *t)
{
    const hc_node_list *list   = &t->scratch->near;
    hc_near_samples    *wanted = t->scratch->wanted;
    hc_choice           chosen[HC_TILE_PARTS];
    hc_planes           planes[HC_TILE_PARTS];
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        choose_blocks(k, t, part, 1, list, &chosen[part], &planes[part]);
    }
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        list_near_samples(t, part, list, &chosen[part], &planes[part], &wanted[part]);
    }
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        take_near_samples(t, part, &wanted[part]);
    }
}

/* The distant samples of one block that may limit the parts. */
INLINE void take_distant_block(kind k, tile *t, int part, int parts, const hc_node_list *list,
                               int b, unsigned samples)
{
    const float *heights = listed_samples(t, list, b);
    const int    column  = 4 * hc_place_x(t->pass->tree, list->place[b]);
    const int    row     = 4 * hc_place_y(t->pass->tree, list->place[b]);
    for (; samples != 0; samples &= samples - 1) {
        const int i      = __builtin_ctz(samples);
        const int x      = column + COLUMN_INDEX[i];
        const int y      = row + ROW_INDEX[i];
        bool      raised = false;
        for (int p = part; p < part + parts; p++) {
            raised |= take_distant(k, t, p, x, y, heights[i]);
        }
        if (raised && t->home_image) {
            remember(t->scratch, x, y, heights[i]);
        }
    }
}

/* First all chosen blocks, then the few that hold something: again without a branch for each. */
INLINE void search_distant(kind k, tile *t, int part, int parts)
{
    const hc_node_list *list = sift_distant(k, t, part);
    hc_choice           chosen;
    hc_planes           planes;
    unsigned            samples[HC_LIST_ROOM];
    int                 hits = 0;
    choose_blocks(k, t, part, parts, list, &chosen, &planes);
    for (int i = 0; i < chosen.count; i++) {
        const int      b     = chosen.number[i];
        const unsigned found = samples_above(t, &planes, b, listed_samples(t, list, b));
        samples[hits]        = found;
        chosen.number[hits]  = b;
        hits += found != 0;
    }
    for (int i = 0; i < hits; i++) {
        take_distant_block(k, t, part, parts, list, chosen.number[i], samples[i]);
    }
}

/* Part by part: what the parts before have just found raises thresholds too. */
INLINE void search_distant_by_parts(kind k, tile *t)
{
    const unsigned known = t->scratch->recent.next;
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        for (unsigned i = known; i != t->scratch->recent.next; i++) {
            (void)guess_from_recent(k, t, part, (int)(i % HC_RECENT));
        }
        search_distant(k, t, part, 1);
    }
}

/* Near blocks raise the thresholds that let distant blocks be left out. */
INLINE void search_blocks(kind k, tile *t)
{
    search_near(k, t);
    if (k.together) {
        search_distant(k, t, 0, HC_TILE_PARTS);
    } else {
        search_distant_by_parts(k, t);
    }
    t->scratch->near.count = t->scratch->lists[0].count = 0;
    t->stale                                            = true;
}

#endif
