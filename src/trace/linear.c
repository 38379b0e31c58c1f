/* One step, or equal steps: parallax mapping with offset limiting (Welsh 2004), linear search (WSCG
 * 2009, section 2), relief mapping (Policarpo et al. 2005), parallax occlusion (Tatarchuk 2006). */
#include "image.h"

#include <math.h>

/* The offset is the depth under the entry, as a length along the ray: what dividing by the
 * direction's height would add at flat angles is left out. */
void hc_march_parallax(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const hc_image_ray ray = hc_image_ray_of(tracer, path);
    const double       s   = path->from + hc_image_gap(tracer, path, path->from) / ray.length;
    found->steps           = 1;
    if (path->along[2] < 0.0 && s <= ray.end) {
        hc_image_stop(tracer, path, found, s, 0);
    }
}

typedef struct bracket {
    double above, below; /* below: INFINITY if there is none */
} bracket;

/* The first of options.steps equal steps, from entry to exit, that is at or under the surface. */
static bracket first_below(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const hc_image_ray ray   = hc_image_ray_of(tracer, path);
    const int          count = tracer->options.steps;
    double             last  = path->from;
    for (int i = 1; i <= count; i++) {
        const double s = path->from + (ray.end - path->from) * ((double)i / count);
        found->steps++;
        if (hc_image_gap(tracer, path, s) <= 0.0) {
            return (bracket){ last, s };
        }
        last = s;
    }
    return (bracket){ last, INFINITY };
}

void hc_march_linear(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const bracket b = first_below(tracer, path, found);
    if (b.below < INFINITY) {
        hc_image_stop(tracer, path, found, b.below, 0);
    }
}

void hc_march_relief(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const bracket b = first_below(tracer, path, found);
    if (b.below < INFINITY) {
        hc_image_stop(tracer, path, found, hc_image_refine(tracer, path, found, b.above, b.below),
                      0);
    }
}

void hc_march_occlusion(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const bracket b = first_below(tracer, path, found);
    if (b.below < INFINITY) {
        hc_image_stop(tracer, path, found, hc_image_secant(tracer, path, b.above, b.below), 0);
    }
}
