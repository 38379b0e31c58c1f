/* Searches of a cone job by shaders: for bakes that are read back and for maps that stay. */
#ifndef HC_GPU_CONES_H
#define HC_GPU_CONES_H

#include "gpu.h"

#include "bake/change.h"
#include "bake/cone_job.h"

/* Texture and image units of searches. */
enum { HC_GPU_BEST_UNIT = 0, HC_GPU_HEIGHTS_UNIT, HC_GPU_BLOCKS_UNIT, HC_GPU_FREE_UNIT };

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
    int                  count, current;        /* searches */
    unsigned             heights, blocks, best; /* blocks: 0 for brute force    */
    unsigned             counters, waiting;     /* of pruned searches: buffers */
    const hc_gpu_change *change; /* method exact: search only where it may matter; NULL: all */
} hc_gpu_baking;

/* HC_ERROR_UNSUPPORTED for those that are the CPU's alone. */
hc_result hc_gpu_check_method(hc_method method, hc_log *log);

/* Which searches there are. */
hc_gpu_baking hc_gpu_plan(hc_gpu *gpu, const hc_cone_job *job, const hc_cone_options *options);

/* Textures of what searches leave: those of relaxed cones all add to one. */
int hc_gpu_finds(const hc_gpu_baking *b);

/* What is at `blocks`: nothing, a mip pyramid of the heights, families of them, or families of the
 * samples that limit relaxed cones, for each search anew. */
typedef enum hc_gpu_walk {
    HC_GPU_NOTHING = 0,
    HC_GPU_MIPS,
    HC_GPU_ALL,
    HC_GPU_LIMITING
} hc_gpu_walk;
hc_gpu_walk hc_gpu_walks(hc_method method);

/* Make and fill `heights` and `blocks`, make the buffers. hc_gpu_unload must follow, whatever the
 * result. */
hc_result hc_gpu_load(hc_gpu_baking *b);
void      hc_gpu_unload(const hc_gpu_baking *b);
/* Bind them to their units. */
void hc_gpu_bind(const hc_gpu_baking *b);
/* What lies above a rectangle of samples; mips: level 0 is there. */
hc_result hc_gpu_fill_blocks(const hc_gpu_baking *b, hc_rect changed);

/* Counters of pruned searches. */
typedef enum hc_gpu_counter { HC_GPU_SEARCHED = 0, HC_GPU_UNFINISHED } hc_gpu_counter;
uint32_t hc_gpu_count(const hc_gpu_baking *b, hc_gpu_counter counter);
void     hc_gpu_set_count(const hc_gpu_baking *b, hc_gpu_counter counter, uint32_t count);

/* Of the one family that has all samples. */
int hc_gpu_top_level(const hc_gpu_baking *b);

/* Searches that can wait for the next dispatch; so a dispatch has no more texels, or one row. */
enum { HC_GPU_WAITING_MAX = 1 << 20 };

/* Run the search `current`, into `best`. */
hc_result hc_gpu_search(const hc_gpu_baking *b);

/* Drivers that do not round may have found up to 2^-19 less than there is: what was found is
 * multiplied by this. */
float hc_gpu_outwards(const hc_gpu *gpu);

#endif
