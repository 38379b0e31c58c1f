/* Canonical ratios of single texels by brute force, nothing left out: what maps are verified with.
 * It shares no search with the bakers it judges. */
#ifndef HC_BAKE_BRUTE_TEXEL_H
#define HC_BAKE_BRUTE_TEXEL_H

#include <heightcast/bake.h>

typedef struct hc_brute_texel {
    const float *heights;
    int          width, height;
    bool         wrap_u, wrap_v;
    float        step_u, step_v;
    int         *columns; /* scratch: width distances */
} hc_brute_texel;

/* The canonical ratios of texel (x, y), no limit applied; channels as in hc_bake_cone_map. */
void hc_brute_ratios(const hc_brute_texel *field, int x, int y, hc_cones cones, float *ratios);

/* How far the elongated diamond |dx| / ratio_u + |dy| / ratio_v at (x, y) is too wide: the largest
 * of rise / (|dx| / ratio_u + |dy| / ratio_v) over all samples. At most 1 if none enters it. */
float hc_brute_excess(const hc_brute_texel *field, int x, int y, float ratio_u, float ratio_v);

#endif
