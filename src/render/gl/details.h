/* Details of a terrain, for detail.glsl. */
#ifndef HC_RENDER_GL_DETAILS_H
#define HC_RENDER_GL_DETAILS_H

#include "../terrain/terrain.h"

/* Textures: of the mask, of all maps beside each other, and of their tops. */
enum { HC_DETAIL_UNITS = 3 };

/* Load them, to units from `unit` on. */
hc_result hc_details_upload(unsigned textures[HC_DETAIL_UNITS], int unit, const hc_terrain *terrain,
                            hc_log *log);
/* Of the program in use. */
void hc_details_set_uniforms(unsigned program, int unit, const hc_terrain *terrain);

#endif
