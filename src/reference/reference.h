/* The judge: what the bakers make, once more, slow, in double precision and in the plainest form
 * that the definitions allow (docs/algorithms.md; its section numbers are cited below). Knows base
 * and field only, so that it cannot inherit an error from the code it judges. Every function looks
 * at every sample; use it on small fields.
 *
 * Samples are named by column x and row y, positions by u and v in texture space. Nothing is
 * checked. */
#ifndef HC_REFERENCE_H
#define HC_REFERENCE_H

#include <heightcast/field.h>

/* ---- cones --------------------------------------------------------------------------------- */

typedef enum hc_ref_metric {
    HC_REF_ROUND = 0, /* sqrt(du^2 + dv^2)                           */
    HC_REF_DIAMOND    /* |du| * elongation + |dv| / elongation       */
} hc_ref_metric;

/* Which cone is meant. Zero: round, in all directions. */
typedef struct hc_ref_cone {
    hc_ref_metric metric;
    double        elongation; /* of diamonds; 0: 1                                           */
    int           quadrant;   /* only what lies in it limits; 0: all, 1 .. 4: (+u +v), (-u +v),
                                 (+u -v), (-u -v), axes included                             */
} hc_ref_cone;

/* Distance in the cone's metric over that many sample distances; INFINITY outside its quadrant. */
double hc_ref_length(const hc_field *field, const hc_ref_cone *cone, double columns, double rows);

/* Distance of two samples: the nearest of the 9 images that the wrap modes and the quadrant allow;
 * INFINITY where none is allowed. */
double hc_ref_distance(const hc_field *field, const hc_ref_cone *cone, int px, int py, int qx,
                       int qy);

/* The ratio itself, a real number up to double rounding: least distance / rise over all samples
 * that are higher; INFINITY if none is. Section 2. */
double hc_ref_ratio(const hc_field *field, const hc_ref_cone *cone, int x, int y);

/* Elongations of two-slope cones, and the one whose slope_u + slope_v is least (the first such).
 * Section 5. */
#define HC_REF_ELONGATIONS 5
extern const double hc_ref_elongation[HC_REF_ELONGATIONS];
int                 hc_ref_best_elongation(const double ratios[HC_REF_ELONGATIONS]);

/* Quick maps (2022) by listing the texels of blocks and the texels visited. Section 9. */
typedef enum hc_ref_quick {
    HC_REF_QUICK_NAIVE = 0,
    HC_REF_QUICK_IMPROVED,
    HC_REF_QUICK_CENTRE,
    HC_REF_QUICK_NAIVE_CENTRE
} hc_ref_quick;
double hc_ref_quick_ratio(const hc_field *field, const hc_ref_cone *cone, hc_ref_quick variant,
                          int x, int y);

/* Relaxed round cones, section 12: by falling edges, and by rays of `steps` samples. A ray that
 * comes out of the surface by rounding only is undecided; with `leniency` > 0 whatever is short of
 * coming out by no more than that comes out, and with < 0 the other way round: the ratios for a
 * little more and a little less enclose all answers that rounding may give. */
double hc_ref_falling_edge_ratio(const hc_field *field, int x, int y);
double hc_ref_gems_ratio(const hc_field *field, int steps, double leniency, int x, int y);

/* ---- the surface between the samples ------------------------------------------------------- */

/* Height of the bilinear surface. */
double hc_ref_surface(const hc_field *field, double u, double v);

/* How far the *surface* rises into a diamond cone that stands on it at (u, v): the largest
 *   S(u + du, v + dv) - S(u, v) - slope_u * |du| - slope_v * |dv|
 * over all (du, dv) in the quadrant (0: all; as in hc_ref_cone). Never below 0, which is its value
 * at (0, 0). Exact up to double rounding: section 4.6 says why finitely many points decide. */
double hc_ref_surface_excess(const hc_field *field, int quadrant, double slope_u, double slope_v,
                             double u, double v);

/* The cell that owns a position: its first corner. */
void hc_ref_cell_at(const hc_field *field, double u, double v, int *x, int *y);

/* ---- what is made of heights and ratios ---------------------------------------------------- */

typedef enum hc_ref_extreme { HC_REF_MAXIMUM = 0, HC_REF_MINIMUM } hc_ref_extreme;

/* Pyramid blocks, section 7: number of texels of a level along an axis of `size` samples, and the
 * one above a sample. */
int hc_ref_level_size(int size, int level);
int hc_ref_block_of(int sample, int level, int size);

/* Extreme over the block (bx, by) of a level, from the samples themselves. */
float hc_ref_block_extreme(const float *heights, int width, int height, int level, int bx, int by,
                           hc_ref_extreme extreme);

/* Extreme of one channel over the four corners of the cell (x, y), wrapped or clamped.
 * Section 6. */
float hc_ref_cell_extreme(const float *values, int channels, int channel, int width, int height,
                          hc_wrap wrap, int x, int y, hc_ref_extreme extreme);

/* dh/du, dh/dv. Section 14. */
void hc_ref_gradient(double gradient[2], const hc_field *field, int x, int y);

/* Codes, section 15: the nearest height code, and the largest ratio code that decodes to at most
 * `ratio`. */
int    hc_ref_height_code(double height, int bits);
int    hc_ref_ratio_code(double ratio, double max_ratio, int bits);
double hc_ref_ratio_of_code(int code, double max_ratio, int bits);

/* Code of a slope in height codes per sample: nearest, halves towards level, at most the bias away
 * from the bias 127 or 32767. */
int hc_ref_slope_code(double slope, int bits);

/* One texel of the 2006 preprocessor's map, its faults included, from 8-bit heights. Sizes 2 and
 * up. Section 16. */
void hc_ref_dummer2006(int rgba[4], const uint8_t *heights, int width, int height, hc_wrap wrap,
                       int x, int y);

#endif
