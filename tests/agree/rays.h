/* Rays that are hard on tracers, and the judge of what a tracer answers. */
#ifndef AGREE_RAYS_H
#define AGREE_RAYS_H

#include "support.h"

#include <heightcast/trace.h>

/* What the rays of a set have in common. */
typedef enum agree_rays {
    RAYS_RANDOM = 0, /* any origin around the box, any direction          */
    RAYS_CAMERA,     /* an eye above the ground, a bundle of directions    */
    RAYS_GRAZING,    /* between two places just above the surface          */
    RAYS_AXIS,       /* along an axis                                      */
    RAYS_LINES,      /* along lines of samples and borders of cells        */
    RAYS_VERTICES,   /* through two samples, at their heights or beside    */
    RAYS_SPIKES,     /* past the highest of some samples, by very little   */
    RAYS_FAR,        /* origin 1e5 sides away, aimed at the field          */
    RAYS_UPRIGHT,    /* straight up or down                                */
    RAYS_LEVEL,      /* at the height of some sample                       */
    RAYS_UNDER,      /* from under the surface, or under the field         */
    RAYS_BORDER,     /* in the walls of the box, or just beside them       */
    RAYS_EXTREME,    /* directions and spans of all magnitudes             */
    RAYS_NOT_RAYS,   /* NaN, infinite, no direction, tmax < tmin           */
    RAYS_SETS
} agree_rays;

const char *agree_rays_name(agree_rays set);

/* The next ray of a set, in texture space. */
hc_ray agree_ray(const hc_field *field, agree_rays set, uint64_t *random);

/* The same ray in the world of a placement, as near as floats can be. */
hc_ray agree_place_ray(const hc_field *field, const hc_placement *placement, const hc_ray *ray);

/* What a tracer is held against. */
typedef struct agree_scene {
    const hc_field      *field;
    const char          *kind; /* for messages */
    const char          *method;
    hc_reference_options surface; /* rise and reach: of the tracer, both > 0 */
} agree_scene;

/* The judge, two one-sided claims: the hit is not before the first one on the surface raised by the
 * tracer's tolerance, and not after the first one on the surface lowered by it. Fails the test with
 * everything that is needed to repeat the case. A ray that comes in under the surface through an
 * open side may come up from some of the surfaces and not from others, and the claims need not hold:
 * then the reference on the surface as it is must say the same. *undecided counts these rays. */
void agree_judge(const agree_scene *scene, const hc_ray *ray, const hc_hit *hit, bool found,
                 size_t *undecided);

typedef struct agree_score {
    size_t fired, found, undecided;
} agree_score;

/* Build the tracer (baking what its method needs), fire `count` rays of each set, through all
 * functions that trace, which must agree bit for bit, and judge each; adds to *score. */
void agree_fire(agree_score *score, const hc_field *field, const char *kind,
                const hc_trace_options *options, hc_cones cones, size_t count, uint64_t *random);

#endif
