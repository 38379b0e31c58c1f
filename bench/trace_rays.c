#include "trace_rays.h"

#include <math.h>

enum { WIDE = 1920, HIGH = 1080, TILE = 4 };

/* Eyes stand so high above the ground. */
static const double EYE = 0.002;

const char *hc_bench_rays_name(int set)
{
    static const char *const names[] = { "fly", "walk", "sight", "shadow", "random", "graze" };
    return set >= 0 && set < HC_RAYS_SETS ? names[set] : NULL;
}

bool hc_bench_rays_any(hc_bench_rays set)
{
    return set == HC_RAYS_SIGHT || set == HC_RAYS_SHADOW;
}

hc_placement hc_bench_placement(const hc_field *field)
{
    const double step_u = hc_field_step_u(field);
    const double step_v = hc_field_step_v(field);
    const double first  = field->registration == HC_GRID ? 0.0 : 0.5;
    return (hc_placement){ .spacing_x = step_u,
                           .spacing_y = step_v,
                           .scale_z   = HC_RAYS_RELIEF,
                           .offset    = { first * step_u, first * step_v, 0.0 } };
}

/* Even over 0 .. 1, and the same on every machine. */
static double next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) * 0x1p-53;
}

static double ground(const hc_field *field, double x, double y)
{
    return HC_RAYS_RELIEF * hc_field_surface(field, x, y);
}

typedef struct camera {
    double eye[3], forward[3], right[3], up[3];
} camera;

/* Level to the right; looks `down` below the horizon along (1, 1). */
static camera make_camera(double x, double y, double z, double down)
{
    const double level = sqrt(0.5 * (1.0 - down * down));
    const double half  = sqrt(0.5);
    return (camera){ .eye     = { x, y, z },
                     .forward = { level, level, -down },
                     .right   = { half, -half, 0.0 },
                     .up      = { down * half, down * half, sqrt(1.0 - down * down) } };
}

static hc_ray pixel_ray(const camera *c, size_t index)
{
    const size_t tile = index / (TILE * TILE);
    const size_t in   = index % (TILE * TILE);
    const double i    = (double)(tile % (WIDE / TILE) * TILE + in % TILE);
    const double j    = (double)(tile / (WIDE / TILE) * TILE + in / TILE);
    const double zoom = 0.57735 / (WIDE / 2); /* 60 degrees from left to right */
    const double x    = (i + 0.5 - WIDE / 2) * zoom;
    const double y    = (HIGH / 2 - j - 0.5) * zoom;
    hc_ray       ray  = { .tmin = 0.0F, .tmax = INFINITY };
    for (int k = 0; k < 3; k++) {
        ray.origin[k]    = (float)c->eye[k];
        ray.direction[k] = (float)(c->forward[k] + x * c->right[k] + y * c->up[k]);
    }
    return ray;
}

static void fill_picture(hc_ray *rays, size_t count, const camera *c)
{
    const size_t tiles = count / (TILE * TILE);
    const size_t skip  = tiles > 0 ? HC_RAYS_PICTURE / (TILE * TILE) / tiles : 1;
    for (size_t i = 0; i < count; i++) {
        rays[i] = pixel_ray(c, i / (TILE * TILE) * skip * TILE * TILE + i % (TILE * TILE));
    }
}

static void ground_point(float point[3], const hc_field *field, uint64_t *state, double above)
{
    const double x = 0.01 + 0.98 * next_random(state);
    const double y = 0.01 + 0.98 * next_random(state);
    point[0]       = (float)x;
    point[1]       = (float)y;
    point[2]       = (float)(ground(field, x, y) + above);
}

static hc_ray sight_ray(const hc_field *field, uint64_t *state)
{
    hc_ray ray = { .tmin = 0.0F, .tmax = 1.0F };
    ground_point(ray.origin, field, state, EYE);
    ground_point(ray.direction, field, state, EYE);
    for (int k = 0; k < 3; k++) {
        ray.direction[k] -= ray.origin[k];
    }
    return ray;
}

/* From the index-th of `count` points in a raster of tiles, as for a map of light. */
static hc_ray shadow_ray(const hc_field *field, size_t index, size_t count)
{
    const size_t row  = (size_t)sqrt((double)count / (TILE * TILE)); /* tiles */
    const size_t tile = index / (TILE * TILE);
    const size_t in   = index % (TILE * TILE);
    const double x =
        0.01 + 0.98 * ((double)(tile % row * TILE + in % TILE) + 0.5) / (double)(row * TILE);
    const double y = 0.01
                     + 0.98 * ((double)(tile / row * TILE + in / TILE) + 0.5)
                           / (double)((count / (row * TILE * TILE) + 1) * TILE);
    /* cos 15 * cos 30, cos 15 * sin 30, sin 15 */
    return (hc_ray){ .origin    = { (float)x, (float)y, (float)(ground(field, x, y) + 1e-5) },
                     .direction = { 0.836516F, 0.482963F, 0.258819F },
                     .tmax      = INFINITY };
}

