/* Rays to the box of the field, in cells; and what is decided there: inside, side walls, open
 * sides.
 *
 * A ray is moved to the box in several strides, each of which leaves an error of 2^-53 of its
 * length: after the last one the ray is as exact as if it had begun at the box, however far its
 * origin is (docs/algorithms.md, section 19). */
#include "cursor.h"
#include "surface.h"

#include <math.h>

enum { STRIDES = 4, NOTHING = 3 };

/* Below the surface whatever the heights are, with room for rounding. */
static const double DEEP = -1.0;

void hc_axis_make(hc_axis *axis, const hc_field *field, const hc_trace_options *options, bool tops,
                  bool vertical)
{
    const hc_placement *where  = &options->placement;
    const bool          placed = where->scale_z != 0.0;
    const double        step   = vertical ? hc_field_step_v(field) : hc_field_step_u(field);
    const double        margin = field->registration == HC_GRID ? 0.0 : 0.5; /* before sample 0 */
    const double        shift  = tops ? 0.5 : 0.0;
    const double        steps  = floor(1.0 / step + 0.5);
    *axis        = (hc_axis){ .size = vertical ? field->height : field->width, .steps = steps };
    axis->wraps  = ((unsigned)field->wrap & (vertical ? HC_WRAP_V : HC_WRAP_U)) != 0;
    axis->zero   = margin - shift;
    axis->offset = placed ? where->offset[vertical ? 1 : 0] : 0.0;
    axis->scale  = placed ? 1.0 : steps;
    axis->unit   = !placed ? 1.0 : vertical ? where->spacing_y : where->spacing_x;
    axis->first  = placed ? -shift : axis->zero;
    axis->period = fabs(axis->size * axis->unit / axis->scale);
    axis->low    = axis->wraps ? -INFINITY : -axis->zero;
    axis->high   = axis->wraps ? INFINITY : steps - axis->zero;
}

/* ---- strides ------------------------------------------------------------------------------- */

typedef struct stride {
    double world[3], slope[3]; /* in the ray's own space, less the offset */
} stride;

static double fold(double world, double period, double *turns)
{
    const double rest   = fmod(world, period);
    const double folded = rest < 0.0 ? rest + period : rest;
    *turns += floor((world - folded) / period + 0.5);
    return folded < period ? folded : 0.0;
}

/* Along a wrapped axis whole periods are taken out of the product before they can round it. */
static double stride_to(const hc_axis *axis, double world, double slope, double s, double *turns)
{
    if (!axis->wraps) {
        return fma(s, slope, world);
    }
    const double product = s * slope;
    const double rest    = fma(s, slope, -product);
    return fold(fold(product, axis->period, turns) + world + rest, axis->period, turns);
}

static void stride_by(const hc_tracer *tracer, stride *at, hc_path *path, double s)
{
    for (int i = 0; i < 2; i++) {
        const hc_axis *axis = &tracer->axes[i];
        at->world[i]        = stride_to(axis, at->world[i], at->slope[i], s, &path->turns[i]);
        path->place[i]      = at->world[i] * axis->scale / axis->unit - axis->first;
    }
    at->world[2]   = fma(s, at->slope[2], at->world[2]);
    path->place[2] = at->world[2] / tracer->height_scale;
    path->t0 += s;
}

static void begin(const hc_tracer *tracer, stride *at, hc_path *path, const hc_ray *ray)
{
    *path = (hc_path){ .tmin = (double)ray->tmin, .tmax = (double)ray->tmax };
    for (int i = 0; i < 3; i++) {
        at->slope[i] = (double)ray->direction[i];
        at->world[i] =
            (double)ray->origin[i] - (i < 2 ? tracer->axes[i].offset : tracer->height_offset);
        path->along[i] = i < 2 ? at->slope[i] * tracer->axes[i].scale / tracer->axes[i].unit
                               : at->slope[i] / tracer->height_scale;
    }
    stride_by(tracer, at, path, path->tmin);
}

/* ---- the box ------------------------------------------------------------------------------- */

typedef struct entry {
    double from, to;
    int    through; /* axis of the side the ray comes in through, 2: from above or below,
                       NOTHING: it starts in the box */
} entry;

