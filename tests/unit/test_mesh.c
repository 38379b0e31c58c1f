/* Meshes: bodies, and OBJ files as others write them. */
#include <heightcast/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ---- bodies ---------------------------------------------------------------------------------- */

static double volume_of(const hc_mesh *mesh)
{
    double sum = 0.0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        const float *p = mesh->vertices + (ptrdiff_t)3 * mesh->triangles[3 * i];
        const float *q = mesh->vertices + (ptrdiff_t)3 * mesh->triangles[3 * i + 1];
        const float *r = mesh->vertices + (ptrdiff_t)3 * mesh->triangles[3 * i + 2];
        for (int k = 0; k < 3; k++) {
            const int a = (k + 1) % 3;
            const int b = (k + 2) % 3;
            sum += (double)p[k] * ((double)q[a] * (double)r[b] - (double)q[b] * (double)r[a]) / 6.0;
        }
    }
    return sum;
}

/* Closed and facing outwards, or the sum would not be the volume. */
static void bodies_have_their_volumes(void **state)
{
    (void)state;
    const double pi        = 3.14159265358979323846;
    const double volumes[] = { pi / 6.0, 1.0, pi * 0.09 / 3.0, 0.7 * 0.6 + 0.7 * 0.4 / 2.0 };
    for (int i = 0; hc_solid_name((hc_solid)i) != NULL; i++) {
        hc_mesh *mesh = NULL;
        float    low = INFINITY, high = -INFINITY;
        assert_int_equal(hc_solid_create(&mesh, (hc_solid)i, NULL), HC_OK);
        assert_int_equal(hc_mesh_check(mesh, NULL), HC_OK);
        assert_true(fabs(volume_of(mesh) / volumes[i] - 1.0) < 0.03);
        for (int k = 0; k < mesh->vertex_count; k++) {
            low  = fminf(low, mesh->vertices[3 * k + 2]);
            high = fmaxf(high, mesh->vertices[3 * k + 2]);
        }
        assert_true(fabsf(low) < 1e-6F && fabsf(high - 1.0F) < 1e-6F);
        hc_mesh_destroy(mesh);
    }
    hc_mesh_destroy(NULL);
}

static void bad_meshes_are_told(void **state)
{
    (void)state;
    hc_log   log  = { .text = "" };
    hc_mesh *mesh = NULL;
    assert_int_equal(hc_mesh_create(&mesh, 0, 1, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "0 vertices"));
    assert_int_equal(hc_mesh_create(&mesh, 1, HC_MESH_MAX + 1, &log), HC_ERROR_ARGUMENT);
    assert_null(mesh);
    assert_int_equal(hc_solid_create(&mesh, HC_SOLID_BOX, &log), HC_OK);
    mesh->triangles[7] = 8;
    assert_int_equal(hc_mesh_check(mesh, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "triangle 2 of a mesh has vertex 8"));
    mesh->triangles[7] = 0;
    mesh->vertices[5]  = NAN;
    assert_int_equal(hc_mesh_check(mesh, &log), HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "vertex 1"));
    hc_mesh_destroy(mesh);
}

/* ---- files ----------------------------------------------------------------------------------- */

static hc_result load(hc_mesh **mesh, const char *text, hc_log *log)
{
    char  path[] = "/tmp/heightcast-mesh-XXXXXX";
    FILE *file   = fdopen(mkstemp(path), "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    const hc_result result = hc_load_mesh(mesh, path, NULL, log);
    (void)remove(path);
    return result;
}

static void files_are_read_as_they_are_written(void **state)
{
    (void)state;
    hc_log   log  = { .text = "" };
    hc_mesh *mesh = NULL;
    /* Comments, groups, normals, windows' lines, four corners, negative indices, no last
     * newline. */
    const char *text = "# a roof\r\nmtllib x.mtl\no roof\nv 0 0 0\nv 1 0 0 1.0\n\tv 1 1 0.5\n"
                       "v  0 1 5e-1 # last\nvn 0 0 1\nvt 0 0\ng a\nusemtl b\ns off\n"
                       "f 1/1/1 2//1 3/1 4\r\nl 1 2\nf -4 -2 -1";
    if (load(&mesh, text, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    const int32_t triangles[] = { 0, 1, 2, 0, 2, 3, 0, 2, 3 };
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->triangle_count, 3);
    assert_memory_equal(mesh->triangles, triangles, sizeof triangles);
    assert_true(mesh->vertices[8] == 0.5F && mesh->vertices[10] == 1.0F);
    assert_true(mesh->normals[0] == 0.0F);
    hc_mesh_destroy(mesh);
}

static void damaged_files_name_their_line(void **state)
{
    (void)state;
    const char *const bad[][2] = {
        { "v 0 0 0\nv 1 0\nf 1 1 1\n", "line 2: a vertex" },
        { "v 0 0 nan\n", "line 1: a vertex" },
        { "v 0 0 1e999\n", "line 1: a vertex" },
        { "v 0 0 0\nf 1 1\n", "line 2: a face has three" },
        { "v 0 0 0\nf 1 1 2\n", "line 2: a face is of" },
        { "v 0 0 0\nf 1 0 1\n", "line 2: a face is of" },
        { "v 0 0 0\nf 1 -2 1\n", "line 2: a face is of" },
        { "v 0 0 0\nf 1 99999999999999999999 1\n", "line 2: a face is of" },
        { "v 0 0 0\nf a b c\n", "line 2: a face is of" },
        { "v 0 0 0\n", "no face" },
        { "", "no face" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        hc_log   log  = { .text = "" };
        hc_mesh *mesh = NULL;
        assert_int_equal(load(&mesh, bad[i][0], &log), HC_ERROR_FORMAT);
        assert_null(mesh);
        if (strstr(log.text, bad[i][1]) == NULL) {
            fail_msg("'%s' does not say '%s'", log.text, bad[i][1]);
        }
    }
    hc_mesh *mesh = NULL;
    assert_int_equal(hc_load_mesh(&mesh, "/nowhere/x.obj", NULL, NULL), HC_ERROR_IO);
    assert_null(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_have_their_volumes),
        cmocka_unit_test(bad_meshes_are_told),
        cmocka_unit_test(files_are_read_as_they_are_written),
        cmocka_unit_test(damaged_files_name_their_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
