/* Baking on the GPU, by compute shaders of OpenGL 4.3 (shaders/bake*.comp). In
 * libheightcast-render, which has all that needs OpenGL; without a GPU Mesa's software renderer
 * does it.
 *
 *     hc_gpu *gpu;
 *     if (hc_gpu_create(&gpu, &log) == HC_OK) {
 *         result = hc_gpu_bake_cone_map(gpu, ratios, &field, NULL, &log);
 *         hc_gpu_destroy(gpu);
 *     }
 *
 * What comes out is what bake.h promises: bit for bit where the driver rounds quotients and roots
 * as IEEE 754 does (hc_gpu_rounds), which is tried once. Elsewhere ratios are never wider than
 * those, and narrower by less than one part in 2^16; of two elongated diamonds that are about as
 * good it may be the other, and of gems, which promises nothing, neither holds. */
#ifndef HEIGHTCAST_GPU_H
#define HEIGHTCAST_GPU_H

#include <heightcast/bake.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An OpenGL context of its own, without a window, and the programs that were compiled so far.
 * Belongs to the thread that made it. */
typedef struct hc_gpu hc_gpu;

/* HC_ERROR_UNSUPPORTED where there is no EGL, no OpenGL 4.3, or this build has none;
 * HC_ERROR_MEMORY. Destroy with hc_gpu_destroy, which accepts NULL. */
HC_API hc_result hc_gpu_create(hc_gpu **gpu, hc_log *log);
HC_API void      hc_gpu_destroy(hc_gpu *gpu);

/* As the driver says; they live as long as `gpu`. */
HC_API const char *hc_gpu_name(const hc_gpu *gpu);
HC_API const char *hc_gpu_driver(
    const hc_gpu *gpu);                       /* who made it; versions of OpenGL and itself */
HC_API bool hc_gpu_rounds(const hc_gpu *gpu); /* as IEEE 754 does */

/* Seconds of the last bake that the shaders ran, less compiling, loading and reading back: by the
 * GPU's time stamps, with Mesa's software renderers by the wall clock, everything finished. Which
 * says hc_gpu_timer. */
HC_API double      hc_gpu_seconds(const hc_gpu *gpu);
HC_API const char *hc_gpu_timer(const hc_gpu *gpu); /* static */

/* As hc_bake_cone_map. Of the options, isa and threads do not count.
 *
 * Every method but ring, which is the CPU's alone: HC_ERROR_UNSUPPORTED. Work is given to
 * the driver in pieces that take about a twentieth of a second, and reported after each; in one
 * piece no search takes more than 1,024 steps, and no more than 2^20 are run.
 * Memory: 4 bytes per sample and search (l2, l1 1, quad 4, aniso 5); on the GPU 14 bytes per
 * sample, and 20 for each of the first 2^20. Errors besides: HC_ERROR_LIMIT for fields larger than
 * the driver's textures; HC_ERROR_MEMORY, on the GPU too; HC_ERROR_IO if the context is lost. */
HC_API hc_result hc_gpu_bake_cone_map(hc_gpu *gpu, float *ratios, const hc_field *field,
                                      const hc_cone_options *options, hc_log *log);

/* As hc_bake_pyramid, bit for bit, with the same errors. */
HC_API hc_result hc_gpu_bake_pyramid(hc_gpu *gpu, hc_pyramid *pyramid, float *values,
                                     const float *heights, int width, int height,
                                     hc_extreme extreme, hc_log *log);

/* As hc_bake_bounds and hc_bake_gradient, likewise. */
HC_API hc_result hc_gpu_bake_bounds(hc_gpu *gpu, float *bounds, const hc_field *field,
                                    hc_extreme extreme, hc_log *log);
HC_API hc_result hc_gpu_bake_gradient(hc_gpu *gpu, float *gradients, const hc_field *field,
                                      hc_log *log);

/* ---- maps that stay -------------------------------------------------------------------------- */

/* A field and its cone ratios in textures of `gpu`, which must outlive it and whose thread alone
 * may use it: hc_relief.baked draws them as they are, and when heights change only what the change
 * may matter to is searched again. */
typedef struct hc_gpu_map hc_gpu_map;

typedef struct hc_gpu_map_options {
    hc_cone_options cone; /* as hc_gpu_bake_cone_map; progress is reported by updates, too        */
    bool            cells; /* of each bilinear cell the least of its corners' (hc_bake_cell_ratios),
                              which `safe` takes */
} hc_gpu_map_options;

/* Bake `field`, of which nothing is borrowed; options NULL: all zero. Errors as
 * hc_gpu_bake_cone_map. Destroy with hc_gpu_map_destroy, which accepts NULL.
 * Memory: 4 bytes per sample; on the GPU 10, 4 per search (falling-edge 1) and 4 per channel (3
 * count as 4), with cells twice; and 20 for each of the first 2^20. */
HC_API hc_result hc_gpu_map_create(hc_gpu_map **map, hc_gpu *gpu, const hc_field *field,
                                   const hc_gpu_map_options *options, hc_log *log);
HC_API void      hc_gpu_map_destroy(hc_gpu_map *map);

/* Take over heights that changed inside `changed`: the ratios are then what a full bake by this GPU
 * gives, bit for bit.
 *
 * heights  the whole new field's heights; only those inside `changed` are read
 * rebaked  [out] searches of a sample that were run again, one (l2, l1), four (quad) or five
 *          (aniso) for each; may be NULL
 *
 * Method exact: samples inside `changed`, and those that its highest samples, old or new, could
 * limit; besides a test and a division for every sample. Other methods bake all anew. After errors
 * other than HC_ERROR_ARGUMENT and HC_ERROR_FIELD ratios are unspecified: make a new map then. */
HC_API hc_result hc_gpu_map_update(hc_gpu_map *map, const float *heights, hc_rect changed,
                                   size_t *rebaked, hc_log *log);

/* A copy of the ratios: width * height * hc_cones_channels(cones). */
HC_API hc_result hc_gpu_map_read(const hc_gpu_map *map, float *ratios, hc_log *log);

/* ---- for whole maps -------------------------------------------------------------------------- */

/* For hc_map_options.baker: hc_bake_map then has all that it stores from here. As long as
 * `gpu`. */
HC_API const hc_map_baker *hc_gpu_map_baker(hc_gpu *gpu);

#ifdef __cplusplus
}
#endif

#endif
