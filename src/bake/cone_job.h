/* What hc_bake_cone_map hands to the method it was asked for. Checked, defaults resolved. */
#ifndef HC_BAKE_CONE_JOB_H
#define HC_BAKE_CONE_JOB_H

#include <heightcast/bake.h>

typedef struct hc_cone_job {
    float       *ratios; /* [out] width * height * channels; no ratio limit applied yet */
    const float *heights;
    int          width, height;
    bool         wrap_u, wrap_v;
    float        step_u, step_v;
    hc_cones     cones;
    int          channels;
    int          threads;    /* 1 .. HC_THREADS_MAX */
    hc_isa       isa;        /* resolved            */
    int          gems_steps; /* > 0                 */
    hc_progress  progress;
    hc_log      *log;
} hc_cone_job;

/* Check everything and resolve defaults. */
hc_result hc_cone_job_init(hc_cone_job *job, float *ratios, const hc_field *field,
                           const hc_cone_options *options, hc_log *log);

/* The last step of every method; max_ratio 0: none. */
void hc_limit_ratios(float *ratios, size_t count, float max_ratio);

/* Elongations tried for HC_CONES_ANISO, in this order; the middle one is the plain diamond. */
#define HC_ANISO_COUNT 5
extern const float hc_aniso_elongation[HC_ANISO_COUNT];

/* ratio_u, ratio_v and the plain diamond's ratio from the largest steepness of each elongation. */
void hc_aniso_choose(float *ratios, const float steepness[HC_ANISO_COUNT]);

/* One search for the largest steepness: its steps, and the side that it looks at. */
typedef struct hc_cone_search {
    float step_u, step_v;
    int   sign_u, sign_v; /* 0: all directions; +1, -1: that side only (always both) */
} hc_cone_search;

#define HC_CONE_SEARCHES_MAX HC_ANISO_COUNT

/* The searches that the job's cones need, in the order that hc_write_ratios takes; how many. */
int hc_cone_searches(hc_cone_search searches[HC_CONE_SEARCHES_MAX], const hc_cone_job *job);

/* Channels of one sample from the largest steepness that each search found. */
void hc_write_ratios(float *ratios, hc_cones cones, const float *steepness);

hc_result hc_cone_exact(const hc_cone_job *job);
hc_result hc_cone_brute(const hc_cone_job *job);
hc_result hc_cone_ring(const hc_cone_job *job);                              /* l2, l1       */
hc_result hc_cone_quick(const hc_cone_job *job, bool improved, bool centre); /* all cones    */
hc_result hc_cone_gems(const hc_cone_job *job);                              /* l2           */
hc_result hc_cone_falling_edge(const hc_cone_job *job);                      /* l2           */

#endif
