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

/* How a method stands. */
typedef struct agree_score {
    size_t fired, found, undecided;
    size_t lost;  /* later than on the lowered surface, or not at all */
    size_t early; /* before the raised surface, or made up            */
    size_t odd;   /* functions that do not agree, or a hit that does not lie on the surface */
    double off;   /* largest distance in height of a hit on a patch, in the first period, from  */
    char   complaint[512]; /* all that is needed to repeat the first that is wrong */
} agree_score;

/* The judge, two one-sided claims: the hit is not before the first one on the surface raised by the
 * tracer's tolerance, and not after the first one on the surface lowered by it. A ray that comes in
 * under the surface through an open side may come up from some of the surfaces and not from others,
 * and the claims need not hold: then what the reference says on the surface as it is, is right.
 * Where that differs from what it says on the other two, or where the ray comes in between the
 * raised surface and the lowered one, so that it may touch the ground right there, any other answer
 * counts as undecided: there should be next to none. Adds to *score. */
void agree_judge(agree_score *score, const agree_scene *scene, const hc_ray *ray, const hc_hit *hit,
                 bool found);

/* Fails the test if anything was wrong. */
void agree_expect_right(const agree_score *score);

enum { AGREE_METHODS_MAX = 4 };

typedef struct agree_volley {
    const hc_field  *field;
    const char      *kind;
    hc_trace_options options; /* but for the method, the ratios and the cones */
    hc_cones         cones;   /* l1 or quad, for those that need cells' ratios */
    int              method_count;
    hc_trace_method  methods[AGREE_METHODS_MAX];
    size_t           count; /* rays of each set */
    int              threads;
    int              alone; /* of so many rays one is traced by itself too; 0: all */
    /* Hits whose t is that of the surface as it is, rounded, are right without the other two
     * surfaces: the reference orders the three, which others of these tests see to. */
    bool trust_equal;
} agree_volley;

/* Build the tracers (baking what they need), fire the same rays with all of them, through all
 * functions that trace, which must agree bit for bit, and judge each; adds to scores[method_count].
 * The same rays for every number of threads. */
void agree_fire(agree_score *scores, const agree_volley *volley, uint64_t *random);

#endif
