/* A scene made ready: defaults resolved, camera aimed, tracers built. What all backends draw. */
#ifndef HC_RENDER_STAGE_H
#define HC_RENDER_STAGE_H

#include "eye.h"
#include "sight.h"

#include "trace/tracer.h"

typedef struct hc_stage {
    hc_scene          scene; /* defaults resolved */
    hc_render_options options;
    int               width, height;
    hc_shape          shape;
    hc_tracer        *tracer, *exact; /* exact: for views that compare, else NULL */
    hc_eye            eye;
    double            sun[3];      /* unit, towards it        */
    double            shadow_slip; /* a shadow's cause lies at least so far before the lit point */
    double            near, far;   /* of the view of depths   */
} hc_stage;

/* Check the scene and build what it needs. hc_stage_clear must follow, whatever the result. */
hc_result hc_stage_set(hc_stage *stage, const hc_picture *picture, const hc_scene *scene,
                       const hc_render_options *options, hc_log *log);
void      hc_stage_clear(hc_stage *stage);

/* True if the view compares with the exact hit. */
bool hc_view_compares(hc_view view);

/* A sun's rays start so far from what they light: outside every body. */
#define HC_SUN_AWAY 8.0

/* A ray of the eye, and the relief as it sees it: flatter where it fades, with fewer steps far
 * away. The ray of the light from there sees the same. */
typedef struct hc_gaze {
    double           origin[3], direction[3];
    hc_shape         shape;
    const hc_tracer *tracer;
    hc_tracer        thinned; /* what `tracer` is where the steps are fewer */
} hc_gaze;

void hc_stage_gaze(const hc_stage *stage, hc_gaze *gaze, double x, double y);

#endif
