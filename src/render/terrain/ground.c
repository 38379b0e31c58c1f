/* Colours of the ground. */
#include "terrain.h"

#include "../vec.h"
#include <string.h>

typedef struct stop {
    double at, rgb[3];
} stop;

static void along_stops(double rgb[3], const stop *stops, int count, double at)
{
    int i = 0;
    while (i < count - 2 && at > stops[i + 1].at) {
        i++;
    }
    const double share = fmin(fmax((at - stops[i].at) / (stops[i + 1].at - stops[i].at), 0.0), 1.0);
    for (int k = 0; k < 3; k++) {
        rgb[k] = stops[i].rgb[k] + share * (stops[i + 1].rgb[k] - stops[i].rgb[k]);
    }
}

static const double ROUGHNESS = 0.05; /* slope of each ripple */

/* ---- speckles ------------------------------------------------------------------------------ */

/* 0 .. 1, of a point of a grid. Whole numbers only, so that shaders have the same. */
static double random_at(int32_t x, int32_t y, uint32_t octave)
{
    uint32_t h = (uint32_t)x * 0x9E3779B1U ^ (uint32_t)y * 0x85EBCA77U ^ octave * 0xC2B2AE3DU;
    h          = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h          = (h ^ (h >> 12)) * 0x297A2D39U;
    return (double)((h ^ (h >> 15)) >> 8) / 16777216.0;
}

typedef struct wave {
    double value, slope[2];
} wave;

/* Smooth from point to point, -1 .. 1. */
static wave ripple(double x, double y, uint32_t octave)
{
    const double  column = floor(x);
    const double  row    = floor(y);
    const double  a      = x - column;
    const double  b      = y - row;
    const double  fx     = a * a * (3.0 - 2.0 * a);
    const double  fy     = b * b * (3.0 - 2.0 * b);
    const int32_t i      = (int32_t)column;
    const int32_t k      = (int32_t)row;
    const double  p      = random_at(i, k, octave);
    const double  q      = random_at(i + 1, k, octave) - p;
    const double  r      = random_at(i, k + 1, octave) - p;
    const double  twist  = random_at(i + 1, k + 1, octave) - p - q - r;
    return (wave){ 2.0 * (p + q * fx + r * fy + twist * fx * fy) - 1.0,
                   { 12.0 * a * (1.0 - a) * (q + twist * fy),
                     12.0 * b * (1.0 - b) * (r + twist * fx) } };
}

/* Ripples of rising frequency; those that a pixel cannot show are left out smoothly. x, y and
 * footprint in samples; the slopes are those of a rough ground. */
static wave speckle(double x, double y, double footprint)
{
    wave   sum  = { 0.0, { 0.0, 0.0 } };
    double size = 0.5, length = 4.0;
    for (uint32_t octave = 0; octave < 8; octave++, length *= 0.4, size *= 0.8) {
        const double seen = fmin(fmax(length / fmax(footprint, 1e-9) - 1.0, 0.0), 1.0);
        if (seen <= 0.0) {
            break;
        }
        const wave w = ripple(x / length, y / length, octave);
        sum.value += seen * size * w.value;
        for (int i = 0; i < 2; i++) {
            sum.slope[i] += seen * ROUGHNESS * w.slope[i];
        }
    }
    return sum;
}

/* ---- grounds ------------------------------------------------------------------------------- */

static const stop natural_stops[] = {
    { 0.00, { 0.120, 0.150, 0.048 } }, { 0.14, { 0.095, 0.125, 0.040 } },
    { 0.34, { 0.046, 0.078, 0.028 } }, { 0.62, { 0.064, 0.088, 0.032 } },
    { 0.82, { 0.170, 0.145, 0.075 } }, { 1.00, { 0.300, 0.275, 0.240 } }
};

static const stop map_stops[] = { { 0.00, { 0.08, 0.22, 0.10 } }, { 0.20, { 0.26, 0.42, 0.14 } },
                                  { 0.45, { 0.62, 0.54, 0.22 } }, { 0.70, { 0.36, 0.20, 0.10 } },
                                  { 0.88, { 0.34, 0.30, 0.28 } }, { 1.00, { 0.85, 0.86, 0.88 } } };

/* At tangents of the slope: 45 degrees are red. */
static const stop slope_stops[] = { { 0.00, { 0.05, 0.25, 0.10 } },
                                    { 0.25, { 0.30, 0.42, 0.06 } },
                                    { 0.60, { 0.66, 0.48, 0.05 } },
                                    { 1.00, { 0.55, 0.05, 0.03 } },
                                    { 2.00, { 0.25, 0.03, 0.32 } } };

