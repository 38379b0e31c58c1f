/* Tracing: rays against height fields. ray.h has the words: rays, hits, placement.
 *
 * A tracer is built once for a field and a method (cold, checked), is read-only afterwards, and is
 * shared freely between threads. The functions that trace are hot: they allocate nothing, check
 * nothing, and have no errors to report, since a miss is an answer.
 *
 *     hc_tracer *tracer;
 *     if (hc_tracer_create(&tracer, &field, NULL, &log) == HC_OK) {
 *         hc_hit hit;
 *         if (hc_trace_nearest(tracer, &hit, &ray)) { ... hit.t ... }
 *         hc_tracer_destroy(tracer);
 *     } */
#ifndef HEIGHTCAST_TRACE_H
#define HEIGHTCAST_TRACE_H

#include <heightcast/maps.h>
#include <heightcast/ray.h>

#ifdef __cplusplus
extern "C" {
#endif

/* name           finds                                        needs            source
 * fast           the first hit; many rays at a time           nothing          docs/algorithms.md
 * safe           the first hit, by diamond cones and patches  l1 or quad cell  docs/algorithms.md
 *                                                             ratios
 * maxmip         the first hit, by the pyramid of the         nothing          WSCG 2009, 3 and 4;
 *                bounding map and patches, down and up                         Tevs 2008
 * qdm            what the sample tops of the max pyramid      nothing          Drobot 2009
 *                give, level by level
 * parallax       one offset, limited                          nothing          Welsh 2004
 * linear         first of `steps` equal steps below           nothing          WSCG 2009, 2
 * relief         linear, then bisection                       nothing          Policarpo 2005
 * occlusion      linear, then one secant (parallax occlusion) nothing          Tatarchuk 2006
 * cone-fixed     `steps` cone steps, then stops               l2 ratios        Dummer 2006, fixed
 * cone-loop      cone steps until below or `steps`            l2 ratios        Dummer 2006, loop
 * cone-exact     texel-wide steps with a back-off             l2 ratios        Dummer 2006, exact
 * relaxed        relaxed cone steps, then bisection           relaxed ratios   GPU Gems 3, 18
 * robust         3 x 3 minimum of the cones, at least to the  l2 ratios        Robust Cone Step
 *                wall of the texel, then secant or bisection                   Mapping 2024
 * quick          cone steps until below or `steps`, then      l2 ratios        2022 (secant,
 *                secant or bisection                                           binary)
 * pdm            the walk of maxmip as it was printed: rays   nothing          WSCG 2009, 4 and 5
 *                slip past corners, and between patches
 *
 * fast, safe and maxmip lose no first hit and make none up, within the bound that
 * hc_tracer_tolerance gives. The others are what their papers say, losses included. They march
 * through the box of the field (heights 0 .. 1), and treat a ray that starts in the solid or comes
 * in through a side wall as ray.h says. */
typedef enum hc_trace_method {
    HC_TRACE_FAST = 0,
    HC_TRACE_SAFE,
    HC_TRACE_MAXMIP,
    HC_TRACE_QDM,
    HC_TRACE_PARALLAX,
    HC_TRACE_LINEAR,
    HC_TRACE_RELIEF,
    HC_TRACE_OCCLUSION,
    HC_TRACE_CONE_FIXED,
    HC_TRACE_CONE_LOOP,
    HC_TRACE_CONE_EXACT,
    HC_TRACE_RELAXED,
    HC_TRACE_ROBUST,
    HC_TRACE_QUICK,
    HC_TRACE_PDM
} hc_trace_method;

HC_API int         hc_trace_method_count(void);
HC_API const char *hc_trace_method_name(hc_trace_method method); /* as above; static */

/* Which ratios the method needs in options.ratios: none, cells, samples or relaxed. */
typedef enum hc_trace_needs {
    HC_NEEDS_NOTHING = 0,
    HC_NEEDS_CELL_RATIOS, /* hc_bake_cell_ratios of l1 or quad */
    HC_NEEDS_RATIOS,      /* hc_bake_cone_map, l2              */
    HC_NEEDS_RELAXED      /* hc_bake_cone_map, l2, methods gems or falling-edge */
} hc_trace_needs;
HC_API hc_trace_needs hc_trace_method_needs(hc_trace_method method);

/* What options.steps and options.refinements of 0 stand for; steps 0: the method counts none. */
HC_API int hc_trace_method_steps(hc_trace_method method);
#define HC_REFINEMENTS_DEFAULT 6

typedef struct hc_trace_options {
    hc_trace_method method;
    hc_surface      surface;    /* steps: fast, safe, maxmip and qdm only                         */
    bool            open_sides; /* no side walls                                                  */
    hc_placement    placement;  /* rays and normals in world space; zero: texture space           */
    const float    *ratios;     /* what the method needs; NULL where it needs nothing             */
    hc_cones        cones;      /* of `ratios`                                                    */
    int             steps;      /* steps along the ray of methods that count them
                                   [1 .. 65536]  0: 10 (cone-fixed), 32 (linear, relief,
                                   occlusion), 256 (cone-loop, cone-exact, robust, quick, relaxed)*/
    int             refinements; /* bisections of relief, relaxed, robust and quick  [1 .. 64]
                                   -1: one secant instead; -2: none, the hit is where the method
                                   first looked below the surface; 0: 6                           */
    hc_isa          isa;         /* kernels of fast                                               */
    int             threads;     /* for building  [0 .. 1024]  0: one per core                    */
} hc_trace_options;

typedef struct hc_tracer hc_tracer;

/* Build a tracer. Destroy with hc_tracer_destroy, which accepts NULL.
 *
 * field    checked by hc_field_check; heights and ratios are borrowed: they must stay, unchanged,
 *          until the tracer is destroyed. `field` itself may go
 * options  NULL or zero: fast, on the bilinear surface, in texture space
 *
 * Errors: hc_field_check's; HC_ERROR_ARGUMENT: a method without the ratios it needs, a surface the
 * method does not know, a placement that is neither zero nor whole, numbers out of range;
 * HC_ERROR_LIMIT: fast on more than 2.0 * 10^9 samples; HC_ERROR_MEMORY. */
HC_API hc_result hc_tracer_create(hc_tracer **tracer, const hc_field *field,
                                  const hc_trace_options *options, hc_log *log);
HC_API void      hc_tracer_destroy(hc_tracer *tracer);

/* The same from a baked map with heights (layouts dummer, rg, aniso, height; of pyramids level 0):
 * they are decoded, as are the ratios if the map has those that the method needs (cone maps of l1
 * for safe, of l2 for the methods that need l2 ratios, relaxed maps for relaxed) and
 * options->ratios is NULL. The tracer owns both: 4 or 8 bytes per texel besides what
 * hc_tracer_bytes says; `map` may go. What it promises, it promises for the heights of the map.
 * Errors: also HC_ERROR_ARGUMENT for maps without heights, and for bounds. */
HC_API hc_result hc_tracer_create_from_map(hc_tracer **tracer, const hc_map *map,
                                           const hc_trace_options *options, hc_log *log);

/* Bytes that hc_tracer_create takes for such a tracer, besides what it borrows; 0 if it would
 * refuse. Exact, but for the allocator's own. */
HC_API size_t hc_tracer_bytes(const hc_field *field, const hc_trace_options *options);

/* How exact fast, safe and maxmip are: as good as the reference for a surface moved by at most
 * `rise` [height] upwards or downwards and `reach` [samples] sideways (hc_reference_options), with
 * t rounded to float. docs/algorithms.md derives both. */
HC_API void hc_tracer_tolerance(const hc_tracer *tracer, double *rise, double *reach);

/* The pyramid that maxmip, pdm and qdm walk, for those who walk it elsewhere, such as in a shader:
 * the highest corner of each cell (qdm and steps: the samples), and above it the maximum of what is
 * below. Lives as long as the tracer; NULL for other methods. */
HC_API const hc_pyramid *hc_tracer_bounds(const hc_tracer *tracer);

/* The blocks that fast marches over, likewise: texels of two words for the hc_blocks of
 * shaders/heightcast.glsl, which has uniforms of these names. */
typedef struct hc_block_map {
    int   width, height; /* texels                                                       */
    int   room[2];       /* along both axes level k begins at room - (room >> 2 * k)     */
    int   cells[2];
    int   first[2]; /* where sample 0 is, in cells                                  */
    int   levels;   /* blocks of level k are 2 * 4^k cells wide                     */
    bool  sparse;   /* few things on flat ground: #define HC_SPARSE                 */
    float blur;     /* [cells] by which rounding in float32 may misplace a ray      */
} hc_block_map;

/* texels [out] 2 * width * height words, or NULL to learn the sizes first. False, and nothing is
 * written, for other methods. */
HC_API bool hc_tracer_block_map(const hc_tracer *tracer, hc_block_map *map, uint32_t *texels);

/* ---- hot ------------------------------------------------------------------------------------- */

/* The first hit; false: a miss. */
HC_API bool hc_trace_nearest(const hc_tracer *tracer, hc_hit *hit, const hc_ray *ray);

/* Is there any hit? For shadows and lines of sight: stops at the first it finds. */
HC_API bool hc_trace_any(const hc_tracer *tracer, const hc_ray *ray);

/* The same for `count` rays, in the calling thread. Rays that lie side by side in the picture
 * should lie side by side in memory; hits are those of the single-ray functions, bit for bit, but
 * for steps and crossings of `fast`: it takes sixteen rays in a row that start in nearly one place
 * and go in nearly one direction as one beam first, and counts what each does on its own.
 * any: 1 or 0 per ray. */
HC_API void hc_trace_nearest_many(const hc_tracer *tracer, hc_hit *hits, const hc_ray *rays,
                                  size_t count);
HC_API void hc_trace_any_many(const hc_tracer *tracer, uint8_t *any, const hc_ray *rays,
                              size_t count);

/* Unit normals of the surface at a hit, in the ray's space: `geometric` is that of the patch (of
 * the wall, on a side), `smooth` that of gradients interpolated between the samples; both may be
 * NULL. */
HC_API void hc_trace_normals(const hc_tracer *tracer, float geometric[3], float smooth[3],
                             const hc_hit *hit);

/* Heights of the surface below (or above) `count` points of the ray, the first at tmin, the last at
 * tmax, evenly spaced; in the ray's space; NAN where there is no field. tmax must be finite. */
HC_API void hc_trace_profile(const hc_tracer *tracer, float *heights, size_t count,
                             const hc_ray *ray);

/* ---- many rays, many threads ----------------------------------------------------------------- */

/* hc_trace_nearest_many on `threads` threads (0: one per core): same hits for every number of them.
 * HC_OK or HC_ERROR_CANCELLED. */
HC_API hc_result hc_trace_batch(const hc_tracer *tracer, hc_hit *hits, const hc_ray *rays,
                                size_t count, int threads, hc_progress progress, hc_log *log);
HC_API hc_result hc_trace_any_batch(const hc_tracer *tracer, uint8_t *any, const hc_ray *rays,
                                    size_t count, int threads, hc_progress progress, hc_log *log);

#ifdef __cplusplus
}
#endif

#endif
