/* The GPU as hc_bake_map takes it. */
#include "gpu.h"

static hc_result cones(void *user, float *ratios, const hc_field *field,
                       const hc_cone_options *options, hc_log *log)
{
    return hc_gpu_bake_cone_map(user, ratios, field, options, log);
}

static hc_result pyramid(void *user, hc_pyramid *made, float *values, const float *heights,
                         int width, int height, hc_extreme extreme, hc_log *log)
{
    return hc_gpu_bake_pyramid(user, made, values, heights, width, height, extreme, log);
}

static hc_result bounds(void *user, float *values, const hc_field *field, hc_extreme extreme,
                        hc_log *log)
{
    return hc_gpu_bake_bounds(user, values, field, extreme, log);
}

static hc_result gradient(void *user, float *gradients, const hc_field *field, hc_log *log)
{
    return hc_gpu_bake_gradient(user, gradients, field, log);
}

const hc_map_baker *hc_gpu_map_baker(hc_gpu *gpu)
{
    gpu->baker = (hc_map_baker){
        .cones = cones, .pyramid = pyramid, .bounds = bounds, .gradient = gradient, .user = gpu
    };
    return &gpu->baker;
}
