/* Height fields: the input of everything else.
 *
 * Conventions (they hold in all of heightcast)
 * - Samples are float32, row-major, row 0 is the image's top row. Heights are normalised: 0 lowest,
 *   1 highest.
 * - Texture space is (u, v, height). Sample (i, j) sits at u = (i + 0.5) / width,
 *   v = (j + 0.5) / height with texel registration, at u = i / (width - 1), v = j / (height - 1)
 *   with grid registration (elevation posts). Along a wrapped axis the samples are 1 / width
 *   (1 / height) apart in both registrations, so that the period is 1.
 * - The surface is the bilinear interpolation of the samples. Beyond the outermost samples it goes
 *   on with the edge value, or repeats along a wrapped axis. The field is solid below it. */
#ifndef HEIGHTCAST_FIELD_H
#define HEIGHTCAST_FIELD_H

#include <heightcast/result.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Largest side a field may have; indices and coordinates stay exact in float32. */
#define HC_SIDE_MAX (1 << 20)

typedef enum hc_wrap { HC_WRAP_NONE = 0, HC_WRAP_U = 1, HC_WRAP_V = 2, HC_WRAP_UV = 3 } hc_wrap;
HC_API const char *hc_wrap_name(hc_wrap wrap); /* "none", "u", "v", "uv"; static */

typedef enum hc_registration { HC_TEXEL = 0, HC_GRID = 1 } hc_registration;
HC_API const char *hc_registration_name(hc_registration registration); /* "texel", "grid"; static */

/* What the numbers meant before they were normalised. All zero: nothing is known.
 * original = low + height * (high - low). */
typedef struct hc_elevation {
    double low, high;            /* original values of heights 0 and 1; both 0: unknown      */
    double spacing_x, spacing_y; /* between samples, source's horizontal unit; 0: unknown    */
    double origin_x, origin_y;   /* georeferenced place of sample (0, 0), if `placed`        */
    bool   placed;
    bool   has_nodata; /* the source names a value that means "no sample here" */
    double nodata;
    int    source_bits; /* bits per sample in the source: 8, 16, 32, 64; 0: unknown */
    char   unit[16];    /* vertical unit, such as "m"; "" if unknown                */
} hc_elevation;

/* A height field. `heights` belongs to the caller and is only read. Zero for the rest is a good
 * default. */
typedef struct hc_field {
    const float    *heights; /* width * height samples, each finite and in 0..1 */
    int             width;   /* 1 .. HC_SIDE_MAX                                */
    int             height;  /* 1 .. HC_SIDE_MAX                                */
    hc_wrap         wrap;
    hc_registration registration;
    hc_elevation    elevation;
} hc_field;

/* Distance between neighbouring samples in texture space: 1 / width, or 1 / (width - 1) for grid
 * registration along an unwrapped axis with more than one sample. Always > 0. */
HC_API double hc_field_step_u(const hc_field *field);
HC_API double hc_field_step_v(const hc_field *field);

/* Check sizes, enums and every height. HC_ERROR_ARGUMENT or HC_ERROR_FIELD with the first culprit
 * in `log`. */
HC_API hc_result hc_field_check(const hc_field *field, hc_log *log);

/* Height of the bilinear surface at (u, v), in double precision; any finite u, v. For tools and
 * tests, not hot. */
HC_API double hc_field_surface(const hc_field *field, double u, double v);

/* ---- raw samples -> heights ------------------------------------------------------------------ */

typedef enum hc_sample_type {
    HC_U8 = 0,
    HC_U16,
    HC_I16,
    HC_U32,
    HC_I32,
    HC_F32,
    HC_F64
} hc_sample_type;
HC_API size_t hc_sample_size(hc_sample_type type); /* bytes; 0 for an unknown type */

/* Raw samples as an image file or an engine holds them: interleaved channels, rows without padding,
 * native endian. */
typedef struct hc_samples {
    const void    *data;
    hc_sample_type type;
    int            width, height;
    int            channels; /* 1 .. 4 */
} hc_samples;

/* auto   the only colour channel, or luma where there are three or more and they differ
 * g, a   of two channels both mean the second
 * luma   0.2126 R + 0.7152 G + 0.0722 B of the stored values (no transfer curve); the first channel
 *        where there are fewer than three */
typedef enum hc_channel {
    HC_CHANNEL_AUTO = 0,
    HC_CHANNEL_R,
    HC_CHANNEL_G,
    HC_CHANNEL_B,
    HC_CHANNEL_A,
    HC_CHANNEL_LUMA
} hc_channel;

/* auto   float types and placed (georeferenced) sources: data; other integers: type
 * data   lowest sample -> 0, highest -> 1; a constant field becomes 0
 * type   0 -> 0, largest code of the type (`type_max` if given) -> 1; float types: 0 and 1
 * given  `low` -> 0, `high` -> 1, clamped outside */
