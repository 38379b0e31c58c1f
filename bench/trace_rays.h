/* Sets of rays to measure with: the same for every caster. */
#ifndef HC_BENCH_TRACE_RAYS_H
#define HC_BENCH_TRACE_RAYS_H

#include <heightcast/ray.h>

/* fly, walk  a picture of 1920 x 1080 from high above and from eye height, in tiles of 4 x 4
 * sight      between two ground points, at eye height: is anything between?
 * shadow     from ground points to a sun 15 degrees high
 * random     from anywhere above the ground into any direction
 * graze      across the whole field, nearly level, by a hair above or below the highest ground on
 *            the way; half of them along rows, columns and diagonals of samples, as crests of made
 *            fields run. Not timed */
typedef enum hc_bench_rays {
    HC_RAYS_FLY = 0,
    HC_RAYS_WALK,
    HC_RAYS_SIGHT,
    HC_RAYS_SHADOW,
    HC_RAYS_RANDOM,
    HC_RAYS_TIMED,
    HC_RAYS_GRAZE = HC_RAYS_TIMED,
    HC_RAYS_SETS
} hc_bench_rays;

const char *hc_bench_rays_name(int set);          /* NULL beyond the last */
bool        hc_bench_rays_any(hc_bench_rays set); /* any hit answers */

/* The world of the rays: one side of the field is 1, heights go up to this. */
#define HC_RAYS_RELIEF 0.15

/* Placement of `field` in that world. */
hc_placement hc_bench_placement(const hc_field *field);

/* Fill `count` rays; pictures have HC_RAYS_PICTURE, of which the first `count` are every n-th
 * tile. */
#define HC_RAYS_PICTURE (1920 * 1080)
void hc_bench_fill_rays(hc_ray *rays, size_t count, hc_bench_rays set, const hc_field *field);

#endif
