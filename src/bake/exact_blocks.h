/* Listed blocks against the parts of a tile: which blocks, and which of their samples, a part must
 * look at. Part of exact_kernel.h. (docs/algorithms.md, "Exact search".) */
#ifndef HC_BAKE_EXACT_BLOCKS_H
#define HC_BAKE_EXACT_BLOCKS_H

#include "exact_hull.h"
#include "exact_samples.h"

/* What a part's samples say about places at a distance along a unit vector, both measured from the
 * part's middle: to be useful, a place must rise above
 *   height + slope * distance + lean_u * unit_u + lean_v * unit_v
 * of one of the samples. */
typedef struct lines {
    float height[HC_LANES], slope[HC_LANES], lean_u[HC_LANES], lean_v[HC_LANES];
    float least_slope; /* of the samples that something can limit */
} lines;

INLINE void draw_lines(const tile *t, int part, lines *l)
{
    const hc_v     middle = hc_v_set(1.5F);
    const hc_v     slope  = hc_v_mul(t->T[part], hc_v_set(t->pass->step_u));
    const hc_v     rows   = hc_v_mul(slope, hc_v_set(t->aspect));
    const unsigned rising = hc_v_greater(slope, hc_v_set(0.0F)); /* level lines are exact */
    const hc_v     margin = hc_v_keep(rising, hc_v_set(t->pass->tree->range * 0x1p-19F));
    hc_v_store(l->height, hc_v_sub(t->lifted[part], margin));
    hc_v_store(l->slope, slope);
    hc_v_store(l->lean_u, hc_v_mul(slope, hc_v_sub(middle, hc_v_load(COLUMN))));
    hc_v_store(l->lean_v, hc_v_mul(rows, hc_v_sub(middle, hc_v_load(ROW))));
    const unsigned limited = hc_v_greater(hc_v_set(0.5F * ABOVE_ALL), t->lifted[part]);
    l->least_slope         = hc_v_lowest(hc_v_pick(limited, slope, hc_v_set(0x1p60F)));
}

/* From a part's middle to the nearest points of sixteen blocks. */
typedef struct bearings {
    hc_v unit_u, unit_v, distance;
} bearings;

/* The lowest of a part's lines at the blocks' nearest points. Not inline: compilers would broadcast
 * all lines into memory before the loop over the list, which is short. */
static __attribute__((noinline)) hc_v lowest_lines(const lines *l, const bearings *b)
{
    const hc_v above   = hc_v_set(ABOVE_ALL);
    hc_v       lows[2] = { above, above }; /* short chains: min takes a while */
    for (int p = 0; p < HC_LANES; p++) {
        hc_v v      = hc_v_about_muladd(b->distance, hc_v_set(l->slope[p]), hc_v_set(l->height[p]));
        v           = hc_v_about_muladd(b->unit_u, hc_v_set(l->lean_u[p]), v);
        v           = hc_v_about_muladd(b->unit_v, hc_v_set(l->lean_v[p]), v);
        lows[p % 2] = hc_v_min(v, lows[p % 2]);
    }
    return hc_v_min(lows[0], lows[1]);
}

/* Gaps from a part's middle to sixteen listed blocks, in columns or rows; negative to the left and
 * above. They are 0 or at least 1/2. */
INLINE hc_v block_gaps(const int32_t *blocks, float middle)
{
    const hc_v zero  = hc_v_set(0.0F);
    const hc_v four  = hc_v_set(4.0F);
    const hc_v index = hc_v_from_ints(blocks);
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
    unsigned   useful = left >= HC_LANES ? 0xFFFFU : (1U << left) - 1;
    useful &= ~hc_v_greater(known, hc_v_max(hc_v_abs(gap_u), hc_v_abs(gap_v)));
    if (k.quadrant) {
        const hc_v beyond = hc_v_set(-1.5F); /* the part's last samples */
        useful &= ~hc_v_greater(beyond, hc_v_mul(gap_u, hc_v_set((float)t->pass->sign_u)));
        useful &= ~hc_v_greater(beyond, hc_v_mul(gap_v, hc_v_set((float)t->pass->sign_v)));
    }
    return useful;
}

