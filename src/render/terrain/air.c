/* Sky and haze. */
#include "terrain.h"

#include "../vec.h"

static const double ZENITH[3]  = { 0.09, 0.22, 0.52 };
static const double HORIZON[3] = { 0.56, 0.68, 0.82 };
static const double GLOW[3]    = { 0.95, 0.72, 0.42 }; /* round the sun */

static const double HAZE_ABOVE = 0.1; /* of the longer side, over the highest height */

static double squared(double x, int times)
{
    for (int i = 0; i < times; i++) {
        x *= x;
    }
    return x;
}

/* Bright air of a direction that is not above the horizon. */
static void air_colour(double rgb[3], const hc_terrain *terrain, const double direction[3])
{
    const double towards = fmax(hc_dot(direction, terrain->sun), 0.0);
    const double glow    = 0.35 * squared(towards, 2);
    for (int k = 0; k < 3; k++) {
        rgb[k] = HORIZON[k] + glow * (GLOW[k] - 0.5 * HORIZON[k]);
    }
}

void hc_sky_colour(double rgb[3], const hc_terrain *terrain, const double direction[3])
{
    const double up      = fmax(direction[2], 0.0);
    const double deep    = 1.0 - squared(1.0 - fmin(up, 1.0), 2);
    const double towards = fmax(hc_dot(direction, terrain->sun), 0.0);
    const double disc    = towards > 0.99996 ? 12.0 : 0.0;
    air_colour(rgb, terrain, direction);
    for (int k = 0; k < 3; k++) {
        rgb[k] += deep * (ZENITH[k] - rgb[k]);
        rgb[k] += GLOW[k] * (0.25 * squared(towards, 5) + 0.7 * squared(towards, 10) + disc);
    }
}

double hc_haze_top(const hc_terrain *terrain)
{
    return terrain->high[2] + HAZE_ABOVE * terrain->side;
}

/* How much of a ray lies in the haze, which ends above the terrain. */
static double way_in_haze(const hc_terrain *terrain, const hc_ray *ray, double distance)
{
    const double top  = hc_haze_top(terrain) - (double)ray->origin[2];
    const double rise = (double)ray->direction[2];
    if (top < 0.0) {
        return rise < 0.0 ? fmax(distance - top / rise, 0.0) : 0.0;
    }
    return rise > 0.0 ? fmin(distance, top / rise) : distance;
}

/* (1 + x / 8)^-8 for e^-x, whose last bits differ between machines. */
void hc_haze(double rgb[3], const hc_terrain *terrain, const hc_ray *ray, double distance)
{
    const double way     = way_in_haze(terrain, ray, distance);
    const double through = squared(1.0 / (1.0 + way / (8.0 * (double)terrain->scene.haze)), 3);
    double       air[3], direction[3];
    for (int k = 0; k < 3; k++) {
        direction[k] = (double)ray->direction[k];
    }
    air_colour(air, terrain, direction);
    for (int k = 0; k < 3; k++) {
        rgb[k] = air[k] + through * (rgb[k] - air[k]);
    }
}
