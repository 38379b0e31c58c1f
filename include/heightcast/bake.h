/* Baking: field -> maps.
 *
 * All functions check their input, are reentrant, and give the same bytes for every thread count
 * and instruction set. Work memory is taken with malloc during the call and given back; the size is
 * stated. `log` may be NULL. */
#ifndef HEIGHTCAST_BAKE_H
#define HEIGHTCAST_BAKE_H

#include <heightcast/maps.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- cone maps ------------------------------------------------------------------------------- */

/* How ratios are found. A method that is not safe makes cones that samples may enter.
 * exact              the brute-force result by pruned search of a max pyramid; what you want
 * brute              all pairs: the judge of the others. Theta(N^2) for N samples
 * ring               expanding squares with early exit (2006). Same result as exact. l2, l1 only
 * quick              nearest texel of the 8 neighbours on every mip level (2022, algorithm 1).
 *                    Safe, narrow
 * quick-improved     nearest unvisited texel of them (2022, algorithm 2). Safe, less narrow
 * quick-centre       improved, with the centre of the unvisited part (2022, heuristic).
 *                    Wider, NOT safe
 * quick-naive-centre naive, with the centre of the block (2022, heuristic). Wider, NOT safe
 * gems               relaxed cones by ray sampling (GPU Gems 3, chapter 18). l2 only. NOT safe
 * falling-edge       exact relaxed cones (EGSR 2024): only falling edges limit. l2 only.
 *                    NOT safe */
typedef enum hc_method {
    HC_METHOD_EXACT = 0,
    HC_METHOD_BRUTE,
    HC_METHOD_RING,
    HC_METHOD_QUICK,
    HC_METHOD_QUICK_IMPROVED,
    HC_METHOD_QUICK_CENTRE,
    HC_METHOD_QUICK_NAIVE_CENTRE,
    HC_METHOD_GEMS,
    HC_METHOD_FALLING_EDGE
} hc_method;

/* "exact", "quick-improved", ...; NULL beyond the last. Static. */
HC_API const char *hc_method_name(hc_method method);

typedef struct hc_cone_options {
    hc_cones    cones;
    hc_method   method;
    float       max_ratio;  /* ratios above it are stored as it  [> 0]  0: no limit        */
    int         threads;    /* [0 .. 1024]  0: one per core, 1: calling thread only        */
    hc_isa      isa;        /* kernels of `exact` and `brute`                              */
    int         gems_steps; /* HC_METHOD_GEMS: samples per ray  [1 .. 4096]  0: 64         */
    hc_progress progress;
} hc_cone_options;

/* Give every sample p the widest upward cone, apex on the sample, that no other sample q enters.
 *
 * ratios   [out] width * height * hc_cones_channels(cones), row-major, channels interleaved
 *          [texture units per unit of normalised height], INFINITY where nothing is higher and
 *          there is no limit
 *
 * The canonical formula (float32, every operation rounded to nearest, no fused operations), bit for
 * bit what `exact`, `brute` and `ring` return:
 *   su = (float)hc_field_step_u(field), sv = (float)hc_field_step_v(field)
 *   i, j = |column distance|, |row distance| of p and q; along a wrapped axis that of q's
 *          nearest image
 *   rise = h(q) - h(p)
 *   l2:    x = i * su, y = j * sv;  weight = 1 / sqrt(x * x + y * y)
 *   l1:    x = i * su, y = j * sv;  weight = 1 / (x + y)
 *   aniso: as l1 with x = i * (su * a), y = j * (sv / a) for a in {1/4, 1/2, 1, 2, 4}
 *   best = maximum of rise * weight over all q with rise > 0
 *          (quad: q in that quadrant, axes included, nearest image in it)
 *   ratio = 1 / best * (1 - 2^-20)
 *   aniso: slope_u = best * a, slope_v = best / a of the `a` whose slope_u + slope_v is least
 *          (the first such); ratio_u = 1 / slope_u * (1 - 2^-20), ratio_v likewise; the third
 *          channel is l1
 *   at last ratio = min(ratio, max_ratio). Ratios above 2^60 count as no limit at all: INFINITY.
 * The last factor outweighs all rounding errors, so a stored ratio is never wider than the real
 * number, and narrower by less than one part in 2^18. Rises below 2^-60 of the height range count
 * as level.
 *
 * Safe on the bilinear surface: l1, quad and aniso after hc_bake_cell_ratios (docs/algorithms.md
 * has the proof); l2 is safe against the samples, as in the 2006 paper, not between them.
 *
 * Work memory: exact about 4.6 bytes per sample and at most 2 MiB; brute, ring: none to speak of;
 * quick, gems, falling-edge 6 bytes.
 * Time for N samples: exact about N log N on natural fields; brute N^2; quick N log N; gems
 * N^2 * steps.
 * Source: Dummer 2006 (definition, ring), 2022 sections 3 (quick), docs/algorithms.md (exact, quad,
 * aniso).
 * Errors: hc_field_check's; HC_ERROR_ARGUMENT for a method that does not make these cones;
 * HC_ERROR_MEMORY; HC_ERROR_CANCELLED. */