/* Choose what a part needs of a list. From a block's nearest point on, no line rises less than the
 * least slope does, which makes a plane over the block's samples. No branch depends on what is
 * found; nobody could predict it. */
INLINE void choose_blocks(kind k, const tile *t, int part, const hc_node_list *list,
                          hc_block_choice *chosen)
{
    const hc_v  zero = hc_v_set(0.0F);
    const float u    = (float)(t->x + 4 * (part & 1)) + 1.5F;
    const float v    = (float)(t->y + 4 * (part >> 1)) + 1.5F;
    lines       l;
    draw_lines(t, part, &l);
    const hc_v rise = hc_v_set(l.least_slope);
    chosen->count   = 0;
    for (int first = 0; first < list->count; first += HC_LANES) {
        const hc_v     gap_u  = block_gaps(list->x + first, u);
        const hc_v     gap_v  = block_gaps(list->y + first, v);
        const bearings b      = take_bearings(k, t, gap_u, gap_v);
        const hc_v     low    = lowest_lines(&l, &b);
        const hc_v     rise_u = hc_v_mul(rise, b.unit_u);
        const hc_v     rise_v = hc_v_mul(rise, hc_v_mul(b.unit_v, hc_v_set(t->aspect)));
        const hc_v     back   = hc_v_add(hc_v_min(rise_u, zero), hc_v_min(rise_v, zero));
        const unsigned found  = hc_v_greater(hc_v_load(list->top + first), low)
                               & useful_lanes(k, t, gap_u, gap_v, list->count - first);
        hc_v_store(chosen->start + first, hc_v_about_muladd(back, hc_v_set(-3.0F), low));
        hc_v_store(chosen->rise_u + first, rise_u);
        hc_v_store(chosen->rise_v + first, rise_v);
        chosen->count += hc_pack_lanes(chosen->blocks + chosen->count, found, LANE_INDEX, first);
    }
}

/* Distant blocks that a part's own envelope does not rule out. Few are left as they are: drawing it
 * takes as long as two times sixteen blocks. */
INLINE const hc_node_list *sift_distant(kind k, const tile *t, int part)
{
    const hc_node_list *list   = &t->scratch->lists[0];
    hc_node_list       *sifted = &t->scratch->sifted;
    if (list->count <= 2 * HC_LANES) {
        return list;
    }
    const envelope hull = draw_envelope(t, part, 1);
    const hc_v     four = hc_v_set(4.0F);
    const hc_v     x    = hc_v_set((float)(t->x + 4 * (part & 1)));
    const hc_v     y    = hc_v_set((float)(t->y + 4 * (part >> 1)));
    int            n    = 0;
    for (int i = 0; i < list->count; i += HC_LANES) {
        const hc_v across = hc_v_sub(hc_v_mul(hc_v_from_ints(list->x + i), four), x);
        const hc_v down   = hc_v_sub(hc_v_mul(hc_v_from_ints(list->y + i), four), y);
        const hc_v tops   = hc_v_load(list->top + i);
        unsigned   found  = promising(k, t, &hull, 4, across, down, tops, 4);
        found &= lanes_left(list->count - i);
        (void)hc_pack_lanes(sifted->x + n, found, list->x + i, 0);
        (void)hc_pack_v(sifted->top + n, found, tops);
        n += hc_pack_lanes(sifted->y + n, found, list->y + i, 0);
    }
    sifted->count = n;
    return sifted;
}

INLINE const float *listed_samples(const tile *t, const hc_node_list *list, int b)
{
    return hc_tree_node(&t->pass->tree->levels[0], list->x[b], list->y[b]);
}

