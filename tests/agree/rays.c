#include "rays.h"

#include <math.h>
#include <string.h>

const char *agree_rays_name(agree_rays set)
{
    static const char *const names[RAYS_SETS] = { "random",  "camera",   "grazing", "axis",
                                                  "lines",   "vertices", "spikes",  "far",
                                                  "upright", "level",    "under",   "border",
                                                  "extreme", "not rays" };
    return names[set];
}

typedef double vector[3];

static double between(uint64_t *random, double low, double high)
{
    return low + (high - low) * agree_uniform(random);
}

static double sign(uint64_t *random)
{
    return agree_range(random, 0, 1) == 0 ? -1.0 : 1.0;
}

/* Texture coordinates and height of a sample. */
static void sample_at(const hc_field *field, int x, int y, vector out)
{
    const double first = field->registration == HC_GRID ? 0.0 : 0.5;
    out[0]             = (x + first) * hc_field_step_u(field);
    out[1]             = (y + first) * hc_field_step_v(field);
    out[2]             = (double)field->heights[(size_t)y * (size_t)field->width + (size_t)x];
}

static void some_sample(const hc_field *field, uint64_t *random, vector out)
{
    sample_at(field, agree_range(random, 0, field->width - 1),
              agree_range(random, 0, field->height - 1), out);
}

static void some_ground(const hc_field *field, uint64_t *random, double above, vector out)
{
    out[0] = agree_uniform(random);
    out[1] = agree_uniform(random);
    out[2] = hc_field_surface(field, out[0], out[1]) + above;
}

static hc_ray ray_of(const vector origin, const vector direction, double tmin, double tmax)
{
    hc_ray ray = { .tmin = (float)tmin, .tmax = (float)tmax };
    for (int i = 0; i < 3; i++) {
        ray.origin[i]    = (float)origin[i];
        ray.direction[i] = (float)direction[i];
    }
    return ray;
}

/* From a to b and on; `back` puts the origin so many lengths before a. */
static hc_ray ray_through(const vector a, const vector b, double back, double tmax)
{
    vector origin, direction;
    for (int i = 0; i < 3; i++) {
        direction[i] = b[i] - a[i];
        origin[i]    = a[i] - back * direction[i];
    }
    return ray_of(origin, direction, 0.0, tmax);
}

static void some_place(uint64_t *random, double margin, vector out)
{
    out[0] = between(random, -margin, 1.0 + margin);
    out[1] = between(random, -margin, 1.0 + margin);
    out[2] = between(random, -0.25, 1.5);
}

static void some_direction(uint64_t *random, vector out)
{
    for (int i = 0; i < 3; i++) {
        out[i] = between(random, -1.0, 1.0);
    }
}

static hc_ray random_ray(const hc_field *field, uint64_t *random)
{
    vector origin, direction;
    (void)field;
    some_place(random, 1.0, origin);
    some_direction(random, direction);
    const double tmax = agree_range(random, 0, 2) == 0 ? between(random, 0.0, 2.0) : INFINITY;
    return ray_of(origin, direction, between(random, -1.0, 1.0), fmax(tmax, 1.0));
}

static hc_ray camera_ray(const hc_field *field, uint64_t *random)
{
    vector eye, direction;
    some_ground(field, random, between(random, 0.01, 0.6), eye);
    some_direction(random, direction);
    direction[2] = between(random, -0.7, 0.1);
    return ray_of(eye, direction, 0.0, INFINITY);
}

static hc_ray grazing_ray(const hc_field *field, uint64_t *random)
{
    vector       a, b;
    const double above = ldexp(1.0, -agree_range(random, 2, 24));
    some_ground(field, random, above, a);
    some_ground(field, random, above, b);
    return ray_through(a, b, between(random, 0.0, 2.0),
                       agree_range(random, 0, 1) == 0 ? INFINITY : 1.0);
}

static hc_ray axis_ray(const hc_field *field, uint64_t *random)
{
    vector    place;
    vector    direction = { 0.0, 0.0, 0.0 };
    const int axis      = agree_range(random, 0, 1);
    (void)field;
    some_place(random, 0.1, place);
    direction[axis] = sign(random);
    direction[2]    = between(random, -0.5, 0.3);
    place[axis] -= direction[axis] * between(random, 0.0, 2.0);
    return ray_of(place, direction, 0.0, INFINITY);
}

/* Half a sample on is the wall between tops. */
static hc_ray line_ray(const hc_field *field, uint64_t *random)
{
    vector    place;
    vector    direction = { 0.0, 0.0, 0.0 };
    const int axis      = agree_range(random, 0, 1);
    some_sample(field, random, place);
    place[1 - axis] += 0.5 * agree_range(random, -1, 1)
                       * (axis == 0 ? hc_field_step_v(field) : hc_field_step_u(field));
    place[2] += agree_range(random, 0, 1) == 0 ? 0.0 : between(random, -0.2, 0.4);
    direction[axis] = sign(random);
    direction[2]    = agree_range(random, 0, 2) == 0 ? 0.0 : between(random, -0.5, 0.3);
    place[axis] -= direction[axis] * agree_range(random, 0, 2);
    return ray_of(place, direction, 0.0, INFINITY);
}

static hc_ray vertex_ray(const hc_field *field, uint64_t *random)
{
    vector a, b;
    some_sample(field, random, a);
    some_sample(field, random, b);
    a[2] += agree_range(random, 0, 1) == 0 ? 0.0 : between(random, 0.0, 0.5);
    b[2] += agree_range(random, 0, 2) == 0 ? between(random, -0x1p-20, 0x1p-20) : 0.0;
    return ray_through(a, b, agree_range(random, 0, 2), INFINITY);
}

