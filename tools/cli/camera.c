#include "camera.h"

#include "options.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 960, HEIGHT = 540, DEGREES = 60 };

/* ---- vectors --------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* False, and `v` as it was, if it has no direction. */
static bool normalise(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3 && length > 0.0; i++) {
        v[i] /= length;
    }
    return length > 0.0;
}

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

/* By its series and not by libm, so that the same rays are cast on every machine. |x| < pi / 2. */
static double tangent(double x)
{
    double       sine     = 0.0;
    double       cosine   = 0.0;
    double       term     = 1.0;
    const double signs[4] = { 1.0, 1.0, -1.0, -1.0 };
    for (int i = 0; i < 32; i++) {
        *(i % 2 == 0 ? &cosine : &sine) += signs[i % 4] * term;
        term *= x / (i + 1);
    }
    return sine / cosine;
}

/* ---- where it stands ------------------------------------------------------------------------- */

/* A place in texture coordinates and normalised height, in the rays' space. */
static void place(double out[3], const hc_cli_scene *scene, double u, double v, double height)
{
    const hc_field     *field = &scene->field;
    const hc_placement *p     = &scene->placement;
    const bool          grid  = field->registration == HC_GRID;
    const double        su    = hc_field_step_u(field);
    const double        sv    = hc_field_step_v(field);
    if (p->scale_z == 0.0) {
        memcpy(out, (const double[3]){ u, v, height }, 3 * sizeof *out);
        return;
    }
    out[0] = p->offset[0] + p->spacing_x * (u - (grid ? 0.0 : su / 2.0)) / su;
    out[1] = p->offset[1] + p->spacing_y * (v - (grid ? 0.0 : sv / 2.0)) / sv;
    out[2] = p->offset[2] + p->scale_z * height;
}

/* Beyond the bottom row, as far and as high as it takes to see all of the field. */
static void choose_view(hc_cli_camera *camera, double at[3], const hc_cli_settings *settings,
                        const hc_cli_scene *scene, double north)
{
    double low[3];
    double high[3];
    place(low, scene, 0.0, 0.0, 0.0);
    place(high, scene, 1.0, 1.0, 1.0);
    const double wide = fmax(fabs(high[0] - low[0]), fabs(high[1] - low[1]));
    const double tall = high[2] - low[2];
    place(camera->eye, scene, 0.35, 1.0, 1.0);
    camera->eye[1] -= north * (0.35 * wide + 0.9 * tall);
    camera->eye[2] += 0.45 * wide + 0.1 * tall;
    place(at, scene, 0.5, 0.5, 0.3);
    if (hc_cli_given(settings, "eye")) {
        memcpy(camera->eye, settings->rays.eye, sizeof camera->eye);
    }
    if (hc_cli_given(settings, "at")) {
        memcpy(at, settings->rays.at, sizeof camera->eye);
    }
}

/* Rows run against y in the world and with it in texture space, where right and left would change
 * places. */
static void aim(hc_cli_camera *camera, const double at[3], double north, double tangent_of_half)
{
    double up[3] = { 0.0, 0.0, 1.0 };
    for (int i = 0; i < 3; i++) {
        camera->forward[i] = at[i] - camera->eye[i];
    }
    if (!normalise(camera->forward)) {
        camera->forward[2] = -1.0;
    }
    cross(camera->right, camera->forward, up);
    if (!normalise(camera->right)) {
        camera->right[0] = north; /* straight up or down: north is on top */
    }
    cross(up, camera->right, camera->forward);
    for (int i = 0; i < 3; i++) {
        camera->right[i] *= north * tangent_of_half;
        camera->down[i] = -up[i] * tangent_of_half * camera->height / camera->width;
    }
}

