/* The bodies: where a point of the world is in texture space, and how it lies there. All are closed
 * formulas, so a ray through the shell can be bent without integrating anything. */
#ifndef HC_RENDER_SHAPE_H
#define HC_RENDER_SHAPE_H

#include <heightcast/render.h>

typedef struct hc_shape {
    hc_body body;
    double  depth;
    double  radius;  /* of hull: cylinder, sphere, the torus' tube */
    double  ring;    /* torus: of the circle the tube goes along  */
    double  half[2]; /* plane: half sides; cylinder: half[1] is half its height */
    double  repeat[2];
    bool    closed[2]; /* the axis closes upon itself */
    double  bound;     /* radius of a ball about the origin that holds the body */
} hc_shape;

/* `relief` with its defaults resolved. */
hc_shape hc_shape_of(const hc_relief *relief);

/* World -> u, v, height; u and v in 0 .. repeat on round bodies. */
void hc_shape_place(const hc_shape *shape, double uvh[3], const double point[3]);

/* Of all images of `uvh` along closed axes, the one nearest to `before`. */
void hc_shape_unwrap(const hc_shape *shape, double uvh[3], const double before[3]);

/* Least radius of curvature of texture space's grid in the world at a point: how fast straight rays
 * bend there. INFINITY on the plane. */
double hc_shape_curvature_radius(const hc_shape *shape, const double point[3]);

/* Unit directions of u, v and outwards, and world units per texture unit. */
typedef struct hc_frame {
    double along_u[3], along_v[3], out[3];
    double scale[2];
} hc_frame;

hc_frame hc_shape_frame(const hc_shape *shape, const double point[3]);

#endif
