/* Searches of a cone job by shaders: for bakes that are read back and for maps that stay. */
#ifndef HC_GPU_CONES_H
#define HC_GPU_CONES_H

#include "gpu.h"

#include "bake/change.h"
#include "bake/cone_job.h"

/* Texture and image units of searches. */
enum { HC_GPU_BEST_UNIT = 0, HC_GPU_HEIGHTS_UNIT, HC_GPU_HIGHEST_UNIT, HC_GPU_FREE_UNIT };

/* Heights that changed; with them textures are up to date, what searches found is not. */
typedef struct hc_gpu_change {
    hc_rect   rect;
    hc_change pieces[HC_CHANGES_MAX];
    int       count; /* of pieces, at least 1 */
} hc_gpu_change;

typedef struct hc_gpu_baking {
    hc_gpu              *gpu;
    const hc_cone_job   *job;
    hc_method            method;
    bool                 l2;
    hc_cone_search       searches[HC_CONE_SEARCHES_MAX];
    int                  count, current; /* searches */
    unsigned             heights, highest, best;
    const hc_gpu_change *change; /* method exact: search only where it may matter; NULL: all */
} hc_gpu_baking;

/* HC_ERROR_UNSUPPORTED for those that are the CPU's alone. */
hc_result hc_gpu_check_method(hc_method method, hc_log *log);

/* Which searches there are. */
hc_gpu_baking hc_gpu_plan(hc_gpu *gpu, const hc_cone_job *job, const hc_cone_options *options);

/* Textures of what searches leave: those of relaxed cones all add to one. */
int hc_gpu_finds(const hc_gpu_baking *b);

/* Fill `heights` and `highest`. Delete both afterwards, whatever the result. */
hc_result hc_gpu_load(hc_gpu_baking *b);
/* Bind them to their units. */
void hc_gpu_bind(const hc_gpu_baking *b);

/* Run the search `current`, into `best`. */
hc_result hc_gpu_search(const hc_gpu_baking *b);

/* Drivers that do not round may have found up to 2^-19 less than there is: what was found is
 * multiplied by this. */
float hc_gpu_outwards(const hc_gpu *gpu);

#endif
