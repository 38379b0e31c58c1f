#include "shape.h"

#include "angle.h"
#include "vec.h"

#include <math.h>

hc_shape hc_shape_of(const hc_relief *relief)
{
    const hc_body body  = relief->body;
    hc_shape      shape = { .body   = body,
                            .depth  = (double)relief->depth,
                            .repeat = { relief->repeat[0], relief->repeat[1] },
                            .closed = { body != HC_BODY_PLANE, body == HC_BODY_TORUS } };
    switch (body) {
    case HC_BODY_PLANE:
        shape.half[0] = 1.0;
        shape.half[1] = (double)relief->aspect;
        shape.bound   = sqrt(1.0 + shape.half[1] * shape.half[1] + shape.depth * shape.depth);
        break;
    case HC_BODY_CYLINDER:
        shape.radius  = 0.6;
        shape.half[1] = 0.9;
        shape.bound   = 1.09; /* above sqrt(0.6^2 + 0.9^2) */
        break;
    case HC_BODY_SPHERE:
        shape.radius = 1.0;
        shape.bound  = 1.0;
        break;
    case HC_BODY_TORUS:
        shape.radius = 0.4;
        shape.ring   = 0.8;
        shape.bound  = 1.2;
        break;
    }
    return shape;
}

/* Distance from the z axis. */
static double from_axis(const double point[3])
{
    return sqrt(point[0] * point[0] + point[1] * point[1]);
}

/* Distance from where the hull's radius is counted: an axis, a point, a circle. */
static double from_core(const hc_shape *shape, const double point[3])
{
    const double flat = from_axis(point) - shape->ring;
    return shape->body == HC_BODY_CYLINDER ? flat : sqrt(flat * flat + point[2] * point[2]);
}

void hc_shape_place(const hc_shape *shape, double uvh[3], const double point[3])
{
    const double z = point[2];
    if (shape->body == HC_BODY_PLANE) {
        uvh[0] = shape->repeat[0] * (0.5 + 0.5 * point[0] / shape->half[0]);
        uvh[1] = shape->repeat[1] * (0.5 - 0.5 * point[1] / shape->half[1]);
        uvh[2] = 1.0 + z / shape->depth;
        return;
    }
    const double flat = from_axis(point) - shape->ring;
    double       v    = 0.5 - 0.5 * z / shape->half[1]; /* cylinder */
    if (shape->body == HC_BODY_SPHERE) {
        v = hc_angle(flat, z) / HC_PI;
    } else if (shape->body == HC_BODY_TORUS) {
        v = 0.5 - hc_angle(z, flat) / (2.0 * HC_PI);
    }
    uvh[0] = shape->repeat[0] * (0.5 + hc_angle(point[1], point[0]) / (2.0 * HC_PI));
    uvh[1] = shape->repeat[1] * fmin(fmax(v, 0.0), 1.0);
    uvh[2] = 1.0 + (from_core(shape, point) - shape->radius) / shape->depth;
}

void hc_shape_unwrap(const hc_shape *shape, double uvh[3], const double before[3])
{
    for (int i = 0; i < 2; i++) {
        const double period = shape->repeat[i];
        if (shape->closed[i]) {
            uvh[i] -= period * floor((uvh[i] - before[i]) / period + 0.5);
        }
    }
}

double hc_shape_curvature_radius(const hc_shape *shape, const double point[3])
{
    return shape->body == HC_BODY_PLANE ? INFINITY
                                        : fmin(from_core(shape, point), from_axis(point));
}

static void set(double out[3], double x, double y, double z)
{
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

hc_frame hc_shape_frame(const hc_shape *shape, const double point[3])
{
    hc_frame     f;
    const double axis  = fmax(from_axis(point), 1e-9); /* on the axis any direction will do */
    const double core  = fmax(from_core(shape, point), 1e-9);
    const double cos_u = point[0] / axis;
    const double sin_u = point[1] / axis;
    if (shape->body == HC_BODY_PLANE) {
        set(f.along_u, 1.0, 0.0, 0.0);
        set(f.along_v, 0.0, -1.0, 0.0);
        set(f.out, 0.0, 0.0, 1.0);
        f.scale[0] = 2.0 * shape->half[0] / shape->repeat[0];
        f.scale[1] = 2.0 * shape->half[1] / shape->repeat[1];
        return f;
    }
    set(f.along_u, -sin_u, cos_u, 0.0);
    f.scale[0] = 2.0 * HC_PI * axis / shape->repeat[0];
    if (shape->body == HC_BODY_CYLINDER) {
        set(f.along_v, 0.0, 0.0, -1.0);
        set(f.out, cos_u, sin_u, 0.0);
        f.scale[1] = 2.0 * shape->half[1] / shape->repeat[1];
        return f;
    }
    const double up   = point[2] / core; /* of the outward direction */
    const double flat = (from_axis(point) - shape->ring) / core;
    set(f.along_v, up * cos_u, up * sin_u, -flat);
    set(f.out, flat * cos_u, flat * sin_u, up);
    f.scale[1] = (shape->body == HC_BODY_SPHERE ? 1.0 : 2.0) * HC_PI * core / shape->repeat[1];
    return f;
}
