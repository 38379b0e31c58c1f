/* The bilinear surface, and the diamond cones it leaves free: docs/algorithms.md, section 4. */
#include "reference.h"

#include <math.h>

/* One axis of a field. Positions on it count in samples, sample 0 at 0. */
typedef struct axis {
    int    size;
    double step;
    bool   wraps;
    double first; /* texture coordinate of sample 0 */
} axis;

static axis axis_of(const hc_field *field, bool vertical)
{
    axis a  = { .size = vertical ? field->height : field->width };
    a.step  = vertical ? hc_field_step_v(field) : hc_field_step_u(field);
    a.wraps = (field->wrap & (vertical ? HC_WRAP_V : HC_WRAP_U)) != 0;
    a.first = field->registration == HC_GRID ? 0.0 : a.step / 2.0;
    return a;
}

/* Texture coordinate -> samples: 0 <= result < size where the axis wraps, 0 <= result <= size - 1
 * elsewhere. */
static double place(const axis *a, double coordinate)
{
    const double position = (coordinate - a->first) / a->step;
    if (!a->wraps) {
        return fmin(fmax(position, 0.0), a->size - 1);
    }
    const double rest = position - floor(position / a->size) * a->size;
    return rest < a->size ? rest : 0.0;
}

static int wrapped(const axis *a, int sample)
{
    if (a->wraps) {
        return (sample % a->size + a->size) % a->size;
    }
    return sample < 0 ? 0 : sample > a->size - 1 ? a->size - 1 : sample;
}

/* Height at a position in samples, which may lie in any period. */
static double height_at(const hc_field *field, const axis *u, const axis *v, double x, double y)
{
    const int    left   = wrapped(u, (int)floor(x));
    const int    right  = wrapped(u, (int)floor(x) + 1);
    const int    top    = wrapped(v, (int)floor(y));
    const int    bottom = wrapped(v, (int)floor(y) + 1);
    const double s      = x - floor(x);
    const double t      = y - floor(y);
    const float *h      = field->heights;
    const double upper  = (1.0 - s) * (double)h[top * field->width + left]
                         + s * (double)h[top * field->width + right];
    const double lower = (1.0 - s) * (double)h[bottom * field->width + left]
                         + s * (double)h[bottom * field->width + right];
    return (1.0 - t) * upper + t * lower;
}

double hc_ref_surface(const hc_field *field, double u, double v)
{
    const axis axis_u = axis_of(field, false);
    const axis axis_v = axis_of(field, true);
    return height_at(field, &axis_u, &axis_v, place(&axis_u, u), place(&axis_v, v));
}

void hc_ref_cell_at(const hc_field *field, double u, double v, int *x, int *y)
{
    const axis axis_u = axis_of(field, false);
    const axis axis_v = axis_of(field, true);
    *x                = (int)floor(place(&axis_u, u));
    *y                = (int)floor(place(&axis_v, v));
}

static bool holds(int quadrant, double columns, double rows)
{
    const bool left  = quadrant == 2 || quadrant == 4;
    const bool above = quadrant == 3 || quadrant == 4;
    return quadrant == 0
           || ((left ? columns <= 0.0 : columns >= 0.0) && (above ? rows <= 0.0 : rows >= 0.0));
}

/* The candidates along one axis: every sample of three periods (one where the axis does not wrap),
 * and the apex's own coordinate as the last. */
static int candidates(const axis *a)
{
    return (a->wraps ? 3 * a->size : a->size) + 1;
}

static double candidate(const axis *a, int index, double apex)
{
    if (index == candidates(a) - 1) {
        return apex;
    }
    return a->wraps ? index - a->size : index;
}

double hc_ref_surface_excess(const hc_field *field, int quadrant, double slope_u, double slope_v,
                             double u, double v)
{
    const axis   axis_u = axis_of(field, false);
    const axis   axis_v = axis_of(field, true);
    const double x      = place(&axis_u, u);
    const double y      = place(&axis_v, v);
    const double apex   = height_at(field, &axis_u, &axis_v, x, y);
    double       excess = 0.0;
    for (int j = 0; j < candidates(&axis_v); j++) {
        for (int i = 0; i < candidates(&axis_u); i++) {
            const double cx = candidate(&axis_u, i, x);
            const double cy = candidate(&axis_v, j, y);
            if (holds(quadrant, cx - x, cy - y)) {
                const double rise   = height_at(field, &axis_u, &axis_v, cx, cy) - apex;
                const double cone_u = slope_u * fabs(cx - x) * axis_u.step;
                const double cone_v = slope_v * fabs(cy - y) * axis_v.step;
                excess              = fmax(excess, rise - cone_u - cone_v);
            }
        }
    }
    return excess;
}