static hc_ray spike_ray(const hc_field *field, uint64_t *random)
{
    vector top, place;
    some_sample(field, random, top);
    for (int i = 0; i < 8; i++) {
        some_sample(field, random, place);
        if (place[2] > top[2]) {
            memcpy(top, place, sizeof top);
        }
    }
    some_place(random, 0.5, place);
    const double off = ldexp(1.0, -agree_range(random, 3, 26));
    top[0] += off * hc_field_step_u(field) * between(random, -1.0, 1.0);
    top[1] += off * hc_field_step_v(field) * between(random, -1.0, 1.0);
    top[2] += off * between(random, -1.0, 1.0);
    return ray_through(place, top, 0.0, INFINITY);
}

static hc_ray far_ray(const hc_field *field, uint64_t *random)
{
    vector target, direction, origin;
    some_ground(field, random, between(random, -0.1, 0.3), target);
    some_direction(random, direction);
    direction[2] *= agree_range(random, 0, 1) == 0 ? 1.0 : 1e-5;
    for (int i = 0; i < 3; i++) {
        direction[i] = (double)(float)direction[i];
        origin[i]    = target[i] - 1e5 * direction[i];
    }
    return ray_of(origin, direction, agree_range(random, 0, 1) == 0 ? 0.0 : 9e4, INFINITY);
}

static hc_ray upright_ray(const hc_field *field, uint64_t *random)
{
    vector place;
    vector up = { 0.0, 0.0, sign(random) };
    some_sample(field, random, place);
    place[0] += 0.5 * agree_range(random, -2, 2) * hc_field_step_u(field);
    place[1] += agree_range(random, 0, 1) == 0 ? 0.0 : between(random, -1.0, 1.0);
    place[2] = between(random, -1.0, 2.0);
    return ray_of(place, up, 0.0, INFINITY);
}

static hc_ray level_ray(const hc_field *field, uint64_t *random)
{
    vector sample, place, direction;
    some_sample(field, random, sample);
    some_place(random, 0.5, place);
    some_direction(random, direction);
    place[2]     = sample[2];
    direction[2] = 0.0;
    return ray_of(place, direction, 0.0, INFINITY);
}

static hc_ray under_ray(const hc_field *field, uint64_t *random)
{
    vector place, direction;
    some_ground(field, random, -between(random, 0.0, 0.5), place);
    some_direction(random, direction);
    direction[2] = between(random, -0.2, 1.0);
    if (agree_range(random, 0, 1) == 0) {
        for (int i = 0; i < 3; i++) {
            place[i] -= 3.0 * direction[i];
        }
    }
    return ray_of(place, direction, 0.0, INFINITY);
}

static hc_ray border_ray(const hc_field *field, uint64_t *random)
{
    static const double beside[] = { 0.0, 0.0, 0x1p-24, -0x1p-24, 0x1p-12 };
    vector              place, direction;
    const int           axis = agree_range(random, 0, 1);
    some_ground(field, random, between(random, -0.1, 0.4), place);
    some_direction(random, direction);
    place[axis] = agree_range(random, 0, 1) + beside[agree_range(random, 0, 4)];
    direction[axis] *= agree_range(random, 0, 1);
    return ray_of(place, direction, 0.0, INFINITY);
}

static hc_ray extreme_ray(const hc_field *field, uint64_t *random)
{
    hc_ray    ray   = camera_ray(field, random);
    const int shift = agree_range(random, -100, 100);
    for (int i = 0; i < 3; i++) {
        ray.direction[i] = ldexpf(ray.direction[i], shift);
    }
    if (agree_range(random, 0, 3) == 0) {
        ray.direction[agree_range(random, 0, 2)] *= 0x1p-40F;
    }
    return ray;
}

static hc_ray not_a_ray(const hc_field *field, uint64_t *random)
{
    static const float odd[] = { NAN, INFINITY, -INFINITY };
    hc_ray             ray   = camera_ray(field, random);
    const int          which = agree_range(random, 0, 9);
    const float        value = odd[agree_range(random, 0, 2)];
    if (which < 3) {
        ray.origin[which] = value;
    } else if (which < 6) {
        ray.direction[which - 3] = value;
    } else if (which == 6) {
        ray.tmin = value;
    } else if (which == 7) {
        ray.tmax = NAN;
    } else if (which == 8) {
        ray.tmax = nextafterf(ray.tmin, -INFINITY);
    } else {
        memset(ray.direction, 0, sizeof ray.direction);
    }
    return ray;
}

hc_ray agree_ray(const hc_field *field, agree_rays set, uint64_t *random)
{
    static hc_ray (*const makers[RAYS_SETS])(const hc_field *, uint64_t *) = {
        random_ray, camera_ray,  grazing_ray, axis_ray,  line_ray,   vertex_ray,  spike_ray,
        far_ray,    upright_ray, level_ray,   under_ray, border_ray, extreme_ray, not_a_ray
    };
    return makers[set](field, random);
}

hc_ray agree_place_ray(const hc_field *field, const hc_placement *placement, const hc_ray *ray)
{
    const double first    = field->registration == HC_GRID ? 0.0 : 0.5;
    const double scale[3] = { placement->spacing_x / hc_field_step_u(field),
                              placement->spacing_y / hc_field_step_v(field), placement->scale_z };
    const double zero[3]  = { first * placement->spacing_x, first * placement->spacing_y, 0.0 };
    hc_ray       placed   = *ray;
    for (int i = 0; i < 3; i++) {
        placed.origin[i] =
            (float)((double)ray->origin[i] * scale[i] - zero[i] + placement->offset[i]);
        placed.direction[i] = (float)((double)ray->direction[i] * scale[i]);
    }
    return placed;
}
