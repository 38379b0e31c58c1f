#include <heightcast/mesh.h>

#include "fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static hc_result check_count(const char *what, int count, hc_log *log)
{
    return count >= 1 && count <= HC_MESH_MAX
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "a mesh has %d %s; it must have 1 .. %d", count,
                         what, HC_MESH_MAX);
}

hc_result hc_mesh_create(hc_mesh **mesh, int vertex_count, int triangle_count, hc_log *log)
{
    hc_result result = check_count("vertices", vertex_count, log);
    result           = result != HC_OK ? result : check_count("triangles", triangle_count, log);
    *mesh            = NULL;
    if (result != HC_OK) {
        return result;
    }
    const size_t vertices  = (size_t)vertex_count * 3;
    const size_t triangles = (size_t)triangle_count * 3;
    hc_mesh     *made      = calloc(1, sizeof *made + (2 * vertices + triangles) * 4);
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a mesh of %d triangles",
                       triangle_count);
    }
    made->vertices       = (float *)(made + 1);
    made->normals        = made->vertices + vertices;
    made->triangles      = (int32_t *)(made->normals + vertices);
    made->vertex_count   = vertex_count;
    made->triangle_count = triangle_count;
    *mesh                = made;
    return HC_OK;
}

void hc_mesh_destroy(hc_mesh *mesh)
{
    free(mesh);
}

hc_result hc_mesh_check(const hc_mesh *mesh, hc_log *log)
{
    hc_result result = check_count("vertices", mesh->vertex_count, log);
    result = result != HC_OK ? result : check_count("triangles", mesh->triangle_count, log);
    if (result != HC_OK) {
        return result;
    }
    for (size_t i = 0; i < (size_t)mesh->vertex_count * 3; i++) {
        if (!isfinite(mesh->vertices[i]) || !isfinite(mesh->normals[i])) {
            return hc_fail(log, HC_ERROR_ARGUMENT, "vertex %zu of a mesh is not finite", i / 3);
        }
    }
    for (size_t i = 0; i < (size_t)mesh->triangle_count * 3; i++) {
        if (mesh->triangles[i] < 0 || mesh->triangles[i] >= mesh->vertex_count) {
            return hc_fail(log, HC_ERROR_ARGUMENT,
                           "triangle %zu of a mesh has vertex %d; there are %d", i / 3,
                           mesh->triangles[i], mesh->vertex_count);
        }
    }
    return HC_OK;
}
