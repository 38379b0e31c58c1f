/* The exact search: for each sample of a tile, the largest rise * weight over all samples of the
 * field. Included by exact_scalar.c, exact_avx2.c and exact_avx512.c, which define HC_EXACT_TILE.
 *
 * Two numbers belong to each sample p while it is searched: S(p), the largest canonical steepness
 * found so far, and a threshold T(p) that is at most the true maximum. A node may be left out only
 * if no sample below it can beat T. Everything that decides about leaving out carries a margin;
 * everything that reaches S is the canonical formula. So the result does not depend on the order of
 * the search, on first guesses or on the instruction set. (docs/algorithms.md, "Exact search".) */
#include "base/simd.h"
#include "canonical.h"
#include "exact_search.h"

/* Relative margin of all bounds: their own rounding is below 2^-20 of the values compared. */
#define LOWER (1.0F - 0x1p-18F)

/* The lower envelopes are piecewise linear in the distance, with pieces that end at powers of two.
 * Distances are measured in columns (one unit: step_u). */
enum { PIECE_SHIFT = 23, PIECE_FIRST = 126 };

static const float COLUMN[16] = { 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3 };
static const float ROW[16]    = { 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3 };

static const int32_t LANE_INDEX[16]   = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
static const int32_t COLUMN_INDEX[16] = { 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3 };
static const int32_t ROW_INDEX[16]    = { 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3 };

/* Ends of the pieces [columns]. The last one is open: it ends farther away than any field is
 * large. */
static const float PIECE_ENDS[17] = { 0x0p0F,  0x1p0F,  0x1p1F,  0x1p2F,  0x1p3F, 0x1p4F,
                                      0x1p5F,  0x1p6F,  0x1p7F,  0x1p8F,  0x1p9F, 0x1p10F,
                                      0x1p11F, 0x1p12F, 0x1p13F, 0x1p14F, 0x1p40F };

/* A lower bound of height(p) + T(p) * distance for all p of a set of samples, piecewise linear. */
typedef struct envelope {
    hc_v offsets, slopes;
} envelope;

typedef struct tile {
    const hc_exact_pass *pass;
    hc_exact_scratch    *scratch;
    float                aspect; /* step_v / step_u                                            */
    int                  x, y;   /* first sample, as seen from the image being searched        */
    bool     home_image;         /* searching the field itself, not one of its periodic images */
    bool     stale;              /* thresholds rose since `hull` was drawn                     */
    envelope hull;               /* of all parts                                               */
    hc_v     height[HC_TILE_PARTS];
    hc_v     lifted[HC_TILE_PARTS]; /* height - tree->base, to compare with maxima      */
    hc_v     S[HC_TILE_PARTS];
    hc_v     T[HC_TILE_PARTS];
} tile;

/* Samples outside the field count as higher than all: nothing limits them. */
#define ABOVE_ALL 4.0F

/* The kind of search; constant where the kernel is compiled, so that its branches vanish. */
typedef struct kind {
    bool diamond, quadrant;
} kind;

#ifndef INLINE
#define INLINE static inline __attribute__((always_inline))
#endif

/* Offsets in columns and rows (rows scaled to columns) to what T is compared on: the square of the
 * distance for round cones, the distance for diamonds. */
INLINE hc_v measure(kind k, hc_v across, hc_v down)
{
    return k.diamond ? hc_v_add(across, down)
                     : hc_v_about_muladd(across, across, hc_v_mul(down, down));
}

/* The least of height(p) + T(p) * distance is a concave function of the distance: between two ends
 * it lies above its chord. So one multiply-add bounds many samples at once, and far more tightly
 * than the lowest height with the least T would. */
