/* Lanes in memory, beside the arithmetic of simd.h: sixteen values of one kind stand in a row, and
 * move densely to and from the lanes whose bit is set. Values of four bytes are words, of any type.
 *
 * hc_pack_words      to[k] = lanes[i] for the k-th set bit i; may write HC_LANES values in any
 *                    case
 * hc_spread_words    lanes[i] = from[k] for the k-th set bit i; may read HC_LANES words in any case
 * hc_pack_doubles, hc_spread_doubles  the same of eight bytes
 * hc_rows            the reverse: word k of the eight words at rows[i] from word i of columns[k]
 * hc_rows_apart      the same, where each row stands so many bytes behind the one before it
 * hc_columns         columns[k][i] = word k of the eight words at base + 32 * rows[i]
 * hc_highest_of      highest[k] of all lanes of rows[k], sixteen rows
 *
 * HC_ROW(type) row[HC_LANES] stands on cache lines of its own, and so do the rows after it in a
 * struct: vectors that lie across two lines take twice as long to read and to write. */
#ifndef HC_BASE_LANES_H
#define HC_BASE_LANES_H

#include "simd.h"

enum { HC_ROW_WORDS = 8, HC_HIGHEST = 16 };

#define HC_ROW(type) _Alignas(HC_LANES * sizeof(type)) type

#if defined(HC_SIMD_AVX512)

static inline void hc_pack_words(void *to, unsigned lanes, const void *from)
{
    const __m512i all = _mm512_loadu_si512(from);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32((__mmask16)lanes, all));
}

static inline void hc_spread_words(void *lanes, unsigned set, const void *from)
{
    const __m512i old = _mm512_loadu_si512(lanes);
    _mm512_storeu_si512(lanes, _mm512_mask_expandloadu_epi32(old, (__mmask16)set, from));
}

static inline void hc_pack_doubles(double *to, unsigned lanes, const double *from)
{
    const __m512i low  = _mm512_loadu_si512(from);
    const __m512i high = _mm512_loadu_si512(from + 8);
    const int     n    = __builtin_popcount(lanes & 255);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64((__mmask8)lanes, low));
    _mm512_storeu_si512(to + n, _mm512_maskz_compress_epi64((__mmask8)(lanes >> 8), high));
}

static inline void hc_spread_doubles(double *lanes, unsigned set, const double *from)
{
    const __m512i low  = _mm512_loadu_si512(lanes);
    const __m512i high = _mm512_loadu_si512(lanes + 8);
    const int     n    = __builtin_popcount(set & 255);
    _mm512_storeu_si512(lanes, _mm512_mask_expandloadu_epi64(low, (__mmask8)set, from));
    _mm512_storeu_si512(lanes + 8,
                        _mm512_mask_expandloadu_epi64(high, (__mmask8)(set >> 8), from + n));
}

/* Two rows in one register. */
static inline __m512 hc_two_rows(const float *base, int32_t first, int32_t second)
{
    const __m256 low  = _mm256_loadu_ps(base + (ptrdiff_t)first * HC_ROW_WORDS);
    const __m256 high = _mm256_loadu_ps(base + (ptrdiff_t)second * HC_ROW_WORDS);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}

/* Quarter by quarter, 4 x 4 transposed. */
static inline void hc_turn4(__m512 out[4], __m512 a, __m512 b, __m512 c, __m512 d)
{
    const __m512 e = _mm512_unpacklo_ps(a, b);
    const __m512 f = _mm512_unpackhi_ps(a, b);
    const __m512 g = _mm512_unpacklo_ps(c, d);
    const __m512 h = _mm512_unpackhi_ps(c, d);
    out[0]         = _mm512_shuffle_ps(e, g, 0x44);
    out[1]         = _mm512_shuffle_ps(e, g, 0xee);
    out[2]         = _mm512_shuffle_ps(f, h, 0x44);
    out[3]         = _mm512_shuffle_ps(f, h, 0xee);
}

/* Words k and k + 4 of eight rows, for k = 0 .. 3: rows 0 to 3 in the first and third quarter of a
 * register where they are words k, in the others where they are words k + 4. */
static inline void hc_turn_rows(__m512 out[4], const float *base, const int32_t *rows)
{
    hc_turn4(out, hc_two_rows(base, rows[0], rows[4]), hc_two_rows(base, rows[1], rows[5]),
             hc_two_rows(base, rows[2], rows[6]), hc_two_rows(base, rows[3], rows[7]));
}

static inline void hc_columns(float columns[HC_ROW_WORDS][HC_LANES], const void *base,
                              const int32_t *rows)
{
    __m512 low[4];
    __m512 high[4];
    hc_turn_rows(low, base, rows);
    hc_turn_rows(high, base, rows + 8);
    for (int k = 0; k < 4; k++) {
        _mm512_storeu_ps(columns[k], _mm512_shuffle_f32x4(low[k], high[k], 0x88));
        _mm512_storeu_ps(columns[k + 4], _mm512_shuffle_f32x4(low[k], high[k], 0xdd));
    }
}

