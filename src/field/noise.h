/* Randomness for made fields: integer hashing, and gradient noise that repeats over the field.
 *
 * Everything here uses + - * on integers and floats alone, in a fixed order, so that the same seed
 * gives the same bits on every machine. */
#ifndef HC_FIELD_NOISE_H
#define HC_FIELD_NOISE_H

#include <stdint.h>

/* Texels that are worked on at a time, so that intermediate values stay on the stack. */
enum { HC_RUN = 256 };

/* 64 well-mixed bits for a place. The finaliser is Stafford's variant 13 of MurmurHash3's. */
static inline uint64_t hc_hash(uint64_t key, int x, int y)
{
    uint64_t bits = key + (uint64_t)x * 0x9E3779B97F4A7C15U + (uint64_t)y * 0xD1B54A32D192ED03U;
    bits          = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9U;
    bits          = (bits ^ (bits >> 27)) * 0x94D049BB133111EBU;
    return bits ^ (bits >> 31);
}

/* Key of an independent stream of randomness below a seed. */
static inline uint64_t hc_stream(uint64_t seed, int stream)
{
    return hc_hash(hc_hash(seed, stream, 1), 0, 0);
}

/* 0 <= result < 1, from the topmost 24 bits: every value is a float. */
static inline float hc_unit(uint64_t bits)
{
    return (float)(bits >> 40) * 0x1p-24F;
}

static inline float hc_hash_unit(uint64_t key, int x, int y)
{
    return hc_unit(hc_hash(key, x, y));
}

/* `cells` <= `side` equal cells along an axis of `side` texels. Texel centres are counted in 1 /
 * (2 * side) of a cell, which keeps their places exact at every size. cells == 0: one endless
 * cell, all texels at the same place of it. */
typedef struct hc_lattice {
    int side, cells;
    int offset; /* 0 .. 2 * side - 1 */
} hc_lattice;

/* Place of a texel: `cell` 0 .. cells - 1, `numerator` / (2 * side) of the way through it. */
typedef struct hc_place {
    int cell, numerator;
} hc_place;

hc_place hc_lattice_place(const hc_lattice *lattice, int texel);

/* Texels from `place` on that lie in the same cell; at most `limit`. */
int hc_lattice_count(const hc_lattice *lattice, hc_place place, int limit);

/* The cell after (step 1) or before (step -1) `cell`, around the end. */
int hc_lattice_beside(const hc_lattice *lattice, int cell, int step);

/* Cells of about `texels` texels along a side: as many as fit, rounded, but no more than there are
 * texels; 0 if not even half of one fits. */
int hc_cells_along(int side, double texels);

/* Lattice of such cells, but of one at least, that begins at the first texel. */
hc_lattice hc_make_cells(int side, double texels);

/* One octave of gradient noise: about -0.7 .. 0.7, zero on average, period the whole field. */
typedef struct hc_octave {
    uint64_t   key;
    hc_lattice u, v;
} hc_octave;

hc_octave hc_make_octave(int width, int height, double cell_texels, uint64_t key);

/* run[i] += amplitude * noise at texel (x + i, y). */
void hc_add_octave(float *run, const hc_octave *octave, int x, int y, int count, float amplitude);

/* Octaves from `cells` cells along the longer side, each of half the size of the last, down to
 * cells of two texels or to `most`. */
enum { HC_OCTAVES_MAX = 20 };
typedef struct hc_fractal {
    int       octaves;
    hc_octave octave[HC_OCTAVES_MAX];
} hc_fractal;

hc_fractal hc_make_fractal(int width, int height, double cells, int most, uint64_t key);

/* run[i] = sum of the octaves at texel (x + i, y), the first times 1, each next one half as
 * much. */
void hc_fractal_run(float *run, const hc_fractal *fractal, int x, int y, int count);

#endif
