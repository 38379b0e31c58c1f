/* Unit normals at hits. */
#include "surface.h"

#include <math.h>

/* A vector in cells and heights -> the ray's space, as normals go, at unit length. */
static void set_normal(const hc_tracer *tracer, float normal[3], double x, double y, double z)
{
    const double a      = x * tracer->axes[0].scale / tracer->axes[0].unit;
    const double b      = y * tracer->axes[1].scale / tracer->axes[1].unit;
    const double c      = z / tracer->height_scale;
    const double length = sqrt(a * a + b * b + c * c);
    normal[0]           = (float)(a / length);
    normal[1]           = (float)(b / length);
    normal[2]           = (float)(c / length);
}

/* Where the hit is, in cells of the first period. */
static double place_of(const hc_axis *axis, float coordinate)
{
    const double u =
        axis->wraps ? (double)coordinate - floor((double)coordinate) : (double)coordinate;
    return u * axis->steps - axis->zero;
}

/* The wall the hit is on is the one it is nearest to: of the field, or of the top. */
static void wall_normal(const hc_tracer *tracer, float normal[3], const double place[2],
                        const int32_t cell[2])
{
    double nearest = INFINITY;
    double out[2]  = { 0.0, 0.0 };
    for (int i = 0; i < 4; i++) {
        const int      k     = i / 2;
        const hc_axis *axis  = &tracer->axes[k];
        const double   first = tracer->tops ? fmax(cell[k], axis->low) : axis->low;
        const double   last  = tracer->tops ? fmin(cell[k] + 1, axis->high) : axis->high;
        const double   away  = fabs(place[k] - (i % 2 == 0 ? first : last));
        if (away < nearest) {
            nearest    = away;
            out[k]     = i % 2 == 0 ? -1.0 : 1.0;
            out[1 - k] = 0.0;
        }
    }
    set_normal(tracer, normal, out[0], out[1], 0.0);
}

static void patch_normal(const hc_tracer *tracer, float normal[3], const double place[2],
                         const int32_t cell[2])
{
    const hc_path  still = { .along = { 1.0, 1.0, 0.0 } };
    const int      at[2] = { cell[0], cell[1] };
    const hc_patch patch = hc_patch_of(tracer, &still, at);
    const double   x     = place[0] - patch.x;
    const double   y     = place[1] - patch.y;
    set_normal(tracer, normal, -(patch.slope_x + y * patch.twist),
               -(patch.slope_y + x * patch.twist), 1.0);
}

/* Slope per sample at a sample: central, one-sided at an unwrapped border. */
static double slope_at(const hc_tracer *tracer, int x, int y, int axis)
{
    const hc_axis *a     = &tracer->axes[axis];
    const int      here  = axis == 0 ? x : y;
    const int      back  = a->wraps || here > 0 ? 1 : 0;
    const int      ahead = a->wraps || here < a->size - 1 ? 1 : 0;
    if (back + ahead == 0 || a->size == 1) {
        return 0.0;
    }
    const double low =
        axis == 0 ? hc_tracer_sample(tracer, x - back, y) : hc_tracer_sample(tracer, x, y - back);
    const double high =
        axis == 0 ? hc_tracer_sample(tracer, x + ahead, y) : hc_tracer_sample(tracer, x, y + ahead);
    return (high - low) / (back + ahead);
}

static double mixed_slope(const hc_tracer *tracer, const double place[2], int axis)
{
    double low[2], weight[2];
    for (int i = 0; i < 2; i++) {
        low[i]    = floor(place[i]);
        weight[i] = place[i] - low[i];
    }
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        const int    x = hc_axis_index(&tracer->axes[0], (int)low[0] + i % 2);
        const int    y = hc_axis_index(&tracer->axes[1], (int)low[1] + i / 2);
        const double share =
            (i % 2 == 1 ? weight[0] : 1.0 - weight[0]) * (i / 2 == 1 ? weight[1] : 1.0 - weight[1]);
        sum += share * slope_at(tracer, x, y, axis);
    }
    return sum;
}

void hc_trace_normals(const hc_tracer *tracer, float geometric[3], float smooth[3],
                      const hc_hit *hit)
{
    const float   coordinate[2] = { hit->u, hit->v };
    const int32_t cell[2]       = { hit->cell_x, hit->cell_y };
    double        place[2];
    for (int i = 0; i < 2; i++) {
        const hc_axis *axis = &tracer->axes[i];
        place[i]            = place_of(axis, coordinate[i]);
        if (axis->wraps && place[i] < cell[i]) {
            place[i] += axis->size; /* the last cell lies across the seam */
        }
    }
    if (geometric != NULL && (hit->flags & HC_HIT_SIDE) != 0) {
        wall_normal(tracer, geometric, place, cell);
    } else if (geometric != NULL) {
        patch_normal(tracer, geometric, place, cell);
    }
    if (smooth != NULL) {
        /* Samples sit in the middle of tops. */
        const double half       = tracer->tops ? 0.5 : 0.0;
        const double between[2] = { place[0] - half, place[1] - half };
        set_normal(tracer, smooth, -mixed_slope(tracer, between, 0),
                   -mixed_slope(tracer, between, 1), 1.0);
    }
}
