#include "stage.h"

#include "angle.h"
#include "check.h"
#include "vec.h"

#include "base/fail.h"
#include "gl/map.h"

#include <math.h>
#include <string.h>

enum { SIDE_MAX = 65536, REPEAT_MAX = 256, SAMPLES_MAX = 256, GLOSS_MAX = 12, VIEWS = 8 };

/* Of relief that has faded: there is still something to divide by. */
static const double FLATTEST = 1.0 / 1024.0;

/* ---- checks -------------------------------------------------------------------------------- */

static hc_result check_relief(const hc_relief *relief, hc_log *log)
{
    const bool     torus = relief->body == HC_BODY_TORUS;
    const unsigned wrap  = (unsigned)relief->field.wrap;
    CHECK(check_whole("relief.body", (int)relief->body, 0, HC_BODY_TORUS, log));
    CHECK(check_whole("relief.edge", (int)relief->edge, 0, HC_EDGE_CLAMP, log));
    CHECK(check_whole("relief.repeat[0]", relief->repeat[0], 0, REPEAT_MAX, log));
    CHECK(check_whole("relief.repeat[1]", relief->repeat[1], 0, REPEAT_MAX, log));
    const float deepest = torus ? 0.36F : relief->body == HC_BODY_CYLINDER ? 0.54F : 0.9F;
    CHECK(check_number("relief.depth", relief->depth, 0.0F, deepest, log));
    CHECK(check_number("relief.aspect", relief->aspect, 0.0F, 64.0F, log));
    CHECK(check_number("relief.fade[0]", relief->fade[0], 0.0F, 1e9F, log));
    CHECK(check_number("relief.fade[1]", relief->fade[1], relief->fade[0], 1e9F, log));
    CHECK(check_number("relief.lod[0]", relief->lod[0], 0.0F, 1e9F, log));
    CHECK(check_number("relief.lod[1]", relief->lod[1], relief->lod[0], 1e9F, log));
    CHECK(check_whole("relief.lod_steps", relief->lod_steps, 0, relief->trace.steps, log));
    if (relief->trace.surface != HC_SURFACE_BILINEAR || relief->trace.placement.scale_z != 0.0) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "relief.trace has a surface or a placement of its own; leave them zero");
    }
    for (int i = 0; i < 2; i++) {
        const bool closed = i == 0 ? relief->body != HC_BODY_PLANE : torus;
        if ((closed || relief->repeat[i] > 1) && (wrap & (i == 0 ? HC_WRAP_U : HC_WRAP_V)) == 0) {
            return hc_fail(log, HC_ERROR_ARGUMENT,
                           "relief.field.wrap is %s; a %s that repeats %d x %d needs a field that "
                           "wraps along %s",
                           hc_wrap_name(relief->field.wrap), hc_body_name(relief->body),
                           relief->repeat[0], relief->repeat[1], i == 0 ? "u" : "v");
        }
    }
    return HC_OK;
}

static hc_result check_rest(const hc_scene *scene, const hc_render_options *options, hc_log *log)
{
    const hc_material *m = &scene->material;
    const hc_camera   *c = &scene->camera;
    CHECK(check_number("material.ambient", m->ambient, 0.0F, 16.0F, log));
    CHECK(check_number("material.diffuse", m->diffuse, 0.0F, 16.0F, log));
    CHECK(check_number("material.specular", m->specular, 0.0F, 16.0F, log));
    CHECK(check_whole("material.gloss", m->gloss, 0, GLOSS_MAX, log));
    if (m->albedo != NULL) {
        CHECK(check_whole("material.albedo_width", m->albedo_width, 1, HC_SIDE_MAX, log));
        CHECK(check_whole("material.albedo_height", m->albedo_height, 1, HC_SIDE_MAX, log));
    }
    CHECK(check_point("light.place", scene->light.place, log));
    if (scene->light.lamp && is_zero(scene->light.place)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "light.place is 0, 0, 0, which is in the body; put "
                       "the lamp outside");
    }
    CHECK(check_point("camera.eye", c->eye, log));
    CHECK(check_point("camera.at", c->at, log));
    CHECK(check_number("camera.fov", c->fov, 0.0F, 170.0F, log));
    CHECK(check_number("camera.orthographic", c->orthographic, 0.0F, 1e6F, log));
    CHECK(check_whole("camera.samples", c->samples, 0, SAMPLES_MAX, log));
    CHECK(check_whole("options.backend", (int)options->backend, 0, HC_BACKEND_GL, log));
    CHECK(check_whole("options.view", (int)options->view, 0, VIEWS - 1, log));
    CHECK(check_number("options.top", options->top, 0.0F, 1e9F, log));
    return check_whole("options.threads", options->threads, 0, 1024, log);
}

static hc_result check_picture(const hc_picture *picture, hc_log *log)
{
    CHECK(check_whole("picture.width", picture->width, 1, SIDE_MAX, log));
    CHECK(check_whole("picture.height", picture->height, 1, SIDE_MAX, log));
    return picture->rgb != NULL ? HC_OK : hc_fail(log, HC_ERROR_ARGUMENT, "picture.rgb is NULL");
}

