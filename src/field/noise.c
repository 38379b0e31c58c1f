/* Gradient noise on a lattice that fits the field.
 *
 * After: Ken Perlin. Improving Noise. 2002 (gradients on lattice points, fifth-degree fade). The
 * lattice is walked cell by cell, so that a row costs two hashes per cell, not per texel. */
#include "noise.h"

#include <math.h>

/* Unit vectors, 1/16 of a turn apart: cos and sin of 0, 22.5, 45 ... degrees. */
static const float gradients[16][2] = {
    { 1.0F, 0.0F },
    { 0.92387953F, 0.38268343F },
    { 0.70710678F, 0.70710678F },
    { 0.38268343F, 0.92387953F },
    { 0.0F, 1.0F },
    { -0.38268343F, 0.92387953F },
    { -0.70710678F, 0.70710678F },
    { -0.92387953F, 0.38268343F },
    { -1.0F, 0.0F },
    { -0.92387953F, -0.38268343F },
    { -0.70710678F, -0.70710678F },
    { -0.38268343F, -0.92387953F },
    { 0.0F, -1.0F },
    { 0.38268343F, -0.92387953F },
    { 0.70710678F, -0.70710678F },
    { 0.92387953F, -0.38268343F },
};

hc_place hc_lattice_place(const hc_lattice *lattice, int texel)
{
    const int64_t period = 2 * (int64_t)lattice->side;
    const int64_t place  = (2 * (int64_t)texel + 1) * lattice->cells + lattice->offset;
    const int     cell   = (int)(place / period);
    return (hc_place){ .cell      = cell < lattice->cells ? cell : 0,
                       .numerator = (int)(place % period) };
}

int hc_lattice_count(const hc_lattice *lattice, hc_place place, int limit)
{
    if (lattice->cells == 0) {
        return limit;
    }
    const int step  = 2 * lattice->cells;
    const int count = (2 * lattice->side - place.numerator + step - 1) / step;
    return count < limit ? count : limit;
}

int hc_lattice_beside(const hc_lattice *lattice, int cell, int step)
{
    const int cells  = lattice->cells > 0 ? lattice->cells : 1;
    const int beside = cell + step;
    return beside < 0 ? cells - 1 : beside < cells ? beside : 0;
}

int hc_cells_along(int side, double texels)
{
    const double cells = floor(side / texels + 0.5);
    return cells < side ? (int)cells : side;
}

hc_lattice hc_make_cells(int side, double texels)
{
    const int cells = hc_cells_along(side, texels);
    return (hc_lattice){ side, cells > 0 ? cells : 1, 0 };
}

hc_octave hc_make_octave(int width, int height, double cell_texels, uint64_t key)
{
    /* Offsets keep the zeros of the octaves, which lie on lattice points, from coinciding. */
    const uint64_t bits     = hc_hash(key, 0, 0);
    const int      offset_u = (int)((bits & 0xFFFFFFFFU) % (2 * (uint64_t)width));
    const int      offset_v = (int)((bits >> 32) % (2 * (uint64_t)height));
    return (hc_octave){ .key = hc_hash(key, 1, 0),
                        .u   = { width, hc_cells_along(width, cell_texels), offset_u },
                        .v   = { height, hc_cells_along(height, cell_texels), offset_v } };
}

static float fade(float t)
{
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

/* The noise along one lattice column within a row of texels: value + slope * (distance from it). */
typedef struct column {
    float value, slope;
} column;

/* Where a row of texels runs through the lattice. */
typedef struct row_place {
    int   above, below; /* lattice rows           */
    float down, fade;   /* from the one above: 0..1 */
} row_place;

static column find_column(const hc_octave *octave, const row_place *row, int cell)
{
    const float *above       = gradients[hc_hash(octave->key, cell, row->above) >> 60];
    const float *below       = gradients[hc_hash(octave->key, cell, row->below) >> 60];
    const float  value_above = above[1] * row->down;
    const float  value_below = below[1] * (row->down - 1.0F);
    return (column){ value_above + (value_below - value_above) * row->fade,
                     above[0] + (below[0] - above[0]) * row->fade };
}

static void add_cell(float *run, int count, int numerator, const hc_lattice *lattice, column left,
                     column right, float amplitude)
{
    const float scale = 1.0F / (float)(2 * lattice->side);
    const int   step  = 2 * lattice->cells;
    for (int i = 0; i < count; i++) {
        const float t          = (float)(numerator + i * step) * scale;
        const float from_left  = left.value + left.slope * t;
        const float from_right = right.value + right.slope * (t - 1.0F);
        run[i] += amplitude * (from_left + (from_right - from_left) * fade(t));
    }
}

void hc_add_octave(float *run, const hc_octave *octave, int x, int y, int count, float amplitude)
{
    const hc_place  down = hc_lattice_place(&octave->v, y);
    const float     t    = (float)down.numerator / (float)(2 * octave->v.side);
    const row_place row  = { down.cell, hc_lattice_beside(&octave->v, down.cell, 1), t, fade(t) };
    hc_place        at   = hc_lattice_place(&octave->u, x);
    column          left = find_column(octave, &row, at.cell);
    for (int done = 0; done < count;) {
        const int    next   = hc_lattice_beside(&octave->u, at.cell, 1);
        const column right  = find_column(octave, &row, next);
        const int    texels = hc_lattice_count(&octave->u, at, count - done);
        add_cell(run + done, texels, at.numerator, &octave->u, left, right, amplitude);
        at.numerator += 2 * (texels * octave->u.cells - octave->u.side);
        at.cell = next;
        left    = right;
        done += texels;
    }
}

hc_fractal hc_make_fractal(int width, int height, double cells, int most, uint64_t key)
{
    hc_fractal fractal = { 0 };
    double     texels  = (width > height ? width : height) / cells;
    do {
        const uint64_t octave_key         = hc_stream(key, fractal.octaves);
        fractal.octave[fractal.octaves++] = hc_make_octave(width, height, texels, octave_key);
        texels *= 0.5;
    } while (texels >= 2.0 && fractal.octaves < most);
    return fractal;
}

void hc_fractal_run(float *run, const hc_fractal *fractal, int x, int y, int count)
{
    for (int i = 0; i < count; i++) {
        run[i] = 0.0F;
    }
    float amplitude = 1.0F;
    for (int k = 0; k < fractal->octaves; k++) {
        hc_add_octave(run, &fractal->octave[k], x, y, count, amplitude);
        amplitude *= 0.5F;
    }
}