INLINE envelope draw_envelope(const tile *t, int first_part, int parts)
{
    const hc_exact_pass *pass     = t->pass;
    const hc_v           start    = hc_v_load(PIECE_ENDS);
    const hc_v           end      = hc_v_load(PIECE_ENDS + 1);
    const hc_v           most     = hc_v_set(2.0F * pass->tree->range); /* keeps chords precise */
    hc_v                 lows[4]  = { most, most, most, most }; /* short chains, as in take_near */
    hc_v                 highs[4] = { most, most, most, most };
    for (int part = first_part; part < first_part + parts; part++) {
        float heights[HC_LANES], rises[HC_LANES];
        hc_v_store(heights, t->lifted[part]);
        hc_v_store(rises, hc_v_mul(t->T[part], hc_v_set(pass->step_u)));
        for (int p = 0; p < HC_LANES; p++) {
            const hc_v height = hc_v_set(heights[p]);
            const hc_v rise   = hc_v_set(rises[p]);
            lows[p % 4]       = hc_v_min(hc_v_about_muladd(rise, start, height), lows[p % 4]);
            highs[p % 4]      = hc_v_min(hc_v_about_muladd(rise, end, height), highs[p % 4]);
        }
    }
    const hc_v low    = hc_v_min(hc_v_min(lows[0], lows[1]), hc_v_min(lows[2], lows[3]));
    const hc_v high   = hc_v_min(hc_v_min(highs[0], highs[1]), hc_v_min(highs[2], highs[3]));
    const hc_v margin = hc_v_set(pass->tree->range * 0x1p-19F);
    envelope   drawn;
    drawn.slopes  = hc_v_div(hc_v_sub(high, low), hc_v_sub(end, start));
    drawn.offsets = hc_v_sub(hc_v_sub(low, hc_v_mul(drawn.slopes, start)), margin);
    return drawn;
}

/* Which of sixteen squares, `side` samples large, may hold something for the `extent` x `extent`
 * samples below the envelope. across, down: from their first sample to the squares' first ones;
 * tops: the squares' highest samples, minus base. */
INLINE unsigned promising(kind k, const tile *t, const envelope *hull, hc_v across, hc_v down,
                          hc_v tops, int extent, int side)
{
    /* gaps: from the samples' last to the squares' first, and from the squares' last to the
     * samples' first; one of them is negative */
    const hc_v zero   = hc_v_set(0.0F);
    const hc_v last   = hc_v_set((float)(extent - 1));
    const hc_v reach  = hc_v_set((float)(1 - side));
    const hc_v after  = hc_v_sub(across, last);
    const hc_v before = hc_v_sub(reach, across);
    const hc_v below  = hc_v_sub(down, last);
    const hc_v above  = hc_v_sub(reach, down);
    const hc_v gap_u  = hc_v_max(hc_v_max(after, before), zero);
    const hc_v gap_v  = hc_v_mul(hc_v_max(hc_v_max(below, above), zero), hc_v_set(t->aspect));
    const hc_v size   = measure(k, gap_u, gap_v);
    const hc_v bound =
        hc_v_about_line(hull->offsets, hull->slopes, k.diamond ? size : hc_v_about_sqrt(size),
                        PIECE_SHIFT, PIECE_FIRST);
    unsigned found = hc_v_greater(tops, bound);
    if (k.quadrant) {
        found &= ~hc_v_greater(t->pass->sign_u > 0 ? before : after, zero);
        found &= ~hc_v_greater(t->pass->sign_v > 0 ? above : below, zero);
    }
    return found;
}

/* ---- samples against samples ---- */

/* A near block against one part: no tests, the table holds the canonical weights. Columns keep
 * maxima of their own, since one chain of sixteen maxima would take longer than all the rest.
 * The order of hc_v_max matters: rise * 0 may be -0, which must not replace S. */
INLINE hc_v take_near(hc_v S, hc_v height, const hc_near_table *table, const float *samples, int dx,
                      int dy)
{
    hc_v columns[4] = { S, S, S, S };
    for (int c = 0; c < 4; c++) {
        const float *weights = hc_near_weights(table, dx + c, dy);
        for (int r = 0; r < 4; r++) {
            const hc_v rise = hc_v_sub(hc_v_set(samples[4 * r + c]), height);
            columns[c]      = hc_v_max(hc_v_mul(rise, hc_v_load(weights - 4 * r)), columns[c]);
        }
    }
    return hc_v_max(hc_v_max(columns[0], columns[1]), hc_v_max(columns[2], columns[3]));
}

INLINE hc_v part_columns(const tile *t, int part)
{
    return hc_v_add(hc_v_load(COLUMN), hc_v_set((float)(t->x + 4 * (part & 1))));
}

INLINE hc_v part_rows(const tile *t, int part)
{
    return hc_v_add(hc_v_load(ROW), hc_v_set((float)(t->y + 4 * (part >> 1))));
}

