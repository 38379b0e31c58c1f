/* Relief on bodies against fine triangle meshes of the same surface, ray by ray. The mesh is built
 * from the bodies' formulas in render.h and knows nothing of how rays are bent. */
#include <heightcast/bake.h>
#include <heightcast/render.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 16, FINE = 10, WIDE = 24, HIGH = 18, TILES_U = 2, TILES_V = 1 };

enum { ACROSS = TILES_U * SIDE * FINE, DOWN = TILES_V * SIDE * FINE };

static const double PI = 3.14159265358979323846;

/* How far the mesh's flat faces and the bent ray's pieces are from the surface, together: of the
 * depth of 0.15 a patch's twist makes 1/400 at most, pieces 1/512; chords of a 320th of a turn lie
 * 0.00005 deep. */
static const double APART = 0.0012;

static double       eye[3]  = { -1.4, -2.2, 1.5 };
static const double PICTURE = 2.7; /* its width in the world */

static float    heights[SIDE * SIDE];
static float    cells[SIDE * SIDE * 4];
static float    ratios[SIDE * SIDE];
static hc_field field = { heights, SIDE, SIDE, .wrap = HC_WRAP_UV };

typedef struct mesh {
    double points[DOWN + 1][ACROSS + 1][3];
} mesh;

static int prepare(void **state)
{
    static float          cones[SIDE * SIDE * 4];
    const hc_cone_options quad   = { .cones = HC_CONES_QUAD };
    hc_result             result = hc_synth(heights, SIDE, SIDE, "cobbles", 2, NULL);
    (void)state;
    if (result == HC_OK) {
        result = hc_bake_cone_map(cones, &field, &quad, NULL);
        hc_bake_cell_ratios(cells, cones, SIDE, SIDE, HC_CONES_QUAD, HC_WRAP_UV);
    }
    return result == HC_OK && hc_bake_cone_map(ratios, &field, NULL, NULL) == HC_OK ? 0 : -1;
}

/* ---- the mesh -------------------------------------------------------------------------------- */

static void on_body(double p[3], hc_body body, double u, double v, double sunk)
{
    const double turn = 2.0 * PI * (u - 0.5);
    const double fall = PI * v;
    const double tube = PI - 2.0 * PI * v;
    double       flat = 0.6 - sunk; /* distance from the axis */
    p[2]              = 0.9 - 1.8 * v;
    if (body == HC_BODY_SPHERE) {
        flat = (1.0 - sunk) * sin(fall);
        p[2] = (1.0 - sunk) * cos(fall);
    } else if (body == HC_BODY_TORUS) {
        flat = 0.8 + (0.4 - sunk) * cos(tube);
        p[2] = (0.4 - sunk) * sin(tube);
    }
    p[0] = flat * cos(turn);
    p[1] = flat * sin(turn);
    if (body == HC_BODY_PLANE) {
        p[0] = 2.0 * u - 1.0;
        p[1] = 1.0 - 2.0 * v;
        p[2] = -sunk;
    }
}

static void build(mesh *m, hc_body body, double depth)
{
    for (int y = 0; y <= DOWN; y++) {
        for (int x = 0; x <= ACROSS; x++) {
            const double u = (double)x / ACROSS;
            const double v = (double)y / DOWN;
            const double h = hc_field_surface(&field, u * TILES_U, v * TILES_V);
            on_body(m->points[y][x], body, u, v, depth * (1.0 - h));
        }
    }
}

static void subtract(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] - b[i];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

/* Moeller and Trumbore. */
static double meet(const double origin[3], const double along[3], const double *a, const double *b,
                   const double *c)
{
    double e1[3], e2[3], p[3], q[3], s[3];
    subtract(e1, b, a);
    subtract(e2, c, a);
    cross(p, along, e2);
    const double det = dot(e1, p);
    if (fabs(det) < 1e-14) {
        return INFINITY;
    }
    subtract(s, origin, a);
    cross(q, s, e1);
    const double x = dot(s, p) / det;
    const double y = dot(along, q) / det;
    const double t = dot(e2, q) / det;
    return x >= 0.0 && y >= 0.0 && x + y <= 1.0 && t > 0.0 ? t : INFINITY;
}

static double nearest(const mesh *m, const double origin[3], const double along[3])
{
    double t = INFINITY;
    for (int y = 0; y < DOWN; y++) {
        for (int x = 0; x < ACROSS; x++) {
            const double *a = m->points[y][x], *b = m->points[y][x + 1];
            const double *c = m->points[y + 1][x], *d = m->points[y + 1][x + 1];
            t = fmin(t, fmin(meet(origin, along, a, b, c), meet(origin, along, b, d, c)));
        }
    }
    return t;
}

/* ---- the pictures ---------------------------------------------------------------------------- */

