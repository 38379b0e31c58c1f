/* Bilinear patches and flat tops; the patch meets a ray in a quadratic.
 * Source: WSCG 2009, section 4; the last term of its printed formula should be u v z11. */
#include "surface.h"

#include "cursor.h"

#include <math.h>

static hc_patch top_of(const hc_tracer *tracer, const hc_path *path, const int cell[2])
{
    const int back_x = hc_path_on_wall(path, 0) ? 1 : 0;
    const int back_y = hc_path_on_wall(path, 1) ? 1 : 0;
    double    top    = 0.0;
    for (int y = cell[1] - back_y; y <= cell[1]; y++) {
        for (int x = cell[0] - back_x; x <= cell[0]; x++) {
            top = fmax(top, hc_tracer_sample(tracer, x, y));
        }
    }
    return (hc_patch){ .base = top, .x = cell[0], .y = cell[1] };
}

hc_patch hc_patch_of(const hc_tracer *tracer, const hc_path *path, const int cell[2])
{
    if (tracer->tops) {
        return top_of(tracer, path, cell);
    }
    const double h00 = hc_tracer_sample(tracer, cell[0], cell[1]);
    const double h10 = hc_tracer_sample(tracer, cell[0] + 1, cell[1]);
    const double h01 = hc_tracer_sample(tracer, cell[0], cell[1] + 1);
    const double h11 = hc_tracer_sample(tracer, cell[0] + 1, cell[1] + 1);
    return (hc_patch){ h00, h10 - h00, h01 - h00, h11 - h10 - h01 + h00, cell[0], cell[1] };
}

double hc_patch_height(const hc_patch *patch, double x, double y)
{
    const double a = x - patch->x;
    const double b = y - patch->y;
    return patch->base + a * patch->slope_x + b * patch->slope_y + a * b * patch->twist;
}

hc_gap hc_gap_of(const hc_patch *patch, const hc_path *path, double from)
{
    const double dx   = path->along[0];
    const double dy   = path->along[1];
    const double x    = path->place[0] + from * dx;
    const double y    = path->place[1] + from * dy;
    const double z    = path->place[2] + from * path->along[2];
    const double turn = patch->twist * ((x - patch->x) * dy + (y - patch->y) * dx);
    return (hc_gap){ z - hc_patch_height(patch, x, y),
                     path->along[2] - (patch->slope_x * dx + patch->slope_y * dy + turn),
                     -(patch->twist * dx * dy) };
}

static double gap_at(const hc_gap *gap, double r)
{
    return gap->value + r * (gap->slope + r * gap->bend);
}

/* The first root of a quadratic that is positive at 0, by the formula that adds what the other one
 * would cancel. */
static double first_root(const hc_gap *gap)
{
    const double square = gap->slope * gap->slope - 4.0 * gap->value * gap->bend;
    if (!(square >= 0.0)) {
        return INFINITY;
    }
    if (gap->slope < 0.0) {
        return 2.0 * gap->value / (sqrt(square) - gap->slope);
    }
    return gap->bend < 0.0 ? (gap->slope + sqrt(square)) / (-2.0 * gap->bend) : INFINITY;
}

double hc_gap_contact(const hc_gap *gap, double length)
{
    if (gap_at(gap, length) <= 0.0) {
        /* The sign has changed, so there is a contact, whatever rounding makes of the root. */
        return fmin(first_root(gap), length);
    }
    if (!(gap->bend > 0.0)) {
        return INFINITY; /* above at both ends, and nowhere lower than on the line between */
    }
    const double root = first_root(gap);
    return root <= length ? root : INFINITY;
}

double hc_gap_return(const hc_gap *gap, double length, bool *below)
{
    const hc_gap under = { -gap->value, -gap->slope, -gap->bend };
    const double up    = gap->value < 0.0 ? hc_gap_contact(&under, length) : 0.0;
    const double slope = gap->slope + 2.0 * up * gap->bend;
    if (up <= length && slope > 0.0 && gap->bend < 0.0 && up - slope / gap->bend <= length) {
        *below = false;
        return up - slope / gap->bend;
    }
    *below = !(gap_at(gap, length) > 0.0);
    return INFINITY;
}

double hc_surface_at(const hc_tracer *tracer, double x, double y)
{
    const hc_path still    = { .along = { 1.0, 1.0, 0.0 } }; /* no face to run along */
    double        place[2] = { x, y };
    int           cell[2];
    for (int i = 0; i < 2; i++) {
        const hc_axis *axis = &tracer->axes[i];
        place[i]            = fmin(fmax(place[i], axis->low), axis->high);
        cell[i]             = (int)floor(place[i]);
    }
    const hc_patch patch = hc_patch_of(tracer, &still, cell);
    return hc_patch_height(&patch, place[0], place[1]);
}