/* Rows i and i + 4 of eight columns in pairs[i], 8 + i and 12 + i in pairs[4 + i]. */
static inline void hc_turn_columns(__m512 pairs[8], const void *const columns[HC_ROW_WORDS])
{
    const __m512i first = _mm512_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23);
    const __m512i last  = _mm512_or_si512(first, _mm512_set1_epi32(8));
    __m512        quarters[2][4];
    for (int k = 0; k < 2; k++) { /* words 4 k .. 4 k + 3 of rows i, i + 4, i + 8, i + 12 */
        const __m512 c0 = _mm512_loadu_ps(columns[4 * k]);
        const __m512 c1 = _mm512_loadu_ps(columns[4 * k + 1]);
        const __m512 c2 = _mm512_loadu_ps(columns[4 * k + 2]);
        const __m512 c3 = _mm512_loadu_ps(columns[4 * k + 3]);
        hc_turn4(quarters[k], c0, c1, c2, c3);
    }
    for (int i = 0; i < 4; i++) {
        pairs[i]     = _mm512_permutex2var_ps(quarters[0][i], first, quarters[1][i]);
        pairs[4 + i] = _mm512_permutex2var_ps(quarters[0][i], last, quarters[1][i]);
    }
}

static inline __m256 hc_row(const __m512 pairs[8], int i)
{
    const __m512 pair = pairs[(i & 3) | (i >> 1 & 4)];
    return (i & 4) == 0 ? _mm512_castps512_ps256(pair)
                        : _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(pair), 1));
}

static inline void hc_rows(void *const rows[HC_LANES], const void *const columns[HC_ROW_WORDS])
{
    __m512 pairs[8];
    hc_turn_columns(pairs, columns);
    for (int i = 0; i < HC_LANES; i++) {
        _mm256_storeu_ps(rows[i], hc_row(pairs, i));
    }
}

static inline void hc_rows_apart(void *first, size_t apart, const void *const columns[HC_ROW_WORDS])
{
    __m512 pairs[8];
    hc_turn_columns(pairs, columns);
    for (size_t i = 0; i < HC_LANES; i++) {
        _mm256_storeu_ps((float *)((char *)first + i * apart), hc_row(pairs, (int)i));
    }
}

/* Of two registers that hold rows by turns, each folded once more, a quarter at a time. */
static inline __m512 hc_fold(__m512 a, __m512 b)
{
    return _mm512_max_ps(_mm512_shuffle_ps(a, b, 0x44), _mm512_shuffle_ps(a, b, 0xee));
}

static inline __m512 hc_fold_quarters(__m512 a, __m512 b)
{
    return _mm512_max_ps(_mm512_shuffle_f32x4(a, b, 0x88), _mm512_shuffle_f32x4(a, b, 0xdd));
}

static inline void hc_highest_of(float highest[HC_HIGHEST], const hc_v rows[HC_HIGHEST])
{
    __m512 two[8];
    __m512 four[4];
    for (int k = 0; k < 8;
         k++) { /* words of each quarter: of the first, the second, the first... */
        const __m512 low  = _mm512_unpacklo_ps(rows[2 * k], rows[2 * k + 1]);
        const __m512 high = _mm512_unpackhi_ps(rows[2 * k], rows[2 * k + 1]);
        two[k]            = _mm512_max_ps(low, high);
    }
    for (int k = 0; k < 4; k++) {
        four[k] = hc_fold(two[2 * k], two[2 * k + 1]);
    }
    const __m512 low  = hc_fold_quarters(four[0], four[1]);
    const __m512 high = hc_fold_quarters(four[2], four[3]);
    _mm512_storeu_ps(highest, hc_fold_quarters(low, high));
}

#elif defined(HC_SIMD_AVX2)

static inline void hc_pack_words(void *to, unsigned lanes, const void *from)
{
    const __m256i *all = (const __m256i *)from;
    int32_t       *out = (int32_t *)to;
    out += hc_pack8(out, lanes & 255, _mm256_loadu_si256(all));
    (void)hc_pack8(out, lanes >> 8, _mm256_loadu_si256(all + 1));
}

static inline void hc_spread8(void *lanes, unsigned set, const void *from)
{
    const uint64_t bytes = _pdep_u64(set, 0x0101010101010101U) * 255;
    const uint64_t order = _pdep_u64(0x0706050403020100U, bytes);
    const __m256i  index = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order));
    const __m256i  dense = _mm256_loadu_si256((const __m256i *)from);
    const __m256i  old   = _mm256_loadu_si256((const __m256i *)lanes);
    const __m256i  moved = _mm256_permutevar8x32_epi32(dense, index);
    _mm256_storeu_si256((__m256i *)lanes, _mm256_blendv_epi8(old, moved, hc_i_mask8(set)));
}

static inline void hc_spread_words(void *lanes, unsigned set, const void *from)
{
    const size_t low = 4 * (size_t)__builtin_popcount(set & 255);
    hc_spread8(lanes, set & 255, from);
    hc_spread8((char *)lanes + 32, set >> 8, (const char *)from + low);
}

