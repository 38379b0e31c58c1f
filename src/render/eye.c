#include "eye.h"

#include "angle.h"
#include "vec.h"

#include <string.h>

hc_eye hc_eye_of(const hc_camera *camera, int width, int height)
{
    hc_eye eye   = { .width    = width,
                     .height   = height,
                     .samples  = camera->samples,
                     .parallel = camera->orthographic > 0.0F };
    double up[3] = { 0.0, 0.0, 1.0 };
    memcpy(eye.place, camera->eye, sizeof eye.place);
    hc_add_scaled(eye.forward, camera->at, -1.0, camera->eye);
    if (!hc_unit(eye.forward)) {
        memcpy(eye.forward, (const double[3]){ 0.0, 1.0, 0.0 }, sizeof eye.forward);
    }
    hc_cross(eye.right, eye.forward, up);
    if (!hc_unit(eye.right)) {
        eye.right[0] = 1.0; /* straight up or down: y is on top */
    }
    hc_cross(up, eye.right, eye.forward);
    const double half = eye.parallel ? 0.5 * (double)camera->orthographic
                                     : hc_tangent((double)camera->fov * HC_PI / 360.0);
    for (int i = 0; i < 3; i++) {
        eye.right[i] *= half;
        eye.down[i] = -up[i] * half * height / width;
    }
    return eye;
}

void hc_eye_sample_place(const hc_eye *eye, double place[2], int index)
{
    double bits    = 0.5;
    double place_y = 0.5; /* the digits of index in base two, mirrored at the point */
    for (int rest = index; rest > 0; rest >>= 1, bits *= 0.5) {
        place_y += (rest & 1) != 0 ? bits : 0.0;
    }
    place[0] = (index + 0.5) / eye->samples;
    place[1] = place_y - floor(place_y);
}

void hc_eye_ray(const hc_eye *eye, double origin[3], double direction[3], double x, double y)
{
    const double across = 2.0 * x / eye->width - 1.0;
    const double down   = 2.0 * y / eye->height - 1.0;
    double      *moved  = eye->parallel ? origin : direction;
    memcpy(origin, eye->place, 3 * sizeof *origin);
    memcpy(direction, eye->forward, 3 * sizeof *direction);
    hc_add_scaled(moved, moved, across, eye->right);
    hc_add_scaled(moved, moved, down, eye->down);
    (void)hc_unit(direction);
}
