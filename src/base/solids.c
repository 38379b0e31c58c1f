/* Bodies to put into a landscape. */
#include <heightcast/mesh.h>

#include <stddef.h>
#include <string.h>

enum { AROUND = 24, RINGS = 13, SPOKES = 24 };

const char *hc_solid_name(hc_solid solid)
{
    static const char *const names[] = { "ball", "box", "cone", "house" };
    return (unsigned)solid < sizeof names / sizeof *names ? names[(unsigned)solid] : NULL;
}

/* Points of a circle, from one to the next by a turn, since sines of libm differ between machines.
 * cosine, sine: of a full turn by `AROUND`. */
static void circle(double points[AROUND][2])
{
    const double cosine = 0.96592582628906828675;
    const double sine   = 0.25881904510252076235;
    points[0][0]        = 1.0;
    points[0][1]        = 0.0;
    for (int i = 1; i < AROUND; i++) {
        points[i][0] = cosine * points[i - 1][0] - sine * points[i - 1][1];
        points[i][1] = sine * points[i - 1][0] + cosine * points[i - 1][1];
    }
}

static hc_result ball(hc_mesh **mesh, hc_log *log)
{
    double          points[AROUND][2];
    const hc_result result = hc_mesh_create(mesh, AROUND * RINGS, AROUND * (RINGS - 1) * 2, log);
    if (result != HC_OK) {
        return result;
    }
    int32_t *triangle = (*mesh)->triangles;
    circle(points);
    for (int i = 0; i < AROUND * RINGS; i++) {
        const int    ring      = i / AROUND; /* rings go from the lowest point to the highest */
        const double out       = points[ring][1];
        const double normal[3] = { out * points[i % AROUND][0], out * points[i % AROUND][1],
                                   -points[ring][0] };
        for (int k = 0; k < 3; k++) {
            (*mesh)->normals[3 * i + k]  = (float)normal[k];
            (*mesh)->vertices[3 * i + k] = (float)(0.5 * normal[k] + (k == 2 ? 0.5 : 0.0));
        }
    }
    for (int i = 0; i < AROUND * (RINGS - 1); i++) {
        const int     next    = i % AROUND == AROUND - 1 ? i + 1 - AROUND : i + 1;
        const int32_t both[6] = { i, next, next + AROUND, i, next + AROUND, i + AROUND };
        memcpy(triangle + (ptrdiff_t)6 * i, both, sizeof both);
    }
    return HC_OK;
}

/* A fan from the top to the foot, and one that closes the foot. */
static hc_result cone(hc_mesh **mesh, hc_log *log)
{
    double          points[AROUND][2];
    const hc_result result = hc_mesh_create(mesh, SPOKES + 2, 2 * SPOKES, log);
    if (result != HC_OK) {
        return result;
    }
    circle(points);
    for (int i = 0; i < SPOKES; i++) {
        const int     next    = (i + 1) % SPOKES;
        const int32_t both[6] = { i, next, SPOKES, next, i, SPOKES + 1 };
        memcpy((*mesh)->triangles + (ptrdiff_t)6 * i, both, sizeof both);
        (*mesh)->vertices[3 * i]     = (float)(0.3 * points[i][0]);
        (*mesh)->vertices[3 * i + 1] = (float)(0.3 * points[i][1]);
    }
    (*mesh)->vertices[3 * SPOKES + 2] = 1.0F;
    return HC_OK;
}

static hc_result listed(hc_mesh **mesh, const float *vertices, int vertex_count,
                        const int32_t *triangles, int triangle_count, hc_log *log)
{
    const hc_result result = hc_mesh_create(mesh, vertex_count, triangle_count, log);
    if (result == HC_OK) {
        memcpy((*mesh)->vertices, vertices, (size_t)vertex_count * 3 * sizeof *vertices);
        memcpy((*mesh)->triangles, triangles, (size_t)triangle_count * 3 * sizeof *triangles);
    }
    return result;
}

static hc_result box(hc_mesh **mesh, hc_log *log)
{
    static const float   v[] = { -0.5F, -0.5F, 0, 0.5F, -0.5F, 0, 0.5F, 0.5F, 0, -0.5F, 0.5F, 0,
                                 -0.5F, -0.5F, 1, 0.5F, -0.5F, 1, 0.5F, 0.5F, 1, -0.5F, 0.5F, 1 };
    static const int32_t t[] = { 0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7 };
    return listed(mesh, v, 8, t, 12, log);
}

static hc_result house(hc_mesh **mesh, hc_log *log)
{
    static const float   v[] = { -0.5F,  -0.35F, 0,     0.5F,  -0.35F, 0,      0.5F,  0.35F,
                                 0,      -0.5F,  0.35F, 0,     -0.5F,  -0.35F, 0.6F,  0.5F,
                                 -0.35F, 0.6F,   0.5F,  0.35F, 0.6F,   -0.5F,  0.35F, 0.6F,
                                 -0.5F,  0,      1,     0.5F,  0,      1 };
    static const int32_t t[] = { 0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1,
                                 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7, 4, 5,
                                 9, 4, 9, 8, 6, 7, 8, 6, 8, 9, 5, 6, 9, 7, 4, 8 };
    return listed(mesh, v, 10, t, 16, log);
}

hc_result hc_solid_create(hc_mesh **mesh, hc_solid solid, hc_log *log)
{
    switch (solid) {
    case HC_SOLID_BALL: return ball(mesh, log);
    case HC_SOLID_CONE: return cone(mesh, log);
    case HC_SOLID_HOUSE: return house(mesh, log);
    default: return box(mesh, log);
    }
}
