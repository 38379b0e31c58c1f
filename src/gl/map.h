/* What bakes on a GPU, and maps that it keeps, as those who draw see them. */
#ifndef HC_GL_MAP_H
#define HC_GL_MAP_H

#include "context.h"

#include <heightcast/maps.h>

struct hc_gpu;

struct hc_gpu_map {
    hc_gl_context *context;
    hc_field       field;   /* heights are a copy of what the texture holds */
    unsigned       heights; /* a texture of one float                       */
    unsigned       ratios;  /* of one float (l1, l2) or four                */
    hc_cones       cones;
    bool           cells;   /* ratios are those of cells */
    bool           relaxed; /* by gems or falling-edge   */
};

/* A struct hc_gpu begins with its context. */
static inline hc_gl_context *hc_gl_context_of(struct hc_gpu *gpu)
{
    return (hc_gl_context *)gpu;
}

#endif
