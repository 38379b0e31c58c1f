/* The judge of tracers: a walk over every cell that a ray crosses, in double precision. The
 * definitions are those of ray.h; docs/algorithms.md, section 19, has the formulas.
 *
 * Positions count in samples. Along an axis the cells are numbered in rising order:
 *   bilinear  cell k lies between the samples k and k + 1
 *   steps     cell 2i is sample i's own flat top, cell 2i + 1 the border strip between the tops i
 *             and i + 1: of no width, or 2 |reach| wide, and as high as the higher of them (the
 *             lower if reach is negative). A strip makes the solid closed: what runs along a face
 *             touches it. */
#include <heightcast/ray.h>

#include <math.h>

typedef struct axis {
    int    size;
    bool   wraps;
    bool   strips; /* steps */
    double offset, scale,
        unit; /* samples from sample 0 = (world - offset) * scale / unit - first */
    double first;
    double period;    /* of the world, if it wraps */
    double low, high; /* the field's ends */
    double reach;
} axis;

typedef struct scene {
    const hc_field             *field;
    const hc_reference_options *options;
    axis                        axes[2];
    double                      lift, height_offset, height_scale;
} scene;

/* A ray, moved along itself to where `t` is: there it is at `world` (less the offset), and at
 * `place` in samples and heights. `turns` are the periods taken out of `world`. */
typedef struct line {
    double world[3], slope[3];
    double place[3], along[3];
    double turns[2];
    double t;
} line;

static axis make_axis(const hc_field *field, const hc_reference_options *options, bool vertical)
{
    const hc_placement *where  = &options->placement;
    const double        step   = vertical ? hc_field_step_v(field) : hc_field_step_u(field);
    const bool          placed = where->scale_z != 0.0;
    axis                a      = { .size   = vertical ? field->height : field->width,
                                   .strips = options->surface == HC_SURFACE_STEPS,
                                   .reach  = options->reach };
    a.wraps                    = ((unsigned)field->wrap & (vertical ? HC_WRAP_V : HC_WRAP_U)) != 0;
    const double u0            = field->registration == HC_GRID ? 0.0 : 0.5; /* in samples */
    a.scale                    = placed ? 1.0 : floor(1.0 / step + 0.5);
    a.unit                     = !placed ? 1.0 : vertical ? where->spacing_y : where->spacing_x;
    a.offset                   = !placed ? 0.0 : where->offset[vertical ? 1 : 0];
    a.first                    = placed ? 0.0 : u0;
    a.period                   = fabs(a.size * a.unit / a.scale);
    a.low                      = a.wraps ? -INFINITY : -u0 - a.reach;
    a.high                     = a.wraps ? INFINITY : floor(1.0 / step + 0.5) - u0 + a.reach;
    return a;
}

/* ---- lines --------------------------------------------------------------------------------- */

static double fold(double world, double period, double *turns)
{
    double rest = fmod(world, period);
    rest        = rest < 0.0 ? rest + period : rest;
    rest        = rest < period ? rest : 0.0;
    *turns += floor((world - rest) / period + 0.5);
    return rest;
}

/* origin + t * direction; products that leave the period are folded before they can round. */
static double advance(const axis *a, double world, double slope, double t, double *turns)
{
    if (!a->wraps) {
        return fma(t, slope, world);
    }
    const double product = t * slope;
    const double rest    = fma(t, slope, -product);
    return fold(fold(product, a->period, turns) + world + rest, a->period, turns);
}

static void move_line(const scene *s, line *l, double t)
{
    for (int i = 0; i < 2; i++) {
        const axis *a = &s->axes[i];
        l->world[i]   = advance(a, l->world[i], l->slope[i], t, &l->turns[i]);
        l->place[i]   = l->world[i] * a->scale / a->unit - a->first;
    }
    l->world[2] = fma(t, l->slope[2], l->world[2]);
    l->place[2] = l->world[2] / s->height_scale;
    l->t += t;
}

