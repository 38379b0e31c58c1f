/* Exact shapes: funnel, steps, sinc, spheres. */
#include "noise.h"
#include "synth.h"

#include <math.h>

/* Texture-space distance of a sample from sample (width / 2, height / 2). */
static double funnel_distance(const hc_canvas *canvas, int x, int y)
{
    const double du = (double)(x - canvas->width / 2) / canvas->width;
    const double dv = (double)(y - canvas->height / 2) / canvas->height;
    return sqrt(du * du + dv * dv);
}

static void paint_funnel(float *run, int x, int y, int count, const hc_canvas *canvas,
                         const void *plan)
{
    const double *farthest = plan;
    for (int i = 0; i < count; i++) {
        run[i] = (float)(funnel_distance(canvas, x + i, y) / *farthest);
    }
}

hc_result hc_make_funnel(const hc_canvas *canvas, hc_log *log)
{
    const double corner   = funnel_distance(canvas, 0, 0); /* none is farther */
    const double farthest = corner > 0.0 ? corner : 1.0;
    return hc_paint(canvas, paint_funnel, &farthest, log);
}

/* Distance from the nearer end of an axis: just above 0 at the ends, 1 in the middle. */
static double inwards(int place, int side)
{
    const int from_start = 2 * place + 1;
    const int from_end   = 2 * side - from_start;
    return (double)(from_start < from_end ? from_start : from_end) / side;
}

static void paint_steps(float *run, int x, int y, int count, const hc_canvas *canvas,
                        const void *plan)
{
    enum { STEPS = 8 };
    (void)plan;
    for (int i = 0; i < count; i++) {
        const double nearest = fmin(inwards(x + i, canvas->width), inwards(y, canvas->height));
        const double step    = fmin(floor(nearest * STEPS), STEPS - 1);
        run[i]               = (float)(step / (STEPS - 1));
    }
}

hc_result hc_make_steps(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_steps, NULL, log);
}

static void paint_sinc(float *run, int x, int y, int count, const hc_canvas *canvas,
                       const void *plan)
{
    const double rings = 5.0; /* full waves from the centre to the middle of an edge */
    const double pi    = 3.141592653589793;
    (void)plan;
    for (int i = 0; i < count; i++) {
        const double u     = (2.0 * (x + i) + 1.0) / canvas->width - 1.0;
        const double v     = (2.0 * y + 1.0) / canvas->height - 1.0;
        const double turns = rings * sqrt(u * u + v * v);
        run[i]             = turns > 0.0 ? (float)(hc_sine(turns) / (2.0 * pi * turns)) : 1.0F;
    }
}

hc_result hc_make_sinc(const hc_canvas *canvas, hc_log *log)
{
    return hc_paint(canvas, paint_sinc, NULL, log);
}

typedef struct sphere_grid {
    hc_lattice u, v;
    uint64_t   key;
} sphere_grid;

/* Texels from the middle of the cell that `place` is in. */
static double from_middle(const hc_lattice *lattice, hc_place place)
{
    return ((double)place.numerator / lattice->side - 1.0) * 0.5 * lattice->side / lattice->cells;
}

static void paint_spheres(float *run, int x, int y, int count, const hc_canvas *canvas,
                          const void *plan)
{
    const sphere_grid *grid = plan;
    const hc_place     down = hc_lattice_place(&grid->v, y);
    const double       dy   = from_middle(&grid->v, down);
    const double       half =
        0.5 * fmin((double)canvas->width / grid->u.cells, (double)canvas->height / grid->v.cells);
    for (int i = 0; i < count; i++) {
        const hc_place across = hc_lattice_place(&grid->u, x + i);
        const double   dx     = from_middle(&grid->u, across);
        const double   share  = (double)hc_hash_unit(grid->key, across.cell, down.cell);
        const double   radius = half * (0.5 + 0.48 * share);
        const double   square = radius * radius - dx * dx - dy * dy;
        run[i]                = square > 0.0 ? (float)(sqrt(square) / half) : 0.0F;
    }
}

hc_result hc_make_spheres(const hc_canvas *canvas, hc_log *log)
{
    const double      texels = hc_longer_side(canvas) / 4.0;
    const sphere_grid grid   = { .u   = hc_make_cells(canvas->width, texels),
                                 .v   = hc_make_cells(canvas->height, texels),
                                 .key = hc_stream(canvas->seed, 0) };
    return hc_paint(canvas, paint_spheres, &grid, log);
}
