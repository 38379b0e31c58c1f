/* Where a terrain stands: checks and defaults of its scene. */
#include "terrain.h"

#include "../check.h"
#include "../stage.h"
#include "../vec.h"

#include <string.h>

enum { SHADOW_MAP_MAX = 16384 };
enum { CONE_STEPS = 512 }; /* the RaycastTerrain sample's */

static const double FLATNESS      = 32.0; /* sides over heights, where no file says more */
static const double EXAGGERATED   = 1000.0;
static const double FARTHEST      = 1e12;
static const double SLIP_EXACT    = 1.0 / 64.0; /* of the distance between samples */
static const double SLIP_OTHERS   = 0.5;
static const double SLIP_DETAIL   = 1.0 / 16.0; /* of a texel */
static const double HAZE_DISTANCE = 2.2;        /* of the longer side */

/* ---- checks -------------------------------------------------------------------------------- */

static hc_result check_distance(const char *what, double value, double low, double high,
                                hc_log *log)
{
    return value >= low && value <= high /* false for NaN */
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "%s is %g; it must be %g .. %g", what, value, low,
                         high);
}

static hc_result check_place(const hc_terrain_scene *scene, hc_log *log)
{
    CHECK(check_distance("scene.spacing[0]", scene->spacing[0], 0.0, FARTHEST, log));
    CHECK(check_distance("scene.spacing[1]", scene->spacing[1], 0.0, FARTHEST, log));
    CHECK(check_distance("scene.low", scene->low, -FARTHEST, FARTHEST, log));
    CHECK(check_distance("scene.high", scene->high, -FARTHEST, FARTHEST, log));
    CHECK(check_distance("scene.exaggeration", scene->exaggeration, 0.0, EXAGGERATED, log));
    CHECK(check_point("scene.offset", scene->offset, log));
    if (scene->low > scene->high) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "scene.low is %g and scene.high %g; low is less",
                       scene->low, scene->high);
    }
    if ((scene->spacing[0] > 0.0) != (scene->spacing[1] > 0.0)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "scene.spacing is %g, %g; both are above 0, or neither is",
                       scene->spacing[0], scene->spacing[1]);
    }
    return HC_OK;
}

static hc_result check_scene(const hc_terrain_scene *scene, hc_log *log)
{
    CHECK(check_place(scene, log));
    CHECK(check_whole("scene.ground", (int)scene->ground, 0, HC_GROUND_PLAIN, log));
    CHECK(check_point("scene.sun", scene->sun, log));
    CHECK(check_whole("scene.shadow_map", scene->shadow_map, 0, SHADOW_MAP_MAX, log));
    if (!(scene->haze >= 0.0F)) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "scene.haze is %g; it must be above 0",
                       (double)scene->haze);
    }
    if (scene->field.wrap != HC_WRAP_NONE) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "scene.field.wrap is %s; a terrain has ends: none",
                       hc_wrap_name(scene->field.wrap));
    }
    if (scene->trace.placement.scale_z != 0.0) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "scene.trace has a placement of its own; leave it zero");
    }
    if (scene->ground == HC_GROUND_IMAGE) {
        CHECK(check_whole("scene.image_width", scene->image_width, 1, HC_SIDE_MAX, log));
        CHECK(check_whole("scene.image_height", scene->image_height, 1, HC_SIDE_MAX, log));
        if (scene->image == NULL) {
            return hc_fail(log, HC_ERROR_ARGUMENT, "scene.ground is image; scene.image is NULL");
        }
    }
    return HC_OK;
}

static hc_result check_polygons(const hc_terrain *terrain, hc_log *log)
{
    const hc_polygons polygons = terrain->scene.polygons;
    CHECK(check_whole("scene.polygons", (int)polygons, 0, HC_POLYGONS_LOD, log));
    const char *why = polygons == HC_POLYGONS_NONE                ? NULL
                      : terrain->options.backend != HC_BACKEND_GL ? "only gl draws them"
                      : hc_terrain_has_tops(terrain) ? "they join samples, and flat tops are apart"
                                                     : NULL;
    return why == NULL ? HC_OK
                       : hc_fail(log, HC_ERROR_UNSUPPORTED, "scene.polygons is %s; %s",
                                 hc_polygons_name(polygons), why);
}

static hc_result check_options(const hc_render_options *options, hc_log *log)
{
    CHECK(check_whole("options.backend", (int)options->backend, 0, HC_BACKEND_GL, log));
    CHECK(check_whole("options.threads", options->threads, 0, 1024, log));
    switch (options->view) {
    case HC_VIEW_SHADED:
    case HC_VIEW_HEIGHT:
    case HC_VIEW_NORMAL:
    case HC_VIEW_DEPTH:
    case HC_VIEW_MISSED:
    case HC_VIEW_CROSSINGS: return HC_OK;
    default:
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "options.view is %d; of terrain there are shaded, height, normal, depth, "
                       "missed and crossings",
                       (int)options->view);
    }
}

/* ---- defaults ------------------------------------------------------------------------------ */