static void make_line(const scene *s, line *l, const hc_ray *ray)
{
    *l = (line){ .t = 0.0 };
    for (int i = 0; i < 3; i++) {
        const double offset = i < 2 ? s->axes[i].offset : s->height_offset;
        l->world[i]         = (double)ray->origin[i] - offset;
        l->slope[i]         = (double)ray->direction[i];
        if (i < 2) {
            l->along[i] = l->slope[i] * s->axes[i].scale / s->axes[i].unit;
        } else {
            l->along[i] = l->slope[i] / s->height_scale;
        }
    }
    move_line(s, l, (double)ray->tmin);
}

/* ---- the box: unwrapped sides, heights up to the top --------------------------------------- */

typedef struct range {
    double low, high;
    int    entered; /* axis of the last bound passed; 2: top or bottom; 3: none, it starts inside */
} range;

/* Cut to where low <= place <= high along one axis. Empty: high < low. */
static void cut(range *r, double place, double along, double low, double high, int which)
{
    if (along == 0.0) {
        r->high = place >= low && place <= high ? r->high : -INFINITY;
        return;
    }
    const double in  = ((along > 0.0 ? low : high) - place) / along;
    const double out = ((along > 0.0 ? high : low) - place) / along;
    if (in > r->low) {
        r->low     = in;
        r->entered = which;
    }
    r->high = fmin(r->high, out);
}

static range box_range(const scene *s, const line *l, double back, double bottom)
{
    range r = { -back, INFINITY, 3 };
    for (int i = 0; i < 2; i++) {
        cut(&r, l->place[i], l->along[i], s->axes[i].low, s->axes[i].high, i);
    }
    cut(&r, l->place[2], l->along[2], bottom, 1.0 + fmax(s->lift, 0.0), 2);
    return r;
}

/* Move the line to where it enters the box, in several strides: each leaves a rounding error as
 * large as 2^-53 of the distance it covered. What remains is in the range. */
static range enter_box(const scene *s, line *l, double bottom)
{
    double back = 0.0;
    range  r    = box_range(s, l, back, bottom);
    for (int stride = 0; stride < 4 && r.low <= r.high && r.low != 0.0; stride++) {
        back += r.low;
        const int entered = r.entered;
        move_line(s, l, r.low);
        r         = box_range(s, l, back, bottom);
        r.entered = r.entered == 3 ? entered : r.entered;
    }
    return r;
}

/* ---- the surface in a cell ----------------------------------------------------------------- */

/* height = base + x * slope_x + y * slope_y + x * y * twist, from the cell's first corner */
typedef struct patch {
    double base, slope_x, slope_y, twist;
    double x, y;
} patch;

static double sample(const scene *s, int x, int y)
{
    const int index[2] = { x, y };
    int       at[2];
    for (int i = 0; i < 2; i++) {
        const int size = s->axes[i].size;
        at[i]          = s->axes[i].wraps  ? (index[i] % size + size) % size
                         : index[i] < 0    ? 0
                         : index[i] < size ? index[i]
                                           : size - 1;
    }
    return (double)s->field->heights[(size_t)at[1] * (size_t)s->field->width + (size_t)at[0]];
}

/* Largest difference of neighbours among the corners of this cell and the eight around it. */
static double steepest(const scene *s, int x, int y)
{
    double steep = 0.0;
    for (int j = -1; j <= 2; j++) {
        for (int i = -1; i <= 2; i++) {
            const double here = sample(s, x + i, y + j);
            steep = i < 2 ? fmax(steep, fabs(sample(s, x + i + 1, y + j) - here)) : steep;
            steep = j < 2 ? fmax(steep, fabs(sample(s, x + i, y + j + 1) - here)) : steep;
        }
    }
    return steep;
}

static patch bilinear_patch(const scene *s, int x, int y)
{
    const double h00 = sample(s, x, y);
    const double h10 = sample(s, x + 1, y);
    const double h01 = sample(s, x, y + 1);
    const double h11 = sample(s, x + 1, y + 1);
    const double lift =
        s->options->rise + (s->options->reach != 0.0 ? s->options->reach * steepest(s, x, y) : 0.0);
    return (patch){ h00 + lift, h10 - h00, h01 - h00, h11 - h10 - h01 + h00, x, y };
}

