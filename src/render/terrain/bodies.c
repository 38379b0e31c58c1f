/* A tree of boxes, halved at the middle triangle along the longest side. */
#include "bodies.h"

#include "../angle.h"
#include "../vec.h"

#include "base/fail.h"

#include <stdlib.h>
#include <string.h>

enum { LEAF = 4, DEPTH_MAX = 64 };

typedef struct triangle {
    double corner[3][3];
    float  normal[3][3]; /* of the corners; zero: flat */
    int    object;
} triangle;

/* A leaf has `count` triangles from `first`; else the children are the next node and `first`. */
typedef struct node {
    double low[3], high[3];
    int    first, count;
} node;

struct hc_bodies {
    triangle *triangles;
    node     *nodes;
    int       triangle_count, node_count;
};

/* ---- triangles ----------------------------------------------------------------------------- */

/* Turned about z, scaled and moved. */
static void place_corner(triangle *t, int corner, const hc_object *object, const double place[3],
                         int vertex)
{
    const float *v    = object->mesh->vertices + (ptrdiff_t)3 * vertex;
    const float *n    = object->mesh->normals + (ptrdiff_t)3 * vertex;
    const double size = object->size > 0.0 ? object->size : 1.0;
    double       c, s;
    hc_turn(&c, &s, object->turn / 360.0);
    const double x       = (double)v[0] * size;
    const double y       = (double)v[1] * size;
    t->corner[corner][0] = place[0] + c * x - s * y;
    t->corner[corner][1] = place[1] + s * x + c * y;
    t->corner[corner][2] = place[2] + (double)v[2] * size;
    t->normal[corner][0] = (float)(c * (double)n[0] - s * (double)n[1]);
    t->normal[corner][1] = (float)(s * (double)n[0] + c * (double)n[1]);
    t->normal[corner][2] = n[2];
}

static void take_object(hc_bodies *bodies, const hc_object *object, const double place[3],
                        int index)
{
    for (int i = 0; i < object->mesh->triangle_count; i++) {
        triangle *t = &bodies->triangles[bodies->triangle_count++];
        t->object   = index;
        for (int k = 0; k < 3; k++) {
            place_corner(t, k, object, place, object->mesh->triangles[3 * i + k]);
        }
    }
}

/* ---- the tree ------------------------------------------------------------------------------ */

static void bound(node *n, const triangle *triangles, int first, int count)
{
    for (int k = 0; k < 3; k++) {
        n->low[k]  = INFINITY;
        n->high[k] = -INFINITY;
        for (int i = 3 * first; i < 3 * (first + count); i++) {
            n->low[k]  = fmin(n->low[k], triangles[i / 3].corner[i % 3][k]);
            n->high[k] = fmax(n->high[k], triangles[i / 3].corner[i % 3][k]);
        }
    }
}

static double middle(const triangle *t, int axis)
{
    return t->corner[0][axis] + t->corner[1][axis] + t->corner[2][axis];
}

/* Ties go by what follows, so that the order is the same with every qsort. */
static int by_axis(const triangle *a, const triangle *b, int axis)
{
    const double x = middle(a, axis);
    const double y = middle(b, axis);
    return x < y ? -1 : x > y ? 1 : memcmp(a->corner, b->corner, sizeof a->corner);
}

static int by_x(const void *a, const void *b)
{
    return by_axis(a, b, 0);
}

static int by_y(const void *a, const void *b)
{
    return by_axis(a, b, 1);
}

static int by_z(const void *a, const void *b)
{
    return by_axis(a, b, 2);
}