/* Lanes from which an offset of (across, down) samples lies in the quadrant. */
INLINE unsigned in_quadrant(const hc_exact_pass *pass, hc_v across, hc_v down)
{
    const hc_v zero = hc_v_set(0.0F);
    return ~(hc_v_greater(zero, hc_v_mul(across, hc_v_set((float)pass->sign_u)))
             | hc_v_greater(zero, hc_v_mul(down, hc_v_set((float)pass->sign_v))));
}

INLINE hc_v canonical_weight(kind k, const hc_exact_pass *pass, hc_v across, hc_v down)
{
    const hc_v x = hc_v_mul(hc_v_abs(across), hc_v_set(pass->step_u));
    const hc_v y = hc_v_mul(hc_v_abs(down), hc_v_set(pass->step_v));
    const hc_v distance =
        k.diamond ? hc_v_add(x, y) : hc_v_sqrt(hc_v_add(hc_v_mul(x, x), hc_v_mul(y, y)));
    return hc_v_div(hc_v_set(1.0F), distance);
}

/* Which lanes may gain from a rise at these offsets: where it is above slope (T per column) *
 * distance. */
INLINE unsigned may_gain(kind k, const tile *t, hc_v slope, hc_v rise, hc_v across, hc_v down)
{
    const hc_v size = measure(k, across, hc_v_mul(down, hc_v_set(t->aspect)));
    return k.diamond ? hc_v_greater(rise, hc_v_mul(slope, size))
                     : hc_v_greater(hc_v_mul(rise, rise), hc_v_mul(hc_v_mul(slope, slope), size));
}

/* What S has become lets T rise. */
INLINE void raise_threshold(tile *t, int part)
{
    t->T[part] = hc_v_max(hc_v_mul(t->S[part], hc_v_set(LOWER)), t->T[part]);
}

/* One distant sample against one part. True if it raised S somewhere. */
INLINE bool take_distant(kind k, tile *t, int part, int x, int y, float height)
{
    const hc_v rise   = hc_v_max(hc_v_sub(hc_v_set(height), t->height[part]), hc_v_set(0.0F));
    const hc_v across = hc_v_sub(hc_v_set((float)x), part_columns(t, part));
    const hc_v down   = hc_v_sub(hc_v_set((float)y), part_rows(t, part));
    const hc_v slope  = hc_v_mul(t->T[part], hc_v_set(t->pass->step_u));
    unsigned   better = may_gain(k, t, slope, rise, hc_v_abs(across), hc_v_abs(down));
    if (k.quadrant) {
        better &= in_quadrant(t->pass, across, down);
    }
    if (better == 0) {
        return false;
    }
    const hc_v steepness = hc_v_mul(rise, canonical_weight(k, t->pass, across, down));
    t->S[part]           = hc_v_max(hc_v_keep(better, steepness), t->S[part]);
    raise_threshold(t, part);
    return true;
}

/* A real sample's steepness, lowered, is a threshold: first guesses for the tile. */
INLINE void guess_from_recent(kind k, tile *t)
{
    const hc_exact_pass    *pass    = t->pass;
    const hc_exact_scratch *scratch = t->scratch;
    const float             unit    = LOWER / pass->step_u;
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        const hc_v zero    = hc_v_set(0.0F);
        const hc_v columns = part_columns(t, part);
        const hc_v rows    = part_rows(t, part);
        hc_v       best    = zero;
        for (int i = 0; i < HC_RECENT; i++) {
            const hc_v across = hc_v_sub(hc_v_set(scratch->recent_x[i]), columns);
            const hc_v down   = hc_v_sub(hc_v_set(scratch->recent_y[i]), rows);
            const hc_v size =
                measure(k, hc_v_abs(across), hc_v_mul(hc_v_abs(down), hc_v_set(t->aspect)));
            hc_v rise =
                hc_v_max(hc_v_sub(hc_v_set(scratch->recent_height[i]), t->height[part]), zero);
            if (k.quadrant) {
                rise = hc_v_keep(in_quadrant(pass, across, down), rise);
            }
            const hc_v power = k.diamond ? rise : hc_v_mul(rise, rise);
            best             = hc_v_max(hc_v_div(power, size), best); /* 0 / 0 keeps best */
        }
        const hc_v slope = k.diamond ? best : hc_v_sqrt(best);
        t->T[part]       = hc_v_max(hc_v_mul(slope, hc_v_set(unit)), t->T[part]);
    }
}

