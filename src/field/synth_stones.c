/* Masonry: bricks and cobbles.
 *
 * After: Steven Worley. A Cellular Texture Basis Function. 1996 (cobbles). */
#include "noise.h"
#include "synth.h"

#include <math.h>

/* Cells over the field, at least one of them along each axis, and fine grain on top. */
typedef struct masonry {
    hc_lattice u, v;
    double     cell_width, cell_height; /* texels */
    uint64_t   key;
    hc_fractal grain;
} masonry;

static masonry make_masonry(const hc_canvas *canvas, hc_lattice u, hc_lattice v)
{
    return (masonry){ .u           = u,
                      .v           = v,
                      .cell_width  = (double)canvas->width / u.cells,
                      .cell_height = (double)canvas->height / v.cells,
                      .key         = hc_stream(canvas->seed, 0),
                      .grain       = hc_make_fractal(canvas->width, canvas->height, 40.0, 6,
                                                     hc_stream(canvas->seed, 1)) };
}

/* Texels to the nearer end of the cell that `place` is in. */
static double to_cell_end(const hc_lattice *lattice, hc_place place)
{
    const int left  = 2 * lattice->side - place.numerator;
    const int least = place.numerator < left ? place.numerator : left;
    return 0.5 * least / lattice->cells;
}

static void paint_bricks(float *run, int x, int y, int count, const hc_canvas *canvas,
                         const void *plan)
{
    const masonry *wall  = plan;
    const hc_place down  = hc_lattice_place(&wall->v, y);
    const double   rise  = to_cell_end(&wall->v, down);
    const double   joint = 0.07 * fmin(wall->cell_width, wall->cell_height);
    const double   bevel = 1.6 * joint;
    hc_lattice     row   = wall->u;
    float          grain[HC_RUN];
    (void)canvas;
    row.offset = down.cell % 2 == 1 ? row.side : 0; /* half a brick */
    hc_fractal_run(grain, &wall->grain, x, y, count);
    for (int i = 0; i < count; i++) {
        const hc_place across = hc_lattice_place(&row, x + i);
        const double   rough  = (double)grain[i] * 0.5 * joint;
        const double   edge   = fmin(to_cell_end(&row, across), rise) + rough - joint;
        const float    body   = hc_smooth(hc_clamp_unit((float)(edge / bevel)));
        const float    brick  = 0.78F + 0.22F * hc_hash_unit(wall->key, across.cell, down.cell);
        run[i]                = 0.1F + (brick - 0.1F) * body + 0.06F * grain[i];
    }
}

/* An even number of courses, so that the bond tiles, wherever there is room for two. */
static hc_lattice make_courses(int height, double texels)
{
    hc_lattice courses = hc_make_cells(height, 2.0 * texels);
    if (height > 1) {
        courses.cells = 2 * courses.cells <= height ? 2 * courses.cells : height - height % 2;
    }
    return courses;
}

hc_result hc_make_bricks(const hc_canvas *canvas, hc_log *log)
{
    const double  longer = hc_longer_side(canvas);
    const masonry wall   = make_masonry(canvas, hc_make_cells(canvas->width, longer / 6.0),
                                        make_courses(canvas->height, longer / 14.0));
    return hc_paint(canvas, paint_bricks, &wall, log);
}

/* A stone's middle, in texels from the first texel centre of the run. */
typedef struct stone {
    double x, y;
    float  level;
} stone;

enum { AROUND = 9 }; /* a cell and its neighbours */

/* Middles keep 0.2 of a cell away from the cell's ends: then the two nearest are always among the
 * neighbours. */
static stone find_stone(const masonry *street, int cell_x, int cell_y, double corner_x,
                        double corner_y)
{
    const uint64_t bits = hc_hash(street->key, cell_x, cell_y);
    return (stone){ .x = corner_x + street->cell_width * (0.2 + 0.6 * (double)hc_unit(bits)),
                    .y = corner_y + street->cell_height * (0.2 + 0.6 * (double)hc_unit(bits << 20)),
                    .level = hc_unit(bits << 40) };
}

static void find_stones(stone *stones, const masonry *street, hc_place across, hc_place down)
{
    const double left = -0.5 * across.numerator / street->u.cells;
    const double top  = -0.5 * down.numerator / street->v.cells;
    for (int k = 0; k < AROUND; k++) {
        const int step_x = k % 3 - 1;
        const int step_y = k / 3 - 1;
        stones[k] =
            find_stone(street, hc_lattice_beside(&street->u, across.cell, step_x),
                       hc_lattice_beside(&street->v, down.cell, step_y),
                       left + step_x * street->cell_width, top + step_y * street->cell_height);
    }
}

static double square_distance(stone from, double x)
{
    return (from.x - x) * (from.x - x) + from.y * from.y;
}

/* Distance from the joints around the nearest stone, rounded off where they meet: each neighbour's
 * joint is half way towards it, and the fourth powers of the closeness to all of them add up. */
static double joint_distance(const stone *stones, int nearest, double x)
{
    const stone  own       = stones[nearest];
    const double own_d     = square_distance(own, x);
    double       closeness = 0.0;
    for (int k = 0; k < AROUND; k++) {
        if (k != nearest) {
            const double dx   = stones[k].x - own.x;
            const double dy   = stones[k].y - own.y;
            const double beat = square_distance(stones[k], x) - own_d;
            /* On the joint itself `beat` is 0; the bound keeps its closeness finite. */
            const double joint = 4.0 * (dx * dx + dy * dy) / fmax(beat * beat, 1e-9);
            closeness += joint * joint;
        }
    }
    return 1.0 / sqrt(sqrt(closeness));
}

static float cobble_height(const stone *stones, double x, double cell)
{
    int nearest = 0;
    for (int k = 1; k < AROUND; k++) {
        if (square_distance(stones[k], x) < square_distance(stones[nearest], x)) {
            nearest = k;
        }
    }
    const double edge = joint_distance(stones, nearest, x) / cell;
    const float  t    = hc_clamp_unit((float)((edge - 0.03) / 0.33));
    return sqrtf(t * (2.0F - t)) * (0.7F + 0.3F * stones[nearest].level);
}

static void paint_cobbles(float *run, int x, int y, int count, const hc_canvas *canvas,
                          const void *plan)
{
    const masonry *street = plan;
    const hc_place down   = hc_lattice_place(&street->v, y);
    const double   cell   = fmin(street->cell_width, street->cell_height);
    float          grain[HC_RUN];
    (void)canvas;
    hc_fractal_run(grain, &street->grain, x, y, count);
    for (int done = 0; done < count;) {
        const hc_place across = hc_lattice_place(&street->u, x + done);
        const int      texels = hc_lattice_count(&street->u, across, count - done);
        stone          stones[AROUND];
        find_stones(stones, street, across, down);
        for (int i = 0; i < texels; i++) {
            run[done + i] = cobble_height(stones, i, cell) + 0.07F * grain[done + i];
        }
        done += texels;
    }
}

hc_result hc_make_cobbles(const hc_canvas *canvas, hc_log *log)
{
    const double  texels = hc_longer_side(canvas) / 11.0;
    const masonry street = make_masonry(canvas, hc_make_cells(canvas->width, texels),
                                        hc_make_cells(canvas->height, texels));
    return hc_paint(canvas, paint_cobbles, &street, log);
}
