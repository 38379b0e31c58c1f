/* Texture look-ups along a ray, and the two ways to refine a bracket. */
#include "image.h"

#include "cursor.h"
#include "surface.h"

hc_image_ray hc_image_ray_of(const hc_tracer *tracer, const hc_path *path)
{
    const double du       = path->along[0] / tracer->axes[0].steps;
    const double dv       = path->along[1] / tracer->axes[1].steps;
    const double dz       = path->along[2];
    const double floor_at = dz < 0.0 ? hc_path_reaches(path, 2, 0.0) : INFINITY;
    /* path->end may lie beyond tmax by rounding, and a hit there would count for nothing. */
    const double last = fmin(path->end, path->tmax - path->t0);
    return (hc_image_ray){ .run    = sqrt(du * du + dv * dv),
                           .length = sqrt(du * du + dv * dv + dz * dz),
                           .end    = fmax(fmin(last, floor_at), path->from) };
}

double hc_image_gap(const hc_tracer *tracer, const hc_path *path, double s)
{
    const double height = hc_surface_at(tracer, hc_path_at(path, 0, s), hc_path_at(path, 1, s));
    return hc_path_at(path, 2, s) - height;
}

double hc_image_ratio(const hc_tracer *tracer, const hc_path *path, double s, bool root)
{
    double low[2], weight[2];
    for (int i = 0; i < 2; i++) {
        const hc_axis *axis  = &tracer->axes[i];
        const double   place = fmin(fmax(hc_path_at(path, i, s), axis->low), axis->high);
        low[i]               = floor(place);
        weight[i]            = place - low[i];
    }
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        const size_t at    = hc_tracer_index(tracer, (int)low[0] + i % 2, (int)low[1] + i / 2);
        const double ratio = fmin((double)tracer->options.ratios[at], 1.0);
        const double share =
            (i % 2 == 1 ? weight[0] : 1.0 - weight[0]) * (i / 2 == 1 ? weight[1] : 1.0 - weight[1]);
        sum += share * (root ? sqrt(ratio) : ratio);
    }
    return root ? sum * sum : sum;
}

void hc_image_stop(const hc_tracer *tracer, const hc_path *path, hc_found *found, double s,
                   uint32_t flags)
{
    for (int i = 0; i < 2; i++) {
        const hc_axis *axis = &tracer->axes[i];
        found->cell[i]      = (int)floor(fmin(fmax(hc_path_at(path, i, s), axis->low), axis->high));
    }
    found->s     = s;
    found->flags = flags;
}

double hc_image_secant(const hc_tracer *tracer, const hc_path *path, double above, double below)
{
    const double over  = hc_image_gap(tracer, path, above);
    const double under = hc_image_gap(tracer, path, below);
    return over > under ? above + (below - above) * (over / (over - under)) : below;
}

static double bisect(const hc_tracer *tracer, const hc_path *path, double above, double below)
{
    for (int i = 0; i < tracer->options.refinements; i++) {
        const double middle = above + 0.5 * (below - above);
        if (hc_image_gap(tracer, path, middle) > 0.0) {
            above = middle;
        } else {
            below = middle;
        }
    }
    return below;
}

double hc_image_refine(const hc_tracer *tracer, const hc_path *path, hc_found *found, double above,
                       double below)
{
    const int times = tracer->options.refinements;
    if (times < -1) {
        return below;
    }
    found->steps += (uint32_t)(times < 0 ? 1 : times);
    return times < 0 ? hc_image_secant(tracer, path, above, below)
                     : bisect(tracer, path, above, below);
}
