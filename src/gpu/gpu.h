/* What baking on the GPU shares: the context, its programs, textures of one float. */
#ifndef HC_GPU_GPU_H
#define HC_GPU_GPU_H

#include "gl/context.h"

#include <heightcast/gpu.h>

/* As HC_BAKE in bake.comp. */
typedef enum hc_gpu_shader {
    HC_GPU_PYRAMID = 1,
    HC_GPU_BRUTE,
    HC_GPU_EXACT,
    HC_GPU_QUICK,
    HC_GPU_FAMILIES,
    HC_GPU_ROUNDING,
    HC_GPU_GEMS,
    HC_GPU_BOUNDS,
    HC_GPU_GRADIENT,
    HC_GPU_UPDATE,
    HC_GPU_RATIOS,
    HC_GPU_CELLS
} hc_gpu_shader;

enum { HC_GPU_NAME_MAX = 128 };

struct hc_gpu {
    hc_gl_context context; /* first: gl/map.h */
    hc_map_baker  baker;
    char          name[HC_GPU_NAME_MAX], driver[HC_GPU_NAME_MAX];
    bool          rounds; /* tests may say that it does not */
    bool          timer;  /* the GPU's own times seconds; tests may choose */
    int           looks;  /* at families in one dispatch for one texel; tests may choose */
    double        seconds, started;
    unsigned      stamps[2]; /* from start to stop */
};

/* Make the context the thread's, and set seconds to 0. */
hc_result hc_gpu_begin(hc_gpu *gpu, hc_log *log);

/* Compile the program, unless it is there, and use it. */
hc_result hc_gpu_use(hc_gpu *gpu, unsigned *program, hc_gpu_shader shader, bool l2, bool sided,
                     hc_log *log);

/* A texture of one float; values: of level 0, or NULL. HC_ERROR_LIMIT, HC_ERROR_MEMORY. */
hc_result hc_gpu_texture(unsigned *texture, int width, int height, int levels, const float *values,
                         hc_log *log);

/* Of one or of four floats, undefined. */
hc_result hc_gpu_empty_texture(unsigned *texture, int width, int height, int channels, hc_log *log);

/* Level 0 is there: all above it; or what lies above a rectangle of it. */
hc_result hc_gpu_fill_pyramid(hc_gpu *gpu, unsigned texture, int width, int height,
                              hc_extreme extreme, hc_log *log);
hc_result hc_gpu_update_pyramid(hc_gpu *gpu, unsigned texture, int width, int height,
                                hc_rect changed, hc_extreme extreme, hc_log *log);

/* Work between these two counts: wait, add to seconds, and give the seconds that it took by the
 * wall clock. */
void   hc_gpu_start(hc_gpu *gpu);
double hc_gpu_stop(hc_gpu *gpu);

/* Hand over one dispatch of the program in use, with what is bound, over the texels first .. end -
 * 1. Drivers finish compiling when a program runs for the first time, so that must be asked for
 * before the start. */
void hc_gpu_warm_up(hc_gpu *gpu, unsigned program);
void hc_gpu_dispatch(unsigned program, const int first[2], const int end[2]);

/* Warm up, start, dispatch, stop. */
double hc_gpu_run(hc_gpu *gpu, unsigned program, const int first[2], const int end[2]);

void hc_gpu_set_pair(unsigned program, const char *name, int x, int y);

#endif