/* First in, first out; but one that limits again when its turn has come stays. */
static void remember(hc_exact_scratch *scratch, int x, int y, float height)
{
    int known = -1;
    for (int i = 0; i < HC_RECENT; i++) {
        known = scratch->recent_x[i] == (float)x && scratch->recent_y[i] == (float)y ? i : known;
    }
    const int oldest = (int)(scratch->recent_next % HC_RECENT);
    if (known < 0) {
        scratch->recent_x[oldest]      = (float)x;
        scratch->recent_y[oldest]      = (float)y;
        scratch->recent_height[oldest] = height;
    }
    scratch->recent_next += known < 0 || known == oldest;
}

/* ---- blocks ---- */

/* Can a near block hold something for the part? dx, dy: from the part's first sample to its. */
INLINE bool near_needed(const tile *t, int part, int dx, int dy, float top)
{
    const hc_near_table *table = t->pass->near;
    const float *weights  = table->block[dy / 4 + HC_NEAR_REACH / 4][dx / 4 + HC_NEAR_REACH / 4];
    const hc_v   generous = hc_v_set(top + t->pass->tree->range * 0x1p-19F);
    const hc_v   rise     = hc_v_sub(generous, t->lifted[part]);
    return hc_v_greater(hc_v_mul(rise, hc_v_load(weights)), t->T[part]) != 0;
}

/* Gaps from samples at `from` to the block's four columns (rows) from `first` on. */
INLINE hc_v block_gap(hc_v from, int first)
{
    const hc_v after  = hc_v_sub(hc_v_set((float)first), from);
    const hc_v before = hc_v_sub(from, hc_v_set((float)(first + 3)));
    return hc_v_max(hc_v_max(after, before), hc_v_set(0.0F));
}

/* -1 or 1, for offsets half-way between samples. */
INLINE hc_v sign_of(hc_v offset)
{
    const hc_v one = hc_v_set(1.0F);
    return hc_v_max(hc_v_min(hc_v_mul(offset, hc_v_set(2.0F)), one), hc_v_sub(hc_v_set(0.0F), one));
}

/* Which rows of a distant block hold samples that the part may gain from.
 * T * distance is convex, so it lies above its tangent plane at the block's middle. With the plane,
 * a pair costs a multiply-add, a subtraction and a maximum. The middle lies half-way between
 * samples: no offset to it is 0, and a diamond's gradient is a sign. */
INLINE unsigned promising_rows(kind k, const tile *t, int part, int x, int y, const float *samples)
{
    const float range  = t->pass->tree->range;
    const hc_v  slope  = hc_v_mul(t->T[part], hc_v_set(t->pass->step_u));
    const hc_v  across = hc_v_sub(hc_v_set((float)x + 1.5F), part_columns(t, part));
    const hc_v  rows   = hc_v_sub(hc_v_set((float)y + 1.5F), part_rows(t, part));
    const hc_v  down   = hc_v_mul(rows, hc_v_set(t->aspect));
    const hc_v  size   = measure(k, hc_v_abs(across), hc_v_abs(down));
    const hc_v  unit   = hc_v_about_rsqrt(size);
    const hc_v  length = k.diamond ? size : hc_v_mul(size, unit);
    const hc_v  per_u  = k.diamond ? sign_of(across) : hc_v_mul(across, unit);
    const hc_v  per_v  = k.diamond ? sign_of(rows) : hc_v_mul(down, unit);
    const hc_v  rise_u = hc_v_mul(slope, per_u);
    const hc_v  rise_v = hc_v_mul(hc_v_mul(slope, per_v), hc_v_set(t->aspect));
    const hc_v  height = hc_v_sub(t->lifted[part], hc_v_set(range * 0x1p-19F));
    /* The plane's terms cancel where the field is much finer along one axis: their rounding is
     * relative to the middle's distance, and so is this margin. */
    const hc_v middle = hc_v_about_muladd(slope, hc_v_mul(length, hc_v_set(LOWER)), height);
    float      tops[HC_LANES];
    hc_v_store(tops, hc_v_sub(hc_v_load(samples), hc_v_set(t->pass->tree->base)));
    hc_v above[4]; /* highest rise of each row above the plane */
    for (int r = 0; r < 4; r++) {
        above[r] = hc_v_set(-1.0F);
    }
    for (int c = 0; c < 4; c++) {
        const hc_v column = hc_v_about_muladd(rise_u, hc_v_set((float)c - 1.5F), middle);
        for (int r = 0; r < 4; r++) {
            above[r] = hc_v_max(hc_v_sub(hc_v_set(tops[4 * r + c]), column), above[r]);
        }
    }
    for (int r = 0; r < 4; r++) {
        above[r] = hc_v_sub(above[r], hc_v_mul(rise_v, hc_v_set((float)r - 1.5F)));
    }
    const hc_v zero       = hc_v_set(0.0F);
    const hc_v most       = hc_v_max(hc_v_max(above[0], above[1]), hc_v_max(above[2], above[3]));
    unsigned   rows_found = 0;
    if (hc_v_greater(most, zero) != 0) {
        for (int r = 0; r < 4; r++) {
            rows_found |= (hc_v_greater(above[r], zero) != 0 ? 0xFU : 0U) << (4 * r);
        }
    }
    return rows_found;
}