static const double rock[3] = { 0.215, 0.190, 0.165 };

static double steepness(const double normal[3])
{
    return sqrt(normal[0] * normal[0] + normal[1] * normal[1]) / fmax(normal[2], 1e-6);
}

/* The normal is bent by what is too small for the samples. */
static void natural(double rgb[3], double normal[3], const hc_terrain *terrain, const hc_hit *hit,
                    double footprint)
{
    const hc_terrain_scene *scene  = &terrain->scene;
    const double            spaced = fmin(scene->spacing[0], scene->spacing[1]);
    const double            x      = (double)hit->u / hc_field_step_u(&scene->field);
    const double            y      = (double)hit->v / hc_field_step_v(&scene->field);
    const wave              grain  = speckle(x, y, footprint / spaced);
    const double            bare =
        fmin(fmax((steepness(normal) + 0.22 * grain.value - 0.55) / 0.35, 0.0), 1.0);
    along_stops(rgb, natural_stops, 6, (double)hit->height + 0.14 * grain.value);
    for (int k = 0; k < 3; k++) {
        rgb[k] += bare * (rock[k] - rgb[k]);
        rgb[k] *= 1.0 + 0.45 * grain.value;
    }
    normal[0] -= grain.slope[0] * normal[2];
    normal[1] += grain.slope[1] * normal[2]; /* rows go against y */
    (void)hc_unit(normal);
}

static int inside(double index, int size)
{
    return (int)fmin(fmax(index, 0.0), size - 1);
}

/* As a texture unit filters, with the weights in full. */
static void draped(double rgb[3], const hc_terrain_scene *scene, const hc_hit *hit)
{
    const double x = (double)hit->u * scene->image_width - (scene->blocky ? 0.0 : 0.5);
    const double y = (double)hit->v * scene->image_height - (scene->blocky ? 0.0 : 0.5);
    const double a = scene->blocky ? 0.0 : x - floor(x);
    const double b = scene->blocky ? 0.0 : y - floor(y);
    memset(rgb, 0, 3 * sizeof *rgb);
    for (int i = 0; i < 4; i++) {
        const double share  = (i % 2 != 0 ? a : 1.0 - a) * (i / 2 != 0 ? b : 1.0 - b);
        const int    column = inside(floor(x) + i % 2, scene->image_width);
        const int    row    = inside(floor(y) + i / 2, scene->image_height);
        const float *texel =
            scene->image + ((size_t)row * (size_t)scene->image_width + (size_t)column) * 3;
        for (int k = 0; k < 3; k++) {
            rgb[k] += share * (double)texel[k];
        }
    }
}

/* The nearest sample instead of what lies between. */
static hc_hit snapped(const hc_terrain_scene *scene, const hc_hit *hit)
{
    const hc_field *field  = &scene->field;
    const double    half   = field->registration == HC_GRID ? 0.0 : 0.5;
    const double    step_u = hc_field_step_u(field);
    const double    step_v = hc_field_step_v(field);
    const int       column = inside(floor((double)hit->u / step_u - half + 0.5), field->width);
    const int       row    = inside(floor((double)hit->v / step_v - half + 0.5), field->height);
    hc_hit          snap   = *hit;
    snap.u                 = (float)((column + half) * step_u);
    snap.v                 = (float)((row + half) * step_v);
    snap.height            = field->heights[(size_t)row * (size_t)field->width + (size_t)column];
    return snap;
}

void hc_ground_colour(double rgb[3], const hc_terrain *terrain, const hc_hit *hit, double normal[3],
                      double footprint)
{
    const hc_hit at = terrain->scene.blocky ? snapped(&terrain->scene, hit) : *hit;
    switch (terrain->scene.ground) {
    case HC_GROUND_NATURAL: natural(rgb, normal, terrain, &at, footprint); break;
    case HC_GROUND_ELEVATION: along_stops(rgb, map_stops, 6, (double)at.height); break;
    case HC_GROUND_SLOPE: along_stops(rgb, slope_stops, 5, steepness(normal)); break;
    case HC_GROUND_IMAGE: draped(rgb, &terrain->scene, hit); break;
    case HC_GROUND_PLAIN: memcpy(rgb, (const double[3]){ 0.3, 0.29, 0.27 }, 3 * sizeof *rgb); break;
    }
}
