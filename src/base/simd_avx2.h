/* The lanes of simd.h, which includes this, in two AVX2 registers. */
#ifndef HC_BASE_SIMD_AVX2_H
#define HC_BASE_SIMD_AVX2_H

#include <immintrin.h>

typedef struct hc_v {
    __m256 a, b; /* lanes 0 .. 7, 8 .. 15 */
} hc_v;

#define HC_V_BINARY(name, operation)                                                               \
    static inline hc_v name(hc_v x, hc_v y)                                                        \
    {                                                                                              \
        return (hc_v){ operation(x.a, y.a), operation(x.b, y.b) };                                 \
    }
HC_V_BINARY(hc_v_add, _mm256_add_ps)
HC_V_BINARY(hc_v_sub, _mm256_sub_ps)
HC_V_BINARY(hc_v_mul, _mm256_mul_ps)
HC_V_BINARY(hc_v_div, _mm256_div_ps)
HC_V_BINARY(hc_v_max, _mm256_max_ps)
HC_V_BINARY(hc_v_min, _mm256_min_ps)

static inline hc_v hc_v_sqrt(hc_v x)
{
    return (hc_v){ _mm256_sqrt_ps(x.a), _mm256_sqrt_ps(x.b) };
}

static inline hc_v hc_v_abs(hc_v x)
{
    const __m256 sign = _mm256_set1_ps(-0.0F);
    return (hc_v){ _mm256_andnot_ps(sign, x.a), _mm256_andnot_ps(sign, x.b) };
}

static inline hc_v hc_v_set(float a)
{
    return (hc_v){ _mm256_set1_ps(a), _mm256_set1_ps(a) };
}

static inline hc_v hc_v_load(const float *p)
{
    return (hc_v){ _mm256_loadu_ps(p), _mm256_loadu_ps(p + 8) };
}

static inline void hc_v_store(float *p, hc_v x)
{
    _mm256_storeu_ps(p, x.a);
    _mm256_storeu_ps(p + 8, x.b);
}

static inline hc_v hc_v_about_muladd(hc_v x, hc_v y, hc_v z)
{
    return (hc_v){ _mm256_fmadd_ps(x.a, y.a, z.a), _mm256_fmadd_ps(x.b, y.b, z.b) };
}

static inline hc_v hc_v_about_rsqrt(hc_v x)
{
    const hc_v roots = { _mm256_rsqrt_ps(x.a), _mm256_rsqrt_ps(x.b) };
    return hc_v_mul(roots, hc_v_set(1.0F - 0x1p-10F));
}

static inline hc_v hc_v_about_over(hc_v x, hc_v y)
{
    const hc_v inverse = { _mm256_rcp_ps(y.a), _mm256_rcp_ps(y.b) };
    return hc_v_mul(hc_v_mul(x, hc_v_set(1.0F - 0x1p-10F)), inverse);
}

static inline unsigned hc_v_greater(hc_v x, hc_v y)
{
    const int low  = _mm256_movemask_ps(_mm256_cmp_ps(x.a, y.a, _CMP_GT_OQ));
    const int high = _mm256_movemask_ps(_mm256_cmp_ps(x.b, y.b, _CMP_GT_OQ));
    return (unsigned)low | (unsigned)high << 8;
}

static inline float hc_v_lowest(hc_v x)
{
    const __m256 eight = _mm256_min_ps(x.a, x.b);
    const __m128 four  = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    const __m128 two   = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
}

static inline __m256 hc_v_keep8(unsigned lanes, __m256 x)
{
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32((int)lanes), bit);
    return _mm256_and_ps(_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, bit)), x);
}

static inline hc_v hc_v_keep(unsigned lanes, hc_v x)
{
    return (hc_v){ hc_v_keep8(lanes & 255, x.a), hc_v_keep8(lanes >> 8, x.b) };
}

static inline __m256 hc_v_line8(hc_v offsets, hc_v slopes, __m256 x, int shift, int first)
{
    const __m256i bits  = _mm256_srl_epi32(_mm256_castps_si256(x), _mm_cvtsi32_si128(shift));
    const __m256i above = _mm256_sub_epi32(bits, _mm256_set1_epi32(first));
    const __m256i least = _mm256_max_epi32(above, _mm256_setzero_si256());
    const __m256i piece = _mm256_min_epi32(least, _mm256_set1_epi32(HC_LANES - 1));
    const __m256  upper = _mm256_castsi256_ps(_mm256_slli_epi32(piece, 28)); /* sign: piece >= 8 */
    const __m256  slope = _mm256_blendv_ps(_mm256_permutevar8x32_ps(slopes.a, piece),
                                           _mm256_permutevar8x32_ps(slopes.b, piece), upper);
    const __m256  start = _mm256_blendv_ps(_mm256_permutevar8x32_ps(offsets.a, piece),
                                           _mm256_permutevar8x32_ps(offsets.b, piece), upper);
    return _mm256_fmadd_ps(slope, x, start);
}

static inline hc_v hc_v_about_line(hc_v offsets, hc_v slopes, hc_v x, int shift, int first)
{
    return (hc_v){ hc_v_line8(offsets, slopes, x.a, shift, first),
                   hc_v_line8(offsets, slopes, x.b, shift, first) };
}

static inline int hc_pack8(int32_t *out, unsigned lanes, __m256i values)
{
    const uint64_t bytes = _pdep_u64(lanes, 0x0101010101010101U) * 255;
    const uint64_t order = _pext_u64(0x0706050403020100U, bytes);
    const __m256i  index = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order));
    _mm256_storeu_si256((__m256i *)(void *)out, _mm256_permutevar8x32_epi32(values, index));
    return __builtin_popcount(lanes);
}