typedef struct view {
    double forward[3], right[3], up[3];
} view;

static view look(void)
{
    const double z[3] = { 0.0, 0.0, 1.0 };
    view         v;
    for (int i = 0; i < 3; i++) {
        v.forward[i] = -eye[i] / sqrt(dot(eye, eye));
    }
    cross(v.right, v.forward, z);
    const double length = sqrt(dot(v.right, v.right));
    for (int i = 0; i < 3; i++) {
        v.right[i] /= length;
    }
    cross(v.up, v.right, v.forward);
    return v;
}

/* Depth of the mesh at a point of the picture, moved by (dx, dy) in the world. */
static double mesh_depth(const mesh *m, const view *v, int pixel, double dx, double dy)
{
    const double x = PICTURE * ((pixel % WIDE + 0.5) / WIDE - 0.5) + dx;
    const double y = PICTURE / WIDE * (HIGH / 2.0 - pixel / WIDE - 0.5) + dy;
    double       origin[3];
    for (int i = 0; i < 3; i++) {
        origin[i] = eye[i] + x * v->right[i] + y * v->up[i];
    }
    return nearest(m, origin, v->forward);
}

/* A pixel agrees if its depth lies between those that the mesh has in a neighbourhood as wide as
 * the two surfaces may be apart. */
static bool agrees(const mesh *m, const view *v, int pixel, double depth)
{
    const double middle = mesh_depth(m, v, pixel, 0.0, 0.0);
    double       low    = middle;
    double       high   = middle;
    if (fabs(depth - middle) < APART || (isinf(depth) && isinf(middle))) {
        return true;
    }
    for (int i = 0; i < 8; i++) {
        const double turn = PI / 4.0 * i;
        const double near =
            mesh_depth(m, v, pixel, 1.5 * APART * cos(turn), 1.5 * APART * sin(turn));
        low  = fmin(low, near);
        high = fmax(high, near);
    }
    return depth >= low - APART && depth <= high + APART;
}

static int count_disagreeing(hc_body body, const hc_trace_options *trace)
{
    static mesh  m;
    static float rgb[WIDE * HIGH * 3], depth[WIDE * HIGH];
    const view   v       = look();
    hc_scene     scene   = { .relief = { .field  = field,
                                         .trace  = *trace,
                                         .body   = body,
                                         .depth  = 0.15F,
                                         .aspect = 1.0F,
                                         .edge   = HC_EDGE_DISCARD,
                                         .repeat = { TILES_U, TILES_V } } };
    hc_picture   picture = { .width = WIDE, .height = HIGH, .rgb = rgb, .depth = depth };
    int          odd     = 0;
    memcpy(scene.camera.eye, eye, sizeof eye);
    scene.camera.orthographic = (float)PICTURE;
    assert_int_equal(hc_render(&picture, &scene, NULL, NULL), HC_OK);
    build(&m, body, 0.15);
    for (int i = 0; i < WIDE * HIGH; i++) {
        odd += !agrees(&m, &v, i, (double)depth[i]);
    }
    return odd;
}

static const hc_trace_options safe = { .method = HC_TRACE_SAFE,
                                       .ratios = cells,
                                       .cones  = HC_CONES_QUAD };

static void a_sphere_is_its_mesh(void **state)
{
    (void)state;
    assert_int_equal(count_disagreeing(HC_BODY_SPHERE, &safe), 0);
}

static void a_torus_is_its_mesh(void **state)
{
    (void)state;
    assert_int_equal(count_disagreeing(HC_BODY_TORUS, &safe), 0);
    const hc_trace_options maxmip = { .method = HC_TRACE_MAXMIP };
    assert_int_equal(count_disagreeing(HC_BODY_TORUS, &maxmip), 0);
}

/* Level with the middle, where the ends are not seen: they are not in the mesh. */
static void a_cylinder_is_its_mesh(void **state)
{
    const double before = eye[2];
    (void)state;
    eye[2] = 0.0;
    assert_int_equal(count_disagreeing(HC_BODY_CYLINDER, &safe), 0);
    eye[2] = before;
}

/* The judge must be able to object. */
static void a_careless_method_is_not(void **state)
{
    (void)state;
    const hc_trace_options careless = { .method = HC_TRACE_CONE_FIXED,
                                        .ratios = ratios,
                                        .steps  = 2 };
    assert_true(count_disagreeing(HC_BODY_SPHERE, &careless) > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_is_its_mesh),
        cmocka_unit_test(a_cylinder_is_its_mesh),
        cmocka_unit_test(a_torus_is_its_mesh),
        cmocka_unit_test(a_careless_method_is_not),
    };
    return cmocka_run_group_tests_name("agree_render", tests, prepare, NULL);
}