static hc_ray random_ray(const hc_field *field, uint64_t *state)
{
    hc_ray ray = { .tmin = 0.0F, .tmax = INFINITY };
    ground_point(ray.origin, field, state, 0.0);
    ray.origin[2] += (float)((HC_RAYS_RELIEF - (double)ray.origin[2]) * next_random(state));
    double length;
    double d[3];
    do {
        for (int k = 0; k < 3; k++) {
            d[k] = 2.0 * next_random(state) - 1.0;
        }
        length = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    } while (length > 1.0 || length < 0.01);
    for (int k = 0; k < 3; k++) {
        ray.direction[k] = (float)(d[k] / sqrt(length));
    }
    return ray;
}

/* The way through (x, y) over the whole field: where it begins and, added to that, ends. */
static void whole_way(double begin[2], double way[2], const double middle[2],
                      const double direction[2])
{
    double from = -INFINITY;
    double to   = INFINITY;
    for (int k = 0; k < 2; k++) {
        const double low  = -middle[k] / direction[k];
        const double high = (1.0 - middle[k]) / direction[k];
        from              = direction[k] == 0.0 ? from : fmax(from, fmin(low, high));
        to                = direction[k] == 0.0 ? to : fmin(to, fmax(low, high));
    }
    for (int k = 0; k < 2; k++) {
        begin[k] = middle[k] + from * direction[k];
        way[k]   = (to - from) * direction[k];
    }
}

/* Least height at which a ray that rises by `rise` on its way stays above the ground. */
static double skim(const hc_field *field, const double begin[2], const double way[2], double rise)
{
    const int points = 2 * field->width;
    double    least  = 0.0;
    for (int i = 0; i <= points; i++) {
        const double part = (double)i / points;
        least = fmax(least, ground(field, begin[0] + part * way[0], begin[1] + part * way[1])
                                - part * rise);
    }
    return least;
}

static hc_ray graze_ray(const hc_field *field, uint64_t *state)
{
    static const double compass[][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 },  { 0, -1 },
                                         { 1, 1 }, { -1, 1 }, { 1, -1 }, { -1, -1 } };
    double              direction[2] = { 0.0, 0.0 };
    double              begin[2];
    double              way[2];
    const double        middle[2] = { next_random(state), next_random(state) };
    const size_t        which     = (size_t)(16.0 * next_random(state));
    for (int k = 0; k < 2; k++) {
        direction[k] = which < 8 ? compass[which][k] : 2.0 * next_random(state) - 1.0;
    }
    whole_way(begin, way, middle, direction);
    const double rise   = HC_RAYS_RELIEF * 0.02 * (next_random(state) - 0.5);
    const double sign   = next_random(state) < 0.5 ? 1.0 : -1.0;
    const double hair   = sign * HC_RAYS_RELIEF * ldexp(1.0, -6 - (int)(13.0 * next_random(state)));
    const double height = skim(field, begin, way, rise) + hair;
    return (hc_ray){ .origin    = { (float)begin[0], (float)begin[1], (float)height },
                     .direction = { (float)way[0], (float)way[1], (float)rise },
                     .tmax      = INFINITY };
}

void hc_bench_fill_rays(hc_ray *rays, size_t count, hc_bench_rays set, const hc_field *field)
{
    uint64_t state = 88172645463325252U;
    if (set == HC_RAYS_FLY || set == HC_RAYS_WALK) {
        const camera c = set == HC_RAYS_FLY
                             ? make_camera(0.05, 0.05, 1.5 * HC_RAYS_RELIEF, 0.3)
                             : make_camera(0.2, 0.2, ground(field, 0.2, 0.2) + EYE, 0.05);
        fill_picture(rays, count, &c);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        rays[i] = set == HC_RAYS_SIGHT    ? sight_ray(field, &state)
                  : set == HC_RAYS_SHADOW ? shadow_ray(field, i, count)
                  : set == HC_RAYS_GRAZE  ? graze_ray(field, &state)
                                          : random_ray(field, &state);
    }
}
