/* Sixteen float lanes, in one place. The including file says which machine it is compiled for:
 * HC_SIMD_AVX512, HC_SIMD_AVX2, or neither for portable C. All give the same bits, except the two
 * functions called `about`.
 *
 * hc_v_max(a, b)     a > b ? a : b in every lane: of equal zeros, and of NaN, it is b. min likewise
 * hc_v_greater       bit i: a > b in lane i
 * hc_v_keep          a where the bit is set, 0 elsewhere
 * hc_v_about_muladd  a * b + c, fused or not: for bounds with a margin, never for results
 * hc_v_about_rsqrt   at most 1 / the square root of a >= 2^-60, and at least (1 - 2^-9) of it
 * hc_v_about_over    at most a / b and at least (1 - 2^-9) of it; a >= 0, b > 2^-100
 * hc_v_about_line    slopes[k] * a + offsets[k], likewise, where k = clamp((bits of a >> shift) -
 * first,
 *                    0, 15) is the piece of a >= 0 on a scale of powers of two
 * hc_i               sixteen integers of 32 bits; shifts by 0 .. 31, to the right without the sign
 * hc_v_pick          a where the bit is set, b elsewhere; hc_i_pick likewise
 * hc_i_from_v        towards zero
 * hc_v_gather        the word at base + 4 * index where the bit is set, anything elsewhere
 * hc_gather_pairs    two words from base + 8 * index where the bit is set, anything elsewhere;
 *                    hc_gather_neighbours the same from base + 4 * index
 * hc_pack_lanes      values[i] + add for every set bit i, densely; may write HC_LANES integers even
 * if
 *                    fewer are set; returns how many are; hc_pack_v the lanes of a vector */
#ifndef HC_BASE_SIMD_H
#define HC_BASE_SIMD_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define HC_LANES 16

#if defined(HC_SIMD_AVX512)

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

