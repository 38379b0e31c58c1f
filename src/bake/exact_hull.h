/* Lower envelopes of what a set of samples needs. Part of exact_kernel.h. */
#ifndef HC_BAKE_EXACT_HULL_H
#define HC_BAKE_EXACT_HULL_H

#include "exact_tile.h"

/* The least of height(p) + T(p) * distance is a concave function of the distance: between two ends
 * it lies above its chord. So one multiply-add bounds many samples at once, and far more tightly
 * than the lowest height with the least T would. The last piece is level: no slope is negative. */
INLINE envelope draw_envelope(const tile *t, int first, int parts)
{
    const hc_exact_pass *pass    = t->pass;
    const hc_v           start   = hc_v_load(PIECE_ENDS);
    const hc_v           end     = hc_v_load(PIECE_ENDS + 1);
    const hc_v           most    = hc_v_set(2.0F * pass->tree->range); /* keeps chords precise */
    hc_v                 lows[4] = { most, most, most, most }; /* short chains: min takes a while */
    hc_v                 level   = hc_v_set(ABOVE_ALL);
    for (int part = first; part < first + parts; part++) {
        float          heights[HC_LANES], rises[HC_LANES];
        const unsigned rising = hc_v_greater(t->T[part], hc_v_set(0.0F));
        level = hc_v_min(hc_v_pick(rising, hc_v_set(ABOVE_ALL), t->lifted[part]), level);
        hc_v_store(heights, hc_v_pick(rising, t->lifted[part], hc_v_set(ABOVE_ALL)));
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
    drawn.level   = hc_v_lowest(level);
    drawn.slopes  = hc_v_div(hc_v_sub(high, low), hc_v_sub(end, start));
    drawn.offsets = hc_v_sub(hc_v_sub(low, hc_v_mul(drawn.slopes, start)), margin);
    return drawn;
}

/* Squares that reach into the quadrant of one viewer at least. across, down: from the viewers'
 * middle to the squares'; `reach` of that both are large. */
INLINE unsigned reached_lanes(kind k, const tile *t, hc_v across, hc_v down, float reach)
{
    if (!k.quadrant) {
        return 0xFFFFU;
    }
    const hc_v beyond = hc_v_set(-reach);
    return ~(hc_v_greater(beyond, hc_v_mul(across, hc_v_set((float)t->pass->sign_u)))
             | hc_v_greater(beyond, hc_v_mul(down, hc_v_set((float)t->pass->sign_v))));
}

/* Which of sixteen squares may hold something for a square of viewers. tops: the squares' highest
 * samples, minus base. */
INLINE unsigned promising(kind k, const tile *t, const envelope *hull, float reach, hc_v across,
                          hc_v down, hc_v tops)
{
    const hc_v zero  = hc_v_set(0.0F);
    const hc_v half  = hc_v_set(reach);
    const hc_v gap_u = hc_v_max(hc_v_sub(hc_v_abs(across), half), zero);
    const hc_v rows  = hc_v_max(hc_v_sub(hc_v_abs(down), half), zero);
    const hc_v size  = measure(k, gap_u, hc_v_mul(rows, hc_v_set(t->aspect)));
    const hc_v bound =
        hc_v_about_line(hull->offsets, hull->slopes, k.diamond ? size : hc_v_about_sqrt(size),
                        PIECE_SHIFT, PIECE_FIRST);
    return hc_v_greater(tops, hc_v_min(bound, hc_v_set(hull->level)))
           & reached_lanes(k, t, across, down, reach);
}

#endif