/* True if the method finds all that it needs in the map. */
static bool serves(const struct hc_gpu_map *map, hc_trace_method method)
{
    const bool diamond = map->cones == HC_CONES_L1 || map->cones == HC_CONES_QUAD;
    const bool plain   = map->cones == HC_CONES_L2 && !map->cells;
    switch (hc_trace_method_needs(method)) {
    case HC_NEEDS_CELL_RATIOS: return map->cells && diamond;
    case HC_NEEDS_RATIOS: return plain && !map->relaxed;
    case HC_NEEDS_RELAXED: return plain && map->relaxed;
    default:
        return method != HC_TRACE_FAST && method != HC_TRACE_MAXMIP && method != HC_TRACE_QDM
               && method != HC_TRACE_PDM;
    }
}

/* What the tracer would have checked, which is not built for such a map. */
static hc_result take_baked(hc_stage *stage, hc_log *log)
{
    hc_relief               *relief = &stage->scene.relief;
    const struct hc_gpu_map *map    = relief->baked;
    hc_trace_options        *trace  = &relief->trace;
    CHECK(check_whole("relief.trace.method", (int)trace->method, 0, hc_trace_method_count() - 1,
                      log));
    CHECK(check_whole("relief.trace.steps", trace->steps, 0, 65536, log));
    CHECK(check_whole("relief.trace.refinements", trace->refinements, -2, 64, log));
    if (stage->options.backend != HC_BACKEND_GL || hc_view_compares(stage->options.view)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "relief.baked is on the GPU: it is drawn by gl, in views that do not "
                       "compare");
    }
    if (!serves(map, trace->method)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "relief.baked has %s%s ratios%s, which %s does not take",
                       map->relaxed ? "relaxed " : "", hc_cones_name(map->cones),
                       map->cells ? " of cells" : "", hc_trace_method_name(trace->method));
    }
    relief->field = map->field;
    trace->ratios = NULL;
    trace->cones  = map->cones;
    return HC_OK;
}

/* ---- defaults ------------------------------------------------------------------------------ */

static void set_if_zero(float *value, float otherwise)
{
    *value = *value == 0.0F ? otherwise : *value;
}

static void resolve_relief(hc_relief *relief)
{
    static const float depths[]     = { 0.16F, 0.12F, 0.16F, 0.12F };
    static const int   repeats[][2] = { { 1, 1 }, { 2, 1 }, { 4, 2 }, { 4, 2 } };
    set_if_zero(&relief->depth, depths[relief->body]);
    set_if_zero(&relief->aspect, (float)relief->field.height / (float)relief->field.width);
    if (relief->trace.steps == 0) {
        relief->trace.steps = hc_trace_method_steps(relief->trace.method);
    }
    if (relief->lod_steps == 0) {
        relief->lod_steps = (relief->trace.steps + 3) / 4;
    }
    if (relief->trace.refinements == 0) {
        relief->trace.refinements = HC_REFINEMENTS_DEFAULT;
    }
    for (int i = 0; i < 2; i++) {
        relief->repeat[i] = relief->repeat[i] == 0 ? repeats[relief->body][i] : relief->repeat[i];
    }
}

static void resolve_material(hc_material *m)
{
    static const float clay[3] = { 0.55F, 0.5F, 0.45F };
    if (m->ambient == 0.0F && m->diffuse == 0.0F && m->specular == 0.0F) {
        m->ambient  = 0.22F;
        m->diffuse  = 0.9F;
        m->specular = 0.12F;
    }
    if (m->colour[0] == 0.0F && m->colour[1] == 0.0F && m->colour[2] == 0.0F) {
        memcpy(m->colour, clay, sizeof clay);
    }
    m->gloss = m->gloss == 0 ? 5 : m->gloss;
}

/* From the left in front, and so far that the whole body is in view. */
static void resolve_camera(hc_camera *camera, const hc_shape *shape, double height_share)
{
    static const double from[][3] = {
        { -0.38, -0.75, 0.62 }, { -0.35, -0.85, 0.38 }, { -0.35, -0.85, 0.38 }, { -0.2, -0.7, 0.68 }
    };
    static const double closer[] = { 0.68, 1.0, 1.04, 1.0 }; /* bounds that are not filled */
    camera->samples              = camera->samples > 0 ? camera->samples : 1;
    set_if_zero(&camera->fov, 32.0F);
    if (is_zero(camera->eye) && is_zero(camera->at)) {
        const double half =
            hc_tangent((double)camera->fov * HC_PI / 360.0) * fmin(height_share, 1.0);
        const double sine = half / sqrt(1.0 + half * half);
        double       away[3];
        memcpy(away, from[shape->body], sizeof away);
        (void)hc_unit(away);
        camera->at[2] = shape->body == HC_BODY_PLANE ? -shape->depth : 0.0;
        hc_add_scaled(camera->eye, camera->at, closer[shape->body] * shape->bound / sine, away);
    }
}

