/* Triangles in a landscape, and rays against them. */
#ifndef HC_RENDER_BODIES_H
#define HC_RENDER_BODIES_H

#include <heightcast/terrain.h>

typedef struct hc_bodies hc_bodies;

/* What a ray comes to. */
typedef struct hc_body_hit {
    double t;         /* along the ray; INFINITY: nothing */
    double normal[3]; /* unit, towards the ray    */
    int    object;
} hc_body_hit;

/* The triangles of all objects, in the world. places: of their origins; meshes were checked.
 * Destroy with hc_bodies_destroy, which accepts NULL. */
hc_result hc_bodies_create(hc_bodies **bodies, const hc_object *objects, const double (*places)[3],
                           int count, hc_log *log);
void      hc_bodies_destroy(hc_bodies *bodies);

/* Make a box hold them. */
void hc_bodies_widen(double low[3], double high[3], const hc_bodies *bodies);

/* The tree and its triangles as shaders/terrain.frag reads them, from `anchor`; the texels' number,
 * and that of the nodes. */
int  hc_bodies_node_count(const hc_bodies *bodies);
int  hc_bodies_texel_count(const hc_bodies *bodies);
void hc_bodies_texels(float *texels, const hc_bodies *bodies, const double anchor[3]);

/* Three corners of each triangle, as shaders/bodies.vert takes them: place from `anchor`, normal,
 * colour. */
enum { HC_CORNER_FLOATS = 9 };
int  hc_bodies_corner_count(const hc_bodies *bodies);
void hc_bodies_corners(float *corners, const hc_bodies *bodies, const double anchor[3],
                       const float (*colours)[3]);

/* The first triangle of origin + t * direction, t_min < t < t_max. */
hc_body_hit hc_bodies_nearest(const hc_bodies *bodies, const double origin[3],
                              const double direction[3], double t_min, double t_max);

#endif
