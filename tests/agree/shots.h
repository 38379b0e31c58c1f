/* Pictures by the CPU and by OpenGL, side by side, and the ratios that their methods need. */
#ifndef AGREE_SHOTS_H
#define AGREE_SHOTS_H

#include "support.h"

#include <heightcast/terrain.h>

enum { SHOT_WIDE = 96, SHOT_HIGH = 64, SHOT_PIXELS = SHOT_WIDE * SHOT_HIGH };

/* Of 1,000 pixels one may differ by more than 2 codes: those on an edge (of a silhouette, of a
 * shadow, of a cut face, between steps of a march), where float32 and double decide differently. */
enum { SHOT_ODD_MAX = SHOT_PIXELS / 1000 };

typedef struct agree_shot {
    float      rgb[SHOT_PIXELS * 3], depth[SHOT_PIXELS];
    uint8_t    bytes[SHOT_PIXELS * 3];
    hc_picture picture;
} agree_shot;

/* Before drawing into shot->picture. */
void agree_shot_open(agree_shot *shot);
/* After it: fails the test unless `result` is HC_OK; skips it where that is no OpenGL. */
void agree_shot_close(agree_shot *shot, hc_result result, hc_backend backend, const hc_log *log);
/* The skipping alone. */
void agree_skip_without_gl(hc_result result, hc_backend backend, const hc_log *log);

/* A terrain, and what a camera sees of it, all in one. */
hc_terrain *agree_terrain_make(const hc_terrain_scene *scene, hc_view view, hc_backend backend);
void agree_shot_terrain(agree_shot *shot, const hc_terrain *terrain, const hc_camera *camera);

/* Pixels that differ. */
int agree_shots_odd(const agree_shot *a, const agree_shot *b);

/* Of all pictures of agree_tour. */
typedef struct agree_toured {
    uint64_t least_hits;                /* in a picture by the CPU            */
    uint64_t wrong_by_cpu, wrong_by_gl; /* rays lost and made up, HC_VIEW_MISSED */
} agree_toured;

/* From every tour, by the CPU and by OpenGL; if `parallel` > 0, once more with parallel rays that
 * span so much. Fails the test where the two differ in more than SHOT_ODD_MAX pixels. */
agree_toured agree_tour(const hc_terrain_scene *scene, hc_view view, float parallel);

/* A made field and all that methods need of it. */
enum { SHOT_SIDE_MAX = 48, SHOT_SAMPLES_MAX = SHOT_SIDE_MAX * SHOT_SIDE_MAX };
typedef struct agree_maps {
    hc_field field;
    float    heights[SHOT_SAMPLES_MAX], l2[SHOT_SAMPLES_MAX], relaxed[SHOT_SAMPLES_MAX];
    float    l1[SHOT_SAMPLES_MAX], quad[4 * SHOT_SAMPLES_MAX];
} agree_maps;

bool agree_maps_bake(agree_maps *maps, const char *name, int side, uint64_t seed, hc_wrap wrap);
/* The method, with the ratios that it needs. */
void agree_maps_choose(hc_trace_options *trace, const agree_maps *maps, hc_trace_method method);

#endif