static inline int hc_pack_lanes(int32_t *out, unsigned lanes, const int32_t *values, int32_t add)
{
    const __m256i *from = (const __m256i *)(const void *)values;
    const __m256i  all  = _mm256_set1_epi32(add);
    const __m256i  low  = _mm256_add_epi32(_mm256_loadu_si256(from), all);
    const __m256i  high = _mm256_add_epi32(_mm256_loadu_si256(from + 1), all);
    const int      n    = hc_pack8(out, lanes & 255, low);
    return n + hc_pack8(out + n, lanes >> 8, high);
}

static inline int hc_pack_v(float *out, unsigned lanes, hc_v x)
{
    int32_t  *to = (int32_t *)(void *)out;
    const int n  = hc_pack8(to, lanes & 255, _mm256_castps_si256(x.a));
    return n + hc_pack8(to + n, lanes >> 8, _mm256_castps_si256(x.b));
}

typedef struct hc_i {
    __m256i a, b;
} hc_i;

static inline hc_i hc_i_set(int32_t a)
{
    return (hc_i){ _mm256_set1_epi32(a), _mm256_set1_epi32(a) };
}

static inline hc_i hc_i_load(const int32_t *p)
{
    const __m256i *from = (const __m256i *)(const void *)p;
    return (hc_i){ _mm256_loadu_si256(from), _mm256_loadu_si256(from + 1) };
}

static inline void hc_i_store(int32_t *p, hc_i x)
{
    _mm256_storeu_si256((__m256i *)(void *)p, x.a);
    _mm256_storeu_si256((__m256i *)(void *)(p + 8), x.b);
}

#define HC_I_BINARY(name, operation)                                                               \
    static inline hc_i name(hc_i x, hc_i y)                                                        \
    {                                                                                              \
        return (hc_i){ operation(x.a, y.a), operation(x.b, y.b) };                                 \
    }
HC_I_BINARY(hc_i_add, _mm256_add_epi32)
HC_I_BINARY(hc_i_mul, _mm256_mullo_epi32)
HC_I_BINARY(hc_i_min, _mm256_min_epi32)
HC_I_BINARY(hc_i_max, _mm256_max_epi32)
HC_I_BINARY(hc_i_and, _mm256_and_si256)
HC_I_BINARY(hc_i_or, _mm256_or_si256)
HC_I_BINARY(hc_i_xor, _mm256_xor_si256)
HC_I_BINARY(hc_i_left, _mm256_sllv_epi32)
HC_I_BINARY(hc_i_right, _mm256_srlv_epi32)

static inline hc_i hc_i_from_v(hc_v x)
{
    return (hc_i){ _mm256_cvttps_epi32(x.a), _mm256_cvttps_epi32(x.b) };
}

static inline hc_v hc_v_from_i(hc_i x)
{
    return (hc_v){ _mm256_cvtepi32_ps(x.a), _mm256_cvtepi32_ps(x.b) };
}

static inline hc_v hc_v_of_bits(hc_i x)
{
    return (hc_v){ _mm256_castsi256_ps(x.a), _mm256_castsi256_ps(x.b) };
}

static inline __m256i hc_i_mask8(unsigned lanes)
{
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    return _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((int)lanes), bit), bit);
}

static inline hc_v hc_v_pick(unsigned lanes, hc_v x, hc_v y)
{
    return (hc_v){ _mm256_blendv_ps(y.a, x.a, _mm256_castsi256_ps(hc_i_mask8(lanes))),
                   _mm256_blendv_ps(y.b, x.b, _mm256_castsi256_ps(hc_i_mask8(lanes >> 8))) };
}

static inline hc_i hc_i_pick(unsigned lanes, hc_i x, hc_i y)
{
    return (hc_i){ _mm256_blendv_epi8(y.a, x.a, hc_i_mask8(lanes)),
                   _mm256_blendv_epi8(y.b, x.b, hc_i_mask8(lanes >> 8)) };
}

static inline unsigned hc_i_differ(hc_i x, hc_i y)
{
    const __m256 low  = _mm256_castsi256_ps(_mm256_cmpeq_epi32(x.a, y.a));
    const __m256 high = _mm256_castsi256_ps(_mm256_cmpeq_epi32(x.b, y.b));
    return ((unsigned)_mm256_movemask_ps(low) | (unsigned)_mm256_movemask_ps(high) << 8) ^ 0xffffU;
}

/* table[index] of a table of sixteen. */
static inline hc_i hc_i_lookup(const int32_t *table, hc_i index)
{
    return (hc_i){ _mm256_i32gather_epi32(table, index.a, 4),
                   _mm256_i32gather_epi32(table, index.b, 4) };
}

static inline int32_t hc_i_first(hc_i a, unsigned lanes)
{
    int32_t all[HC_LANES];
    hc_i_store(all, a);
    return all[__builtin_ctz(lanes)];
}

static inline hc_v hc_v_gather(const void *base, hc_i index, unsigned lanes)
{
    const __m256 low  = _mm256_castsi256_ps(hc_i_mask8(lanes));
    const __m256 high = _mm256_castsi256_ps(hc_i_mask8(lanes >> 8));
    return (hc_v){ _mm256_mask_i32gather_ps(_mm256_setzero_ps(), base, index.a, low, 4),
                   _mm256_mask_i32gather_ps(_mm256_setzero_ps(), base, index.b, high, 4) };
}

#endif