HC_API hc_result hc_bake_cone_map(float *ratios, const hc_field *field,
                                  const hc_cone_options *options, hc_log *log);

/* True if `method` can make `cones`. */
HC_API bool hc_method_makes(hc_method method, hc_cones cones);

/* Samples of a field; inside it. */
typedef struct hc_rect {
    int x, y, width, height;
} hc_rect;

/* A cone baker that stays: keeps the pyramids between calls so that a change of a small rectangle
 * costs what it affects. Method exact; owns about 4.5 bytes per sample; one thread at a time. */
typedef struct hc_cone_baker hc_cone_baker;

/* Create a baker and bake `ratios` for `field` once (as hc_bake_cone_map with method exact). The
 * baker keeps neither pointer. Destroy with hc_cone_baker_destroy, which accepts NULL. */
HC_API hc_result hc_cone_baker_create(hc_cone_baker **baker, float *ratios, const hc_field *field,
                                      const hc_cone_options *options, hc_log *log);
HC_API void      hc_cone_baker_destroy(hc_cone_baker *baker);

/* Take over heights that changed inside `changed`, and bring `ratios` to what a full bake of the
 * new field gives, bit for bit.
 *
 * ratios   [in, out] as the last create or update of this baker left it
 * heights  the whole new field's heights; outside `changed` they must be the same as before
 * rebaked  [out] number of samples whose search was run again; may be NULL
 *
 * HC_ERROR_CANCELLED and HC_ERROR_MEMORY leave ratios unspecified: create a new baker then. */
HC_API hc_result hc_cone_baker_update(hc_cone_baker *baker, float *ratios, const float *heights,
                                      hc_rect changed, size_t *rebaked, hc_log *log);

/* Ratios of bilinear cells for the safe marchers: cell (i, j) has the corners (i, j), (i + 1, j),
 * (i, j + 1), (i + 1, j + 1), wrapped or clamped at the border, and gets the least of their ratios,
 * channel by channel.
 * cells [out] width * height * hc_cones_channels(cones); may not overlap `ratios`.
 * docs/algorithms.md proves what they promise; no errors. */
HC_API void hc_bake_cell_ratios(float *cells, const float *ratios, int width, int height,
                                hc_cones cones, hc_wrap wrap);

/* ---- gradients and pyramids ------------------------------------------------------------------ */

/* dh/du and dh/dv of every sample [height per texture unit], v downwards: central differences,
 * one-sided at unwrapped edges, 0 along an axis with one sample.
 * gradients [out] width * height * 2. */
HC_API void hc_bake_gradient(float *gradients, const hc_field *field);

typedef enum hc_extreme { HC_MAXIMUM = 0, HC_MINIMUM = 1 } hc_extreme;

/* Fill a pyramid from its level 0 upwards: each texel is the extreme of all base texels below it.
 * values [out] hc_pyramid_size(width, height) floats; `pyramid` is set to point at them.
 * heights may be the start of `values` itself (then level 0 is taken as it is). */
HC_API void hc_bake_pyramid(hc_pyramid *pyramid, float *values, const float *heights, int width,
                            int height, hc_extreme extreme);
/* Bring a pyramid up to date after `heights` changed inside `changed`; cost follows the
 * rectangle. */
HC_API void hc_update_pyramid(hc_pyramid *pyramid, const float *heights, hc_rect changed,
                              hc_extreme extreme);

/* Extreme of each bilinear cell's four corners (cells as in hc_bake_cell_ratios): the bounding map
 * of the WSCG 2009 paper, section 5. bounds [out] width * height. */