static int halved(int k)
{
    return k >= 0 ? k / 2 : -((1 - k) / 2);
}

/* The highest (or lowest) of the one, two or four tops that this cell of tops and strips is of. */
static patch step_patch(const scene *s, int x, int y)
{
    const double sign = s->options->reach < 0.0 ? -1.0 : 1.0;
    double       best = -INFINITY;
    for (int j = halved(y); j <= halved(y + 1); j++) {
        for (int i = halved(x); i <= halved(x + 1); i++) {
            best = fmax(best, sign * sample(s, i, j));
        }
    }
    return (patch){ .base = sign * best + s->options->rise };
}

static patch patch_of(const scene *s, const int cell[2])
{
    return s->axes[0].strips ? step_patch(s, cell[0], cell[1])
                             : bilinear_patch(s, cell[0], cell[1]);
}

/* How far the ray is above the patch: value + t * slope + t * t * bend, t from `from` on. */
typedef struct gap {
    double value, slope, bend;
} gap;

static gap gap_of(const patch *p, const line *l, double from)
{
    const double dx = l->along[0];
    const double dy = l->along[1];
    const double x  = l->place[0] + from * dx - p->x;
    const double y  = l->place[1] + from * dy - p->y;
    const double z  = l->place[2] + from * l->along[2];
    return (gap){ z - (p->base + x * p->slope_x + y * p->slope_y + x * y * p->twist),
                  l->along[2] - (p->slope_x * dx + p->slope_y * dy + p->twist * (x * dy + y * dx)),
                  -(p->twist * dx * dy) };
}

static double gap_at(const gap *g, double t)
{
    return g->value + t * (g->slope + t * g->bend);
}

/* The least t in 0 .. length at which the gap, positive at 0, is no more; INFINITY if it stays. The
 * root that is near is the one whose formula adds and does not cancel. */
static double first_contact(const gap *g, double length)
{
    const double end    = gap_at(g, length);
    const double square = g->slope * g->slope - 4.0 * g->value * g->bend;
    double       root   = INFINITY;
    if (square >= 0.0 && g->slope < 0.0) {
        root = 2.0 * g->value / (sqrt(square) - g->slope);
    } else if (square >= 0.0 && g->bend < 0.0) {
        root = (g->slope + sqrt(square)) / (-2.0 * g->bend);
    }
    if (end <= 0.0) {
        return fmin(root, length); /* it has changed sign: what rounding says of the root is moot */
    }
    /* Both ends are above: only a patch that bends towards the ray can be touched in between. */
    return g->bend > 0.0 && root <= length ? root : INFINITY;
}

/* ---- the walk ------------------------------------------------------------------------------ */

static double wall(const axis *a, int cell)
{
    if (!a->strips) {
        return cell;
    }
    const double away = fabs(a->reach);
    return cell % 2 == 0 ? halved(cell) - 0.5 + away : halved(cell) + 0.5 - away;
}

static int cell_at(const axis *a, double place)
{
    if (!a->strips) {
        const int cell = (int)floor(place);
        return a->wraps || cell < a->size ? cell : a->size - 1;
    }
    const int    top  = (int)floor(place + 0.5);
    const double away = fabs(a->reach);
    return place <= top - 0.5 + away   ? 2 * top - 1
           : place >= top + 0.5 - away ? 2 * top + 1
                                       : 2 * top;
}

typedef struct walk {
    int    cell[2];
    double from;
    bool   below; /* came in through an open side and has not come up yet */
    int    cells;
} walk;

/* When the ray crosses into the next cell along an axis. */
static double next_wall(const scene *s, const line *l, const walk *w, int i)
{
    const double along = l->along[i];
    if (along == 0.0) {
        return INFINITY;
    }
    const int next = along > 0.0 ? w->cell[i] + 1 : w->cell[i];
    return (wall(&s->axes[i], next) - l->place[i]) / along;
}

