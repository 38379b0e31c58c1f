/* The ground's triangles, for hc_bands: ground.vert draws them, terrain.frag lights them. */
#ifndef HC_RENDER_GL_POLYGONS_H
#define HC_RENDER_GL_POLYGONS_H

#include "../terrain/blocks.h"
#include "../terrain/terrain.h"

typedef struct hc_gl_polygons {
    hc_blocks       blocks;
    hc_block_place *places;
    int             counts[HC_BLOCK_LEVELS];     /* blocks of each level                     */
    int             firsts[HC_BLOCK_LEVELS + 1]; /* of a level's corners among all of them   */
    unsigned        array, corners, instances;   /* corners: of triangles, as vertices       */
} hc_gl_polygons;

/* In a context that is current; hc_polygons_free must follow in it, whatever the result. */
hc_result hc_polygons_make(hc_gl_polygons *polygons, const hc_terrain *terrain, hc_log *log);
void      hc_polygons_free(hc_gl_polygons *polygons);

/* Choose what of them `eye` sees. */
void hc_polygons_aim(hc_gl_polygons *polygons, const hc_terrain *terrain, const hc_eye *eye);

/* Draw it with the program in use. */
void hc_polygons_draw(const hc_gl_polygons *polygons);

#endif
