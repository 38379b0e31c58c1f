/* From a scene and a camera to a picture. */
#include "terrain.h"

#include "../gl/landscape.h"

#include "../check.h"
#include "../stage.h"

#include "base/clock.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 65536, SAMPLES_MAX = 256, OBJECTS_MAX = 1 << 20 };

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

const char *hc_polygons_name(hc_polygons polygons)
{
    static const char *const names[] = { "none", "full", "lod" };
    return name_of(names, 3, (unsigned)polygons);
}

/* ---- making -------------------------------------------------------------------------------- */

static hc_result build(hc_terrain *terrain, hc_log *log)
{
    hc_trace_options trace = terrain->scene.trace;
    trace.placement        = terrain->placement;
    trace.threads          = terrain->options.threads;
    hc_result result       = HC_OK;
    if (terrain->scene.polygons == HC_POLYGONS_NONE || !terrain->scene.no_shadows) {
        result = hc_tracer_create(&terrain->tracer, &terrain->scene.field, &trace, log);
    }
    if (result == HC_OK && hc_view_compares(terrain->options.view)) {
        const hc_trace_options exact = { .method     = HC_TRACE_MAXMIP,
                                         .surface    = trace.surface,
                                         .open_sides = trace.open_sides,
                                         .placement  = trace.placement };
        result = hc_tracer_create(&terrain->exact, &terrain->scene.field, &exact, log);
    }
    return result;
}

/* ---- objects ------------------------------------------------------------------------------- */

static hc_result check_object(const hc_object *object, int index, hc_log *log)
{
    CHECK(check_point("object.place", object->place, log));
    if (object->mesh == NULL || !(object->size >= 0.0 && object->size <= 1e9)
        || !(fabs(object->turn) <= 1e9)) {
        return hc_fail(
            log, HC_ERROR_ARGUMENT,
            "object %d has %s, size %g and turn %g; a size is 0 .. 1e+09, a turn within 1e+09",
            index, object->mesh != NULL ? "a mesh" : "no mesh", object->size, object->turn);
    }
    return hc_mesh_check(object->mesh, log);
}

static void set_colour(float colour[3], const hc_object *object)
{
    static const float paint[3] = { 0.45F, 0.16F, 0.10F };
    const bool         given =
        object->colour[0] > 0.0F || object->colour[1] > 0.0F || object->colour[2] > 0.0F;
    memcpy(colour, given ? object->colour : paint, sizeof paint);
}

static hc_result put_objects(hc_terrain *terrain, hc_log *log)
{
    const int        count   = terrain->scene.object_count;
    const hc_object *objects = terrain->scene.objects;
    CHECK(check_whole("scene.object_count", count, 0, OBJECTS_MAX, log));
    for (int i = 0; i < count; i++) {
        CHECK(check_object(&objects[i], i, log));
    }
    double(*places)[3] = count > 0 ? malloc((size_t)count * sizeof *places) : NULL;
    terrain->colours   = count > 0 ? malloc((size_t)count * sizeof *terrain->colours) : NULL;
    if (count > 0 && (places == NULL || terrain->colours == NULL)) {
        free(places);
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for %d objects", count);
    }
    for (int i = 0; i < count; i++) {
        const double *p = objects[i].place;
        memcpy(places[i], p, sizeof places[i]);
        places[i][2] += objects[i].grounded ? hc_terrain_ground(terrain, p[0], p[1]) : 0.0;
        set_colour(terrain->colours[i], &objects[i]);
    }
    const hc_result result = count > 0 ? hc_bodies_create(&terrain->bodies, objects,
                                                          (const double(*)[3])places, count, log)
                                       : HC_OK;
    free(places);
    terrain->scene.objects = NULL; /* they may go */
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
    if (result == HC_OK) {
        result = put_objects(*terrain, log);
    }
    if (result == HC_OK && scene->shadow_map > 0 && !scene->no_shadows) {
        result = hc_sunview_place(&(*terrain)->sunview, *terrain, scene->shadow_map, log);
        if (result == HC_OK && !hc_terrain_gl_sees_sun(*terrain)) {
            result = hc_sunview_cast(&(*terrain)->sunview, *terrain, log);
        }
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
        hc_sunview_free(&terrain->sunview);
        hc_details_free(&terrain->details);
        hc_bodies_destroy(terrain->bodies);
        free(terrain->colours);
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