hc_cli_camera hc_cli_camera_of(const hc_cli_settings *settings, const hc_cli_scene *scene)
{
    const bool    sized  = settings->size.width > 0;
    const double  north  = scene->placement.scale_z == 0.0 ? -1.0 : 1.0;
    const double  degree = settings->rays.fov > 0.0F ? (double)settings->rays.fov : DEGREES;
    const double  half   = degree * (3.14159265358979323846 / 360.0);
    const double  step   = fmin(hc_field_step_u(&scene->field), hc_field_step_v(&scene->field));
    double        at[3];
    hc_cli_camera camera = { .width  = sized ? settings->size.width : WIDTH,
                             .height = sized ? settings->size.height : HEIGHT,
                             .sun    = { -0.70, 0.45 * north, 0.35 } };
    (void)normalise(camera.sun);
    choose_view(&camera, at, settings, scene, north);
    aim(&camera, at, north, tangent(half));
    camera.lift = (float)(0.02 * (north < 0.0 ? step : scene->placement.spacing_x));
    return camera;
}

/* ---- rays ------------------------------------------------------------------------------------ */

void hc_cli_camera_rays(const hc_cli_camera *camera, hc_ray *rays, uint64_t first, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint64_t index = first + i;
        const uint64_t width = (uint64_t)camera->width;
        const double   x     = (2.0 * (double)(index % width) + 1.0) / camera->width - 1.0;
        const double   y     = (2.0 * (double)(index / width) + 1.0) / camera->height - 1.0;
        rays[i].tmin         = 0.0F;
        rays[i].tmax         = INFINITY;
        for (int k = 0; k < 3; k++) {
            rays[i].origin[k] = (float)camera->eye[k];
            rays[i].direction[k] =
                (float)(camera->forward[k] + x * camera->right[k] + y * camera->down[k]);
        }
    }
}

hc_ray hc_cli_camera_shadow(const hc_cli_camera *camera, const hc_tracer *tracer, const hc_ray *ray,
                            const hc_hit *hit)
{
    hc_ray shadow = { .tmin = 1.0F, .tmax = 0.0F };
    float  normal[3];
    if (!isfinite(hit->t)) {
        return shadow;
    }
    hc_trace_normals(tracer, normal, NULL, hit);
    for (int k = 0; k < 3; k++) {
        shadow.origin[k] = ray->origin[k] + hit->t * ray->direction[k] + camera->lift * normal[k];
        shadow.direction[k] = (float)camera->sun[k];
    }
    shadow.tmin = 0.0F;
    shadow.tmax = INFINITY;
    return shadow;
}

/* ---- colours --------------------------------------------------------------------------------- */

/* From valleys to peaks. */
static void ground(double colour[3], double height)
{
    static const double stops[4][3] = {
        { 0.10, 0.20, 0.08 }, { 0.30, 0.30, 0.12 }, { 0.36, 0.24, 0.14 }, { 0.80, 0.80, 0.82 }
    };
    const double place = fmin(fmax(height, 0.0), 1.0) * 3.0;
    const int    stop  = place < 2.0 ? (int)place : 2;
    for (int i = 0; i < 3; i++) {
        colour[i] = stops[stop][i] + (place - stop) * (stops[stop + 1][i] - stops[stop][i]);
    }
}

static void sky(double colour[3], const hc_cli_camera *camera, uint64_t index)
{
    const double y = (double)(index / (uint64_t)camera->width) / camera->height;
    colour[0]      = 0.20 + 0.35 * y;
    colour[1]      = 0.38 + 0.30 * y;
    colour[2]      = 0.70 + 0.15 * y;
}

void hc_cli_camera_shade(uint8_t rgb[3], const hc_cli_camera *camera, const hc_tracer *tracer,
                         const hc_hit *hit, uint64_t index, bool shadowed)
{
    double colour[3];
    float  normal[3];
    if (isfinite(hit->t)) {
        hc_trace_normals(tracer, NULL, normal, hit);
        const double wide[3] = { (double)normal[0], (double)normal[1], (double)normal[2] };
        const double facing  = fmax(dot(wide, camera->sun), 0.0);
        const double light   = 0.25 + 0.1 * wide[2] + (shadowed ? 0.0 : 0.9 * facing);
        ground(colour, (double)hit->height);
        for (int i = 0; i < 3; i++) {
            colour[i] *= light;
        }
    } else {
        sky(colour, camera, index);
    }
    for (int i = 0; i < 3; i++) {
        rgb[i] = (uint8_t)(255.0 * sqrt(fmin(colour[i], 1.0)) + 0.5);
    }
}
