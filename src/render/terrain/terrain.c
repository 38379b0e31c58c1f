/* From a scene and a camera to a picture. */
#include "terrain.h"

#include "../gl/landscape.h"

#include "../check.h"
#include "../stage.h"

#include "base/clock.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 65536, SAMPLES_MAX = 256 };

static const float FOV = 60.0F;

static const char *name_of(const char *const *names, unsigned count, unsigned index)
{
    return index < count ? names[index] : NULL;
}

const char *hc_ground_name(hc_ground ground)
{
    static const char *const names[] = { "natural", "elevation", "slope", "image", "plain" };
    return name_of(names, 5, (unsigned)ground);
}

const char *hc_tour_name(hc_tour tour)
{
    static const char *const names[] = { "fly", "walk", "up", "orbit" };
    return name_of(names, 4, (unsigned)tour);
}

/* ---- making -------------------------------------------------------------------------------- */

static hc_result build(hc_terrain *terrain, hc_log *log)
{
    hc_trace_options trace = terrain->scene.trace;
    trace.placement        = terrain->placement;
    trace.threads          = terrain->options.threads;
    hc_result result       = hc_tracer_create(&terrain->tracer, &terrain->scene.field, &trace, log);
    if (result == HC_OK && hc_view_compares(terrain->options.view)) {
        const hc_trace_options exact = { .method     = HC_TRACE_MAXMIP,
                                         .surface    = trace.surface,
                                         .open_sides = trace.open_sides,
                                         .placement  = trace.placement };
        result = hc_tracer_create(&terrain->exact, &terrain->scene.field, &exact, log);
    }
    return result;
}

hc_result hc_terrain_create(hc_terrain **terrain, const hc_terrain_scene *scene,
                            const hc_render_options *options, hc_log *log)
{
    *terrain = malloc(sizeof **terrain);
    if (*terrain == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a terrain");
    }
    hc_result result = hc_site_set(*terrain, scene, options, log);
    if (result == HC_OK) {
        result = build(*terrain, log);
    }
    if (result == HC_OK && (*terrain)->options.backend == HC_BACKEND_GL) {
        result = hc_terrain_gl_make(&(*terrain)->gl, *terrain, log);
    }
    if (result != HC_OK) {
        hc_terrain_destroy(*terrain);
        *terrain = NULL;
    }
    return result;
}

void hc_terrain_destroy(hc_terrain *terrain)
{
    if (terrain != NULL) {
        hc_terrain_gl_free(terrain->gl);
        hc_tracer_destroy(terrain->tracer);
        hc_tracer_destroy(terrain->exact);
        free(terrain);
    }
}

double hc_terrain_ground(const hc_terrain *terrain, double x, double y)
{
    const hc_field     *field = &terrain->scene.field;
    const hc_placement *p     = &terrain->placement;
    const double        across =
        fmin(fmax((x - terrain->low[0]) / (terrain->high[0] - terrain->low[0]), 0.0), 1.0);
    const double up =
        fmin(fmax((y - terrain->low[1]) / (terrain->high[1] - terrain->low[1]), 0.0), 1.0);
    return p->offset[2] + p->scale_z * hc_field_surface(field, across, 1.0 - up);
}

hc_placement hc_terrain_placement(const hc_terrain *terrain)
{
    return terrain->placement;
}

/* ---- drawing ------------------------------------------------------------------------------- */

static hc_result check_camera(const hc_camera *camera, hc_log *log)
{
    CHECK(check_point("camera.eye", camera->eye, log));
    CHECK(check_point("camera.at", camera->at, log));
    CHECK(check_number("camera.fov", camera->fov, 0.0F, 170.0F, log));
    CHECK(check_number("camera.orthographic", camera->orthographic, 0.0F, 1e12F, log));
    CHECK(check_whole("camera.samples", camera->samples, 0, SAMPLES_MAX, log));
    if (memcmp(camera->eye, camera->at, sizeof camera->eye) == 0 && !is_zero(camera->eye)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "camera.eye and camera.at are both %g, %g, %g: it looks nowhere",
                       camera->eye[0], camera->eye[1], camera->eye[2]);
    }
    return HC_OK;
}

static hc_result check_picture(const hc_picture *picture, hc_log *log)
{
    CHECK(check_whole("picture.width", picture->width, 1, SIDE_MAX, log));
    CHECK(check_whole("picture.height", picture->height, 1, SIDE_MAX, log));
    return picture->rgb != NULL ? HC_OK : hc_fail(log, HC_ERROR_ARGUMENT, "picture.rgb is NULL");
}

static hc_eye aim(const hc_terrain *terrain, const hc_camera *camera, const hc_picture *picture)
{
    hc_camera aimed = *camera;
    aimed.samples   = camera->samples > 0 ? camera->samples : 1;
    aimed.fov       = camera->fov > 0.0F ? camera->fov : FOV;
    if (is_zero(camera->eye) && is_zero(camera->at)) {
        hc_camera usual;
        hc_terrain_tour(&usual, terrain, HC_TOUR_FLY, 0.0);
        memcpy(aimed.eye, usual.eye, sizeof aimed.eye);
        memcpy(aimed.at, usual.at, sizeof aimed.at);
    }
    return hc_eye_of(&aimed, picture->width, picture->height);
}

static hc_result fill(hc_pixel *pixels, double *seconds, const hc_terrain *terrain,
                      const hc_eye *eye, hc_log *log)
{
    if (terrain->gl != NULL) {
        return hc_terrain_gl_draw(pixels, seconds, terrain, eye, log);
    }
    const double    start  = hc_clock_now();
    const hc_result result = hc_terrain_cast(pixels, terrain, eye, log);
    *seconds               = hc_clock_now() - start;
    return result;
}

hc_result hc_terrain_draw(hc_picture *picture, const hc_terrain *terrain, const hc_camera *camera,
                          hc_log *log)
{
    CHECK(check_picture(picture, log));
    CHECK(check_camera(camera, log));
    const hc_eye eye    = aim(terrain, camera, picture);
    const size_t count  = (size_t)picture->width * (size_t)picture->height;
    hc_pixel    *pixels = calloc(count, sizeof *pixels);
    if (pixels == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a picture of %d x %d pixels",
                       picture->width, picture->height);
    }
    const hc_result result = fill(pixels, &picture->figures.seconds, terrain, &eye, log);
    if (result == HC_OK) {
        hc_pixels_count(&picture->figures, pixels, count, eye.samples);
        hc_terrain_finish(picture, terrain, pixels, eye.samples);
    }
    free(pixels);
    return result;
}
