/* What the integer codes of a map mean, in one place: whoever writes codes compares with what is
 * read back here. */
#ifndef HC_MAPS_CODES_H
#define HC_MAPS_CODES_H

/* Largest code of an 8 or 16 bit channel. */
static inline int hc_code_max(int bits)
{
    return (1 << bits) - 1;
}

static inline float hc_code_height(int code, int bits)
{
    return (float)code / (float)hc_code_max(bits);
}

/* Square law: most ratios are small, and the root spreads them over the codes. */
static inline float hc_code_ratio(int code, int bits, float max_ratio)
{
    const float root = (float)code / (float)hc_code_max(bits);
    return max_ratio * (root * root);
}

#endif
