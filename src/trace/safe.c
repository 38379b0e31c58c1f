/* Cones that the surface does not enter, and the patch of every cell that they do not carry the ray
 * across. docs/algorithms.md, sections 4 and 19. */
#include "cursor.h"
#include "surface.h"

typedef struct cones {
    size_t channels, channel; /* the one for the quadrant of the direction */
    double run;               /* texture units per s, in the 1-norm        */
    double step[2];           /* texture units per cell                    */
} cones;

static cones choose_cones(const hc_tracer *tracer, const hc_path *path)
{
    cones c = { .channels = (size_t)hc_cones_channels(tracer->options.cones) };
    if (tracer->options.cones == HC_CONES_QUAD) {
        c.channel = (path->along[0] < 0.0 ? 1U : 0U) + (path->along[1] < 0.0 ? 2U : 0U);
    }
    for (int i = 0; i < 2; i++) {
        c.step[i] = 1.0 / tracer->axes[i].steps;
        c.run += fabs(path->along[i]) * c.step[i];
    }
    return c;
}

static double slope_at(const hc_tracer *tracer, const cones *c, int x, int y)
{
    const size_t at    = hc_tracer_index(tracer, x, y) * c->channels + c->channel;
    const double ratio = (double)tracer->options.ratios[at];
    return 1.0 / fmax(ratio, 0x1p-100); /* 0: no free space known. Such a step does not count. */
}

/* Along the face between two tops the steeper of their cones counts. */
static double steepest_of(const hc_tracer *tracer, const hc_path *path, const cones *c,
                          const int cell[2])
{
    const int back_x = tracer->tops && hc_path_on_wall(path, 0) ? 1 : 0;
    const int back_y = tracer->tops && hc_path_on_wall(path, 1) ? 1 : 0;
    double    slope  = 0.0;
    for (int y = cell[1] - back_y; y <= cell[1]; y++) {
        for (int x = cell[0] - back_x; x <= cell[0]; x++) {
            slope = fmax(slope, slope_at(tracer, c, x, y));
        }
    }
    return slope;
}

/* Tops are wider than their samples: how much nearer they are than the samples, from here on. */
static double nearer(const hc_tracer *tracer, const hc_path *path, const cones *c,
                     const hc_cursor *at)
{
    double distance = 0.0;
    for (int i = 0; i < 2 && tracer->tops; i++) {
        const double inside = hc_path_at(path, i, at->s) - at->cell[i];
        const double behind = path->along[i] > 0.0 ? inside : 1.0 - inside;
        distance += path->along[i] != 0.0 ? behind * c->step[i] : 0.0;
    }
    return distance;
}

/* Where the ray leaves the cone; INFINITY: it rises out of it for good. */
static double cone_exit(const hc_tracer *tracer, const hc_path *path, const cones *c,
                        const hc_cursor *at, double gap)
{
    const double slope = steepest_of(tracer, path, c, at->cell);
    const double room  = gap - slope * nearer(tracer, path, c, at);
    const double rate  = slope * c->run - path->along[2];
    if (!(room >= 0.0)) {
        return at->s;
    }
    return rate > 0.0 ? at->s + room / rate : INFINITY;
}

static void report(hc_found *found, const hc_cursor *at, double s, uint32_t flags)
{
    found->s       = s;
    found->cell[0] = at->cell[0];
    found->cell[1] = at->cell[1];
    found->flags   = flags;
}

/* A step of the cone that ends in the cell it began in must be one over a wall. */
static void leap(hc_cursor *at, const hc_path *path, double s)
{
    const hc_cursor before = *at;
    hc_cursor_jump(at, path, s);
    if (at->cell[0] == before.cell[0] && at->cell[1] == before.cell[1]) {
        hc_cursor_cross(at, path);
    }
}

void hc_march_safe(const hc_tracer *tracer, const hc_path *path, hc_found *found)
{
    const cones c  = choose_cones(tracer, path);
    hc_cursor   at = { path->from, { path->cell[0], path->cell[1] } };
    for (bool crossed = false;; crossed = true) {
        const hc_patch patch = hc_patch_of(tracer, path, at.cell);
        const hc_gap   gap   = hc_gap_of(&patch, path, at.s);
        const double   exit  = fmin(hc_cursor_exit(&at, path), path->end);
        found->steps++;
        if (gap.value <= 0.0) {
            report(found, &at, at.s, tracer->tops && crossed ? HC_HIT_SIDE : 0);
            return;
        }
        const double free = cone_exit(tracer, path, &c, &at, gap.value);
        const double meet = free > exit ? INFINITY : at.s + hc_gap_contact(&gap, exit - at.s);
        if (meet < INFINITY) {
            report(found, &at, meet, 0);
            return;
        }
        if (fmax(exit, free) >= path->end) {
            return;
        }
        found->crossings++;
        if (free > exit) {
            leap(&at, path, free);
        } else {
            hc_cursor_cross(&at, path);
        }
    }
}