static void cut(entry *e, const hc_path *path, int axis, double low, double high)
{
    const double place = path->place[axis];
    const double along = path->along[axis];
    if (along == 0.0) {
        e->to = place >= low && place <= high ? e->to : -INFINITY;
        return;
    }
    const double enters = ((along > 0.0 ? low : high) - place) / along;
    const double leaves = ((along > 0.0 ? high : low) - place) / along;
    if (enters > e->from) {
        e->from    = enters;
        e->through = axis;
    }
    e->to = fmin(e->to, leaves);
}

static entry cut_all(const hc_tracer *tracer, const hc_path *path, double back, double bottom)
{
    entry e = { -back, INFINITY, NOTHING };
    for (int i = 0; i < 2; i++) {
        cut(&e, path, i, tracer->axes[i].low, tracer->axes[i].high);
    }
    cut(&e, path, 2, bottom, 1.0);
    return e;
}

/* Move the path to where it enters the box. */
static entry enter(const hc_tracer *tracer, stride *at, hc_path *path, double bottom)
{
    double back = 0.0;
    entry  e    = cut_all(tracer, path, back, bottom);
    for (int i = 0; i < STRIDES && e.from <= e.to && e.from != 0.0; i++) {
        const int through = e.through;
        back += e.from;
        stride_by(tracer, at, path, e.from);
        e         = cut_all(tracer, path, back, bottom);
        e.through = e.through == NOTHING ? through : e.through;
    }
    return e;
}

/* `end` may lie beyond tmax by rounding: the hit itself is held against tmax. */
static void settle(const hc_tracer *tracer, hc_path *path, const entry *e)
{
    path->from = e->from;
    path->end  = fmin(e->to, nextafter(path->tmax - path->t0, INFINITY));
    for (int i = 0; i < 2; i++) {
        const hc_axis *axis = &tracer->axes[i];
        const double   far  = HC_PERIODS_MAX * (double)axis->size / fabs(path->along[i]);
        path->end           = axis->wraps ? fmin(path->end, far) : path->end;
        const double place  = hc_path_at(path, i, path->from);
        const double inside = fmin(fmax(place, axis->low), axis->high);
        /* On a wall the ray is in the cell that it goes into. */
        path->cell[i] = (int)(path->along[i] < 0.0 ? ceil(inside) - 1.0 : floor(inside));
    }
    if (path->along[2] < 0.0) {
        path->end = fmin(path->end, hc_path_reaches(path, 2, DEEP));
    }
    path->end = fmax(path->end, path->from);
}

static double gap_at_start(const hc_tracer *tracer, const hc_path *path)
{
    const hc_patch patch = hc_patch_of(tracer, path, path->cell);
    return hc_gap_of(&patch, path, path->from).value;
}

/* ---- from below, through an open side ------------------------------------------------------ */

static void set_found(hc_found *found, const hc_cursor *at, double s, uint32_t flags)
{
    found->s       = s;
    found->cell[0] = at->cell[0];
    found->cell[1] = at->cell[1];
    found->flags   = flags;
}

/* Cell by cell until the ray comes up. True: from there on it can be marched; else it is lost, or
 * has come down again at once and `found` says where. */
static bool come_up(const hc_tracer *tracer, hc_path *path, hc_found *found)
{
    hc_cursor at = { path->from, { path->cell[0], path->cell[1] } };
    for (bool below = true;;) {
        const hc_patch patch = hc_patch_of(tracer, path, at.cell);
        const hc_gap   gap   = hc_gap_of(&patch, path, at.s);
        const double   exit  = fmin(hc_cursor_exit(&at, path), path->end);
        found->steps++;
        if (gap.value > 0.0) {
            break;
        }
        const double back = hc_gap_return(&gap, exit - at.s, &below);
        if (back < INFINITY || exit >= path->end) {
            set_found(found, &at, at.s + back, 0);
            return false;
        }
        found->crossings++;
        hc_cursor_cross(&at, path);
        if (!below) {
            break;
        }
    }
    path->from    = at.s;
    path->cell[0] = at.cell[0];
    path->cell[1] = at.cell[1];
    return true;
}

