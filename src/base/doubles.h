/* Double precision beside the float lanes of simd.h, as many lanes at a time as a register holds,
 * HC_D_LANES of the HC_LANES: more would not stay in registers. Vectors are added and so on by the
 * operators of the language. All machines give the same bits.
 *
 * hc_d_min(a, b)     a < b ? a : b: of equal zeros, and of NaN, it is b. max likewise
 * hc_d_if_less       (x, y, a, b): x < y ? a : b
 * hc_d_less          bit i: a < b in lane i; hc_d_most: a <= b
 * hc_d_pick          a where the bit is set, b elsewhere
 * hc_d_of_floats, hc_d_of_ints  of as many in memory
 * hc_d_round         (p, a, b): as floats to p, where b has the lanes HC_D_MORE after those of a:
 *                    HC_D_BOTH at once, as a vector that is read soon after it has been written in
 *                    two parts waits for the cache */
#ifndef HC_BASE_DOUBLES_H
#define HC_BASE_DOUBLES_H

#include "simd.h"

#define HC_D(type, name, parameters, expression)                                                   \
    static inline type name parameters                                                             \
    {                                                                                              \
        return expression;                                                                         \
    }

#if HC_LANES == 1

typedef double hc_d;
enum { HC_D_LANES = 1 };

HC_D(hc_d, hc_d_set, (double a), a)
HC_D(hc_d, hc_d_load, (const double *p), *p)
HC_D(hc_d, hc_d_of_floats, (const float *p), (double)*p)
HC_D(hc_d, hc_d_of_ints, (const int32_t *p), *p)
HC_D(hc_d, hc_d_abs, (hc_d a), fabs(a))
HC_D(hc_d, hc_d_sqrt, (hc_d a), sqrt(a))
HC_D(hc_d, hc_d_min, (hc_d a, hc_d b), a < b ? a : b)
HC_D(hc_d, hc_d_max, (hc_d a, hc_d b), a > b ? a : b)
HC_D(hc_d, hc_d_if_less, (hc_d x, hc_d y, hc_d a, hc_d b), x < y ? a : b)
HC_D(hc_d, hc_d_pick, (unsigned set, hc_d a, hc_d b), (set & 1) != 0 ? a : b)
HC_D(unsigned, hc_d_less, (hc_d a, hc_d b), a < b)
HC_D(unsigned, hc_d_most, (hc_d a, hc_d b), a <= b)

static inline void hc_d_store(double *p, hc_d a)
{
    *p = a;
}

static inline void hc_d_round(float *p, hc_d a, hc_d b)
{
    (void)b; /* the same */
    *p = (float)a;
}

#elif defined(HC_SIMD_AVX512)

typedef __m512d hc_d;
enum { HC_D_LANES = 8 };

HC_D(hc_d, hc_d_set, (double a), _mm512_set1_pd(a))
HC_D(hc_d, hc_d_load, (const double *p), _mm512_loadu_pd(p))

static inline void hc_d_store(double *p, hc_d a)
{
    _mm512_storeu_pd(p, a);
}

HC_D(hc_d, hc_d_of_floats, (const float *p), _mm512_cvtps_pd(_mm256_loadu_ps(p)))
HC_D(hc_d, hc_d_of_ints, (const int32_t *p),
     _mm512_cvtepi32_pd(_mm256_loadu_si256((const __m256i *)p)))

static inline void hc_d_round(float *p, hc_d a, hc_d b)
{
    const __m512 low = _mm512_castps256_ps512(_mm512_cvtpd_ps(a));
    _mm512_storeu_ps(p, _mm512_insertf32x8(low, _mm512_cvtpd_ps(b), 1));
}

HC_D(hc_d, hc_d_abs, (hc_d a), _mm512_abs_pd(a))
HC_D(hc_d, hc_d_sqrt, (hc_d a), _mm512_sqrt_pd(a))
HC_D(hc_d, hc_d_min, (hc_d a, hc_d b), _mm512_min_pd(a, b))
HC_D(hc_d, hc_d_max, (hc_d a, hc_d b), _mm512_max_pd(a, b))
HC_D(unsigned, hc_d_less, (hc_d a, hc_d b), _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ))
HC_D(unsigned, hc_d_most, (hc_d a, hc_d b), _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ))
HC_D(hc_d, hc_d_pick, (unsigned set, hc_d a, hc_d b), _mm512_mask_mov_pd(b, (__mmask8)set, a))
HC_D(hc_d, hc_d_if_less, (hc_d x, hc_d y, hc_d a, hc_d b),
     _mm512_mask_mov_pd(b, _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ), a))

#elif defined(HC_SIMD_AVX2)

typedef __m256d hc_d;
enum { HC_D_LANES = 4 };

