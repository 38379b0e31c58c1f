/* Cameras on their ways through a terrain. */
#include "terrain.h"

#include "../angle.h"

#include <math.h>
#include <string.h>

static const float FOV = 60.0F;

/* Eyes of those who walk are so high, in samples' distances; deep cells look like large ones. */
static const double EYE_HEIGHT = 0.05;

enum { AROUND = 8, SEARCH = 48 };

static void middle_of(double middle[2], const hc_terrain *terrain)
{
    middle[0] = 0.5 * (terrain->low[0] + terrain->high[0]);
    middle[1] = 0.5 * (terrain->low[1] + terrain->high[1]);
}

/* On a circle round the middle, or an ellipse that fits the field; radius in sides of it. */
static void on_round(double place[2], const hc_terrain *terrain, double radius, double turn)
{
    double c, s;
    hc_turn(&c, &s, turn);
    middle_of(place, terrain);
    place[0] += radius * c * (terrain->high[0] - terrain->low[0]);
    place[1] += radius * s * (terrain->high[1] - terrain->low[1]);
}

/* The highest ground near a place. */
static double roof_near(const hc_terrain *terrain, const double place[2], double radius)
{
    double roof = hc_terrain_ground(terrain, place[0], place[1]);
    for (int i = 0; i < AROUND; i++) {
        double c, s;
        hc_turn(&c, &s, (double)i / AROUND);
        for (int ring = 1; ring <= 2; ring++) {
            const double away = 0.5 * ring * radius;
            roof = fmax(roof, hc_terrain_ground(terrain, place[0] + away * c, place[1] + away * s));
        }
    }
    return roof;
}

static void fly(hc_camera *camera, const hc_terrain *terrain, double moment)
{
    const double rise = terrain->placement.scale_z;
    double       flat = 0.0;
    on_round(camera->eye, terrain, 0.36, moment + 0.62);
    on_round(camera->at, terrain, 0.17, moment + 0.86);
    /* The mean over what lies around makes the flight smooth. */
    for (int i = -2; i <= 2; i++) {
        double place[2];
        on_round(place, terrain, 0.36, moment + 0.62 + 0.02 * i);
        flat += roof_near(terrain, place, 0.05 * terrain->side) / 5.0;
    }
    camera->eye[2] = fmax(flat + 0.34 * rise,
                          hc_terrain_ground(terrain, camera->eye[0], camera->eye[1]) + 0.1 * rise);
    camera->at[2]  = terrain->low[2] - 0.6 * rise;
}

static double eye_height(const hc_terrain *terrain)
{
    return EYE_HEIGHT * fmin(terrain->scene.spacing[0], terrain->scene.spacing[1]);
}

static void walk(hc_camera *camera, const hc_terrain *terrain, double moment)
{
    const double tall = eye_height(terrain);
    on_round(camera->eye, terrain, 0.3, moment + 0.62);
    on_round(camera->at, terrain, 0.25, moment + 0.69);
    const double ground = hc_terrain_ground(terrain, camera->eye[0], camera->eye[1]);
    const double ahead  = roof_near(terrain, camera->at, 0.02 * terrain->side);
    camera->eye[2]      = ground + tall;
    camera->at[2]       = fmax(camera->eye[2], 0.5 * (ground + ahead));
}

static void up(hc_camera *camera, const hc_terrain *terrain, double moment)
{
    double deepest = -INFINITY, c, s;
    for (int i = 0; i < SEARCH * SEARCH; i++) {
        const double a = 0.2 + 0.6 * (i % SEARCH) / (SEARCH - 1);
        const double b = 0.2 + 0.6 * (i / SEARCH) / (SEARCH - 1);
        const double x = terrain->low[0] + a * (terrain->high[0] - terrain->low[0]);
        const double y = terrain->low[1] + b * (terrain->high[1] - terrain->low[1]);
        const double z = hc_terrain_ground(terrain, x, y);
        const double depth =
            roof_near(terrain, (const double[2]){ x, y }, 0.04 * terrain->side) - z;
        if (depth > deepest) {
            deepest = depth;
            memcpy(camera->eye, (const double[3]){ x, y, z }, sizeof camera->eye);
        }
    }
    hc_turn(&c, &s, moment);
    camera->eye[2] += eye_height(terrain);
    camera->at[0] = camera->eye[0] + c * terrain->side;
    camera->at[1] = camera->eye[1] + s * terrain->side;
    camera->at[2] = camera->eye[2] + 0.22 * terrain->side;
}

static void orbit(hc_camera *camera, const hc_terrain *terrain, double moment)
{
    double c, s;
    hc_turn(&c, &s, moment + 0.69);
    middle_of(camera->at, terrain);
    camera->at[2]  = terrain->low[2] - 0.1 * terrain->side; /* near sides are large */
    camera->eye[0] = camera->at[0] + 1.2 * c * terrain->side;
    camera->eye[1] = camera->at[1] + 1.2 * s * terrain->side;
    camera->eye[2] = terrain->high[2] + 0.62 * terrain->side;
}

void hc_terrain_tour(hc_camera *camera, const hc_terrain *terrain, hc_tour tour, double moment)
{
    *camera = (hc_camera){ .fov = FOV };
    switch (tour) {
    case HC_TOUR_FLY: fly(camera, terrain, moment); break;
    case HC_TOUR_WALK: walk(camera, terrain, moment); break;
    case HC_TOUR_UP: up(camera, terrain, moment); break;
    case HC_TOUR_ORBIT: orbit(camera, terrain, moment); break;
    }
}

/* ---- paths --------------------------------------------------------------------------------- */

/* Catmull-Rom, from b at 0 to c at 1. */
static double spline(double a, double b, double c, double d, double x)
{
    return b
           + 0.5 * x
                 * (c - a + x * (2.0 * a - 5.0 * b + 4.0 * c - d + x * (3.0 * (b - c) + d - a)));
}

static const hc_camera *key_at(const hc_camera *keys, int count, int index)
{
    return &keys[index < 0 ? 0 : index < count ? index : count - 1];
}

static double fov_of(const hc_camera *key)
{
    return (double)(key->fov > 0.0F ? key->fov : FOV);
}

void hc_camera_between(hc_camera *camera, const hc_camera *keys, int count, double moment)
{
    const double     place = fmin(fmax(moment, 0.0), 1.0) * (count - 1);
    const int        first = (int)fmin(floor(place), fmax(count - 2, 0));
    const double     x     = place - first;
    const hc_camera *a     = key_at(keys, count, first - 1);
    const hc_camera *b     = key_at(keys, count, first);
    const hc_camera *c     = key_at(keys, count, first + 1);
    const hc_camera *d     = key_at(keys, count, first + 2);
    *camera                = keys[0];
    for (int k = 0; k < 3; k++) {
        camera->eye[k] = spline(a->eye[k], b->eye[k], c->eye[k], d->eye[k], x);
        camera->at[k]  = spline(a->at[k], b->at[k], c->at[k], d->at[k], x);
    }
    const double fov = spline(fov_of(a), fov_of(b), fov_of(c), fov_of(d), x);
    camera->fov      = (float)fmin(fmax(fov, 1.0), 170.0);
}
