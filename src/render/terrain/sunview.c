/* The map's plane lies across the sun's rays, beyond everything. */
#include "terrain.h"

#include "../vec.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

/* ---- the plane ----------------------------------------------------------------------------- */

/* Of a corner of the box that holds ground and objects, from the ground's low corner. */
static void corner_at(double corner[3], const hc_terrain *terrain, int which)
{
    double low[3], high[3];
    memcpy(low, terrain->low, sizeof low);
    memcpy(high, terrain->high, sizeof high);
    if (terrain->bodies != NULL) {
        hc_bodies_widen(low, high, terrain->bodies);
    }
    for (int k = 0; k < 3; k++) {
        corner[k] = ((which >> k & 1) != 0 ? high[k] : low[k]) - terrain->low[k];
    }
}

static void set_axes(hc_sunview *view, const double sun[3])
{
    const double north[3] = { 0.0, 1.0, 0.0 };
    const double up[3]    = { 0.0, 0.0, 1.0 };
    hc_cross(view->across, sun, fabs(sun[2]) < 0.9 ? up : north);
    (void)hc_unit(view->across);
    hc_cross(view->along, view->across, sun);
}

static void set_plane(hc_sunview *view, const hc_terrain *terrain)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    view->top = -INFINITY;
    for (int i = 0; i < 8; i++) {
        double corner[3];
        corner_at(corner, terrain, i);
        const double at[2] = { hc_dot(corner, view->across), hc_dot(corner, view->along) };
        for (int k = 0; k < 2; k++) {
            low[k]  = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
        view->top = fmax(view->top, hc_dot(corner, terrain->sun));
    }
    for (int k = 0; k < 2; k++) {
        view->texel[k] = (high[k] - low[k]) / view->side;
        view->first[k] = low[k];
    }
    view->top += fmax(view->texel[0], view->texel[1]);
}

hc_result hc_sunview_place(hc_sunview *view, const hc_terrain *terrain, int side, hc_log *log)
{
    const size_t row = (size_t)side;
    *view            = (hc_sunview){ .side = side };
    set_axes(view, terrain->sun);
    set_plane(view, terrain);
    view->depths = malloc(row * row * sizeof *view->depths);
    return view->depths != NULL
               ? HC_OK
               : hc_fail(log, HC_ERROR_MEMORY, "no memory for a shadow map of %d x %d", side, side);
}

void hc_sunview_eye(hc_eye *eye, const hc_terrain *terrain)
{
    const hc_sunview *view    = &terrain->sunview;
    const double      zero[3] = { 0.0, 0.0, 0.0 };
    const double half[2] = { 0.5 * view->side * view->texel[0], 0.5 * view->side * view->texel[1] };
    *eye = (hc_eye){ .width = view->side, .height = view->side, .samples = 1, .parallel = true };
    hc_add_scaled(eye->place, terrain->low, view->first[0] + half[0], view->across);
    hc_add_scaled(eye->place, eye->place, view->first[1] + half[1], view->along);
    hc_add_scaled(eye->place, eye->place, view->top, terrain->sun);
    hc_add_scaled(eye->forward, zero, -1.0, terrain->sun);
    hc_add_scaled(eye->right, zero, half[0], view->across);
    hc_add_scaled(eye->down, zero, half[1], view->along);
}

/* ---- rays ---------------------------------------------------------------------------------- */

typedef struct job {
    hc_sunview       *view;
    const hc_terrain *terrain;
    hc_ray           *rays; /* a row for each thread */
    hc_hit           *hits;
} job;

static void aim(hc_ray *ray, const job *j, int column, int row)
{
    const hc_sunview *view = j->view;
    double            origin[3];
    memcpy(origin, j->terrain->low, sizeof origin);
    hc_add_scaled(origin, origin, view->first[0] + (column + 0.5) * view->texel[0], view->across);
    hc_add_scaled(origin, origin, view->first[1] + (row + 0.5) * view->texel[1], view->along);
    hc_add_scaled(origin, origin, view->top, j->terrain->sun);
    *ray = (hc_ray){ .tmax = INFINITY };
    for (int k = 0; k < 3; k++) {
        ray->origin[k]    = (float)origin[k];
        ray->direction[k] = (float)-j->terrain->sun[k];
    }
}