HC_API void hc_bake_bounds(float *bounds, const hc_field *field, hc_extreme extreme);

/* ---- whole maps, quantised safely ------------------------------------------------------------ */

/* What computes the numbers of a map: as hc_bake_cone_map, hc_bake_pyramid, hc_bake_bounds and
 * hc_bake_gradient, with `user` in front. heightcast/gpu.h has one. */
typedef struct hc_map_baker {
    hc_result (*cones)(void *user, float *ratios, const hc_field *field,
                       const hc_cone_options *options, hc_log *log);
    hc_result (*pyramid)(void *user, hc_pyramid *pyramid, float *values, const float *heights,
                         int width, int height, hc_extreme extreme, hc_log *log);
    hc_result (*bounds)(void *user, float *bounds, const hc_field *field, hc_extreme extreme,
                        hc_log *log);
    hc_result (*gradient)(void *user, float *gradients, const hc_field *field, hc_log *log);
    void *user;
} hc_map_baker;

typedef struct hc_map_options {
    hc_map_kind     kind;
    hc_layout       layout;
    int             bits;       /* 8, 16, 32; 0: 8 for dummer, else 32                           */
    bool            compat2006; /* dummer: the 2006 preprocessor's bytes, its faults included;
                                   8-bit heights only                                            */
    hc_cone_options cone;       /* kinds cone and relaxed. max_ratio 0: no limit for float, 1 for
                                   codes. relaxed: method gems or falling-edge; exact (zero) means
                                   falling-edge                                                  */
    /* NULL: the CPU. Slopes in codes, and compat2006, are the CPU's in any case. */
    const hc_map_baker *baker;
} hc_map_options;

/* Fill in the info of the map that hc_bake_map would make: all defaults resolved. Then allocate
 * hc_map_bytes. */
HC_API hc_result hc_map_info_for(hc_map_info *info, const hc_field *field,
                                 const hc_map_options *options, hc_log *log);

/* Bake a whole map: round the heights to the map's codes first, bake from the heights that will be
 * stored, round ratios down. The promise of the cones then holds for what the file says
 * (docs/algorithms.md).
 *
 * map      map->info from hc_map_info_for with the same field and options;
 *          map->texels [out] hc_map_bytes
 *
 * Heights go to the nearest code; layout quad stores none, so its ratios are those of the field's
 * own heights. Extremes are those of the field's own heights, rounded outwards. Layout height holds
 * the heights alone in cone maps, the maxima alone in pyramids.
 * Work memory beyond that of hc_bake_cone_map: 4 bytes per sample for rounded heights, 4 per sample
 * and channel for ratios that are not stored as float; pyramids 5.4 bytes per sample.
 * compat2006 needs at least 2 samples along both axes (the original reads outside the image
 * otherwise). */
HC_API hc_result hc_bake_map(hc_map *map, const hc_field *field, const hc_map_options *options,
                             hc_log *log);

/* ---- judging --------------------------------------------------------------------------------- */

/* How a map's ratios stand against brute force on the heights that the map itself stores (or on
 * `field` if it stores none): the figures of `heightcast verify`. The two ratios of an elongated
 * diamond (aniso) are judged together, by whether a sample is inside, for a method may choose
 * another elongation than the canonical one. worst_x, worst_y: where widest_factor was found. */
typedef struct hc_verdict {
    size_t checked;        /* texels * cone channels compared                                */
    size_t wider;          /* of these, wider than the canonical ratio                       */
    double widest_factor;  /* largest stored / true ratio; 1 if none is wider                */
    double mean_kept;      /* mean of stored / true, both at most max_ratio (1 if unlimited) */
    size_t height_differs; /* stored heights that are not the field's, rounded               */
    int    worst_x, worst_y;
} hc_verdict;

/* Recompute texels of a cone or relaxed map by brute force and compare.
 * texels   how many texels to check, spread over the map by a fixed pseudo-random order; 0 or more
 *          than there are: all
 * Cost: N per texel checked. HC_ERROR_ARGUMENT for kinds without ratios and for sizes that
 * differ. */
HC_API hc_result hc_verify_map(hc_verdict *verdict, const hc_map *map, const hc_field *field,
                               size_t texels, int threads, hc_progress progress, hc_log *log);

#ifdef __cplusplus
}
#endif

#endif