HC_D(hc_d, hc_d_set, (double a), _mm256_set1_pd(a))
HC_D(hc_d, hc_d_load, (const double *p), _mm256_loadu_pd(p))

static inline void hc_d_store(double *p, hc_d a)
{
    _mm256_storeu_pd(p, a);
}

HC_D(hc_d, hc_d_of_floats, (const float *p), _mm256_cvtps_pd(_mm_loadu_ps(p)))
HC_D(hc_d, hc_d_of_ints, (const int32_t *p),
     _mm256_cvtepi32_pd(_mm_loadu_si128((const __m128i *)p)))

static inline void hc_d_round(float *p, hc_d a, hc_d b)
{
    _mm256_storeu_ps(p, _mm256_set_m128(_mm256_cvtpd_ps(b), _mm256_cvtpd_ps(a)));
}

HC_D(hc_d, hc_d_abs, (hc_d a), _mm256_andnot_pd(_mm256_set1_pd(-0.0), a))
HC_D(hc_d, hc_d_sqrt, (hc_d a), _mm256_sqrt_pd(a))
HC_D(hc_d, hc_d_min, (hc_d a, hc_d b), _mm256_min_pd(a, b))
HC_D(hc_d, hc_d_max, (hc_d a, hc_d b), _mm256_max_pd(a, b))
HC_D(unsigned, hc_d_less, (hc_d a, hc_d b),
     (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ)))
HC_D(unsigned, hc_d_most, (hc_d a, hc_d b),
     (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LE_OQ)))

static inline hc_d hc_d_pick(unsigned set, hc_d a, hc_d b)
{
    const __m256i bit  = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i bits = _mm256_and_si256(_mm256_set1_epi64x(set), bit);
    return _mm256_blendv_pd(b, a, _mm256_castsi256_pd(_mm256_cmpeq_epi64(bits, bit)));
}

HC_D(hc_d, hc_d_if_less, (hc_d x, hc_d y, hc_d a, hc_d b),
     _mm256_blendv_pd(b, a, _mm256_cmp_pd(x, y, _CMP_LT_OQ)))

#else

typedef double  hc_d __attribute__((vector_size(16)));
typedef int64_t hc_d_bits __attribute__((vector_size(16)));
enum { HC_D_LANES = 2 };

static inline hc_d hc_d_set(double a)
{
    return (hc_d){ a, a };
}

static inline hc_d hc_d_load(const double *p)
{
    return (hc_d){ p[0], p[1] };
}

static inline void hc_d_store(double *p, hc_d a)
{
    memcpy(p, &a, sizeof a);
}

static inline hc_d hc_d_of_floats(const float *p)
{
    return (hc_d){ (double)p[0], (double)p[1] };
}

static inline hc_d hc_d_of_ints(const int32_t *p)
{
    return (hc_d){ p[0], p[1] };
}

static inline void hc_d_round(float *p, hc_d a, hc_d b)
{
    const hc_quarter all = { (float)a[0], (float)a[1], (float)b[0], (float)b[1] };
    memcpy(p, &all, sizeof all);
}

HC_D(hc_d, hc_d_abs, (hc_d a), (hc_d)((hc_d_bits)a &INT64_MAX))

static inline hc_d hc_d_sqrt(hc_d a)
{
    return (hc_d){ sqrt(a[0]), sqrt(a[1]) };
}

HC_D(hc_d, hc_d_choose, (hc_d_bits mask, hc_d a, hc_d b),
     (hc_d)(((hc_d_bits)a & mask) | ((hc_d_bits)b & ~mask)))
HC_D(hc_d, hc_d_min, (hc_d a, hc_d b), hc_d_choose(a < b, a, b))
HC_D(hc_d, hc_d_max, (hc_d a, hc_d b), hc_d_choose(a > b, a, b))
HC_D(unsigned, hc_d_set_bits, (hc_d_bits mask), (unsigned)((mask[0] & 1) | (mask[1] & 2)))
HC_D(unsigned, hc_d_less, (hc_d a, hc_d b), hc_d_set_bits(a < b))
HC_D(unsigned, hc_d_most, (hc_d a, hc_d b), hc_d_set_bits(a <= b))

static inline hc_d hc_d_pick(unsigned set, hc_d a, hc_d b)
{
    return (hc_d){ (set & 1) != 0 ? a[0] : b[0], (set & 2) != 0 ? a[1] : b[1] };
}

HC_D(hc_d, hc_d_if_less, (hc_d x, hc_d y, hc_d a, hc_d b), hc_d_choose(x < y, a, b))

#endif

enum { HC_D_MORE = HC_LANES == 1 ? 0 : HC_D_LANES, HC_D_BOTH = HC_D_LANES + HC_D_MORE };

#endif
