/* Cone ratios over all pairs of samples and all images: docs/algorithms.md, sections 2 and 5. */
#include "reference.h"

#include <math.h>

const double hc_ref_elongation[HC_REF_ELONGATIONS] = { 0.25, 0.5, 1.0, 2.0, 4.0 };

/* Whether a quadrant (1 .. 4, or 0 for all) holds what lies `columns` right and `rows` below. */
static bool holds(int quadrant, double columns, double rows)
{
    switch (quadrant) {
    case 1: return columns >= 0.0 && rows >= 0.0;
    case 2: return columns <= 0.0 && rows >= 0.0;
    case 3: return columns >= 0.0 && rows <= 0.0;
    case 4: return columns <= 0.0 && rows <= 0.0;
    default: return true;
    }
}

double hc_ref_length(const hc_field *field, const hc_ref_cone *cone, double columns, double rows)
{
    const double du         = columns * hc_field_step_u(field);
    const double dv         = rows * hc_field_step_v(field);
    const double elongation = cone->elongation > 0.0 ? cone->elongation : 1.0;
    if (!holds(cone->quadrant, columns, rows)) {
        return INFINITY;
    }
    if (cone->metric == HC_REF_ROUND) {
        return sqrt(du * du + dv * dv);
    }
    return fabs(du) * elongation + fabs(dv) / elongation;
}

double hc_ref_distance(const hc_field *field, const hc_ref_cone *cone, int px, int py, int qx,
                       int qy)
{
    const int images_u = (field->wrap & HC_WRAP_U) != 0 ? 1 : 0;
    const int images_v = (field->wrap & HC_WRAP_V) != 0 ? 1 : 0;
    double    nearest  = INFINITY;
    for (int image_v = -images_v; image_v <= images_v; image_v++) {
        for (int image_u = -images_u; image_u <= images_u; image_u++) {
            const int columns = qx + image_u * field->width - px;
            const int rows    = qy + image_v * field->height - py;
            nearest           = fmin(nearest, hc_ref_length(field, cone, columns, rows));
        }
    }
    return nearest;
}

double hc_ref_ratio(const hc_field *field, const hc_ref_cone *cone, int x, int y)
{
    const double apex  = (double)field->heights[(size_t)y * (size_t)field->width + (size_t)x];
    double       ratio = INFINITY;
    for (int qy = 0; qy < field->height; qy++) {
        for (int qx = 0; qx < field->width; qx++) {
            const size_t q    = (size_t)qy * (size_t)field->width + (size_t)qx;
            const double rise = (double)field->heights[q] - apex;
            if (rise > 0.0) {
                ratio = fmin(ratio, hc_ref_distance(field, cone, x, y, qx, qy) / rise);
            }
        }
    }
    return ratio;
}

int hc_ref_best_elongation(const double ratios[HC_REF_ELONGATIONS])
{
    int    best       = 0;
    double best_slope = INFINITY;
    for (int i = 0; i < HC_REF_ELONGATIONS; i++) {
        const double slope_u = 1.0 / ratios[i] * hc_ref_elongation[i];
        const double slope_v = 1.0 / ratios[i] / hc_ref_elongation[i];
        if (slope_u + slope_v < best_slope) {
            best_slope = slope_u + slope_v;
            best       = i;
        }
    }
    return best;
}