/* Which samples of listed block b rise above its plane. */
INLINE unsigned samples_above(const tile *t, const hc_block_choice *chosen, int b,
                              const float *samples)
{
    const hc_v tops  = hc_v_sub(hc_v_load(samples), hc_v_set(t->pass->tree->base));
    const hc_v row   = hc_v_about_muladd(hc_v_load(COLUMN), hc_v_set(chosen->rise_u[b]),
                                         hc_v_set(chosen->start[b]));
    const hc_v plane = hc_v_about_muladd(hc_v_load(ROW), hc_v_set(chosen->rise_v[b]), row);
    return hc_v_greater(tops, plane);
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
                              const hc_block_choice *chosen, hc_near_samples *wanted)
{
    const int x = t->x + 4 * (part & 1);
    const int y = t->y + 4 * (part >> 1);
    int       n = 0;
    for (int i = 0; i < chosen->count; i++) {
        const int      b       = chosen->blocks[i];
        const float   *samples = listed_samples(t, list, b);
        const unsigned found   = samples_above(t, chosen, b, samples);
        const float   *weights =
            hc_near_weights(t->pass->near, 4 * list->x[b] - x, 4 * list->y[b] - y);
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

INLINE void search_near(kind k, tile *t, int part)
{
    hc_near_samples    *wanted = &t->scratch->wanted;
    const float        *table  = t->pass->near->sample[0][0];
    hc_v                S[4];
    hc_block_choice     chosen;
    const hc_node_list *list = &t->scratch->near;
    choose_blocks(k, t, part, list, &chosen);
    list_near_samples(t, part, list, &chosen, wanted);
    begin_maxima(t, part, S);
    for (int first = 0; first < wanted->count; first += 4) {
        for (int i = 0; i < 4; i++) {
            S[i] = take_near(S[i], t->height[part], wanted->heights[first + i],
                             table + wanted->weights[first + i]);
        }
    }
    end_maxima(t, part, S);
}

/* The distant samples of one block that may limit the part. */
INLINE void take_distant_block(kind k, tile *t, int part, const hc_node_list *list, int b,
                               unsigned samples)
{
    const float *heights = listed_samples(t, list, b);
    for (; samples != 0; samples &= samples - 1) {
        const int i = __builtin_ctz(samples);
        const int x = 4 * list->x[b] + COLUMN_INDEX[i];
        const int y = 4 * list->y[b] + ROW_INDEX[i];
        if (take_distant(k, t, part, x, y, heights[i]) && t->home_image) {
            remember(t->scratch, x, y, heights[i]);
        }
    }
}

/* First all chosen blocks, then the few that hold something: again without a branch for each. */
INLINE void search_distant(kind k, tile *t, int part)
{
    const hc_node_list *list = sift_distant(k, t, part);
    hc_block_choice     chosen;
    unsigned            samples[HC_LIST_ROOM];
    int                 hits = 0;
    choose_blocks(k, t, part, list, &chosen);
    for (int i = 0; i < chosen.count; i++) {
        const int      b     = chosen.blocks[i];
        const unsigned found = samples_above(t, &chosen, b, listed_samples(t, list, b));
        samples[hits]        = found;
        chosen.blocks[hits]  = b;
        hits += found != 0;
    }
    for (int i = 0; i < hits; i++) {
        take_distant_block(k, t, part, list, chosen.blocks[i], samples[i]);
    }
}

/* Near blocks raise the thresholds that let distant blocks be left out, and so does what the parts
 * before have just found. */
INLINE void search_blocks(kind k, tile *t)
{
    const unsigned known = t->scratch->recent.next;
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        search_near(k, t, part);
        for (unsigned i = known; i != t->scratch->recent.next; i++) {
            (void)guess_from_recent(k, t, part, (int)(i % HC_RECENT));
        }
        search_distant(k, t, part);
    }
    t->scratch->near.count = t->scratch->lists[0].count = 0;
    t->stale                                            = true;
}

#endif
