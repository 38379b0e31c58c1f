/* Round cones: the three marchers of 2006, relaxed cones (GPU Gems 3, chapter 18), the marcher of
 * 2022, and robust cones (2024). From a gap above the surface the ray leaves the cone after
 * gap / (run / ratio - rise). */
#include "image.h"

#include "cursor.h"

/* Cones lead towards the surface for ever. Whoever is within a code of an 8-bit map has arrived. */
static const double ARRIVED = 1.0 / 255.0;

/* What the robust march adds to come over the wall. */
static const double OVER_WALL = 1e-5;

/* How far to go from s; INFINITY: the ray rises out of the cone. */
static double cone_step(const hc_path *path, const hc_image_ray *ray, double gap, double ratio)
{
    const double grows = ray->run > 0.0 ? ray->run / ratio : 0.0; /* ratio 0: no step */
    const double rate  = grows - path->along[2];
    return rate > 0.0 ? gap / rate : INFINITY;
}

typedef struct march {
    double above; /* the last place above the surface */
    double s, gap;
    bool   left; /* out of the box, still above */
} march;

static void look(const hc_tracer *tracer, const hc_path *path, const hc_image_ray *ray, march *m,
                 double s)
{
    m->above = m->s;
    m->s     = fmin(s, ray->end);
    m->gap   = hc_image_gap(tracer, path, m->s);
    m->left  = m->gap > 0.0 && s >= ray->end;
}

typedef double step_rule(const hc_tracer *tracer, const hc_path *path, const hc_image_ray *ray,
                         const march *m);

/* Step until below the surface, out of the box, or out of steps. */
static march march_by(step_rule *rule, const hc_tracer *tracer, const hc_path *path,
                      hc_found *found)
{
    const hc_image_ray ray = hc_image_ray_of(tracer, path);
    march m = { path->from, path->from, hc_image_gap(tracer, path, path->from), false };
    for (int i = 0; i < tracer->options.steps && m.gap > 0.0 && !m.left; i++) {
        found->steps++;
        look(tracer, path, &ray, &m, m.s + rule(tracer, path, &ray, &m));
    }
    return m;
}

static void stop(const hc_tracer *tracer, const hc_path *path, hc_found *found, const march *m,
                 double s, bool converged)
{
    if (!m->left) {
        hc_image_stop(tracer, path, found, s, converged ? 0 : HC_HIT_UNCONVERGED);
    }
}

/* ---- 2006 ---------------------------------------------------------------------------------- */

static double root_filtered(const hc_tracer *tracer, const hc_path *path, const hc_image_ray *ray,
                            const march *m)
{
    return cone_step(path, ray, m->gap, hc_image_ratio(tracer, path, m->s, true));
}

/* `fixed` is the same march, unrolled to ten steps. */
void hc_march_cone_fixed(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const march m = march_by(root_filtered, tracer, path, found);
    stop(tracer, path, found, &m, m.s, m.gap <= ARRIVED);
}

void hc_march_cone_loop(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    hc_march_cone_fixed(tracer, path, found);
}

/* The width of a texel as a length along the ray. */
static double texel_step(const hc_tracer *tracer, const hc_image_ray *ray)
{
    return 1.0 / (fmax(tracer->axes[0].steps, tracer->axes[1].steps) * ray->length);
}

static double cone_and_texel(const hc_tracer *tracer, const hc_path *path, const hc_image_ray *ray,
                             const march *m)
{
    return texel_step(tracer, ray) + root_filtered(tracer, path, ray, m);
}

void hc_march_cone_exact(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const hc_image_ray ray  = hc_image_ray_of(tracer, path);
    const march        m    = march_by(cone_and_texel, tracer, path, found);
    const double       back = m.s - texel_step(tracer, &ray);
    stop(tracer, path, found, &m, fmax(back, path->from), m.gap <= 0.0);
}

/* ---- 2022 and relaxed ---------------------------------------------------------------------- */

static double filtered(const hc_tracer *tracer, const hc_path *path, const hc_image_ray *ray,
                       const march *m)
{
    return cone_step(path, ray, m->gap, hc_image_ratio(tracer, path, m->s, false));
}

static void stop_refined(const hc_tracer *tracer, const hc_path *path, hc_found *found,
                         const march *m)
{
    const double s = m->gap <= 0.0 ? hc_image_refine(tracer, path, found, m->above, m->s) : m->s;
    stop(tracer, path, found, m, s, m->gap <= ARRIVED);
}

void hc_march_quick(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const march m = march_by(filtered, tracer, path, found);
    stop_refined(tracer, path, found, &m);
}

/* Relaxed cones may end under the surface, once: then the bracket has one root. */
void hc_march_relaxed(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    hc_march_quick(tracer, path, found);
}

/* ---- robust -------------------------------------------------------------------------------- */

/* Least ratio of the nearest sample and the eight around it. */
static double least_around(const hc_tracer *tracer, const hc_path *path, double s)
{
    const int x     = (int)floor(hc_path_at(path, 0, s) + 0.5);
    const int y     = (int)floor(hc_path_at(path, 1, s) + 0.5);
    double    least = INFINITY;
    for (int i = 0; i < 9; i++) {
        const size_t at = hc_tracer_index(tracer, x + i % 3 - 1, y + i / 3 - 1);
        least           = fmin(least, (double)tracer->options.ratios[at]);
    }
    return least;
}

static double to_cell_wall(const hc_path *path, double s)
{
    double nearest = INFINITY;
    for (int i = 0; i < 2; i++) {
        const double cell = floor(hc_path_at(path, i, s));
        const double wall = hc_path_reaches(path, i, path->along[i] > 0.0 ? cell + 1.0 : cell);
        nearest           = fmin(nearest, wall - s);
    }
    return fmax(nearest, 0.0);
}

/* Upright rays come to no wall; their cone step ends on the surface itself. */

static double cone_or_wall(const hc_tracer *tracer, const hc_path *path, const hc_image_ray *ray,
                           const march *m)
{
    const double cone = cone_step(path, ray, m->gap, least_around(tracer, path, m->s));
    const double wall = to_cell_wall(path, m->s) + OVER_WALL / ray->length;
    return wall < INFINITY ? fmax(cone, wall) : cone;
}

/* A step to the wall may end far under the surface, but in one cell: that bracket is refined. */
void hc_march_robust(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const march m = march_by(cone_or_wall, tracer, path, found);
    stop_refined(tracer, path, found, &m);
}
