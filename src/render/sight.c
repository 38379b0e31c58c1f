#include "sight.h"

#include "vec.h"

#include <math.h>
#include <string.h>

/* Pieces of a bent ray are nowhere farther than this from it, in depths of the relief. */
static const double BEND = 1.0 / 512.0;

/* Near the axis, where u turns ever faster, pieces do not get shorter than on this radius. */
static const double RADIUS_LEAST = 0.004;

/* Rays end so far before the sides of the plane, in tiles: beyond them the next tile of a field
 * that wraps would begin. */
static const double BRINK = 1e-6;

/* Rays that come down end so far below the bottom, in depths of the relief: ground of height 0 is
 * a hit, however the end is rounded. */
static const double BELOW = 0x1p-14;

enum {
    PIECES_MAX  = 1024, /* far more than a ray needs; a bound for NaNs */
    PIECES_FLAT = 5     /* between four sides' planes */
};

typedef struct span {
    double from, to;
    int    through; /* axis of the side that the ray comes in through; -1: none */
} span;

static void clip(span *s, double place, double along, double half_low, double half_high, int axis)
{
    if (along == 0.0) {
        s->to = place >= half_low && place <= half_high ? s->to : -INFINITY;
        return;
    }
    const double enters = ((along > 0.0 ? half_low : half_high) - place) / along;
    const double leaves = ((along > 0.0 ? half_high : half_low) - place) / along;
    if (enters > s->from) {
        s->from    = enters;
        s->through = axis;
    }
    s->to = fmin(s->to, leaves);
}

/* The straight piece from a to b in texture space. */
static bool march(hc_sight *sight, const hc_tracer *tracer, const double a[3], const double b[3])
{
    hc_ray ray = { .tmin = 0.0F, .tmax = 1.0F };
    for (int i = 0; i < 3; i++) {
        ray.origin[i]    = (float)a[i];
        ray.direction[i] = (float)(b[i] - a[i]);
    }
    const bool found = hc_trace_nearest(tracer, &sight->hit, &ray);
    sight->entered   = true;
    sight->steps += sight->hit.steps;
    sight->unconverged = found && (sight->hit.flags & HC_HIT_UNCONVERGED) != 0;
    return found;
}

static void set_cut(hc_sight *sight, int axis, const double direction[3])
{
    sight->cut[axis] = direction[axis] > 0.0 ? -1.0 : 1.0;
}

static bool starts_in_solid(const hc_hit *hit)
{
    return !(hit->t > 0.0F) && (hit->flags & (HC_HIT_INSIDE | HC_HIT_SIDE)) != 0;
}

/* ---- the plane ------------------------------------------------------------------------------- */

static void clip_slab(span *s, const hc_shape *shape, const double origin[3],
                      const double direction[3])
{
    const double low = shape->depth * (direction[2] < 0.0 ? 1.0 + BELOW : 1.0);
    clip(s, origin[2], direction[2], -low, 0.0, 2);
}

static span plane_span(const hc_shape *shape, const double origin[3], const double direction[3])
{
    span s = { 0.0, INFINITY, -1 };
    clip(&s, origin[0], direction[0], -shape->half[0], shape->half[0], 0);
    clip(&s, origin[1], direction[1], -shape->half[1], shape->half[1], 1);
    clip_slab(&s, shape, origin, direction);
    return s;
}

/* Where the rim goes on outwards the ray ends at the bottom, wherever that is. */
static span edge_span(const hc_shape *shape, hc_edge edge, hc_sight_of of, const double origin[3],
                      const double direction[3])
{
    const span inside = plane_span(shape, origin, direction);
    span       s      = { 0.0, INFINITY, -1 };
    if (edge != HC_EDGE_CLAMP || (of == HC_SIGHT_OF_EYE && !(inside.from <= inside.to))) {
        return inside;
    }
    clip_slab(&s, shape, origin, direction);
    return (span){ of == HC_SIGHT_OF_EYE ? inside.from : s.from, s.to,
                   of == HC_SIGHT_OF_EYE ? inside.through : s.through };
}

static bool comes_in(const span *s, hc_edge edge, hc_sight_of of, const double direction[3])
{
    const bool down = direction[2] < 0.0;
    const bool top =
        (s->through == 2 || (edge == HC_EDGE_CLAMP && of == HC_SIGHT_OF_LIGHT)) && down;
    return s->from <= s->to && (edge == HC_EDGE_WALL || top);
}

/* Beyond a side the clamped place stands still along that axis, so the ray is straight in texture
 * space from one crossing of the sides' planes to the next: this one, after t. */
static double next_crossing(const hc_shape *shape, const span *s, double t, const double origin[3],
                            const double direction[3])
{
    double next = s->to;
    for (int i = 0; i < 4; i++) {
        const double side  = (i % 2 == 0 ? -1.0 : 1.0) * shape->half[i / 2];
        const double cross = (side - origin[i / 2]) / direction[i / 2];
        next               = cross > t && cross < next ? cross : next; /* false for NaN */
    }
    return next;
}