static inline hc_v hc_v_from_ints(const int32_t *p)
{
    return _mm512_cvtepi32_ps(_mm512_loadu_si512(p));
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
HC_I_BINARY(hc_i_left, _mm512_sllv_epi32)
HC_I_BINARY(hc_i_right, _mm512_srlv_epi32)

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

static inline unsigned hc_i_differ(hc_i a, hc_i b)
{
    return _mm512_cmpneq_epi32_mask(a, b);
}

/* table[index] of a table of sixteen. */
static inline hc_i hc_i_lookup(const int32_t *table, hc_i index)
{
    return _mm512_permutexvar_epi32(index, _mm512_loadu_si512(table));
}

/* Without optimisation gcc's gathers are macros, which convert masks in our name. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"

static inline hc_v hc_v_gather(const float *base, hc_i index, unsigned lanes)
{
    return _mm512_mask_i32gather_ps(_mm512_setzero_ps(), (__mmask16)lanes, index, base, 4);
}

static inline void hc_i_deal(hc_i *first, hc_i *second, __m512i low, __m512i high)
{
    const __m512i even =
        _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i odd = _mm512_add_epi32(even, _mm512_set1_epi32(1));
    *first            = _mm512_permutex2var_epi32(low, even, high);
    *second           = _mm512_permutex2var_epi32(low, odd, high);
}

#define HC_I_GATHER(name, scale)                                                                   \
    static inline void name(hc_i *first, hc_i *second, const void *base, hc_i index,               \
                            unsigned lanes)                                                        \
    {                                                                                              \
        const __m512i zero = _mm512_setzero_si512();                                               \
        const __m512i low  = _mm512_mask_i32gather_epi64(                                          \
             zero, (__mmask8)lanes, _mm512_castsi512_si256(index), base, scale);                   \
        const __m512i high = _mm512_mask_i32gather_epi64(                                          \
            zero, (__mmask8)(lanes >> 8), _mm512_extracti64x4_epi64(index, 1), base, scale);       \
        hc_i_deal(first, second, low, high);                                                       \
    }
HC_I_GATHER(hc_gather_pairs, 8)
HC_I_GATHER(hc_gather_neighbours, 4)

#pragma GCC diagnostic pop

#elif defined(HC_SIMD_AVX2)

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

static inline hc_v hc_v_from_ints(const int32_t *p)
{
    const __m256i *from = (const __m256i *)(const void *)p;
    return (hc_v){ _mm256_cvtepi32_ps(_mm256_loadu_si256(from)),
                   _mm256_cvtepi32_ps(_mm256_loadu_si256(from + 1)) };
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

static inline hc_v hc_v_gather(const float *base, hc_i index, unsigned lanes)
{
    const __m256 low  = _mm256_castsi256_ps(hc_i_mask8(lanes));
    const __m256 high = _mm256_castsi256_ps(hc_i_mask8(lanes >> 8));
    return (hc_v){ _mm256_mask_i32gather_ps(_mm256_setzero_ps(), base, index.a, low, 4),
                   _mm256_mask_i32gather_ps(_mm256_setzero_ps(), base, index.b, high, 4) };
}

static inline __m256i hc_i_deal8(__m256i low, __m256i high, int odd)
{
    const __m256i order = odd != 0 ? _mm256_setr_epi32(1, 3, 5, 7, 1, 3, 5, 7)
                                   : _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
    return _mm256_blend_epi32(_mm256_permutevar8x32_epi32(low, order),
                              _mm256_permutevar8x32_epi32(high, order), 0xf0);
}

static inline __m256i hc_i_wide4(unsigned lanes)
{
    const __m256i bit = _mm256_setr_epi64x(1, 2, 4, 8);
    return _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x((long long)lanes), bit), bit);
}

#define HC_I_GATHER(name, scale)                                                                   \
    static inline __m256i name##4(const void *base, __m128i index, unsigned lanes)                 \
    {                                                                                              \
        return _mm256_mask_i32gather_epi64(_mm256_setzero_si256(), (const long long *)base, index, \
                                           hc_i_wide4(lanes), scale);                              \
    }                                                                                              \
    static inline void name(hc_i *first, hc_i *second, const void *base, hc_i index,               \
                            unsigned lanes)                                                        \
    {                                                                                              \
        const __m256i q0 = name##4(base, _mm256_castsi256_si128(index.a), lanes);                  \
        const __m256i q1 = name##4(base, _mm256_extracti128_si256(index.a, 1), lanes >> 4);        \
        const __m256i q2 = name##4(base, _mm256_castsi256_si128(index.b), lanes >> 8);             \
        const __m256i q3 = name##4(base, _mm256_extracti128_si256(index.b, 1), lanes >> 12);       \
        *first           = (hc_i){ hc_i_deal8(q0, q1, 0), hc_i_deal8(q2, q3, 0) };                 \
        *second          = (hc_i){ hc_i_deal8(q0, q1, 1), hc_i_deal8(q2, q3, 1) };                 \
    }
HC_I_GATHER(hc_gather_pairs, 8)
HC_I_GATHER(hc_gather_neighbours, 4)

#else

/* The compiler's own vectors of four; it finds the machine's, or does without. */
typedef float   hc_quarter __attribute__((vector_size(16)));
typedef int32_t hc_quarter_bits __attribute__((vector_size(16)));
typedef struct hc_v {
    hc_quarter q[HC_LANES / 4];
} hc_v;

#define HC_V_QUARTERS(name, parameters, expression)                                                \
    static inline hc_v name parameters                                                             \
    {                                                                                              \
        hc_v r;                                                                                    \
        for (int i = 0; i < HC_LANES / 4; i++) {                                                   \
            r.q[i] = expression;                                                                   \
        }                                                                                          \
        return r;                                                                                  \
    }

static inline hc_quarter hc_choose(hc_quarter_bits mask, hc_quarter a, hc_quarter b)
{
    return (hc_quarter)(((hc_quarter_bits)a & mask) | ((hc_quarter_bits)b & ~mask));
}

static inline hc_quarter hc_sqrt4(hc_quarter a)
{
    return (hc_quarter){ sqrtf(a[0]), sqrtf(a[1]), sqrtf(a[2]), sqrtf(a[3]) };
}

HC_V_QUARTERS(hc_v_add, (hc_v a, hc_v b), a.q[i] + b.q[i])
HC_V_QUARTERS(hc_v_sub, (hc_v a, hc_v b), a.q[i] - b.q[i])
HC_V_QUARTERS(hc_v_mul, (hc_v a, hc_v b), a.q[i] * b.q[i])
HC_V_QUARTERS(hc_v_div, (hc_v a, hc_v b), a.q[i] / b.q[i])
HC_V_QUARTERS(hc_v_max, (hc_v a, hc_v b), hc_choose(a.q[i] > b.q[i], a.q[i], b.q[i]))
HC_V_QUARTERS(hc_v_min, (hc_v a, hc_v b), hc_choose(a.q[i] < b.q[i], a.q[i], b.q[i]))
HC_V_QUARTERS(hc_v_about_muladd, (hc_v a, hc_v b, hc_v c), a.q[i] * b.q[i] + c.q[i])
HC_V_QUARTERS(hc_v_sqrt, (hc_v a), hc_sqrt4(a.q[i]))
HC_V_QUARTERS(hc_v_about_rsqrt, (hc_v a), (1.0F - 0x1p-12F) / hc_sqrt4(a.q[i]))
HC_V_QUARTERS(hc_v_about_over, (hc_v a, hc_v b), a.q[i] * (1.0F - 0x1p-12F) / b.q[i])
HC_V_QUARTERS(hc_v_abs, (hc_v a), (hc_quarter)((hc_quarter_bits)a.q[i] & INT32_MAX))
HC_V_QUARTERS(hc_v_set, (float a), ((hc_quarter){ a, a, a, a }))

static inline hc_v hc_v_load(const float *p)
{
    hc_v a;
    memcpy(&a, p, sizeof a);
    return a;
}

static inline void hc_v_store(float *p, hc_v a)
{
    memcpy(p, &a, sizeof a);
}

static inline hc_v hc_v_from_ints(const int32_t *p)
{
    float a[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        a[i] = (float)p[i];
    }
    return hc_v_load(a);
}

static inline unsigned hc_v_greater(hc_v a, hc_v b)
{
    unsigned lanes = 0;
    for (int i = 0; i < HC_LANES / 4; i++) {
        const hc_quarter_bits bit = (a.q[i] > b.q[i]) & (hc_quarter_bits){ 1, 2, 4, 8 };
        lanes |= (unsigned)(bit[0] | bit[1] | bit[2] | bit[3]) << (4 * i);
    }
    return lanes;
}

static inline hc_v hc_v_keep(unsigned lanes, hc_v a)
{
    float kept[HC_LANES];
    hc_v_store(kept, a);
    for (int i = 0; i < HC_LANES; i++) {
        kept[i] = (lanes >> i & 1) != 0 ? kept[i] : 0.0F;
    }
    return hc_v_load(kept);
}

static inline hc_v hc_v_about_line(hc_v offsets, hc_v slopes, hc_v a, int shift, int first)
{
    float   start[HC_LANES], slope[HC_LANES], line[HC_LANES];
    int32_t bits[HC_LANES];
    hc_v_store(start, offsets);
    hc_v_store(slope, slopes);
    hc_v_store(line, a);
    memcpy(bits, &a, sizeof bits);
    for (int i = 0; i < HC_LANES; i++) {
        const int above = (bits[i] >> shift) - first;
        const int piece = above < 0 ? 0 : above < HC_LANES ? above : HC_LANES - 1;
        line[i]         = slope[piece] * line[i] + start[piece];
    }
    return hc_v_load(line);
}

static inline int hc_pack_lanes(int32_t *out, unsigned lanes, const int32_t *values, int32_t add)
{
    int count = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
        out[count++] = values[__builtin_ctz(lanes)] + add;
    }
    return count;
}