/* From below the surface: when the ray comes down on it again, having come up in the same cell. */
static double meet_from_below(const gap *g, double length, bool *below)
{
    const gap    under = { -g->value, -g->slope, -g->bend };
    const double up    = g->value == 0.0 ? 0.0 : first_contact(&under, length);
    const double slope = g->slope + 2.0 * up * g->bend;
    if (up <= length && slope > 0.0 && g->bend < 0.0 && up - slope / g->bend <= length) {
        *below = false;
        return up - slope / g->bend;
    }
    *below = !(gap_at(g, length) > 0.0);
    return INFINITY;
}

/* First contact in the present cell up to `to`, from w->from on. */
static double meet(const scene *s, const line *l, walk *w, double to)
{
    const patch p = patch_of(s, w->cell);
    const gap   g = gap_of(&p, l, w->from);
    if (w->below && g.value <= 0.0) {
        return w->from + meet_from_below(&g, to - w->from, &w->below);
    }
    w->below = false;
    return g.value <= 0.0 ? w->from : w->from + first_contact(&g, to - w->from);
}

static double walk_cells(const scene *s, const line *l, walk *w, double end)
{
    for (;;) {
        const double next[2] = { next_wall(s, l, w, 0), next_wall(s, l, w, 1) };
        const double to      = fmin(fmin(fmax(next[0], w->from), fmax(next[1], w->from)), end);
        const double found   = meet(s, l, w, to);
        w->cells++;
        if (found < INFINITY || to >= end) {
            return found;
        }
        for (int i = 0; i < 2; i++) {
            if (next[i] <= to) {
                w->cell[i] += l->along[i] > 0.0 ? 1 : -1;
            }
        }
        w->from = to;
    }
}

/* ---- the answer ---------------------------------------------------------------------------- */

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

static int reported_index(const axis *a, int index)
{
    if (a->wraps) {
        return (index % a->size + a->size) % a->size;
    }
    const int least = a->strips || a->low + a->reach == 0.0 ? 0 : -1;
    return index < least ? least : index < a->size ? index : a->size - 1;
}

/* Of a strip's tops, the highest. */
static void report_cell(hc_hit *hit, const scene *s, const walk *w)
{
    int x = w->cell[0];
    int y = w->cell[1];
    if (s->axes[0].strips) {
        const int left = halved(x), right = halved(x + 1);
        const int above = halved(y), under = halved(y + 1);
        x = left;
        y = above;
        for (int i = 0; i < 4; i++) {
            const int other_x = i % 2 == 0 ? left : right;
            const int other_y = i / 2 == 0 ? above : under;
            if (sample(s, other_x, other_y) > sample(s, x, y)) {
                x = other_x;
                y = other_y;
            }
        }
    }
    hit->cell_x = reported_index(&s->axes[0], x);
    hit->cell_y = reported_index(&s->axes[1], y);
}

static float texture_place(const scene *s, const line *l, double at, int i)
{
    const axis  *a     = &s->axes[i];
    const double u0    = s->field->registration == HC_GRID ? 0.0 : 0.5;
    const double step  = i == 0 ? hc_field_step_u(s->field) : hc_field_step_v(s->field);
    const double place = (l->place[i] + at * l->along[i] + u0) * step;
    return (float)(a->wraps ? place + l->turns[i] * (a->unit < 0.0 ? -1.0 : 1.0)
                            : fmin(fmax(place, 0.0), 1.0));
}

static double answer(hc_hit *hit, const scene *s, const line *l, const walk *w, double at,
                     uint32_t flags, const hc_ray *ray)
{
    const double t  = (flags & HC_HIT_INSIDE) != 0 ? (double)ray->tmin : l->t + at;
    hit->steps      = (uint32_t)w->cells;
    hit->crossings  = (uint32_t)w->cells;
    const double t0 = fmax(t, (double)ray->tmin);
    if (!(t0 <= (double)ray->tmax) || !isfinite((float)t0)) {
        return INFINITY;
    }
    hit->t      = (float)t0;
    hit->u      = texture_place(s, l, at, 0);
    hit->v      = texture_place(s, l, at, 1);
    hit->height = (float)(l->place[2] + at * l->along[2]);
    hit->flags  = flags;
    report_cell(hit, s, w);
    return t0;
}