static void place_on_plane(const hc_shape *shape, double uvh[3], double t, double brink,
                           const double origin[3], const double direction[3])
{
    double point[3];
    hc_add_scaled(point, origin, t, direction);
    hc_shape_place(shape, uvh, point);
    for (int i = 0; i < 2; i++) {
        uvh[i] = fmin(fmax(uvh[i], brink), shape->repeat[i] - brink);
    }
}

static void across_plane(hc_sight *sight, const hc_shape *shape, hc_edge edge, hc_sight_of of,
                         const hc_tracer *tracer, const double origin[3], const double direction[3])
{
    const span s       = edge_span(shape, edge, of, origin, direction);
    const bool clamped = edge == HC_EDGE_CLAMP;
    double     t       = s.from;
    double     a[3], b[3];
    int        pieces = !comes_in(&s, edge, of, direction) ? 0 : clamped ? PIECES_FLAT : 1;
    for (; pieces > 0; pieces--) {
        const double next = clamped ? next_crossing(shape, &s, t, origin, direction) : s.to;
        place_on_plane(shape, a, t, clamped ? BRINK : 0.0, origin, direction);
        place_on_plane(shape, b, next, BRINK, origin, direction);
        if (march(sight, tracer, a, b)) {
            const bool side = s.through >= 0 && !(s.through == 2 && direction[2] < 0.0);
            sight->distance = t + (next - t) * (double)sight->hit.t;
            if (side && starts_in_solid(&sight->hit)) {
                set_cut(sight, s.through, direction);
            }
            return;
        }
        t      = next;
        pieces = t < s.to ? pieces : 1;
    }
}

/* ---- round bodies ---------------------------------------------------------------------------- */

static span round_span(const hc_shape *shape, const double origin[3], const double direction[3])
{
    const double middle = -hc_dot(origin, direction);
    const double square = middle * middle - hc_dot(origin, origin) + shape->bound * shape->bound;
    span         s      = { 0.0, -INFINITY, -1 };
    if (square >= 0.0) {
        s.from = fmax(middle - sqrt(square), 0.0);
        s.to   = middle + sqrt(square);
        if (shape->body == HC_BODY_CYLINDER) {
            clip(&s, origin[2], direction[2], -shape->half[1], shape->half[1], 2);
        }
    }
    return s;
}

/* A piece of length l strays by at most l^2 / (8 r), r being the least radius of curvature on it:
 * docs/algorithms.md, section 21. The piece itself may lead to a smaller one. */
static double piece_length(const hc_shape *shape, const double point[3])
{
    const double stray  = 8.0 * BEND * shape->depth;
    const double radius = hc_shape_curvature_radius(shape, point);
    return sqrt(stray * fmax(radius - sqrt(stray * radius), RADIUS_LEAST));
}

static void through_shell(hc_sight *sight, const hc_shape *shape, const hc_tracer *tracer,
                          const double origin[3], const double direction[3])
{
    const span s     = round_span(shape, origin, direction);
    bool       first = s.through >= 0;
    double     point[3], here[3], there[3];
    hc_add_scaled(point, origin, s.from, direction);
    hc_shape_place(shape, here, point);
    double t = s.from;
    for (int i = 0; i < PIECES_MAX && t < s.to; i++, first = false) {
        const double away = (here[2] - 1.0) * shape->depth;
        const double step = piece_length(shape, point);
        const double next = fmin(t + fmax(step, away), s.to);
        hc_add_scaled(point, origin, next, direction);
        hc_shape_place(shape, there, point);
        hc_shape_unwrap(shape, there, here);
        if (here[2] < 0.0 && !first) {
            return; /* into the core: the method has lost its hit */
        }
        if (away <= step && march(sight, tracer, here, there)) {
            sight->distance = t + (next - t) * (double)sight->hit.t;
            if (first && starts_in_solid(&sight->hit)) {
                set_cut(sight, s.through, direction);
            }
            return;
        }
        memcpy(here, there, sizeof here);
        t = next;
    }
}

double hc_sight_entry(const hc_shape *shape, const double origin[3], const double direction[3])
{
    const span s = shape->body == HC_BODY_PLANE ? plane_span(shape, origin, direction)
                                                : round_span(shape, origin, direction);
    return s.from <= s.to ? s.from : INFINITY;
}

hc_sight hc_sight_along(const hc_shape *shape, hc_edge edge, hc_sight_of of,
                        const hc_tracer *tracer, const double origin[3], const double direction[3])
{
    hc_sight sight = { .distance = INFINITY };
    if (shape->body == HC_BODY_PLANE) {
        across_plane(&sight, shape, edge, of, tracer, origin, direction);
    } else {
        through_shell(&sight, shape, tracer, origin, direction);
    }
    return sight;
}