static inline int hc_pack_v(float *out, unsigned lanes, hc_v a)
{
    float values[HC_LANES];
    int   count = 0;
    hc_v_store(values, a);
    for (; lanes != 0; lanes &= lanes - 1) {
        out[count++] = values[__builtin_ctz(lanes)];
    }
    return count;
}

typedef struct hc_i {
    int32_t lane[HC_LANES];
} hc_i;

#define HC_I_LANES(name, parameters, expression)                                                   \
    static inline hc_i name parameters                                                             \
    {                                                                                              \
        hc_i r;                                                                                    \
        for (int i = 0; i < HC_LANES; i++) {                                                       \
            r.lane[i] = expression;                                                                \
        }                                                                                          \
        return r;                                                                                  \
    }
HC_I_LANES(hc_i_set, (int32_t a), a)
HC_I_LANES(hc_i_load, (const int32_t *p), p[i])
HC_I_LANES(hc_i_add, (hc_i a, hc_i b), (int32_t)((uint32_t)a.lane[i] + (uint32_t)b.lane[i]))
HC_I_LANES(hc_i_mul, (hc_i a, hc_i b), (int32_t)((uint32_t)a.lane[i] * (uint32_t)b.lane[i]))
HC_I_LANES(hc_i_min, (hc_i a, hc_i b), a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i])
HC_I_LANES(hc_i_max, (hc_i a, hc_i b), a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i])
HC_I_LANES(hc_i_and, (hc_i a, hc_i b), a.lane[i] & b.lane[i])
HC_I_LANES(hc_i_or, (hc_i a, hc_i b), a.lane[i] | b.lane[i])
HC_I_LANES(hc_i_xor, (hc_i a, hc_i b), a.lane[i] ^ b.lane[i])
HC_I_LANES(hc_i_left, (hc_i a, hc_i b), (int32_t)((uint32_t)a.lane[i] << b.lane[i]))
HC_I_LANES(hc_i_right, (hc_i a, hc_i b), (int32_t)((uint32_t)a.lane[i] >> b.lane[i]))
HC_I_LANES(hc_i_lookup, (const int32_t *table, hc_i index), table[index.lane[i]])
HC_I_LANES(hc_i_pick, (unsigned lanes, hc_i a, hc_i b),
           (lanes >> i & 1) != 0 ? a.lane[i] : b.lane[i])

