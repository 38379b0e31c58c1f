/* Baked data: what stands between baking and tracing. Plain values, no hidden state.
 *
 * Cone ratio: run over rise in texture space, |(du, dv)| per unit of normalised height; the widest
 * upward cone with its apex on the sample that no other sample enters. INFINITY where nothing is
 * higher. See docs/algorithms.md for the formulas and for the proof of which ratios are safe on the
 * bilinear surface. */
#ifndef HEIGHTCAST_MAPS_H
#define HEIGHTCAST_MAPS_H

#include <heightcast/field.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- cones ----------------------------------------------------------------------------------- */

/* Shape of the cones, and what the channels of a ratio array mean. dx, dy are texture-space
 * distances (du, dv).
 * l2     1 channel: round, sqrt(dx^2 + dy^2) / rise
 * l1     1 channel: diamond, (|dx| + |dy|) / rise: safe on the bilinear surface by cell minimum
 * quad   4 channels: diamond, one per quadrant: (+u +v), (-u +v), (+u -v), (-u -v), axes included
 * aniso  3 channels: ratio_u, ratio_v of an elongated diamond |dx| / ratio_u + |dy| / ratio_v >=
 *        rise, and the plain diamond ratio. hc_bake_cone_map says which elongation is chosen */
typedef enum hc_cones { HC_CONES_L2 = 0, HC_CONES_L1, HC_CONES_QUAD, HC_CONES_ANISO } hc_cones;

HC_API int         hc_cones_channels(hc_cones cones); /* 1, 1, 4, 3; 0 for an unknown value */
HC_API const char *hc_cones_name(hc_cones cones);     /* "l2", "l1", "quad", "aniso"; static */

/* ---- pyramids -------------------------------------------------------------------------------- */

/* A mip pyramid of one float channel that drops nothing at odd sizes.
 * Level 0 has the base size; level k is max(1, width >> k) x max(1, height >> k), as graphics APIs
 * count, and its last column (row) also covers what an odd size leaves over: texel i of level k
 * covers base columns i * 2^k up to (i + 1) * 2^k - 1, the last one up to width - 1. The texel of
 * level k above base column x is min(x >> k, level width - 1). The last level is 1 x 1. */
typedef struct hc_pyramid {
    float *values; /* all levels, level 0 first, each row-major, without gaps */
    int    width, height;
    int    levels; /* floor(log2(max(width, height))) + 1 */
} hc_pyramid;

/* Levels, and floats in all levels together; 0 for a bad size. */
HC_API int    hc_pyramid_levels(int width, int height);
HC_API size_t hc_pyramid_size(int width, int height);
/* First value of level `level`; sizes to *level_width, *level_height if not NULL.
 * 0 <= level < pyramid->levels. */
HC_API float *hc_pyramid_level(const hc_pyramid *pyramid, int level, int *level_width,
                               int *level_height);

/* ---- maps as files and shaders hold them ----------------------------------------------------- */

/* cone      cone ratios
 * relaxed   relaxed cone ratios
 * pyramid   max and min mip pyramid of the samples
 * bounds    max and min over each bilinear cell's four corners, and their pyramid
 * gradient  dh/du, dh/dv */
typedef enum hc_map_kind {
    HC_MAP_CONE = 0,
    HC_MAP_RELAXED,
    HC_MAP_PYRAMID,
    HC_MAP_BOUNDS,
    HC_MAP_GRADIENT
} hc_map_kind;

/* "cone", "relaxed", "pyramid", "bounds", "gradient"; static. */
HC_API const char *hc_map_kind_name(hc_map_kind kind);

/* How texel channels are arranged. `n` is the largest code, 2^bits - 1; in float maps the value
 * itself is stored.
 * auto      cone, relaxed: rg (quad, aniso for those cones); pyramid, bounds: minmax;
 *           gradient: gradient
 * dummer    RGBA, 8 bits only: R height, G sqrt(ratio) with ratio at most 1, B dh/dx and A dh/dy
 *           (v upwards) per texel step, 0.5-biased, as in the 2006 paper. See docs/formats.md for
 *           the exact codes.
 * rg        height, ratio. Codes: ratio = max_ratio * (code / n)^2, rounded down.
 * quad      the four quadrant ratios, coded as in rg.
 * aniso     height, ratio_u, ratio_v, plain diamond ratio; ratios coded as in rg.
 * height    height alone: code / n.
 * minmax    highest, lowest: maxima rounded up, minima down (heights that are codes already stay
 *           exact).
 * gradient  dh/du, dh/dv [height per texture unit]; codes: 0.5-biased height per texel step, as in
 *           dummer but unflipped. */
typedef enum hc_layout {
    HC_LAYOUT_AUTO = 0,
    HC_LAYOUT_DUMMER,
    HC_LAYOUT_RG,
    HC_LAYOUT_QUAD,
    HC_LAYOUT_ANISO,
    HC_LAYOUT_HEIGHT,
    HC_LAYOUT_MINMAX,
    HC_LAYOUT_GRADIENT
} hc_layout;
HC_API const char *hc_layout_name(hc_layout layout);
HC_API int hc_layout_channels(hc_layout layout); /* 0 for HC_LAYOUT_AUTO and unknown values */

/* Everything about a map but its texels. Files carry it in their metadata. */
typedef struct hc_map_info {
    hc_map_kind     kind;
    hc_layout       layout; /* never AUTO in a baked map           */
    hc_cones        cones;  /* meaningful for cone and relaxed maps */
    int             bits;   /* 8, 16: unsigned codes; 32: float    */
    int             width, height;
    int             channels;
    int             levels; /* 1, or all levels of a pyramid */
    hc_wrap         wrap;
    hc_registration registration;
    float           max_ratio;  /* ratios are at most this; 0: no limit (float maps only) */
    bool            compat2006; /* bytes as the 2006 preprocessor writes them: not safe   */
    char            method[24]; /* how the ratios were found, such as "exact"             */
    hc_elevation    elevation;  /* of the field                                           */
} hc_map_info;

/* A baked map. Texels: interleaved channels, row-major, levels one after another as in hc_pyramid;
 * uint8_t, uint16_t (native endian) or float by info.bits. */
typedef struct hc_map {
    hc_map_info info;
    void       *texels;
} hc_map;

/* Bytes of all texels of a map with these sizes, channels, levels and bits; 0 if they are not
 * valid. */
HC_API size_t hc_map_bytes(const hc_map_info *info);
/* First byte of a level, and its size in texels if the pointers are not NULL. */
HC_API void *hc_map_level(const hc_map *map, int level, int *level_width, int *level_height);

/* Check that an info makes sense: enums, sizes, channels for the layout, bits. Names the culprit in
 * `log`. */
HC_API hc_result hc_map_info_check(const hc_map_info *info, hc_log *log);

/* Decoded texels of level 0. Cold: for tools and tests.
 * Height of a texel, 0..1; layouts without a height (quad, gradient) give NAN; minmax gives the
 * maximum.
 * Ratio of channel `cone` (0 .. hc_cones_channels - 1) of a cone or relaxed map; code 0 of a ratio
 * decodes to 0: "no free space known", which bakers write only where the true ratio is below the
 * smallest code. */
HC_API float hc_map_height_at(const hc_map *map, int x, int y);
HC_API float hc_map_ratio_at(const hc_map *map, int x, int y, int cone);

#ifdef __cplusplus
}
#endif

#endif
