/* Samples of the field against the sixteen samples of a part. Part of exact_kernel.h. */
#ifndef HC_BAKE_EXACT_SAMPLES_H
#define HC_BAKE_EXACT_SAMPLES_H

#include "exact_tile.h"

/* One near sample against one part: no test, `weights` are the canonical ones. The order of
 * hc_v_max matters: rise * 0 may be -0, which must not replace S. */
INLINE hc_v take_near(hc_v S, hc_v height, float sample, const float *weights)
{
    const hc_v rise = hc_v_sub(hc_v_set(sample), height);
    return hc_v_max(hc_v_mul(rise, hc_v_load(weights)), S);
}

/* Four maxima in turn begin with S and end in S, which lets T rise: one chain would take longer
 * than all the rest. */
INLINE void begin_maxima(const tile *t, int part, hc_v S[4])
{
    for (int i = 0; i < 4; i++) {
        S[i] = t->S[part];
    }
}

INLINE void end_maxima(tile *t, int part, const hc_v S[4])
{
    t->S[part] = hc_v_max(hc_v_max(S[0], S[1]), hc_v_max(S[2], S[3]));
    raise_threshold(t, part);
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

/* A real sample's steepness, lowered, is a threshold: a guess from recent limit number i. True if
 * it raised the threshold of a sample of the part. */
INLINE bool guess_from_recent(kind k, tile *t, int part, int i)
{
    const hc_exact_pass    *pass    = t->pass;
    const hc_exact_scratch *scratch = t->scratch;
    const hc_v across = hc_v_sub(hc_v_set(scratch->recent.x[i]), part_columns(t, part));
    const hc_v below  = hc_v_sub(hc_v_set(scratch->recent.y[i]), part_rows(t, part));
    const hc_v down   = hc_v_mul(below, hc_v_set(t->aspect));
    const hc_v size =
        k.diamond ? measure(k, hc_v_abs(across), hc_v_abs(down)) : measure(k, across, down);
    const hc_v root = hc_v_about_rsqrt(size);
    hc_v       rise = hc_v_sub(hc_v_set(scratch->recent.height[i]), t->height[part]);
    if (k.quadrant) {
        rise = hc_v_keep(in_quadrant(pass, across, down), rise);
    }
    const hc_v steepness = hc_v_mul(rise, k.diamond ? hc_v_mul(root, root) : root);
    const hc_v lowered   = hc_v_mul(steepness, hc_v_set(LOWER / pass->step_u));
    const bool raised    = hc_v_greater(lowered, t->T[part]) != 0;
    /* the sample itself, 0 * infinity, keeps T */
    t->T[part] = hc_v_max(lowered, t->T[part]);
    return raised;
}

/* Guesses from those recent limits whose bits are set. Returns which of them raised thresholds. */
INLINE unsigned guess_from_all(kind k, tile *t, unsigned guesses)
{
    unsigned raised = 0;
    for (; guesses != 0; guesses &= guesses - 1) {
        const int i = __builtin_ctz(guesses);
        for (int part = 0; part < HC_TILE_PARTS; part++) {
            raised |= (unsigned)guess_from_recent(k, t, part, i) << i;
        }
    }
    return raised;
}

/* Bits of the recent limits that are this sample. */
INLINE unsigned find_recent(const hc_exact_scratch *scratch, int x, int y)
{
    unsigned others = 0;
    for (int i = 0; i < HC_RECENT; i += HC_LANES) {
        const hc_v across = hc_v_sub(hc_v_load(scratch->recent.x + i), hc_v_set((float)x));
        const hc_v down   = hc_v_sub(hc_v_load(scratch->recent.y + i), hc_v_set((float)y));
        const hc_v apart  = hc_v_add(hc_v_abs(across), hc_v_abs(down));
        others |= hc_v_greater(apart, hc_v_set(0.0F)) << i;
    }
    return ~others;
}

/* First in, first out; but one that limits again when its turn has come stays. */
static void remember(hc_exact_scratch *scratch, int x, int y, float height)
{
    const unsigned known  = find_recent(scratch, x, y);
    const unsigned oldest = scratch->recent.next % HC_RECENT;
    if (known == 0) {
        scratch->recent.x[oldest]      = (float)x;
        scratch->recent.y[oldest]      = (float)y;
        scratch->recent.height[oldest] = height;
        scratch->recent.useful |= 1U << oldest;
    }
    scratch->recent.next += known == 0 || (known >> oldest & 1U) != 0;
}

#endif
