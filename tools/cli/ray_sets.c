#include "ray_sets.h"

#include <math.h>

/* Rays that share an eye. */
enum { PER_EYE = 64 };

typedef struct numbers {
    uint64_t state;
} numbers;

/* After: Steele, Lea, Flood. Fast splittable pseudorandom number generators. 2014 (splitmix64) */
static uint64_t next(numbers *n)
{
    uint64_t x = n->state += 0x9E3779B97F4A7C15U;
    x          = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
    x          = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31);
}

static double between(numbers *n, double low, double high)
{
    return low + (high - low) * ((double)(next(n) >> 11) * 0x1p-53);
}

static int below(numbers *n, int end)
{
    return (int)(next(n) % (uint64_t)end);
}

static void set_ray(hc_ray *ray, const double from[3], const double direction[3], double tmax)
{
    ray->tmin = 0.0F;
    ray->tmax = (float)tmax;
    for (int i = 0; i < 3; i++) {
        ray->origin[i]    = (float)from[i];
        ray->direction[i] = (float)direction[i];
    }
}

static void set_ray_to(hc_ray *ray, const double from[3], const double to[3], double tmax)
{
    const double direction[3] = { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
    set_ray(ray, from, direction, tmax);
}

/* A point `above` the ground. */
static void ground_point(double point[3], numbers *n, const hc_field *field, double above)
{
    point[0] = between(n, 0.0, 1.0);
    point[1] = between(n, 0.0, 1.0);
    point[2] = hc_field_surface(field, point[0], point[1]) + above;
}

static void random_ray(hc_ray *ray, numbers *n)
{
    double from[3];
    double to[3];
    for (int i = 0; i < 3; i++) {
        from[i] = between(n, i < 2 ? -0.5 : -0.1, 1.5);
        to[i]   = between(n, i < 2 ? -0.5 : -0.1, 1.5);
    }
    set_ray_to(ray, from, to, INFINITY);
}

static void camera_ray(hc_ray *ray, numbers *n, const hc_field *field, uint64_t seed, size_t index)
{
    numbers of_eye = { seed ^ (index / HC_CLI_RAY_SETS / PER_EYE) * 0xD1342543DE82EF95U };
    double  eye[3];
    double  to[3];
    ground_point(eye, &of_eye, field, 0.0);
    eye[2] += between(&of_eye, 0.01, 0.4);
    ground_point(to, n, field, 0.0);
    set_ray_to(ray, eye, to, INFINITY);
}

static void sight_ray(hc_ray *ray, numbers *n, const hc_field *field)
{
    double from[3];
    double to[3];
    ground_point(from, n, field, 0.005);
    ground_point(to, n, field, 0.005);
    set_ray_to(ray, from, to, 1.0);
}

static void grazing_ray(hc_ray *ray, numbers *n, const hc_field *field)
{
    const int    x       = below(n, field->width);
    const int    y       = below(n, field->height);
    const double height  = (double)field->heights[(size_t)y * (size_t)field->width + (size_t)x];
    const bool   along_u = below(n, 2) == 0;
    const double cross   = between(n, 0.0, 1.0);
    const double slant   = between(n, -1.0, 1.0);
    const double from[3] = { along_u ? -0.01 : cross, along_u ? cross : -0.01,
                             height + between(n, -0.002, 0.002) };
    const double direction[3] = { along_u ? 1.0 : slant, along_u ? slant : 1.0,
                                  between(n, -0.004, 0.004) };
    set_ray(ray, from, direction, INFINITY);
}

/* Where column (row) `index` of the samples is. */
static double sample_place(double step, bool grid, int index)
{
    return (grid ? index : index + 0.5) * step;
}

static void axis_ray(hc_ray *ray, numbers *n, const hc_field *field)
{
    const bool grid         = field->registration == HC_GRID;
    const bool line         = below(n, 2) == 0;
    const int  axis         = below(n, 3);
    const bool backwards    = axis < 2 && below(n, 2) == 0;
    double     from[3]      = { between(n, 0.0, 1.0), between(n, 0.0, 1.0), between(n, 0.0, 1.0) };
    double     direction[3] = { 0.0, 0.0, 0.0 };
    if (line) {
        from[0] = sample_place(hc_field_step_u(field), grid, below(n, field->width));
        from[1] = sample_place(hc_field_step_v(field), grid, below(n, field->height));
    }
    direction[axis] = axis == 2 || backwards ? -1.0 : 1.0;
    if (axis == 2) {
        from[2] = 1.25;
    } else {
        from[axis] = backwards ? 1.25 : -0.25;
    }
    set_ray(ray, from, direction, INFINITY);
}

const char *hc_cli_ray_set(int index)
{
    static const char *const names[HC_CLI_RAY_SETS] = { "random", "camera", "sight", "grazing",
                                                        "axis" };
    return names[index];
}

void hc_cli_make_rays(hc_ray *rays, size_t count, const hc_field *field, uint64_t seed)
{
    numbers n = { seed };
    for (size_t i = 0; i < count; i++) {
        switch (i % HC_CLI_RAY_SETS) {
        case 0: random_ray(&rays[i], &n); break;
        case 1: camera_ray(&rays[i], &n, field, seed, i); break;
        case 2: sight_ray(&rays[i], &n, field); break;
        case 3: grazing_ray(&rays[i], &n, field); break;
        default: axis_ray(&rays[i], &n, field); break;
        }
    }
}
