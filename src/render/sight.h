/* What a ray of the world comes to: the shell of a body, straight pieces in texture space, a
 * hit. */
#ifndef HC_RENDER_SIGHT_H
#define HC_RENDER_SIGHT_H

#include "shape.h"

typedef struct hc_sight {
    double   distance; /* along the unit direction; INFINITY: nothing        */
    hc_hit   hit;      /* texture coordinates and height                      */
    double   cut[3];   /* normal of the cut face it is on; zero: it is on none */
    uint32_t steps;
    bool     entered; /* it came to the hull, or to a cut face */
    bool     unconverged;
} hc_sight;

/* Where a ray comes to the box (plane) or ball that holds the body; INFINITY: it passes by. */
double hc_sight_entry(const hc_shape *shape, const double origin[3], const double direction[3]);

/* Rays of the eye and those of the light differ at a clamped edge: the light also comes down to
 * ground that only continues the texture. */
typedef enum hc_sight_of { HC_SIGHT_OF_EYE = 0, HC_SIGHT_OF_LIGHT } hc_sight_of;

/* origin outside the hull; direction of unit length. */
hc_sight hc_sight_along(const hc_shape *shape, hc_edge edge, hc_sight_of of,
                        const hc_tracer *tracer, const double origin[3], const double direction[3]);

#endif
