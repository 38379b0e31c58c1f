/* Rays, hits, and what a ray meets: the words that all tracers share, and the reference walk that
 * judges them.
 *
 * Conventions (field.h has those of fields)
 * - A ray is the set of points origin + t * direction, tmin <= t <= tmax. The direction may have
 *   any length; t counts in it, so it is the same number in texture space and in world space.
 * - The field is solid at and below its surface, without end downwards. Along an unwrapped axis it
 *   ends at texture coordinates 0 and 1, in vertical side walls; along a wrapped axis it goes on.
 * - The first hit is the least t in tmin .. tmax at which the ray is in the solid. A ray that
 *   starts there hits at tmin, and says so (HC_HIT_INSIDE). A ray that comes in through a side wall
 *   hits the wall (HC_HIT_SIDE), unless sides are open: then it goes on below the surface, may
 *   leave it upwards without a hit, and hits what it comes down on later.
 * - A miss is an answer: t = INFINITY. Rays with a NaN, an infinite origin or direction, an
 *   infinite or NaN tmin, no direction at all, or tmax < tmin miss. tmax may be INFINITY. A hit
 *   whose t is beyond the largest float is a miss, too.
 * - Along a wrapped axis a ray is followed for HC_PERIODS_MAX periods from where it is at tmin, or
 *   where it first is between the sides that do not wrap and at most at height 1, if that is later
 *   (with open sides, below the surface: and at least at height -1): what lies beyond is a miss. */
#ifndef HEIGHTCAST_RAY_H
#define HEIGHTCAST_RAY_H

#include <heightcast/field.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HC_PERIODS_MAX 256

/* Eight floats, as in ray files. */
typedef struct hc_ray {
    float origin[3]; /* u, v, height; with a placement: x, y, z */
    float tmin;
    float direction[3];
    float tmax;
} hc_ray;

/* bilinear  patches between four samples, as field.h says
 * steps     every sample is a flat top, as wide as the distance between samples and centred on the
 *           sample (cut at 0 and 1), with vertical faces between different tops */
typedef enum hc_surface { HC_SURFACE_BILINEAR = 0, HC_SURFACE_STEPS } hc_surface;
HC_API const char *hc_surface_name(hc_surface surface); /* "bilinear", "steps"; static */

/* Where the field stands in the world:
 *   x = offset[0] + spacing_x * (u - u0) / step_u    u0, v0: texture coordinates of sample (0, 0)
 *   y = offset[1] + spacing_y * (v - v0) / step_v    step_u, step_v: hc_field_step_u, _v
 *   z = offset[2] + scale_z * height
 * So spacings are world units between samples, and offset is the place of sample (0, 0) at height
 * 0. Spacings may be negative (rows that run north to south), scale_z must be > 0. All zero:
 * texture space. */
typedef struct hc_placement {
    double spacing_x, spacing_y, scale_z;
    double offset[3];
} hc_placement;

/* Bits of hc_hit.flags.
 * inside       the ray starts in the solid
 * side         the hit is on a side wall of the field, or on a vertical face between steps
 * unconverged  the method ran out of steps; t is where it stopped (published methods only) */
enum { HC_HIT_INSIDE = 1, HC_HIT_SIDE = 2, HC_HIT_UNCONVERGED = 4 };

typedef struct hc_hit {
    float    t;      /* INFINITY: a miss; all but steps and crossings are then 0              */
    float    u, v;   /* texture coordinates; 0 .. 1 along an unwrapped axis, as they come along
                         a wrapped one                                                         */
    float    height; /* of the ray at t, normalised                                           */
    int32_t  cell_x; /* bilinear: the cell between samples cell_x and cell_x + 1, -1 to width - 1
                         unwrapped, 0 to width - 1 wrapped. steps: the sample                  */
    int32_t  cell_y; /* likewise                                                              */
    uint32_t flags;
    uint32_t steps;     /* steps along the ray: what a step is depends on the method           */
    uint32_t crossings; /* of them, moves over a wall of a cell or of a node of the pyramid    */
} hc_hit;

/* How the reference sees a field. All zero: the bilinear surface as it is. */
typedef struct hc_reference_options {
    hc_surface   surface;
    bool         open_sides;
    hc_placement placement;
    /* For judging others: the surface of every cell is raised by rise + reach * (largest difference
     * of neighbouring corners, per sample distance, over the cell and the eight around it), or
     * lowered if both are negative. Steps are raised by rise, and each top grows by reach, at the
     * cost of lower (negative: higher) neighbours. So does the field at its sides. `reach` is a
     * sideways distance in samples, below 1/4. A method whose arithmetic is as good as a ray moved
     * by at most `rise` upwards and `reach` sideways finds its hit between those of the raised and
     * the lowered surface, unless it starts under the surface at an open side. */
    double rise, reach;
} hc_reference_options;

/* The judge: a walk over every cell the ray crosses, in double precision, with the patch solved in
 * closed form. Fills `hit`; steps and crossings count cells. Cost: the cells crossed, whatever the
 * ray; `field` is read, not checked (hc_field_check does), nor is the placement. Exact but for
 * double rounding, which is below 2^-48 of the field's side (of 256 sides along a wrapped axis),
 * however far the origin is; t itself is rounded like all doubles, relative to tmin, too.
 * Returns t in double precision, INFINITY for a miss. `options` may be NULL. Reentrant.
 * Source: WSCG 2009 section 4 (patch; the last term of its printed formula should be u v z11). */
HC_API double hc_reference_trace(hc_hit *hit, const hc_field *field,
                                 const hc_reference_options *options, const hc_ray *ray);

/* The same for `count` rays, on `threads` threads (0: one per core): the same for every number of
 * them.
 * hits, exact  [out] of every ray, hits and returned values; either may be NULL
 * HC_OK or HC_ERROR_CANCELLED. */
HC_API hc_result hc_reference_batch(hc_hit *hits, double *exact, const hc_field *field,
                                    const hc_reference_options *options, const hc_ray *rays,
                                    size_t count, int threads, hc_progress progress, hc_log *log);

#ifdef __cplusplus
}
#endif

#endif
