/* What a ray of a terrain sees: the ground in its light behind the air, or the sky. */
#include "terrain.h"

#include "../vec.h"

#include <string.h>

/* Light of the sun and of the sky on level ground, and of the ground itself on what faces it. */
static const double SUNLIGHT[3]   = { 2.75, 2.40, 1.90 };
static const double SKYLIGHT[3]   = { 0.26, 0.34, 0.50 };
static const double BOUNCED[3]    = { 0.14, 0.13, 0.10 };
static const double CUT_GROUND[3] = { 0.16, 0.12, 0.085 }; /* sides of the field, and inside it */

bool hc_terrain_has_tops(const hc_terrain *terrain)
{
    return terrain->scene.trace.surface == HC_SURFACE_STEPS
           || terrain->scene.trace.method == HC_TRACE_QDM;
}

static bool is_side(const hc_hit *hit)
{
    return (hit->flags & HC_HIT_SIDE) != 0;
}

static bool is_cut(const hc_terrain *terrain, const hc_hit *hit)
{
    return (hit->flags & HC_HIT_INSIDE) != 0 || (is_side(hit) && !hc_terrain_has_tops(terrain));
}

static bool is_body(const hc_glance *glance)
{
    return glance->body.t < INFINITY;
}

static double distance_of(const hc_glance *glance)
{
    return is_body(glance) ? glance->body.t : (double)glance->hit.t;
}

static void split_ray(double origin[3], double direction[3], const hc_ray *ray)
{
    for (int k = 0; k < 3; k++) {
        origin[k]    = (double)ray->origin[k];
        direction[k] = (double)ray->direction[k];
    }
}

static void point_of(double point[3], const hc_glance *glance)
{
    double origin[3], direction[3];
    split_ray(origin, direction, &glance->ray);
    hc_add_scaled(point, origin, distance_of(glance), direction);
}

static void normal_at(double normal[3], const hc_terrain *terrain, const hc_glance *glance)
{
    if (is_body(glance)) {
        memcpy(normal, glance->body.normal, 3 * sizeof *normal);
        return;
    }
    const bool flat =
        terrain->scene.blocky || is_cut(terrain, &glance->hit) || hc_terrain_has_tops(terrain);
    float out[3];
    hc_trace_normals(terrain->tracer, flat ? out : NULL, flat ? NULL : out, &glance->hit);
    for (int k = 0; k < 3; k++) {
        normal[k] = (double)out[k];
    }
    if (terrain->details.count > 0 && !is_cut(terrain, &glance->hit) && !is_side(&glance->hit)) {
        hc_details_bend(normal, terrain, &glance->hit, glance->left);
    }
}

/* ---- the sun ------------------------------------------------------------------------------- */

/* How far it is from a point to where the field's box ends, towards the sun. */
static double way_out(const hc_terrain *terrain, const double point[3])
{
    double away = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double along = terrain->sun[k];
        if (along > 0.0) {
            away = fmin(away, (terrain->high[k] - point[k]) / along);
        } else if (along < 0.0 && k < 2) { /* below there is no end */
            away = fmin(away, (terrain->low[k] - point[k]) / along);
        }
    }
    return fmax(away, 0.0);
}

/* It comes from there, since published methods cannot start on the surface. */
hc_ray hc_terrain_sun_ray(const hc_terrain *terrain, const hc_glance *glance)
{
    hc_ray ray = { .tmin = 1.0F, .direction = { 0.0F, 0.0F, 1.0F } };
    double point[3], origin[3], normal[3];
    if (!(distance_of(glance) < INFINITY)) {
        return ray;
    }
    point_of(point, glance);
    normal_at(normal, terrain, glance);
    if (hc_dot(normal, terrain->sun) <= 0.0) {
        return ray; /* it faces away */
    }
    const double away = way_out(terrain, point) + terrain->shadow_slip;
    hc_add_scaled(origin, point, away, terrain->sun);
    ray.tmin = 0.0F;
    ray.tmax = (float)(away - terrain->shadow_slip);
    for (int k = 0; k < 3; k++) {
        ray.origin[k]    = (float)origin[k];
        ray.direction[k] = (float)-terrain->sun[k];
    }
    return ray;
}

/* ---- objects ------------------------------------------------------------------------------- */

double hc_terrain_body_slip(const hc_terrain *terrain)
{
    return 0x1p-20 * terrain->side;
}

void hc_terrain_dig(hc_glance *glance, const hc_terrain *terrain)
{
    if (terrain->details.count > 0) {
        glance->left = hc_details_dig(&glance->hit, terrain, terrain->tracer, &glance->ray,
                                      terrain->scene.detail_method, HC_BY_DISTANCE);
    }
}