typedef enum hc_range { HC_RANGE_AUTO = 0, HC_RANGE_DATA, HC_RANGE_TYPE, HC_RANGE_GIVEN } hc_range;

/* error  refuse: HC_ERROR_FIELD with the count and the first place
 * fill   nearest valid sample in Chebyshev distance, averaged over ties
 * lowest the lowest valid height (after range and inversion) */
typedef enum hc_holes { HC_HOLES_ERROR = 0, HC_HOLES_FILL, HC_HOLES_LOWEST } hc_holes;

typedef struct hc_normalise_options {
    hc_channel channel;
    hc_range   range;
    double     low, high; /* HC_RANGE_GIVEN: low != high, both finite                    */
    double     type_max;  /* HC_RANGE_TYPE of integers: code that means 1, such as a
                             PGM's maxval; 0: the type's                                 */
    hc_holes   holes;     /* what to do about NaN, infinities and `elevation->nodata`    */
    bool       invert;    /* height = 1 - height: for depth maps                         */
} hc_normalise_options;

/* Turn raw samples into normalised heights; arithmetic in double, rounded to float once.
 *
 * heights    [out] width * height
 * samples    width, height 1 .. HC_SIDE_MAX
 * options    NULL or zero: defaults
 * elevation  [in, out] may be NULL. Read: nodata, placed. Written: low, high, source_bits. With
 *            `invert`, low and high are swapped, so that original = low + height * (high - low)
 *            still holds.
 *
 * HC_ERROR_FIELD: holes and HC_HOLES_ERROR, or no valid sample at all. HC_ERROR_ARGUMENT: a channel
 * that is not there, low == high. HC_ERROR_MEMORY: `fill` alone takes memory, 12 bytes per sample
 * around the holes. With the type's range it warns if the heights use less than 1/16 of that range,
 * or reach beyond it and were clamped. Reentrant. */
HC_API hc_result hc_normalise(float *heights, const hc_samples *samples,
                              const hc_normalise_options *options, hc_elevation *elevation,
                              hc_log *log);

/* ---- tiles -> one field ---------------------------------------------------------------------- */

#define HC_TILES_MAX 64 /* in a row or a column */

/* What neighbouring tiles have along a seam.
 * auto    shared if all edges agree, else apart
 * shared  the last column (row) of one is the first of the next: it is there once
 * apart   neighbours lie one sample distance apart, like samples within them */
typedef enum hc_seams { HC_SEAMS_AUTO = 0, HC_SEAMS_SHARED, HC_SEAMS_APART } hc_seams;

typedef struct hc_tiling {
    int      columns, rows; /* [1 .. HC_TILES_MAX] */
    hc_seams seams;
} hc_tiling;

/* Size of the field that `columns * rows` tiles make, row-major from the north-west (upper left).
 * Tiles of a column are as wide, those of a row as high; none wraps; all have one registration.
 * Each may have its own range: shared edges agree if they do to 2^-21 of the range of all.
 * HC_ERROR_ARGUMENT, HC_ERROR_FIELD where shared edges differ, HC_ERROR_LIMIT; `log` names the
 * tile. */
HC_API hc_result hc_join_size(int *width, int *height, const hc_tiling *tiling,
                              const hc_field *tiles, hc_log *log);

/* Join them: there is no seam in one field. Heights are brought into the range of all tiles, and
 * copied bit for bit where that is the tile's own; what else is known of elevations is taken from
 * the first tile, whose first sample is that of the whole.
 *
 * heights  [out] of hc_join_size
 * joined   [out] the field, with `heights`
 *
 * Errors: hc_join_size's. Reentrant. */
HC_API hc_result hc_join_fields(float *heights, hc_field *joined, const hc_tiling *tiling,
                                const hc_field *tiles, hc_log *log);

/* ---- made fields ----------------------------------------------------------------------------- */

/* Number, name and one-line description of the made fields, index 0 .. hc_synth_count() - 1; NULL
 * beyond. Static. */
HC_API int         hc_synth_count(void);
HC_API const char *hc_synth_name(int index);
HC_API const char *hc_synth_description(int index);

/* Fill `heights` (width * height) with the named field: heights in 0..1, same bytes on every
 * machine and for every number of threads (large fields take one per core). Fields marked "tiles"
 * in their description repeat without a seam; those marked "no seed" are always the same, for the
 * others `seed` selects the variant. HC_ERROR_ARGUMENT: unknown name (the text lists the known
 * ones) or sizes. Takes no memory of its own to speak of. Reentrant. */
HC_API hc_result hc_synth(float *heights, int width, int height, const char *name, uint64_t seed,
                          hc_log *log);

#ifdef __cplusplus
}
#endif

#endif