/* NOLINTNEXTLINE(misc-no-recursion): as deep as the logarithm of the triangles. */
static void split(hc_bodies *bodies, int first, int count)
{
    static int (*const by[3])(const void *, const void *) = { by_x, by_y, by_z };
    const int own                                         = bodies->node_count++;
    node     *n                                           = &bodies->nodes[own];
    int       axis                                        = 0;
    bound(n, bodies->triangles, first, count);
    for (int k = 1; k < 3; k++) {
        axis = n->high[k] - n->low[k] > n->high[axis] - n->low[axis] ? k : axis;
    }
    n->first = first;
    n->count = count;
    if (count > LEAF) {
        qsort(bodies->triangles + first, (size_t)count, sizeof *bodies->triangles, by[axis]);
        split(bodies, first, count / 2);
        n->first = bodies->node_count;
        n->count = 0;
        split(bodies, first + count / 2, count - count / 2);
    }
}

hc_result hc_bodies_create(hc_bodies **bodies, const hc_object *objects, const double (*places)[3],
                           int count, hc_log *log)
{
    int64_t triangles = 0;
    for (int i = 0; i < count; i++) {
        triangles += objects[i].mesh->triangle_count;
    }
    *bodies = NULL;
    if (triangles > HC_MESH_MAX) {
        return hc_fail(log, HC_ERROR_LIMIT, "the objects have %lld triangles; at most %d",
                       (long long)triangles, HC_MESH_MAX);
    }
    *bodies = calloc(1, sizeof **bodies);
    if (*bodies != NULL) {
        (*bodies)->triangles = malloc((size_t)triangles * sizeof *(*bodies)->triangles);
        (*bodies)->nodes     = malloc((size_t)triangles * 2 * sizeof *(*bodies)->nodes);
    }
    if (*bodies == NULL || (*bodies)->triangles == NULL || (*bodies)->nodes == NULL) {
        hc_bodies_destroy(*bodies);
        *bodies = NULL;
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for %lld triangles", (long long)triangles);
    }
    for (int i = 0; i < count; i++) {
        take_object(*bodies, &objects[i], places[i], i);
    }
    split(*bodies, 0, (int)triangles);
    return HC_OK;
}

void hc_bodies_destroy(hc_bodies *bodies)
{
    if (bodies != NULL) {
        free(bodies->triangles);
        free(bodies->nodes);
        free(bodies);
    }
}

/* ---- rays ---------------------------------------------------------------------------------- */

static bool comes_to(const node *n, const double origin[3], const double direction[3], double from,
                     double to)
{
    for (int k = 0; k < 3; k++) {
        if (fabs(direction[k]) > 0.0) {
            const double a = (n->low[k] - origin[k]) / direction[k];
            const double b = (n->high[k] - origin[k]) / direction[k];
            from           = fmax(from, fmin(a, b));
            to             = fmin(to, fmax(a, b));
        } else if (origin[k] < n->low[k] || origin[k] > n->high[k]) {
            return false;
        }
    }
    return from <= to;
}

/* Möller and Trumbore 1997. Weights of the second and third corner in `share`. */
static double meets(const triangle *t, const double origin[3], const double direction[3],
                    double share[2])
{
    double one[3], two[3], across[3], from[3], over[3];
    hc_add_scaled(one, t->corner[1], -1.0, t->corner[0]);
    hc_add_scaled(two, t->corner[2], -1.0, t->corner[0]);
    hc_add_scaled(from, origin, -1.0, t->corner[0]);
    hc_cross(across, direction, two);
    hc_cross(over, from, one);
    const double volume = hc_dot(one, across);
    if (!(fabs(volume) > 0.0)) {
        return INFINITY;
    }
    share[0] = hc_dot(from, across) / volume;
    share[1] = hc_dot(direction, over) / volume;
    return share[0] >= 0.0 && share[1] >= 0.0 && share[0] + share[1] <= 1.0
               ? hc_dot(two, over) / volume
               : INFINITY;
}

/* Of the corners, or of the triangle. */
static void set_normal(double normal[3], const triangle *t, const double share[2])
{
    double one[3], two[3];
    for (int k = 0; k < 3; k++) {
        normal[k] = (1.0 - share[0] - share[1]) * (double)t->normal[0][k]
                    + share[0] * (double)t->normal[1][k] + share[1] * (double)t->normal[2][k];
    }
    if (!hc_unit(normal)) {
        hc_add_scaled(one, t->corner[1], -1.0, t->corner[0]);
        hc_add_scaled(two, t->corner[2], -1.0, t->corner[0]);
        hc_cross(normal, one, two);
        (void)hc_unit(normal);
    }
}

