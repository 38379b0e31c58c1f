/* Relaxed round cones, which let rays into the surface but not out of it again:
 * docs/algorithms.md, section 12. */
#include "reference.h"

#include <math.h>

static int wrapped(int sample, int size, bool wraps)
{
    if (wraps) {
        return (sample % size + size) % size;
    }
    return sample < 0 ? 0 : sample > size - 1 ? size - 1 : sample;
}

/* Sample of any period, or of the border that goes on outside. */
static double height_at(const hc_field *field, int x, int y)
{
    const int column = wrapped(x, field->width, (field->wrap & HC_WRAP_U) != 0);
    const int row    = wrapped(y, field->height, (field->wrap & HC_WRAP_V) != 0);
    return (double)field->heights[row * field->width + column];
}

/* Whether the surface falls along an edge of the cell that starts at (x, y) and lies outwards of
 * it. */
static bool falls_outwards(const hc_field *field, int x, int y, int out_u, int out_v)
{
    const double h00 = height_at(field, x, y);
    const double h10 = height_at(field, x + out_u, y);
    const double h01 = height_at(field, x, y + out_v);
    const double h11 = height_at(field, x + out_u, y + out_v);
    return h00 > h10 || h00 > h01 || h10 > h11 || h01 > h11;
}

/* The samples of one quadrant as seen from (px, py), every image that lies in it. */
static double quadrant_ratio(const hc_field *field, int px, int py, int out_u, int out_v)
{
    const int reach_u = (field->wrap & HC_WRAP_U) != 0 ? field->width : 0;
    const int reach_v = (field->wrap & HC_WRAP_V) != 0 ? field->height : 0;
    double    ratio   = INFINITY;
    for (int y = -reach_v; y < field->height + reach_v; y++) {
        for (int x = -reach_u; x < field->width + reach_u; x++) {
            const double rise = height_at(field, x, y) - height_at(field, px, py);
            if (rise > 0.0 && (x - px) * out_u >= 0 && (y - py) * out_v >= 0
                && falls_outwards(field, x, y, out_u, out_v)) {
                const double du = (x - px) * hc_field_step_u(field);
                const double dv = (y - py) * hc_field_step_v(field);
                ratio           = fmin(ratio, sqrt(du * du + dv * dv) / rise);
            }
        }
    }
    return ratio;
}

double hc_ref_falling_edge_ratio(const hc_field *field, int x, int y)
{
    const double below =
        fmin(quadrant_ratio(field, x, y, 1, 1), quadrant_ratio(field, x, y, -1, 1));
    const double above =
        fmin(quadrant_ratio(field, x, y, 1, -1), quadrant_ratio(field, x, y, -1, -1));
    return fmin(below, above);
}

/* Samples from p to the nearest image of q along one axis; rightwards or downwards if two are. */
static int towards(int p, int q, int size, bool wraps)
{
    const int apart = q - p;
    if (!wraps) {
        return apart;
    }
    const int ahead = apart < 0 ? apart + size : apart;
    return 2 * ahead <= size ? ahead : ahead - size;
}

/* Height of the surface `columns` right of and `rows` below the sample (px, py). */
static double surface_beyond(const hc_field *field, int px, int py, double columns, double rows)
{
    const double first = field->registration == HC_GRID ? 0.0 : 0.5;
    return hc_ref_surface(field, (px + columns + first) * hc_field_step_u(field),
                          (py + rows + first) * hc_field_step_v(field));
}

/* The ray from height 1 above p through the top of q, on to height 0 in equal steps: where it is
 * first above the surface again it limits the cone, if that is above p. */
static double ray_ratio(const hc_field *field, int steps, double leniency, int px, int py,
                        int columns, int rows)
{
    const hc_ref_cone round    = { .metric = HC_REF_ROUND };
    const double      apex     = height_at(field, px, py);
    const double      entry    = height_at(field, px + columns, py + rows);
    const double      distance = hc_ref_length(field, &round, columns, rows);
    if (entry >= 1.0) {
        return distance / (1.0 - apex);
    }
    for (int step = 1; step <= steps; step++) {
        const double height = entry * (steps - step) / steps;
        const double way    = (1.0 - height) / (1.0 - entry);
        const double rise   = height + leniency - apex;
        if (rise <= 0.0) {
            break;
        }
        if (surface_beyond(field, px, py, columns * way, rows * way) < height + leniency) {
            return distance * way / rise;
        }
    }
    return INFINITY;
}

double hc_ref_gems_ratio(const hc_field *field, int steps, double leniency, int x, int y)
{
    double ratio = INFINITY;
    for (int qy = 0; qy < field->height; qy++) {
        for (int qx = 0; qx < field->width; qx++) {
            if (height_at(field, qx, qy) > height_at(field, x, y)) {
                const int columns = towards(x, qx, field->width, (field->wrap & HC_WRAP_U) != 0);
                const int rows    = towards(y, qy, field->height, (field->wrap & HC_WRAP_V) != 0);
                ratio = fmin(ratio, ray_ratio(field, steps, leniency, x, y, columns, rows));
            }
        }
    }
    return ratio;
}
