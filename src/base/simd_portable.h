/* The lanes of simd.h, which includes this, in the compiler's own vectors of four: it finds the
 * machine's, or does without. */
#ifndef HC_BASE_SIMD_PORTABLE_H
#define HC_BASE_SIMD_PORTABLE_H

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

static inline unsigned hc_v_greater(hc_v a, hc_v b)
{
    unsigned lanes = 0;
    for (int i = 0; i < HC_LANES / 4; i++) {
        const hc_quarter_bits bit = (a.q[i] > b.q[i]) & (hc_quarter_bits){ 1, 2, 4, 8 };
        lanes |= (unsigned)(bit[0] | bit[1] | bit[2] | bit[3]) << (4 * i);
    }
    return lanes;
}

static inline float hc_v_lowest(hc_v a)
{
    const hc_quarter two  = hc_choose(a.q[0] < a.q[1], a.q[0], a.q[1]);
    const hc_quarter more = hc_choose(a.q[2] < a.q[3], a.q[2], a.q[3]);
    const hc_quarter all  = hc_choose(two < more, two, more);
    const float      low  = all[0] < all[1] ? all[0] : all[1];
    const float      high = all[2] < all[3] ? all[2] : all[3];
    return low < high ? low : high;
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
    float lanes[HC_LANES];
    for (int i = 0; i < HC_LANES; i++) {
        lanes[i] = (float)a.lane[i];
    }
    return hc_v_load(lanes);
}

static inline hc_v hc_v_of_bits(hc_i a)
{
    hc_v r;
    memcpy(&r, &a, sizeof r);
    return r;
}

static inline int32_t hc_i_first(hc_i a, unsigned lanes)
{
    int32_t all[HC_LANES];
    hc_i_store(all, a);
    return all[__builtin_ctz(lanes)];
}

static inline hc_v hc_v_gather(const void *base, hc_i index, unsigned lanes)
{
    float found[HC_LANES] = { 0.0F };
    for (int i = 0; i < HC_LANES; i++) {
        if ((lanes >> i & 1) != 0) {
            memcpy(&found[i], (const char *)base + 4 * (ptrdiff_t)index.lane[i], sizeof found[i]);
        }
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

#endif