static void resolve_heights(hc_terrain_scene *scene)
{
    const hc_elevation *e = &scene->field.elevation;
    if (scene->low == 0.0 && scene->high == 0.0) { /* unknown ones are 0, too */
        scene->low  = fmin(e->low, e->high);
        scene->high = fmax(e->low, e->high);
    }
    scene->high += scene->low < scene->high ? 0.0 : 1.0;
    scene->exaggeration = scene->exaggeration > 0.0 ? scene->exaggeration : 1.0;
}

static void resolve_spacing(hc_terrain_scene *scene)
{
    const hc_elevation *e     = &scene->field.elevation;
    const bool          known = e->spacing_x > 0.0 && e->spacing_y > 0.0;
    const int           most =
        scene->field.width > scene->field.height ? scene->field.width : scene->field.height;
    const double else_ = FLATNESS * (scene->high - scene->low) / most;
    if (scene->spacing[0] == 0.0) {
        scene->spacing[0] = known ? e->spacing_x : else_;
        scene->spacing[1] = known ? e->spacing_y : else_;
    }
}

/* Texture coordinates 0 and 1 in the world, along one axis; grid registration has its outermost
 * samples there, texel registration half a sample from there. */
static void set_sides(double *low, double *high, double spacing, double step, bool grid)
{
    const double first = grid ? 0.0 : -0.5 * spacing;
    *low += fmin(first, first + spacing / step);
    *high += fmax(first, first + spacing / step);
}

static void place(hc_terrain *terrain)
{
    const hc_terrain_scene *scene = &terrain->scene;
    const hc_field         *field = &scene->field;
    const bool              grid  = field->registration == HC_GRID;
    const double            z     = scene->exaggeration * scene->low;
    terrain->placement =
        (hc_placement){ .spacing_x = scene->spacing[0],
                        .spacing_y = -scene->spacing[1],
                        .scale_z   = scene->exaggeration * (scene->high - scene->low),
                        .offset    = { scene->offset[0], scene->offset[1], scene->offset[2] + z } };
    memcpy(terrain->low, terrain->placement.offset, sizeof terrain->low);
    memcpy(terrain->high, terrain->placement.offset, sizeof terrain->high);
    set_sides(&terrain->low[0], &terrain->high[0], terrain->placement.spacing_x,
              hc_field_step_u(field), grid);
    set_sides(&terrain->low[1], &terrain->high[1], terrain->placement.spacing_y,
              hc_field_step_v(field), grid);
    terrain->high[2] += terrain->placement.scale_z;
    terrain->side = fmax(terrain->high[0] - terrain->low[0], terrain->high[1] - terrain->low[1]);
}

static bool is_exact(hc_trace_method method)
{
    return method == HC_TRACE_FAST || method == HC_TRACE_SAFE || method == HC_TRACE_MAXMIP;
}

static void resolve_light(hc_terrain *terrain)
{
    static const double usual[3] = { -0.75, 0.5, 0.36 };
    hc_terrain_scene   *scene    = &terrain->scene;
    const double        spaced   = fmin(scene->spacing[0], scene->spacing[1]);
    memcpy(terrain->sun, is_zero(scene->sun) ? usual : scene->sun, sizeof terrain->sun);
    (void)hc_unit(terrain->sun);
    scene->haze = scene->haze > 0.0F ? scene->haze : (float)(HAZE_DISTANCE * terrain->side);
    /* Published methods stop short of the surface. */
    terrain->shadow_slip = is_exact(scene->trace.method)
                               ? SLIP_EXACT * spaced
                               : SLIP_OTHERS * spaced + terrain->placement.scale_z / 64.0;
    terrain->slack       = 0.25 * spaced;
    if (terrain->details.count > 0) { /* they throw shadows of their own, and are missed */
        terrain->shadow_slip = fmin(terrain->shadow_slip, fmax(SLIP_DETAIL * terrain->details.texel,
                                                               hc_terrain_body_slip(terrain)));
        terrain->slack       = fmin(terrain->slack, terrain->details.texel);
    }
}

hc_result hc_site_set(hc_terrain *terrain, const hc_terrain_scene *scene,
                      const hc_render_options *options, hc_log *log)
{
    *terrain = (hc_terrain){ .scene = *scene };
    if (options != NULL) {
        terrain->options = *options;
    }
    CHECK(hc_field_check(&scene->field, log));
    CHECK(check_scene(scene, log));
    CHECK(check_options(&terrain->options, log));
    CHECK(check_polygons(terrain, log));
    hc_trace_options *trace = &terrain->scene.trace;
    if (trace->steps == 0) {
        trace->steps =
            trace->method == HC_TRACE_CONE_LOOP ? CONE_STEPS : hc_trace_method_steps(trace->method);
    }
    trace->refinements = trace->refinements == 0 ? HC_REFINEMENTS_DEFAULT : trace->refinements;
    resolve_heights(&terrain->scene);
    resolve_spacing(&terrain->scene);
    place(terrain);
    CHECK(hc_details_set(terrain, log));
    resolve_light(terrain);
    return HC_OK;
}
