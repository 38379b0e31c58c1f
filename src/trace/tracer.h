/* What a tracer is made of, and the ray as all methods but `fast` see it.
 *
 * Methods count positions in cells: along an axis, cell k lies between the coordinates k and k + 1.
 * On the bilinear surface sample i sits at i; of steps, top i is cell i, and its sample in its
 * middle. Along an unwrapped axis the field may begin (texel registration) at -1/2. */
#ifndef HC_TRACE_TRACER_H
#define HC_TRACE_TRACER_H

#include "fast.h"

#include <heightcast/trace.h>

typedef struct hc_axis {
    int    size;
    bool   wraps;
    double steps;               /* cells per texture unit                                     */
    double zero;                /* u = (coordinate + zero) / steps                            */
    double offset, scale, unit; /* coordinate = (world - offset) * scale / unit - first       */
    double first;
    double period;    /* of the world, if it wraps                                            */
    double low, high; /* the field's ends; infinite if it wraps                               */
} hc_axis;

/* A ray where it enters the box of the field: at `place` for s = 0, and t = t0 + s. Along wrapped
 * axes `place` is in the first period, and `turns` counts what was taken out. */
typedef struct hc_path {
    double place[3], along[3];
    double turns[2];
    double t0, tmin, tmax;
    double from, end; /* s */
    int    cell[2];   /* at `from` */
} hc_path;

typedef struct hc_found {
    double   s; /* INFINITY: nothing */
    int      cell[2];
    uint32_t flags, steps, crossings;
} hc_found;

/* Find the first hit in path->from .. path->end, where the ray starts above the surface: all of
 * `found`, which comes zeroed and with s = INFINITY. */
typedef void hc_march(const hc_tracer *tracer, const hc_path *path, hc_found *found);

struct hc_tracer {
    hc_trace_options options; /* defaults resolved */
    const float     *heights;
    int              width, height;
    bool             tops; /* cells are flat tops: steps, and qdm always */
    hc_axis          axes[2];
    double           height_offset, height_scale;
    float           *owned;  /* heights and ratios decoded from a map, or NULL */
    hc_pyramid       bounds; /* of the cells' highest corners, or no values */
    hc_march        *march;  /* NULL: fast */
    hc_fast         *fast;
};

/* Sample or cell along an axis, of any period or beyond the border -> its index. */
static inline int hc_axis_index(const hc_axis *axis, int index)
{
    if (axis->wraps) {
        const int rest = index % axis->size;
        return rest < 0 ? rest + axis->size : rest;
    }
    return index < 0 ? 0 : index < axis->size ? index : axis->size - 1;
}

static inline size_t hc_tracer_index(const hc_tracer *tracer, int x, int y)
{
    return (size_t)hc_axis_index(&tracer->axes[1], y) * (size_t)tracer->width
           + (size_t)hc_axis_index(&tracer->axes[0], x);
}

static inline double hc_tracer_sample(const hc_tracer *tracer, int x, int y)
{
    return (double)tracer->heights[hc_tracer_index(tracer, x, y)];
}

/* clip.c */
void hc_axis_make(hc_axis *axis, const hc_field *field, const hc_trace_options *options, bool tops,
                  bool vertical);
/* Follow the ray to where its march begins. False: there is nothing to march, and `found` says
 * where it hits at once, if it does. */
bool hc_path_begin(const hc_tracer *tracer, hc_path *path, hc_found *found, const hc_ray *ray);
/* Follow the ray to the box, and march from there. Fills the hit; false: a miss. */
bool hc_trace_path(const hc_tracer *tracer, hc_hit *hit, const hc_ray *ray);

/* bounds.c: highest corner of every cell, and the pyramid of them. */
void hc_bounds_fill(hc_tracer *tracer, float *values);

/* The marches, one file per family. */
hc_march hc_march_safe, hc_march_maxmip, hc_march_pdm;
hc_march hc_march_parallax, hc_march_linear, hc_march_relief, hc_march_occlusion;
hc_march hc_march_cone_fixed, hc_march_cone_loop, hc_march_cone_exact, hc_march_quick;
hc_march hc_march_relaxed, hc_march_robust;

#endif