/* Can a distant block hold something for the part? */
INLINE bool distant_needed(kind k, const tile *t, int part, int x, int y, float top)
{
    const hc_v generous = hc_v_set(top + t->pass->tree->range * 0x1p-19F);
    const hc_v rise     = hc_v_max(hc_v_sub(generous, t->lifted[part]), hc_v_set(0.0F));
    const hc_v slope    = hc_v_mul(t->T[part], hc_v_set(t->pass->step_u));
    return may_gain(k, t, slope, rise, block_gap(part_columns(t, part), x),
                    block_gap(part_rows(t, part), y))
           != 0;
}

INLINE void search_distant_block(kind k, tile *t, int part, int x, int y, const float *samples)
{
    unsigned found = promising_rows(k, t, part, x, y, samples);
    for (; found != 0; found &= found - 1) {
        const int i        = __builtin_ctz(found);
        const int sample_x = x + COLUMN_INDEX[i];
        const int sample_y = y + ROW_INDEX[i];
        if (take_distant(k, t, part, sample_x, sample_y, samples[i]) && t->home_image) {
            remember(t->scratch, sample_x, sample_y, samples[i]);
        }
    }
}

/* Offsets from a part's first sample to sixteen listed blocks. */
typedef struct offsets {
    hc_v     across, down;
    unsigned listed; /* lanes that hold one */
} offsets;

INLINE offsets block_offsets(const tile *t, int part, const hc_node_list *list, int first)
{
    const hc_v four = hc_v_set(4.0F);
    const hc_v x    = hc_v_set((float)(t->x + 4 * (part & 1)));
    const hc_v y    = hc_v_set((float)(t->y + 4 * (part >> 1)));
    const int  left = list->count - first;
    offsets    o;
    o.across = hc_v_sub(hc_v_mul(hc_v_from_ints(list->x + first), four), x);
    o.down   = hc_v_sub(hc_v_mul(hc_v_from_ints(list->y + first), four), y);
    o.listed = left >= HC_LANES ? 0xFFFFU : (1U << left) - 1;
    return o;
}

/* The part's own block and those next to it have been searched before. */
INLINE unsigned known_lanes(const tile *t, const offsets *o)
{
    const hc_v far = hc_v_max(hc_v_abs(o->across), hc_v_abs(o->down));
    return hc_v_greater(hc_v_set(t->home_image ? 5.0F : 0.0F), far);
}

/* Listed blocks that one part still needs, as indices into the list. */
typedef struct choice {
    int     count;
    int32_t blocks[HC_LIST + 32];
} choice;

/* By the envelope, sixteen at a time, then one by one; they are looked into later. No branch depends
 * on what is found: nobody could predict it. */
INLINE void choose_blocks(kind k, const tile *t, int part, const hc_node_list *list, bool near,
                          choice *chosen)
{
    const envelope hull     = draw_envelope(t, part, 1);
    const int      x        = t->x + 4 * (part & 1);
    const int      y        = t->y + 4 * (part >> 1);
    int            promised = 0;
    for (int first = 0; first < list->count; first += HC_LANES) {
        const offsets  o     = block_offsets(t, part, list, first);
        const hc_v     tops  = hc_v_load(list->top + first);
        const unsigned found = promising(k, t, &hull, o.across, o.down, tops, 4, 4) & o.listed;
        promised += hc_pack_lanes(chosen->blocks + promised, found & ~known_lanes(t, &o),
                                  LANE_INDEX, first);
    }
    chosen->count = 0;
    for (int i = 0; i < promised; i++) {
        const int b                   = chosen->blocks[i];
        chosen->blocks[chosen->count] = b;
        chosen->count +=
            near ? near_needed(t, part, 4 * list->x[b] - x, 4 * list->y[b] - y, list->top[b])
                 : distant_needed(k, t, part, 4 * list->x[b], 4 * list->y[b], list->top[b]);
    }
}

