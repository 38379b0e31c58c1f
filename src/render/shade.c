#include "shade.h"

#include "vec.h"

#include <math.h>
#include <string.h>

/* ---- the surface --------------------------------------------------------------------------- */

static int wrapped(int index, int size, bool wraps)
{
    if (wraps) {
        const int rest = index % size;
        return rest < 0 ? rest + size : rest;
    }
    return index < 0 ? 0 : index < size ? index : size - 1;
}

/* As a texture unit filters, with the weights in full. */
static void albedo_at(double rgb[3], const hc_stage *stage, const hc_sight *sight)
{
    const hc_material *m     = &stage->scene.material;
    const unsigned     wrap  = (unsigned)stage->scene.relief.field.wrap;
    const bool         plain = m->albedo == NULL || hc_dot(sight->cut, sight->cut) > 0.0;
    const double       x     = (double)sight->hit.u * m->albedo_width - 0.5;
    const double       y     = (double)sight->hit.v * m->albedo_height - 0.5;
    for (int k = 0; k < 3; k++) {
        rgb[k] = plain ? (double)m->colour[k] : 0.0;
    }
    for (int i = 0; i < 4 && !plain; i++) {
        const int    right = i % 2;
        const int    below = i / 2;
        const double share = (right != 0 ? x - floor(x) : 1.0 - (x - floor(x)))
                             * (below != 0 ? y - floor(y) : 1.0 - (y - floor(y)));
        const int column = wrapped((int)floor(x) + right, m->albedo_width, (wrap & HC_WRAP_U) != 0);
        const int row = wrapped((int)floor(y) + below, m->albedo_height, (wrap & HC_WRAP_V) != 0);
        const float *texel =
            m->albedo + ((size_t)row * (size_t)m->albedo_width + (size_t)column) * 3;
        for (int k = 0; k < 3; k++) {
            rgb[k] += share * (double)texel[k];
        }
    }
}

/* Slopes of the relief bend the body's own normal. */
static void normal_at(double normal[3], const hc_stage *stage, const hc_shape *shape,
                      const hc_sight *sight, const double point[3])
{
    const hc_frame frame = hc_shape_frame(shape, point);
    float          flat[3];
    if (hc_dot(sight->cut, sight->cut) > 0.0) {
        memcpy(normal, sight->cut, 3 * sizeof *normal);
        return;
    }
    hc_trace_normals(stage->tracer, NULL, flat, &sight->hit);
    const double steep = shape->depth / (double)flat[2];
    memcpy(normal, frame.out, 3 * sizeof *normal);
    hc_add_scaled(normal, normal, steep * (double)flat[0] / frame.scale[0], frame.along_u);
    hc_add_scaled(normal, normal, steep * (double)flat[1] / frame.scale[1], frame.along_v);
    (void)hc_unit(normal);
}

/* ---- the light ----------------------------------------------------------------------------- */

/* A ray from the light that ends before the point leaves it in shadow. It comes from there, as the
 * 2006 paper has it, since published methods cannot start on the surface. */
static bool in_shadow(const hc_stage *stage, const hc_gaze *gaze, const double point[3],
                      const double to_light[3], double distance)
{
    double origin[3], along[3];
    hc_add_scaled(origin, point, distance, to_light);
    for (int i = 0; i < 3; i++) {
        along[i] = -to_light[i];
    }
    const hc_sight sight = hc_sight_along(&gaze->shape, stage->scene.relief.edge, HC_SIGHT_OF_LIGHT,
                                          gaze->tracer, origin, along);
    return sight.distance < distance - stage->shadow_slip;
}

static double power_of_two(double base, int exponent)
{
    for (int i = 0; i < exponent; i++) {
        base *= base;
    }
    return base;
}

static void light(double rgb[3], const hc_stage *stage, const hc_gaze *gaze, const double albedo[3],
                  const double normal[3], const double point[3])
{
    const hc_material *m        = &stage->scene.material;
    double             distance = HC_SUN_AWAY;
    double             to_light[3];
    memcpy(to_light, stage->sun, sizeof to_light);
    if (stage->scene.light.lamp) {
        hc_add_scaled(to_light, stage->scene.light.place, -1.0, point);
        distance = sqrt(hc_dot(to_light, to_light));
        (void)hc_unit(to_light);
    }
    const double facing = hc_dot(normal, to_light);
    const bool   dark =
        !(facing > 0.0)
        || (!stage->scene.light.no_shadows && in_shadow(stage, gaze, point, to_light, distance));
    double half[3];
    hc_add_scaled(half, to_light, -1.0, gaze->direction);
    (void)hc_unit(half);
    const double shine =
        (double)m->specular * power_of_two(fmax(hc_dot(normal, half), 0.0), m->gloss);
    for (int i = 0; i < 3; i++) {
        rgb[i] = albedo[i] * (double)m->ambient * (0.7 + 0.3 * normal[2]);
        rgb[i] += dark ? 0.0 : albedo[i] * (double)m->diffuse * facing + shine;
    }
}

void hc_shade(hc_sample *sample, const hc_stage *stage, const hc_gaze *gaze, const hc_sight *sight)
{
    double albedo[3], normal[3], point[3], rgb[3];
    *sample = (hc_sample){ .distance    = (float)sight->distance,
                           .exact       = INFINITY,
                           .height      = sight->hit.height,
                           .steps       = (float)sight->steps,
                           .entered     = sight->entered,
                           .unconverged = sight->unconverged };
    if (!(sight->distance < INFINITY)) {
        return;
    }
    hc_add_scaled(point, gaze->origin, sight->distance, gaze->direction);
    albedo_at(albedo, stage, sight);
    normal_at(normal, stage, &gaze->shape, sight, point);
    light(rgb, stage, gaze, albedo, normal, point);
    for (int i = 0; i < 3; i++) {
        sample->normal[i] = (float)normal[i];
        sample->rgb[i]    = (float)rgb[i];
    }
}