static walk start_walk(const scene *s, const line *l, double from)
{
    walk w = { .from = from };
    for (int i = 0; i < 2; i++) {
        w.cell[i] = cell_at(&s->axes[i], l->place[i] + from * l->along[i]);
    }
    return w;
}

static double gap_now(const scene *s, const line *l, const walk *w)
{
    const patch p = patch_of(s, w->cell);
    return gap_of(&p, l, w->from).value;
}

/* Where the walk ends: out of the box, at tmax, or after its periods. A ray that falls is in the
 * solid, or under it for good, a height of 1 below everything. */
static double end_of(const scene *s, const line *l, const range *r, double tmax)
{
    const double top   = (1.0 - l->place[2]) / l->along[2];
    const double start = l->along[2] < 0.0 ? fmax(top, 0.0) : 0.0; /* the box may be raised */
    double       end   = fmin(r->high, nextafter(tmax - l->t, INFINITY));
    for (int i = 0; i < 2; i++) {
        const axis  *a       = &s->axes[i];
        const double periods = HC_PERIODS_MAX * (double)a->size + a->reach;
        if (a->wraps && l->along[i] != 0.0) {
            end = fmin(end, start + periods / fabs(l->along[i]));
        }
    }
    if (l->along[2] < 0.0) {
        end = fmin(end, (-1.0 - s->lift - l->place[2]) / l->along[2]);
    }
    return fmax(end, r->low);
}

/* Through an open side, from below the surface. False: it never comes up. */
static bool enter_below(const scene *s, line *l, range *r, walk *w)
{
    const double deep = -1.0 - s->lift;
    if (l->place[2] < deep) {
        if (l->along[2] <= 0.0) {
            return false;
        }
        *r = enter_box(s, l, deep);
        *w = start_walk(s, l, r->low);
    }
    w->below = true;
    return r->low <= r->high;
}

static double trace_line(hc_hit *hit, const scene *s, const hc_ray *ray)
{
    line l;
    make_line(s, &l, ray);
    range r = enter_box(s, &l, -INFINITY);
    if (!(r.low <= r.high) || l.t + r.low > (double)ray->tmax) {
        return INFINITY;
    }
    walk w = start_walk(s, &l, r.low);
    if (gap_now(s, &l, &w) <= 0.0) {
        w.cells = 1;
        if (r.entered == 3) {
            return answer(hit, s, &l, &w, r.low, HC_HIT_INSIDE, ray);
        }
        if (r.entered == 2 || !s->options->open_sides) {
            return answer(hit, s, &l, &w, r.low, r.entered == 2 ? 0 : HC_HIT_SIDE, ray);
        }
        if (!enter_below(s, &l, &r, &w)) {
            return INFINITY;
        }
    }
    const double end   = end_of(s, &l, &r, (double)ray->tmax);
    const double found = walk_cells(s, &l, &w, end);
    /* Tops have no slope: a hit where the cell begins is one on a face. */
    const bool face = s->axes[0].strips && found == w.from && w.cells > 1;
    return found < INFINITY ? answer(hit, s, &l, &w, found, face ? HC_HIT_SIDE : 0, ray) : INFINITY;
}

double hc_reference_trace(hc_hit *hit, const hc_field *field, const hc_reference_options *options,
                          const hc_ray *ray)
{
    static const hc_reference_options plain = { .open_sides = false };
    const hc_reference_options       *given = options != NULL ? options : &plain;
    *hit                                    = (hc_hit){ .t = INFINITY };
    if (!valid(ray)) {
        return INFINITY;
    }
    const bool placed = given->placement.scale_z != 0.0;
    scene      s      = { .field         = field,
                          .options       = given,
                          .lift          = fabs(given->rise) + fabs(given->reach),
                          .height_offset = placed ? given->placement.offset[2] : 0.0,
                          .height_scale  = placed ? given->placement.scale_z : 1.0 };
    s.axes[0]         = make_axis(field, given, false);
    s.axes[1]         = make_axis(field, given, true);
    return trace_line(hit, &s, ray);
}