INLINE void search_near(kind k, tile *t, int part)
{
    const hc_node_list *list = &t->scratch->near;
    const int           x    = t->x + 4 * (part & 1);
    const int           y    = t->y + 4 * (part >> 1);
    hc_v                S    = t->S[part];
    choice              chosen;
    choose_blocks(k, t, part, list, true, &chosen);
    for (int i = 0; i < chosen.count; i++) {
        const int b = chosen.blocks[i];
        S           = take_near(S, t->height[part], t->pass->near,
                                hc_tree_node(&t->pass->tree->levels[0], list->x[b], list->y[b]),
                                4 * list->x[b] - x, 4 * list->y[b] - y);
    }
    t->S[part] = S;
    raise_threshold(t, part);
}

INLINE void search_distant(kind k, tile *t, int part)
{
    const hc_node_list *list = &t->scratch->lists[0];
    choice              chosen;
    choose_blocks(k, t, part, list, false, &chosen);
    for (int i = 0; i < chosen.count; i++) {
        const int b = chosen.blocks[i];
        search_distant_block(k, t, part, 4 * list->x[b], 4 * list->y[b],
                             hc_tree_node(&t->pass->tree->levels[0], list->x[b], list->y[b]));
    }
}

INLINE void search_blocks(kind k, tile *t)
{
    for (int part = 0; part < HC_TILE_PARTS; part++) {
        search_near(k, t, part); /* raises the thresholds that let distant blocks be left out */
        search_distant(k, t, part);
    }
    t->scratch->near.count = t->scratch->lists[0].count = 0;
    t->stale                                            = true;
}

/* ---- the tree ---- */

INLINE void list_children(hc_node_list *list, unsigned found, int x, int y, const float *entries)
{
    const int at = list->count;
    (void)hc_pack_lanes(list->x + at, found, COLUMN_INDEX, 4 * x);
    (void)hc_pack_floats(list->top + at, found, entries);
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

/* Sixteen children of one node: those that may hold something join the list of the level below. */
INLINE void search_node(kind k, const tile *t, int level, int x, int y, hc_node_list *below)
{
    const float *entries = hc_tree_node(&t->pass->tree->levels[level], x, y);
    const int    side    = 1 << (2 * level);
    const hc_v   size    = hc_v_set((float)side);
    const hc_v   across =
        hc_v_about_muladd(hc_v_load(COLUMN), size, hc_v_set((float)(4 * x * side - t->x)));
    const hc_v down =
        hc_v_about_muladd(hc_v_load(ROW), size, hc_v_set((float)(4 * y * side - t->y)));
    const unsigned found =
        promising(k, t, &t->hull, across, down, hc_v_load(entries), HC_TILE_SIDE, side);
    const unsigned near = level == 1 ? near_lanes(t, across, down) : 0;
    if ((found & near) != 0) {
        list_children(&t->scratch->near, found & near, x, y, entries);
    }
    list_children(below, found & ~near, x, y, entries);
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
        if (t->stale) {
            t->hull  = draw_envelope(t, 0, HC_TILE_PARTS);
            t->stale = false;
        }
        while (done[level] < list->count && below->count <= HC_LIST) {
            const int i = done[level]++;
            search_node(k, t, level, list->x[i], list->y[i], below);
        }
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
        for (int dy = -1; dy <= 1; dy++) {
            for (int dx = -1; dx <= 1; dx++) {
                if (x + dx >= 0 && y + dy >= 0 && x + dx < blocks->columns
                    && y + dy < blocks->rows) {
                    const float *samples = hc_tree_node(blocks, x + dx, y + dy);
                    t->S[part] = take_near(t->S[part], t->height[part], t->pass->near, samples,
                                           4 * dx, 4 * dy);
                }
            }
        }
        t->T[part] = hc_v_mul(t->S[part], hc_v_set(LOWER));
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
    guess_from_recent(k, &t);
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
