/* Nodes of the pyramid of bounds. */
#ifndef HC_TRACE_NODES_H
#define HC_TRACE_NODES_H

#include "cursor.h"

typedef struct hc_node {
    int    low[2], high[2]; /* cells low .. high - 1 */
    double bound;
} hc_node;

/* The node's index on its level, and its cells. Above single cells the first and the last one of an
 * unwrapped axis have what lies at the border, too. */
static inline int hc_node_span(const hc_axis *axis, int cell, int level, int level_side, int *low,
                               int *high)
{
    const int index = hc_axis_index(axis, cell);
    const int which = index >> level < level_side ? index >> level : level_side - 1;
    const int base  = cell - index; /* of the period, where there are some */
    *low            = base + (which << level);
    *high           = base + (which < level_side - 1 ? (which + 1) << level : axis->size);
    if (level == 0) {
        *low  = cell;
        *high = cell + 1;
    } else if (!axis->wraps) {
        *low  = which == 0 ? -2 : which << level;
        *high = which < level_side - 1 ? (which + 1) << level : axis->size + 1;
    }
    return which;
}

static inline hc_node hc_node_of(const hc_tracer *tracer, const int cell[2], int level)
{
    int          wide, high;
    const float *values = hc_pyramid_level(&tracer->bounds, level, &wide, &high);
    hc_node      n;
    const int    x = hc_node_span(&tracer->axes[0], cell[0], level, wide, &n.low[0], &n.high[0]);
    const int    y = hc_node_span(&tracer->axes[1], cell[1], level, high, &n.low[1], &n.high[1]);
    n.bound        = (double)values[(size_t)y * (size_t)wide + (size_t)x];
    return n;
}

/* When the ray comes to the wall it goes to; never before s. */
static inline double hc_node_wall(const hc_node *node, const hc_path *path, int axis, double s)
{
    const int wall = path->along[axis] > 0.0 ? node->high[axis] : node->low[axis];
    return fmax(hc_path_reaches(path, axis, wall), s);
}

#endif