/* ---- the camera ---------------------------------------------------------------------------- */

static void aim(hc_stage *stage)
{
    stage->eye          = hc_eye_of(&stage->scene.camera, stage->width, stage->height);
    const double middle = -hc_dot(stage->eye.place, stage->eye.forward);
    stage->near         = fmax(middle - stage->shape.bound, 0.0);
    stage->far          = fmax(middle + stage->shape.bound, stage->near + 1e-6);
}

/* Share of the way from near to far, with smooth ends: 0 before, 1 beyond. */
static double share_of_way(const float range[2], double away)
{
    const double near   = (double)range[0];
    const double length = fmax((double)range[1] - near, 1e-6);
    const double share  = fmin(fmax((away - near) / length, 0.0), 1.0);
    return share * share * (3.0 - 2.0 * share);
}

void hc_stage_gaze(const hc_stage *stage, hc_gaze *gaze, double x, double y)
{
    const hc_relief *relief = &stage->scene.relief;
    hc_eye_ray(&stage->eye, gaze->origin, gaze->direction, x, y);
    gaze->shape  = stage->shape;
    gaze->tracer = stage->tracer;
    if (!(relief->fade[1] > 0.0F || relief->lod[1] > 0.0F)) {
        return;
    }
    const double away = hc_sight_entry(&gaze->shape, gaze->origin, gaze->direction);
    if (relief->fade[1] > 0.0F) {
        gaze->shape.depth *= fmax(1.0 - share_of_way(relief->fade, away), FLATTEST);
    }
    if (relief->lod[1] > 0.0F) {
        const double most           = relief->trace.steps;
        const double fewer          = (most - relief->lod_steps) * share_of_way(relief->lod, away);
        gaze->thinned               = *stage->tracer;
        gaze->thinned.options.steps = (int)(most - fewer + 0.5);
        gaze->tracer                = &gaze->thinned;
    }
}

/* ---- the light ----------------------------------------------------------------------------- */

static void place_light(hc_stage *stage)
{
    static const double usual[3] = { -0.75, -0.1, 0.5 };
    const hc_light     *light    = &stage->scene.light;
    const hc_field     *field    = &stage->scene.relief.field;
    memcpy(stage->sun, is_zero(light->place) ? usual : light->place, sizeof stage->sun);
    (void)hc_unit(stage->sun);
    /* Half a texel, and what published methods stop short of the surface. */
    const double   point[3] = { 1.0, 0.0, 0.0 };
    const hc_frame frame    = hc_shape_frame(&stage->shape, point);
    stage->shadow_slip =
        0.5 * fmin(frame.scale[0] * hc_field_step_u(field), frame.scale[1] * hc_field_step_v(field))
        + stage->shape.depth / 64.0;
}

/* ---- all together -------------------------------------------------------------------------- */

bool hc_view_compares(hc_view view)
{
    return view == HC_VIEW_MISSED || view == HC_VIEW_ERROR;
}

static hc_result build(hc_stage *stage, hc_log *log)
{
    hc_trace_options trace = stage->scene.relief.trace;
    if (stage->scene.relief.baked != NULL) {
        return HC_OK;
    }
    trace.open_sides = false;
    trace.threads    = stage->options.threads;
    hc_result result = hc_tracer_create(&stage->tracer, &stage->scene.relief.field, &trace, log);
    if (result == HC_OK && hc_view_compares(stage->options.view)) {
        const hc_trace_options exact = { .method = HC_TRACE_MAXMIP };
        result = hc_tracer_create(&stage->exact, &stage->scene.relief.field, &exact, log);
    }
    return result;
}

hc_result hc_stage_set(hc_stage *stage, const hc_picture *picture, const hc_scene *scene,
                       const hc_render_options *options, hc_log *log)
{
    *stage = (hc_stage){ .scene = *scene, .width = picture->width, .height = picture->height };
    if (options != NULL) {
        stage->options = *options;
    }
    CHECK(check_picture(picture, log));
    if (scene->relief.baked != NULL) {
        CHECK(take_baked(stage, log));
    } else {
        CHECK(hc_field_check(&scene->relief.field, log));
    }
    CHECK(check_rest(scene, &stage->options, log));
    if ((unsigned)stage->scene.relief.body <= HC_BODY_TORUS) {
        resolve_relief(&stage->scene.relief);
    }
    CHECK(check_relief(&stage->scene.relief, log));
    stage->shape = hc_shape_of(&stage->scene.relief);
    resolve_material(&stage->scene.material);
    resolve_camera(&stage->scene.camera, &stage->shape, (double)stage->height / stage->width);
    aim(stage);
    place_light(stage);
    return build(stage, log);
}

void hc_stage_clear(hc_stage *stage)
{
    hc_tracer_destroy(stage->tracer);
    hc_tracer_destroy(stage->exact);
}
