/* Sixteen float lanes. The including file says which machine it is compiled for: HC_SIMD_AVX512,
 * HC_SIMD_AVX2, or neither for portable C. All give the same bits, but for what is
 * called `about`.
 *
 * hc_v_max(a, b)     a > b ? a : b in every lane: of equal zeros, and of NaN, it is b. min likewise
 * hc_v_greater       bit i: a > b in lane i
 * hc_v_keep          a where the bit is set, 0 elsewhere
 * hc_v_lowest        of all lanes
 * hc_v_about_muladd  a * b + c, fused or not: for bounds with a margin, never for results
 * hc_v_about_rsqrt   at most 1 / the square root of a >= 2^-60, and at least (1 - 2^-9) of it
 * hc_v_about_over    at most a / b and at least (1 - 2^-9) of it; a >= 0, b > 2^-100
 * hc_v_about_line    slopes[k] * a + offsets[k], likewise, where k = clamp((bits of a >> shift) -
 *                    first, 0, 15) is the piece of a >= 0 on a scale of powers of two
 * hc_i               sixteen integers of 32 bits; shifts by 0 .. 31, to the right without the sign
 * hc_v_put           stores a where the bit is set, leaves what stands elsewhere; hc_i_put likewise
 * hc_v_pick          a where the bit is set, b elsewhere; hc_i_pick likewise
 * hc_i_from_v        towards zero
 * hc_v_gather        the word at base + 4 * index where the bit is set, anything elsewhere
 * hc_v_lookup        table[index] of a table of thirty-two: where HC_LOOKUPS is 1, sooner done than
 *                    a gather
 * hc_i_first         of the lanes whose bit is set, of which there is one
 * hc_pack_lanes      values[i] + add for every set bit i, densely; may write HC_LANES integers even
 *                    if fewer are set; returns how many are; hc_pack_v the lanes of a vector */
#ifndef HC_BASE_SIMD_H
#define HC_BASE_SIMD_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if !defined(HC_LANES)
#define HC_LANES 16
#endif

#if HC_LANES == 1
#include "simd_one.h"
#elif defined(HC_SIMD_AVX512)
#include "simd_avx512.h"
#elif defined(HC_SIMD_AVX2)
#include "simd_avx2.h"
#else
#include "simd_portable.h"
#endif

#if defined(HC_SIMD_AVX512) && HC_LANES == 16
enum { HC_LOOKUPS = 1 };
#else
enum { HC_LOOKUPS = 0 };

static inline hc_v hc_v_lookup(const float *table, hc_i index)
{
    return hc_v_gather(table, index, (1U << HC_LANES) - 1);
}
#endif

#if HC_LANES != 1 && !defined(HC_SIMD_AVX512)
static inline void hc_v_put(float *p, unsigned lanes, hc_v a)
{
    hc_v_store(p, hc_v_pick(lanes, a, hc_v_load(p)));
}

static inline void hc_i_put(int32_t *p, unsigned lanes, hc_i a)
{
    hc_i_store(p, hc_i_pick(lanes, a, hc_i_load(p)));
}
#endif

static inline hc_i hc_v_bits(hc_v a)
{
    hc_i bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static inline float hc_v_highest(hc_v a)
{
    const hc_v zero = hc_v_set(0.0F);
    return -hc_v_lowest(hc_v_sub(zero, a));
}

/* At most the square root of a >= 0, and at least (1 - 2^-9) of it. */
static inline hc_v hc_v_about_sqrt(hc_v a)
{
    return hc_v_mul(a, hc_v_about_rsqrt(hc_v_max(a, hc_v_set(0x1p-60F)))); /* no 0 * infinity */
}

#endif
