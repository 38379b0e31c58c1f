/* Heights along a ray. */
#include "surface.h"

#include <math.h>

/* The world's coordinate in cells; NAN outside the field. */
static double place_of(const hc_axis *axis, double world)
{
    const double from  = world - axis->offset;
    const double once  = axis->wraps ? fmod(from, axis->period) : from;
    const double place = once * axis->scale / axis->unit - axis->first;
    return place >= axis->low && place <= axis->high ? place : NAN;
}

void hc_trace_profile(const hc_tracer *tracer, float *heights, size_t count, const hc_ray *ray)
{
    const double length = (double)ray->tmax - (double)ray->tmin;
    for (size_t i = 0; i < count; i++) {
        const double share = count > 1 ? (double)i / (double)(count - 1) : 0.0;
        const double t     = (double)ray->tmin + length * share;
        double       place[2];
        for (int k = 0; k < 2; k++) {
            place[k] = place_of(&tracer->axes[k],
                                fma(t, (double)ray->direction[k], (double)ray->origin[k]));
        }
        heights[i] =
            isnan(place[0]) || isnan(place[1])
                ? NAN
                : (float)(tracer->height_offset
                          + tracer->height_scale * hc_surface_at(tracer, place[0], place[1]));
    }
}