/* 8 x 8 words, transposed. */
static inline void hc_turn8(__m256 r[8])
{
    __m256 a[8];
    for (int k = 0; k < 8; k += 4) {
        const __m256 e = _mm256_unpacklo_ps(r[k], r[k + 1]);
        const __m256 f = _mm256_unpackhi_ps(r[k], r[k + 1]);
        const __m256 g = _mm256_unpacklo_ps(r[k + 2], r[k + 3]);
        const __m256 h = _mm256_unpackhi_ps(r[k + 2], r[k + 3]);
        a[k]           = _mm256_shuffle_ps(e, g, 0x44);
        a[k + 1]       = _mm256_shuffle_ps(e, g, 0xee);
        a[k + 2]       = _mm256_shuffle_ps(f, h, 0x44);
        a[k + 3]       = _mm256_shuffle_ps(f, h, 0xee);
    }
    for (int k = 0; k < 4; k++) {
        r[k]     = _mm256_permute2f128_ps(a[k], a[k + 4], 0x20);
        r[k + 4] = _mm256_permute2f128_ps(a[k], a[k + 4], 0x31);
    }
}

static inline void hc_columns(float columns[HC_ROW_WORDS][HC_LANES], const void *base,
                              const int32_t *rows)
{
    for (int half = 0; half < HC_LANES; half += 8) {
        __m256 r[8];
        for (int i = 0; i < 8; i++) {
            r[i] = _mm256_loadu_ps((const float *)base + (ptrdiff_t)rows[half + i] * HC_ROW_WORDS);
        }
        hc_turn8(r);
        for (int k = 0; k < 8; k++) {
            _mm256_storeu_ps(columns[k] + half, r[k]);
        }
    }
}

static inline void hc_rows(void *const rows[HC_LANES], const void *const columns[HC_ROW_WORDS])
{
    for (int half = 0; half < HC_LANES; half += 8) {
        __m256 r[8];
        for (int k = 0; k < 8; k++) {
            r[k] = _mm256_loadu_ps((const float *)columns[k] + half);
        }
        hc_turn8(r);
        for (int i = 0; i < 8; i++) {
            _mm256_storeu_ps((float *)rows[half + i], r[i]);
        }
    }
}

#endif

#if !defined(HC_SIMD_AVX512)

static inline void hc_highest_of(float highest[HC_HIGHEST], const hc_v rows[HC_HIGHEST])
{
    for (int k = 0; k < HC_HIGHEST; k++) {
        highest[k] = hc_v_highest(rows[k]);
    }
}

#define HC_MOVE_LANES(pack, spread, type, size)                                                    \
    static inline void pack(type *to, unsigned lanes, const type *from)                            \
    {                                                                                              \
        for (size_t k = 0; lanes != 0; lanes &= lanes - 1, k++) {                                  \
            memcpy((char *)to + (size)*k,                                                          \
                   (const char *)from + (size) * (size_t)__builtin_ctz(lanes), (size));            \
        }                                                                                          \
    }                                                                                              \
    static inline void spread(type *lanes, unsigned set, const type *from)                         \
    {                                                                                              \
        for (size_t k = 0; set != 0; set &= set - 1, k++) {                                        \
            memcpy((char *)lanes + (size) * (size_t)__builtin_ctz(set),                            \
                   (const char *)from + (size)*k, (size));                                         \
        }                                                                                          \
    }
HC_MOVE_LANES(hc_pack_doubles, hc_spread_doubles, double, 8)

#endif

#if !defined(HC_SIMD_AVX512) && !defined(HC_SIMD_AVX2)

HC_MOVE_LANES(hc_pack_words, hc_spread_words, void, 4)

static inline void hc_columns(float columns[HC_ROW_WORDS][HC_LANES], const void *base,
                              const int32_t *rows)
{
    for (int i = 0; i < HC_LANES; i++) {
        float row[HC_ROW_WORDS];
        memcpy(row, (const char *)base + (ptrdiff_t)rows[i] * (ptrdiff_t)sizeof row, sizeof row);
        for (int k = 0; k < HC_ROW_WORDS; k++) {
            columns[k][i] = row[k];
        }
    }
}

static inline void hc_rows(void *const rows[HC_LANES], const void *const columns[HC_ROW_WORDS])
{
    for (int i = 0; i < HC_LANES; i++) {
        for (int k = 0; k < HC_ROW_WORDS; k++) {
            memcpy((float *)rows[i] + k, (const float *)columns[k] + i, sizeof(float));
        }
    }
}

#endif

#if !defined(HC_SIMD_AVX512)

static inline void hc_rows_apart(void *first, size_t apart, const void *const columns[HC_ROW_WORDS])
{
    void *rows[HC_LANES];
    for (size_t i = 0; i < HC_LANES; i++) {
        rows[i] = (char *)first + i * apart;
    }
    hc_rows(rows, columns);
}

#endif

#endif
