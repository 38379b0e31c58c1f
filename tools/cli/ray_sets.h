/* Rays of all sorts, for judging: made from a seed, in texture space, the same everywhere. */
#ifndef HC_CLI_RAY_SETS_H
#define HC_CLI_RAY_SETS_H

#include <heightcast/ray.h>

/* random   between any two points in and around the box of the field
 * camera   from an eye above the ground to points of the ground
 * sight    between points on the ground, as long as the way between them
 * grazing  nearly level, from the edge, as high as some sample
 * axis     along u, v or straight down, half of them along the lines of the samples */
enum { HC_CLI_RAY_SETS = 5 };
const char *hc_cli_ray_set(int index);

/* Fill `count` rays; ray i belongs to set i % HC_CLI_RAY_SETS. */
void hc_cli_make_rays(hc_ray *rays, size_t count, const hc_field *field, uint64_t seed);

#endif