static inline void hc_i_store(int32_t *p, hc_i a)
{
    memcpy(p, &a, sizeof a);
}

/* What does not fit an integer becomes the least one, as the vector machines do it. */
static inline hc_i hc_i_from_v(hc_v a)
{
    hc_i  r;
    float from[HC_LANES];
    hc_v_store(from, a);
    for (int i = 0; i < HC_LANES; i++) {
        r.lane[i] = fabsf(from[i]) < 0x1p31F ? (int32_t)from[i] : INT32_MIN;
    }
    return r;
}

static inline hc_v hc_v_from_i(hc_i a)
{
    return hc_v_from_ints(a.lane);
}

static inline hc_v hc_v_of_bits(hc_i a)
{
    hc_v r;
    memcpy(&r, &a, sizeof r);
    return r;
}

static inline hc_v hc_v_gather(const float *base, hc_i index, unsigned lanes)
{
    float found[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        found[i] = (lanes >> i & 1) != 0 ? base[index.lane[i]] : 0.0F;
    }
    return hc_v_load(found);
}

static inline hc_v hc_v_pick(unsigned lanes, hc_v a, hc_v b)
{
    hc_i first, second;
    memcpy(&first, &a, sizeof a);
    memcpy(&second, &b, sizeof b);
    return hc_v_of_bits(hc_i_pick(lanes, first, second));
}

static inline unsigned hc_i_differ(hc_i a, hc_i b)
{
    unsigned lanes = 0;
    for (int i = 0; i < HC_LANES; i++) {
        lanes |= (unsigned)(a.lane[i] != b.lane[i]) << i;
    }
    return lanes;
}

#define HC_I_GATHER(name, scale)                                                                   \
    static inline void name(hc_i *first, hc_i *second, const void *base, hc_i index,               \
                            unsigned lanes)                                                        \
    {                                                                                              \
        for (int i = 0; i < HC_LANES; i++) {                                                       \
            int32_t pair[2] = { 0, 0 };                                                            \
            if ((lanes >> i & 1) != 0) {                                                           \
                memcpy(pair, (const char *)base + (ptrdiff_t)index.lane[i] * (scale),              \
                       sizeof pair);                                                               \
            }                                                                                      \
            first->lane[i]  = pair[0];                                                             \
            second->lane[i] = pair[1];                                                             \
        }                                                                                          \
    }
HC_I_GATHER(hc_gather_pairs, 8)
HC_I_GATHER(hc_gather_neighbours, 4)

#endif

static inline hc_i hc_v_bits(hc_v a)
{
    hc_i bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

/* At most the square root of a >= 0, and at least (1 - 2^-9) of it. */
static inline hc_v hc_v_about_sqrt(hc_v a)
{
    return hc_v_mul(a, hc_v_about_rsqrt(hc_v_max(a, hc_v_set(0x1p-60F)))); /* no 0 * infinity */
}

#endif
