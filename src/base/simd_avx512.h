/* The lanes of simd.h, which includes this, in one AVX-512 register. */
#ifndef HC_BASE_SIMD_AVX512_H
#define HC_BASE_SIMD_AVX512_H

#include <immintrin.h>

typedef __m512 hc_v;

#define HC_V_UNARY(name, operation)                                                                \
    static inline hc_v name(hc_v a)                                                                \
    {                                                                                              \
        return operation(a);                                                                       \
    }
#define HC_V_BINARY(name, operation)                                                               \
    static inline hc_v name(hc_v a, hc_v b)                                                        \
    {                                                                                              \
        return operation(a, b);                                                                    \
    }
HC_V_BINARY(hc_v_add, _mm512_add_ps)
HC_V_BINARY(hc_v_sub, _mm512_sub_ps)
HC_V_BINARY(hc_v_mul, _mm512_mul_ps)
HC_V_BINARY(hc_v_div, _mm512_div_ps)
HC_V_BINARY(hc_v_max, _mm512_max_ps)
HC_V_BINARY(hc_v_min, _mm512_min_ps)
HC_V_UNARY(hc_v_sqrt, _mm512_sqrt_ps)
HC_V_UNARY(hc_v_abs, _mm512_abs_ps)

static inline hc_v hc_v_set(float a)
{
    return _mm512_set1_ps(a);
}

static inline hc_v hc_v_load(const float *p)
{
    return _mm512_loadu_ps(p);
}

static inline void hc_v_store(float *p, hc_v a)
{
    _mm512_storeu_ps(p, a);
}

static inline hc_v hc_v_about_muladd(hc_v a, hc_v b, hc_v c)
{
    return _mm512_fmadd_ps(a, b, c);
}

static inline hc_v hc_v_about_rsqrt(hc_v a)
{
    return _mm512_mul_ps(_mm512_rsqrt14_ps(a), _mm512_set1_ps(1.0F - 0x1p-12F));
}

static inline hc_v hc_v_about_over(hc_v a, hc_v b)
{
    return _mm512_mul_ps(_mm512_mul_ps(a, _mm512_set1_ps(1.0F - 0x1p-12F)), _mm512_rcp14_ps(b));
}

static inline unsigned hc_v_greater(hc_v a, hc_v b)
{
    return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ);
}

static inline float hc_v_lowest(hc_v a)
{
    return _mm512_reduce_min_ps(a);
}

static inline hc_v hc_v_keep(unsigned lanes, hc_v a)
{
    return _mm512_maskz_mov_ps((__mmask16)lanes, a);
}

static inline hc_v hc_v_about_line(hc_v offsets, hc_v slopes, hc_v a, int shift, int first)
{
    const __m512i bits  = _mm512_srl_epi32(_mm512_castps_si512(a), _mm_cvtsi32_si128(shift));
    const __m512i above = _mm512_sub_epi32(bits, _mm512_set1_epi32(first));
    const __m512i least = _mm512_max_epi32(above, _mm512_setzero_si512());
    const __m512i piece = _mm512_min_epi32(least, _mm512_set1_epi32(HC_LANES - 1));
    return _mm512_fmadd_ps(_mm512_permutexvar_ps(piece, slopes), a,
                           _mm512_permutexvar_ps(piece, offsets));
}

static inline int hc_pack_lanes(int32_t *out, unsigned lanes, const int32_t *values, int32_t add)
{
    const __m512i all = _mm512_add_epi32(_mm512_loadu_si512(values), _mm512_set1_epi32(add));
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32((__mmask16)lanes, all));
    return __builtin_popcount(lanes);
}

static inline int hc_pack_v(float *out, unsigned lanes, hc_v a)
{
    _mm512_storeu_ps(out, _mm512_maskz_compress_ps((__mmask16)lanes, a));
    return __builtin_popcount(lanes);
}

typedef __m512i hc_i;

static inline hc_i hc_i_set(int32_t a)
{
    return _mm512_set1_epi32(a);
}

static inline hc_i hc_i_load(const int32_t *p)
{
    return _mm512_loadu_si512(p);
}

static inline void hc_i_store(int32_t *p, hc_i a)
{
    _mm512_storeu_si512(p, a);
}

#define HC_I_BINARY(name, operation)                                                               \
    static inline hc_i name(hc_i a, hc_i b)                                                        \
    {                                                                                              \
        return operation(a, b);                                                                    \
    }
HC_I_BINARY(hc_i_add, _mm512_add_epi32)
HC_I_BINARY(hc_i_mul, _mm512_mullo_epi32)
HC_I_BINARY(hc_i_min, _mm512_min_epi32)
HC_I_BINARY(hc_i_max, _mm512_max_epi32)
HC_I_BINARY(hc_i_and, _mm512_and_si512)
HC_I_BINARY(hc_i_or, _mm512_or_si512)
HC_I_BINARY(hc_i_xor, _mm512_xor_si512)

/* Operators, not intrinsics: of these gcc knows when one constant shifts all lanes. */
static inline hc_i hc_i_left(hc_i a, hc_i b)
{
    return (hc_i)((__v16su)a << (__v16su)b);
}

static inline hc_i hc_i_right(hc_i a, hc_i b)
{
    return (hc_i)((__v16su)a >> (__v16su)b);
}

static inline hc_i hc_i_from_v(hc_v a)
{
    return _mm512_cvttps_epi32(a);
}

static inline hc_v hc_v_from_i(hc_i a)
{
    return _mm512_cvtepi32_ps(a);
}

static inline hc_v hc_v_of_bits(hc_i a)
{
    return _mm512_castsi512_ps(a);
}

static inline hc_v hc_v_pick(unsigned lanes, hc_v a, hc_v b)
{
    return _mm512_mask_mov_ps(b, (__mmask16)lanes, a);
}

static inline hc_i hc_i_pick(unsigned lanes, hc_i a, hc_i b)
{
    return _mm512_mask_mov_epi32(b, (__mmask16)lanes, a);
}

static inline void hc_v_put(float *p, unsigned lanes, hc_v a)
{
    _mm512_mask_storeu_ps(p, (__mmask16)lanes, a);
}

static inline void hc_i_put(int32_t *p, unsigned lanes, hc_i a)
{
    _mm512_mask_storeu_epi32(p, (__mmask16)lanes, a);
}

static inline unsigned hc_i_differ(hc_i a, hc_i b)
{
    return _mm512_cmpneq_epi32_mask(a, b);
}

static inline int32_t hc_i_first(hc_i a, unsigned lanes)
{
    const __m512i dense = _mm512_maskz_compress_epi32((__mmask16)lanes, a);
    return _mm_cvtsi128_si32(_mm512_castsi512_si128(dense));
}

/* table[index] of a table of sixteen. */
static inline hc_i hc_i_lookup(const int32_t *table, hc_i index)
{
    return _mm512_permutexvar_epi32(index, _mm512_loadu_si512(table));
}

static inline hc_v hc_v_lookup(const float *table, hc_i index)
{
    return _mm512_permutex2var_ps(_mm512_loadu_ps(table), index, _mm512_loadu_ps(table + 16));
}

/* Without optimisation gcc's gathers are macros, which convert masks in our name. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"

static inline hc_v hc_v_gather(const void *base, hc_i index, unsigned lanes)
{
    return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), (__mmask16)lanes, index, base, 4);
}

#pragma GCC diagnostic pop

#endif