static bool enter_below(const hc_tracer *tracer, stride *at, hc_path *path, hc_found *found)
{
    if (path->place[2] < DEEP) {
        if (path->along[2] <= 0.0) {
            return false;
        }
        const entry e = enter(tracer, at, path, DEEP);
        if (!(e.from <= e.to)) {
            return false;
        }
        settle(tracer, path, &e);
    }
    return come_up(tracer, path, found);
}

/* ---- hits ---------------------------------------------------------------------------------- */

static bool valid(const hc_ray *ray)
{
    bool finite = isfinite(ray->tmin) && ray->tmax >= ray->tmin; /* false for NaN */
    bool moves  = false;
    for (int i = 0; i < 3; i++) {
        finite = finite && isfinite(ray->origin[i]) && isfinite(ray->direction[i]);
        moves  = moves || ray->direction[i] != 0.0F;
    }
    return finite && moves;
}

static float texture_place(const hc_axis *axis, const hc_path *path, int i, double s)
{
    const double place = (hc_path_at(path, i, s) + axis->zero) / axis->steps;
    if (!axis->wraps) {
        return (float)fmin(fmax(place, 0.0), 1.0);
    }
    return (float)(place + (axis->unit < 0.0 ? -path->turns[i] : path->turns[i]));
}

/* The border strips of an unwrapped axis are cells of their own on the bilinear surface. */
static int32_t cell_index(const hc_axis *axis, int cell, bool tops)
{
    return !axis->wraps && !tops && axis->low < 0.0 && cell < 0 ? -1 : hc_axis_index(axis, cell);
}

static bool fill(const hc_tracer *tracer, hc_hit *hit, const hc_path *path, const hc_found *found)
{
    const double t = fmax(path->t0 + found->s, path->tmin);
    if (!(t <= path->tmax) || !isfinite((float)t)) {
        return false;
    }
    hit->t      = (float)((found->flags & HC_HIT_INSIDE) != 0 ? path->tmin : t);
    hit->u      = texture_place(&tracer->axes[0], path, 0, found->s);
    hit->v      = texture_place(&tracer->axes[1], path, 1, found->s);
    hit->height = (float)hc_path_at(path, 2, found->s);
    hit->cell_x = cell_index(&tracer->axes[0], found->cell[0], tracer->tops);
    hit->cell_y = cell_index(&tracer->axes[1], found->cell[1], tracer->tops);
    hit->flags  = found->flags;
    return true;
}

/* Decide what the entry decides. False: nothing is left to march. */
static bool decide_entry(const hc_tracer *tracer, stride *at, hc_path *path, const entry *e,
                         hc_found *found)
{
    settle(tracer, path, e);
    const hc_cursor start = { path->from, { path->cell[0], path->cell[1] } };
    if (gap_at_start(tracer, path) > 0.0) {
        return true;
    }
    found->steps = 1;
    if (e->through == NOTHING) {
        set_found(found, &start, path->from, HC_HIT_INSIDE);
        return false;
    }
    if (e->through == 2 || !tracer->options.open_sides) {
        set_found(found, &start, path->from, e->through == 2 ? 0 : HC_HIT_SIDE);
        return false;
    }
    return enter_below(tracer, at, path, found);
}

bool hc_path_begin(const hc_tracer *tracer, hc_path *path, hc_found *found, const hc_ray *ray)
{
    *found = (hc_found){ .s = INFINITY };
    if (!valid(ray)) {
        return false;
    }
    stride at;
    begin(tracer, &at, path, ray);
    const entry e = enter(tracer, &at, path, -INFINITY);
    if (!(e.from <= e.to) || path->t0 + e.from > path->tmax) {
        return false;
    }
    return decide_entry(tracer, &at, path, &e, found);
}

bool hc_trace_path(const hc_tracer *tracer, hc_hit *hit, const hc_ray *ray)
{
    hc_path  path;
    hc_found found;
    if (hc_path_begin(tracer, &path, &found, ray)) {
        tracer->march(tracer, &path, &found);
    }
    *hit = (hc_hit){ .t = INFINITY, .steps = found.steps, .crossings = found.crossings };
    return found.s < INFINITY && fill(tracer, hit, &path, &found);
}
