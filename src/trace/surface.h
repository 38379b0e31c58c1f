/* The surface in one cell, and a ray's height above it. Nothing else in this folder knows what is
 * between the samples. docs/algorithms.md, section 19. */
#ifndef HC_TRACE_SURFACE_H
#define HC_TRACE_SURFACE_H

#include "tracer.h"

/* height = base + x * slope_x + y * slope_y + x * y * twist, with x, y from the cell's corner */
typedef struct hc_patch {
    double base, slope_x, slope_y, twist;
    int    x, y;
} hc_patch;

/* Of tops, the highest that a ray touches which runs along a face. */
hc_patch hc_patch_of(const hc_tracer *tracer, const hc_path *path, const int cell[2]);

double hc_patch_height(const hc_patch *patch, double x, double y);

/* Height of the ray above the patch: value + r * slope + r * r * bend, r = s - from. */
typedef struct hc_gap {
    double value, slope, bend;
} hc_gap;

hc_gap hc_gap_of(const hc_patch *patch, const hc_path *path, double from);

/* Least r in 0 .. length at which a gap that starts above 0 is no more; INFINITY: it stays. */
double hc_gap_contact(const hc_gap *gap, double length);

/* For a ray that starts at or under the surface: least r at which it comes down on it again after
 * it came up; INFINITY if it does not. *below: it ends below. */
double hc_gap_return(const hc_gap *gap, double length, bool *below);

/* Height of the surface at a place, as a texture unit filters it (tops: the nearest). */
double hc_surface_at(const hc_tracer *tracer, double x, double y);

#endif
