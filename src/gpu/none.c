/* What a build without OpenGL says. */
#include "base/fail.h"

#include <heightcast/gpu.h>

static hc_result refuse(hc_log *log)
{
    return hc_fail(log, HC_ERROR_UNSUPPORTED,
                   "OpenGL cannot be used: heightcast was built without libepoxy");
}

hc_result hc_gpu_create(hc_gpu **gpu, hc_log *log)
{
    *gpu = NULL;
    return refuse(log);
}

void hc_gpu_destroy(hc_gpu *gpu)
{
    (void)gpu;
}

/* Nobody has a `gpu` to ask the rest with. */

const char *hc_gpu_name(const hc_gpu *gpu)
{
    (void)gpu;
    return "none";
}

const char *hc_gpu_driver(const hc_gpu *gpu)
{
    (void)gpu;
    return "none";
}

bool hc_gpu_rounds(const hc_gpu *gpu)
{
    (void)gpu;
    return false;
}

const char *hc_gpu_timer(const hc_gpu *gpu)
{
    (void)gpu;
    return "none";
}

double hc_gpu_seconds(const hc_gpu *gpu)
{
    (void)gpu;
    return 0.0;
}

hc_result hc_gpu_bake_cone_map(hc_gpu *gpu, float *ratios, const hc_field *field,
                               const hc_cone_options *options, hc_log *log)
{
    (void)gpu;
    (void)ratios;
    (void)field;
    (void)options;
    return refuse(log);
}

hc_result hc_gpu_bake_pyramid(hc_gpu *gpu, hc_pyramid *pyramid, float *values, const float *heights,
                              int width, int height, hc_extreme extreme, hc_log *log)
{
    (void)gpu;
    (void)pyramid;
    (void)values;
    (void)heights;
    (void)width;
    (void)height;
    (void)extreme;
    return refuse(log);
}

hc_result hc_gpu_bake_bounds(hc_gpu *gpu, float *bounds, const hc_field *field, hc_extreme extreme,
                             hc_log *log)
{
    (void)gpu;
    (void)bounds;
    (void)field;
    (void)extreme;
    return refuse(log);
}

hc_result hc_gpu_bake_gradient(hc_gpu *gpu, float *gradients, const hc_field *field, hc_log *log)
{
    (void)gpu;
    (void)gradients;
    (void)field;
    return refuse(log);
}

hc_result hc_gpu_map_create(hc_gpu_map **map, hc_gpu *gpu, const hc_field *field,
                            const hc_gpu_map_options *options, hc_log *log)
{
    *map = NULL;
    (void)gpu;
    (void)field;
    (void)options;
    return refuse(log);
}

void hc_gpu_map_destroy(hc_gpu_map *map)
{
    (void)map;
}

hc_result hc_gpu_map_update(hc_gpu_map *map, const float *heights, hc_rect changed, size_t *rebaked,
                            hc_log *log)
{
    (void)map;
    (void)heights;
    (void)changed;
    (void)rebaked;
    return refuse(log);
}

hc_result hc_gpu_map_read(const hc_gpu_map *map, float *ratios, hc_log *log)
{
    (void)map;
    (void)ratios;
    return refuse(log);
}

const hc_map_baker *hc_gpu_map_baker(hc_gpu *gpu)
{
    (void)gpu;
    return NULL;
}