hc_body_hit hc_bodies_nearest(const hc_bodies *bodies, const double origin[3],
                              const double direction[3], double t_min, double t_max)
{
    const triangle *best = NULL;
    hc_body_hit     hit  = { .t = t_max };
    double          where[2];
    int             stack[DEPTH_MAX], waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
        const int   index = stack[--waiting];
        const node *n     = &bodies->nodes[index];
        if (!comes_to(n, origin, direction, t_min, hit.t)) {
            continue;
        }
        if (n->count == 0) {
            stack[waiting++] = n->first;
            stack[waiting++] = index + 1;
        }
        for (int i = n->first; i < n->first + n->count; i++) {
            double       share[2];
            const double t = meets(&bodies->triangles[i], origin, direction, share);
            if (t > t_min && t < hit.t) {
                hit.t = t;
                best  = &bodies->triangles[i];
                memcpy(where, share, sizeof where);
            }
        }
    }
    if (best == NULL) {
        return (hc_body_hit){ .t = INFINITY };
    }
    hit.object = best->object;
    set_normal(hit.normal, best, where);
    if (hc_dot(hit.normal, direction) > 0.0) {
        hc_add_scaled(hit.normal, hit.normal, -2.0, hit.normal);
    }
    return hit;
}

void hc_bodies_widen(double low[3], double high[3], const hc_bodies *bodies)
{
    for (int k = 0; k < 3; k++) {
        low[k]  = fmin(low[k], bodies->nodes[0].low[k]);
        high[k] = fmax(high[k], bodies->nodes[0].high[k]);
    }
}

/* ---- for shaders --------------------------------------------------------------------------- */

int hc_bodies_node_count(const hc_bodies *bodies)
{
    return bodies->node_count;
}

int hc_bodies_texel_count(const hc_bodies *bodies)
{
    return 2 * bodies->node_count + 3 * bodies->triangle_count;
}

/* Rounded to float, a triangle may stick out of its boxes. */
static void put_node(float texels[8], const node *n, const double anchor[3])
{
    for (int k = 0; k < 3; k++) {
        const double low   = n->low[k] - anchor[k];
        const double high  = n->high[k] - anchor[k];
        const double slack = 0x1p-20 * fmax(fabs(low), fabs(high));
        texels[k]          = (float)(low - slack);
        texels[4 + k]      = (float)(high + slack);
    }
    texels[3] = (float)n->first;
    texels[7] = (float)n->count;
}

void hc_bodies_texels(float *texels, const hc_bodies *bodies, const double anchor[3])
{
    for (int i = 0; i < bodies->node_count; i++, texels += 8) {
        put_node(texels, &bodies->nodes[i], anchor);
    }
    for (int i = 0; i < 3 * bodies->triangle_count; i++, texels += 4) {
        const double *corner = bodies->triangles[i / 3].corner[i % 3];
        for (int k = 0; k < 3; k++) {
            texels[k] = (float)(corner[k] - anchor[k]);
        }
        texels[3] = 0.0F;
    }
}

int hc_bodies_corner_count(const hc_bodies *bodies)
{
    return 3 * bodies->triangle_count;
}

void hc_bodies_corners(float *corners, const hc_bodies *bodies, const double anchor[3],
                       const float (*colours)[3])
{
    for (int i = 0; i < 3 * bodies->triangle_count; i++, corners += HC_CORNER_FLOATS) {
        static const double shares[3][2] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
        const triangle     *t            = &bodies->triangles[i / 3];
        double              normal[3];
        set_normal(normal, t, shares[i % 3]);
        for (int k = 0; k < 3; k++) {
            corners[k]     = (float)(t->corner[i % 3][k] - anchor[k]);
            corners[3 + k] = (float)normal[k];
            corners[6 + k] = colours[t->object][k];
        }
    }
}
