/* Triangle meshes: what stands on a terrain. They know nothing about heights.
 *
 * Axes are those of the world: x to the right, y away, z up. */
#ifndef HEIGHTCAST_MESH_H
#define HEIGHTCAST_MESH_H

#include <heightcast/result.h>

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Seen from both sides. */
typedef struct hc_mesh {
    float   *vertices;  /* vertex_count * 3: x, y, z                                          */
    float   *normals;   /* vertex_count * 3, unit; all zero: the triangles are flat           */
    int32_t *triangles; /* triangle_count * 3: indices of vertices                           */
    int      vertex_count, triangle_count;
} hc_mesh;

#define HC_MESH_MAX (1 << 26) /* vertices, and triangles */

/* A mesh with memory for so many [1 .. HC_MESH_MAX], zeroed, in one block. Destroy with
 * hc_mesh_destroy, which accepts NULL. HC_ERROR_ARGUMENT, HC_ERROR_MEMORY. */
HC_API hc_result hc_mesh_create(hc_mesh **mesh, int vertex_count, int triangle_count, hc_log *log);
HC_API void      hc_mesh_destroy(hc_mesh *mesh);

/* Finite vertices, indices in range: HC_ERROR_ARGUMENT names the first culprit. */
HC_API hc_result hc_mesh_check(const hc_mesh *mesh, hc_log *log);

/* Bodies that stand on z = 0 around the z axis, 1 high.
 * ball   of diameter 1
 * box    of side 1
 * cone   on a circle of diameter 0.6
 * house  1 long along x, 0.7 wide, with a gable roof above 0.6 */
typedef enum hc_solid { HC_SOLID_BALL = 0, HC_SOLID_BOX, HC_SOLID_CONE, HC_SOLID_HOUSE } hc_solid;
HC_API const char *hc_solid_name(hc_solid solid); /* as above; NULL beyond the last. Static */

/* hc_mesh_create, filled with a body. */
HC_API hc_result hc_solid_create(hc_mesh **mesh, hc_solid solid, hc_log *log);

#ifdef __cplusplus
}
#endif

#endif
