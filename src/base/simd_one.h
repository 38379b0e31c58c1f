/* simd.h with a single lane. */
#ifndef HC_BASE_SIMD_ONE_H
#define HC_BASE_SIMD_ONE_H

#if defined(__SSE2__)
#include <immintrin.h>
#endif

typedef float   hc_v;
typedef int32_t hc_i;

#define HC_ONE(type, name, parameters, expression)                                                 \
    static inline type name parameters                                                             \
    {                                                                                              \
        return expression;                                                                         \
    }

HC_ONE(hc_v, hc_v_add, (hc_v a, hc_v b), a + b)
HC_ONE(hc_v, hc_v_sub, (hc_v a, hc_v b), a - b)
HC_ONE(hc_v, hc_v_mul, (hc_v a, hc_v b), a *b)
HC_ONE(hc_v, hc_v_div, (hc_v a, hc_v b), a / b)
HC_ONE(hc_v, hc_v_max, (hc_v a, hc_v b), a > b ? a : b)
HC_ONE(hc_v, hc_v_min, (hc_v a, hc_v b), a < b ? a : b)
HC_ONE(hc_v, hc_v_about_muladd, (hc_v a, hc_v b, hc_v c), a *b + c)
HC_ONE(hc_v, hc_v_about_rsqrt, (hc_v a), (1.0F - 0x1p-12F) / sqrtf(a))
HC_ONE(hc_v, hc_v_about_over, (hc_v a, hc_v b), a *(1.0F - 0x1p-12F) / b)
HC_ONE(hc_v, hc_v_abs, (hc_v a), fabsf(a))
HC_ONE(hc_v, hc_v_set, (float a), a)
HC_ONE(hc_v, hc_v_load, (const float *p), *p)
HC_ONE(unsigned, hc_v_greater, (hc_v a, hc_v b), a > b)
HC_ONE(float, hc_v_lowest, (hc_v a), a)
HC_ONE(hc_v, hc_v_keep, (unsigned lanes, hc_v a), (lanes & 1) != 0 ? a : 0.0F)
HC_ONE(hc_v, hc_v_pick, (unsigned lanes, hc_v a, hc_v b), (lanes & 1) != 0 ? a : b)
HC_ONE(hc_i, hc_i_pick, (unsigned lanes, hc_i a, hc_i b), (lanes & 1) != 0 ? a : b)
HC_ONE(hc_i, hc_i_set, (int32_t a), a)
HC_ONE(hc_i, hc_i_load, (const int32_t *p), *p)
HC_ONE(hc_i, hc_i_add, (hc_i a, hc_i b), (int32_t)((uint32_t)a + (uint32_t)b))
HC_ONE(hc_i, hc_i_mul, (hc_i a, hc_i b), (int32_t)((uint32_t)a *(uint32_t)b))
HC_ONE(hc_i, hc_i_min, (hc_i a, hc_i b), a < b ? a : b)
HC_ONE(hc_i, hc_i_max, (hc_i a, hc_i b), a > b ? a : b)
HC_ONE(hc_i, hc_i_and, (hc_i a, hc_i b), a &b)
HC_ONE(hc_i, hc_i_or, (hc_i a, hc_i b), a | b)
HC_ONE(hc_i, hc_i_xor, (hc_i a, hc_i b), a ^ b)
HC_ONE(hc_i, hc_i_left, (hc_i a, hc_i b), (int32_t)((uint32_t)a << b))
HC_ONE(hc_i, hc_i_right, (hc_i a, hc_i b), (int32_t)((uint32_t)a >> b))
HC_ONE(hc_i, hc_i_lookup, (const int32_t *table, hc_i index), table[index])
HC_ONE(int32_t, hc_i_first, (hc_i a, unsigned lanes), (lanes & 1) != 0 ? a : 0)
HC_ONE(unsigned, hc_i_differ, (hc_i a, hc_i b), a != b)
#if defined(__SSE2__)
HC_ONE(hc_i, hc_i_from_v, (hc_v a), _mm_cvttss_si32(_mm_set_ss(a)))
#else
HC_ONE(hc_i, hc_i_from_v, (hc_v a), fabsf(a) < 0x1p31F ? (int32_t)a : INT32_MIN)
#endif
HC_ONE(hc_v, hc_v_from_i, (hc_i a), (float)a)

static inline hc_v hc_v_gather(const void *base, hc_i index, unsigned lanes)
{
    float found = 0.0F;
    if ((lanes & 1) != 0) {
        memcpy(&found, (const char *)base + 4 * (ptrdiff_t)index, sizeof found);
    }
    return found;
}

static inline void hc_v_store(float *p, hc_v a)
{
    *p = a;
}

static inline void hc_i_store(int32_t *p, hc_i a)
{
    *p = a;
}

static inline void hc_v_put(float *p, unsigned lanes, hc_v a)
{
    if ((lanes & 1) != 0) {
        *p = a;
    }
}

static inline void hc_i_put(int32_t *p, unsigned lanes, hc_i a)
{
    if ((lanes & 1) != 0) {
        *p = a;
    }
}

static inline hc_v hc_v_of_bits(hc_i a)
{
    hc_v r;
    memcpy(&r, &a, sizeof r);
    return r;
}

#endif
