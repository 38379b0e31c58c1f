/* The field as the published methods see it: a texture that is filtered wherever they look, and a
 * box of heights 0 .. 1. They look at points of the ray, not at what is between them. */
#ifndef HC_TRACE_IMAGE_H
#define HC_TRACE_IMAGE_H

#include "tracer.h"

/* Directions in texture space, per s. */
typedef struct hc_image_ray {
    double run;    /* horizontal                                   */
    double length; /* of all three components                      */
    double end;    /* where it leaves the box, the bottom included */
} hc_image_ray;

hc_image_ray hc_image_ray_of(const hc_tracer *tracer, const hc_path *path);

/* Height of the ray above the filtered heights. */
double hc_image_gap(const hc_tracer *tracer, const hc_path *path, double s);

/* Filtered ratio at a point of the ray, as maps hold it: at most 1, and its root is filtered if
 * `root` (2006), itself if not. */
double hc_image_ratio(const hc_tracer *tracer, const hc_path *path, double s, bool root);

/* Report that the ray ends at s. */
void hc_image_stop(const hc_tracer *tracer, const hc_path *path, hc_found *found, double s,
                   uint32_t flags);

/* A bracket: above the surface at `above`, at or under it at `below`. Both return a place in it:
 * where the line between the ends comes down; and that, or what options.refinements bisections
 * found last at or under the surface, with the steps that it took; or `below` where there are to be
 * none. */
double hc_image_secant(const hc_tracer *tracer, const hc_path *path, double above, double below);
double hc_image_refine(const hc_tracer *tracer, const hc_path *path, hc_found *found, double above,
                       double below);

#endif
