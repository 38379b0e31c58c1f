/* Small height maps cut into the ground: what they are at a place. Behind terrain.h. */
#ifndef HC_RENDER_TERRAIN_DETAIL_H
#define HC_RENDER_TERRAIN_DETAIL_H

#include <heightcast/terrain.h>

/* Of a scene, defaults resolved. */
typedef struct hc_details {
    int        count; /* 0: there are none */
    hc_detail  maps[HC_DETAILS_MAX];
    double     rate[HC_DETAILS_MAX];    /* texels per world unit      */
    double     mean[HC_DETAILS_MAX][3]; /* of its colours             */
    double     cut[HC_DETAILS_MAX];     /* depth in the field's heights */
    double     texel; /* the smallest one, in the world; INFINITY: there are none */
    double     fade[2];
    hc_pyramid tops[HC_DETAILS_MAX]; /* highest corner of the patch right below and to the right of
                                        each texel, and maxima above */
    int        level_max;            /* blocks above it are larger than the ground's cells */
} hc_details;

void hc_details_free(hc_details *details);

struct hc_terrain;

/* Check and resolve; the terrain's place is known. */
hc_result hc_details_set(struct hc_terrain *terrain, hc_log *log);

/* height = base + x * slope[0] + y * slope[1] + x * y * twist, from the corner of a cell */
typedef struct hc_bilinear {
    double base, slope[2], twist;
} hc_bilinear;

/* Of the ground; of the mask's channel, in shares of 1; of a detail's heights: between texel (x, y)
 * and its neighbours. tops: the ground is flat tops, and the mask a share for each. */
hc_bilinear hc_ground_patch(const struct hc_terrain *terrain, const int cell[2], bool tops);
hc_bilinear hc_mask_patch(const struct hc_terrain *terrain, int detail, const int cell[2],
                          bool tops);
hc_bilinear hc_detail_patch(const struct hc_terrain *terrain, int detail, const int cell[2]);
double      hc_bilinear_at(const hc_bilinear *patch, double x, double y);

/* What is left of details at a distance from the eye: 1 .. 0. */
double hc_details_left(const struct hc_terrain *terrain, double distance);

/* Bend a normal of the ground, in the world, by what is cut into it at the hit. */
void hc_details_bend(double normal[3], const struct hc_terrain *terrain, const hc_hit *hit,
                     double left);
/* Lay their colours over that of the ground. */
void hc_details_colour(double rgb[3], const struct hc_terrain *terrain, const hc_hit *hit,
                       double left);

/* `left` of rays of the eye. */
#define HC_BY_DISTANCE (-1.0)

/* dig.c. From a hit of the ground to that of the detail in it, or on to where the ray comes to the
 * ground next. `tracer` found the hit. left: how much of details this ray sees, or
 * HC_BY_DISTANCE: as its distance says where it comes to the ground. Returns what it was there. */
double hc_details_dig(hc_hit *hit, const struct hc_terrain *terrain, const hc_tracer *tracer,
                      const hc_ray *ray, hc_detail_method method, double left);

#endif