static void cast_row(void *context, int row, int worker)
{
    const job        *j    = context;
    const hc_sunview *view = j->view;
    const size_t      side = (size_t)view->side;
    hc_ray           *rays = j->rays + (size_t)worker * side;
    hc_hit           *hits = j->hits + (size_t)worker * side;
    for (int i = 0; i < view->side; i++) {
        aim(&rays[i], j, i, row);
    }
    hc_trace_nearest_many(j->terrain->tracer, hits, rays, side);
    for (size_t i = 0; i < side; i++) {
        hc_glance glance = { rays[i], hits[i], { .t = INFINITY }, 0.0 };
        if (j->terrain->details.count > 0) { /* all of them, however far the eye is */
            (void)hc_details_dig(&glance.hit, j->terrain, j->terrain->tracer, &rays[i],
                                 j->terrain->scene.detail_method, 1.0);
        }
        if (j->terrain->bodies != NULL) {
            hc_terrain_find_body(&glance, j->terrain);
        }
        const double depth                   = fmin((double)glance.hit.t, glance.body.t);
        view->depths[(size_t)row * side + i] = fminf((float)depth, HC_SUNVIEW_FAR);
    }
}

hc_result hc_sunview_cast(hc_sunview *view, const hc_terrain *terrain, hc_log *log)
{
    const int    threads = hc_threads_resolve(terrain->options.threads);
    const size_t row     = (size_t)view->side;
    job          j       = { .view    = view,
                             .terrain = terrain,
                             .rays    = malloc(row * (size_t)threads * sizeof *j.rays),
                             .hits    = malloc(row * (size_t)threads * sizeof *j.hits) };
    hc_result    result  = HC_OK;
    if (j.rays == NULL || j.hits == NULL) {
        result = hc_fail(log, HC_ERROR_MEMORY, "no memory for the rays of a shadow map");
    } else {
        result = hc_parallel_for(view->side, threads, cast_row, &j, terrain->options.progress, log);
    }
    free(j.rays);
    free(j.hits);
    return result;
}

void hc_sunview_free(hc_sunview *view)
{
    free(view->depths);
}

/* ---- light --------------------------------------------------------------------------------- */

/* Outside of the map there is nothing. */
static double depth_at(const hc_sunview *view, double column, double row)
{
    const double last = view->side - 1;
    if (column < 0.0 || row < 0.0 || column > last || row > last) {
        return (double)HC_SUNVIEW_FAR;
    }
    return (double)view->depths[(size_t)row * (size_t)view->side + (size_t)column];
}

/* Over a texel the depth of a surface changes by the texel times the tangent of its angle. */
double hc_sunview_light(const hc_sunview *view, const double sun[3], const double place[3],
                        double facing)
{
    const double texel = fmax(view->texel[0], view->texel[1]);
    const double slope = sqrt(fmax(1.0 - facing * facing, 0.0)) / fmax(facing, 0.05);
    const double depth = view->top - hc_dot(place, sun) - texel * (0.5 + slope);
    const double x     = (hc_dot(place, view->across) - view->first[0]) / view->texel[0] - 0.5;
    const double y     = (hc_dot(place, view->along) - view->first[1]) / view->texel[1] - 0.5;
    const double a     = x - floor(x);
    const double b     = y - floor(y);
    double       share = 0.0;
    for (int i = 0; i < 4; i++) {
        const double weight = (i % 2 != 0 ? a : 1.0 - a) * (i / 2 != 0 ? b : 1.0 - b);
        share += depth <= depth_at(view, floor(x) + i % 2, floor(y) + i / 2) ? weight : 0.0;
    }
    return share;
}