void hc_terrain_find_body(hc_glance *glance, const hc_terrain *terrain)
{
    double origin[3], direction[3];
    split_ray(origin, direction, &glance->ray);
    glance->body =
        hc_bodies_nearest(terrain->bodies, origin, direction, 0.0, (double)glance->hit.t);
    if (is_body(glance) && terrain->details.count > 0) { /* those that shade it */
        glance->left = hc_details_left(terrain, glance->body.t);
    }
}

bool hc_terrain_body_shades(const hc_terrain *terrain, const hc_glance *glance)
{
    const double slip = hc_terrain_body_slip(terrain);
    double       point[3];
    point_of(point, glance);
    return hc_bodies_nearest(terrain->bodies, point, terrain->sun, slip, INFINITY).t < INFINITY;
}

/* ---- the map ------------------------------------------------------------------------------- */

double hc_terrain_map_light(const hc_terrain *terrain, const hc_glance *glance)
{
    double point[3], normal[3];
    if (!(distance_of(glance) < INFINITY)) {
        return 0.0;
    }
    point_of(point, glance);
    normal_at(normal, terrain, glance);
    const double facing = hc_dot(normal, terrain->sun);
    hc_add_scaled(point, point, -1.0, terrain->low);
    return facing > 0.0 ? hc_sunview_light(&terrain->sunview, terrain->sun, point, facing) : 0.0;
}

/* ---- light --------------------------------------------------------------------------------- */

static void light(double rgb[3], const hc_terrain *terrain, const double normal[3], double lit)
{
    const double facing = lit * fmax(hc_dot(normal, terrain->sun), 0.0);
    const double open   = 0.5 + 0.5 * normal[2];
    for (int k = 0; k < 3; k++) {
        rgb[k] *= SUNLIGHT[k] * facing + SKYLIGHT[k] * open + BOUNCED[k] * (1.0 - open);
    }
}

static void colour_at(double rgb[3], double normal[3], const hc_terrain *terrain,
                      const hc_glance *glance, double footprint)
{
    if (is_body(glance)) {
        for (int k = 0; k < 3; k++) {
            rgb[k] = (double)terrain->colours[glance->body.object][k];
        }
    } else if (is_cut(terrain, &glance->hit)) {
        memcpy(rgb, CUT_GROUND, sizeof CUT_GROUND);
    } else {
        hc_ground_colour(rgb, terrain, &glance->hit, normal, footprint);
        hc_details_colour(rgb, terrain, &glance->hit, glance->left);
    }
}

static void see_surface(hc_sample *sample, const hc_terrain *terrain, const hc_glance *glance,
                        double footprint, double lit)
{
    const double distance = distance_of(glance);
    double       normal[3], rgb[3];
    normal_at(normal, terrain, glance);
    for (int k = 0; k < 3; k++) {
        sample->normal[k] = (float)normal[k];
    }
    colour_at(rgb, normal, terrain, glance, footprint * distance);
    light(rgb, terrain, normal, lit);
    hc_haze(rgb, terrain, &glance->ray, distance);
    for (int k = 0; k < 3; k++) {
        sample->rgb[k] = (float)rgb[k];
    }
}

/* Of a ray that comes to an object nothing is said about its way over the ground. */
static void take_numbers(hc_sample *sample, const hc_terrain *terrain, const hc_glance *glance)
{
    const hc_hit *hit = &glance->hit;
    double        point[3];
    if (is_body(glance)) {
        point_of(point, glance);
        *sample = (hc_sample){ .distance = (float)glance->body.t,
                               .height   = (float)((point[2] - terrain->placement.offset[2])
                                                 / terrain->placement.scale_z) };
    } else {
        *sample =
            (hc_sample){ .distance    = hit->t,
                         .height      = hit->height,
                         .steps       = (float)hit->steps,
                         .crossings   = (float)(hit->crossings > 0 ? hit->crossings : hit->steps),
                         .entered     = hit->t < INFINITY || hit->steps > 0,
                         .unconverged = (hit->flags & HC_HIT_UNCONVERGED) != 0 };
    }
    sample->exact = INFINITY;
}

void hc_terrain_see(hc_sample *sample, const hc_terrain *terrain, const hc_glance *glance,
                    double footprint, double lit)
{
    double origin[3], direction[3], sky[3];
    take_numbers(sample, terrain, glance);
    if (distance_of(glance) < INFINITY) {
        see_surface(sample, terrain, glance, footprint, lit);
        return;
    }
    split_ray(origin, direction, &glance->ray);
    hc_sky_colour(sky, terrain, direction);
    for (int k = 0; k < 3; k++) {
        sample->rgb[k] = (float)sky[k];
    }
}
