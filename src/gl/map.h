/* Maps that a GPU baked and keeps, as those who draw them see them. */
#ifndef HC_GL_MAP_H
#define HC_GL_MAP_H

#include "context.h"

#include <heightcast/maps.h>

struct hc_gpu_map {
    const hc_gl_context *context;
    hc_field             field;   /* heights are a copy of what the texture holds */
    unsigned             heights; /* a texture of one float                       */
    unsigned             ratios;  /* of one float (l1, l2) or four                */
    hc_cones             cones;
    bool                 cells;   /* ratios are those of cells */
    bool                 relaxed; /* by gems or falling-edge   */
};

#endif
