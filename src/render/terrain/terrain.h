/* A terrain made ready: what its parts know of each other. */
#ifndef HC_RENDER_TERRAIN_H
#define HC_RENDER_TERRAIN_H

#include <heightcast/terrain.h>

#include "../eye.h"
#include "../sums.h"
#include "bodies.h"
#include "detail.h"
#include "sunview.h"

struct hc_terrain {
    hc_terrain_scene  scene; /* defaults resolved */
    hc_render_options options;
    hc_placement      placement;
    double            low[3], high[3]; /* corners of the box                             */
    double            side;            /* the longer one, in the world                   */
    hc_tracer        *tracer, *exact;  /* exact: for views that compare, else NULL       */
    hc_bodies        *bodies;          /* NULL: there are no objects                     */
    float (*colours)[3];               /* of the objects                                 */
    struct hc_terrain_gl *gl;          /* NULL: the CPU draws                            */
    double                sun[3];      /* unit                                           */
    hc_sunview            sunview;     /* side 0: shadows are cast */
    hc_details            details;
    double shadow_slip; /* a shadow's cause lies at least so far before the lit point */
    double slack;       /* hits farther from the exact ones are wrong         */
};

/* Check a scene and resolve it: all members but the tracers. */
hc_result hc_site_set(hc_terrain *terrain, const hc_terrain_scene *scene,
                      const hc_render_options *options, hc_log *log);

/* A ray and what it came to. */
typedef struct hc_glance {
    hc_ray      ray; /* direction of unit length */
    hc_hit      hit;
    hc_body_hit body; /* t is INFINITY unless it is nearer than the ground */
    double      left; /* how much of details there is */
} hc_glance;

/* Is the ground flat tops, instead of patches? */
bool hc_terrain_has_tops(const hc_terrain *terrain);

/* From the ground to the detail in it, if there is one. */
void hc_terrain_dig(hc_glance *glance, const hc_terrain *terrain);

/* Find the object before the ground, if there is one. */
void hc_terrain_find_body(hc_glance *glance, const hc_terrain *terrain);

/* Rays leave an object so far from it: what rounding of coordinates may do, also in a shader. */
double hc_terrain_body_slip(const hc_terrain *terrain);

/* Is an object between what the ray came to and the sun? */
bool hc_terrain_body_shades(const hc_terrain *terrain, const hc_glance *glance);

/* Share of the sun's light that comes to what the ray came to, from the map. */
double hc_terrain_map_light(const hc_terrain *terrain, const hc_glance *glance);

/* What a ray sees; footprint: width of its pixel at distance 1. lit: share of the sun's light. */
void hc_terrain_see(hc_sample *sample, const hc_terrain *terrain, const hc_glance *glance,
                    double footprint, double lit);

/* The ray from the sun to a hit, which ends before it; one without length for a miss. */
hc_ray hc_terrain_sun_ray(const hc_terrain *terrain, const hc_glance *glance);

/* Colour of the ground, linear. normal [in, out]: of the world, unit; natural ground is rough;
 * footprint: width of the pixel there. */
void hc_ground_colour(double rgb[3], const hc_terrain *terrain, const hc_hit *hit, double normal[3],
                      double footprint);

/* Colour of the sky, and of the air between the eye and what it sees. direction: unit. */
void hc_sky_colour(double rgb[3], const hc_terrain *terrain, const double direction[3]);
/* The haze ends at this z. */
double hc_haze_top(const hc_terrain *terrain);
void   hc_haze(double rgb[3], const hc_terrain *terrain, const hc_ray *ray, double distance);

/* The terrain is a block: walls end so far below height 0, in heights. */
#define HC_TERRAIN_BASE 0.25

/* Width of a pixel at distance 1. */
double hc_terrain_footprint(const hc_eye *eye);

/* Fill zeroed pixels on all threads. */
hc_result hc_terrain_cast(hc_pixel *pixels, const hc_terrain *terrain, const hc_eye *eye,
                          hc_log *log);

/* Add what a ray saw; direction: of the ray. */
void hc_terrain_add(hc_pixel *pixel, const hc_terrain *terrain, const hc_eye *eye,
                    const hc_sample *sample, const double direction[3]);

/* Colours of the terrain's view, and depths. */
void hc_terrain_finish(hc_picture *picture, const hc_terrain *terrain, const hc_pixel *pixels,
                       int samples);

#endif
