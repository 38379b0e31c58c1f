/* What the fast caster holds, and the ray as its parts see it. docs/algorithms.md, "Fast rays", has
 * the proofs. */
#ifndef HC_TRACE_FAST_DATA_H
#define HC_TRACE_FAST_DATA_H

#include "fast.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#define ALWAYS_INLINE inline __attribute__((always_inline))

/* Blocks of level k are 2 * 4^k cells wide: 2^20 is the widest field. */
enum { HC_FAST_LEVELS = 10, HC_FAST_RATIO_BITS = 2, HC_FAST_BASE_BITS = 1 };

/* Slopes are floats of five bits exponent and three bits mantissa, from 2^-30 to 3.75. */
enum { HC_FAST_SLOPE_SHIFT = 20, HC_FAST_SLOPE_BIAS = 97 << 23 };

/* Four rows of heights, or of blocks, stand together, value by value, so that a cache line is a
 * square. */
enum { HC_FAST_HEIGHT_BITS = 2, HC_FAST_BLOCK_BITS = 2 };

/* Where few things stand on a flat ground a slope is a power of two, four bits from 2^-11 to 2^4,
 * and the other four say how far nothing beyond the block is higher than it: so many times its
 * side. */
enum { HC_FAST_SPARSE_SHIFT = 23, HC_FAST_SPARSE_BIAS = 116 << 23, HC_FAST_FREE_BITS = 4 };

/* Heights are read that many rows and columns at once, where rays stand next to each other. */
enum { HC_FAST_WINDOW = 8 };

/* Towers are listed by bins of so many cells a side. */
enum { HC_FAST_BIN = 64 };

/* A block of cells as rays of a quadrant (+u +v, -u +v, +u -v, -u -v) see it: a float above the
 * surface on it, whose last eight bits are the slope within which the surface beyond the block
 * stays below a cone around it. */
typedef uint32_t hc_fast_block;
enum { HC_FAST_CODE = 0xff };

/* One axis of the cell grid: cell i lies between coordinates i and i + 1. */
typedef struct hc_fast_axis {
    int    cells;
    int    first;        /* sample at coordinate 0                 */
    int    samples;      /* of the field                           */
    bool   wrapped;      /* coordinates repeat after `cells`       */
    double low, high;    /* the field's ends                       */
    double scale, shift; /* coordinate = scale * (ray's) + shift   */
    double step, zero;   /* (u or v) = step * (coordinate - zero)  */
} hc_fast_axis;

/* What is higher than the floor of sparse ground: boxes that hold the corners next to each other
 * that are, by their middles and wider sides in half cells, and their heights above the floor.
 * Those that a ray over bin i may meet are bins[i] .. bins[i + 1] - 1; around the field stands a
 * frame of bins, row by row. */
typedef struct hc_fast_towers {
    bool      listed; /* they are few everywhere, nothing repeats, no side is open */
    float     floor;  /* and what marching keeps above it               */
    int       bins_x, bins_y;
    uint32_t  most; /* entries */
    uint32_t *bins;
    float    *x, *y, *size, *rise;
} hc_fast_towers;

/* For which rays the ground is asked for ahead, by the size of heights and blocks: none where the
 * second-level cache holds them; those that climb, from the ground most often, and so are sure to
 * need it, where the last one does not; otherwise all. */
typedef enum hc_fast_ask { HC_FAST_ASK_NOTHING, HC_FAST_ASK_CLIMBING, HC_FAST_ASK_ALL } hc_fast_ask;

struct hc_fast {
    const hc_tracer *tracer; /* that it is part of */

    hc_fast_axis x, y;
    double       scale_z, shift_z; /* normalised height of a ray's height */
    double       highest;
    bool         steps, open_sides;
    bool         sparse; /* few things on a flat ground */
    hc_isa       isa;
    hc_fast_ask  ask;
    float        blur;  /* [cells] by which marching may misplace a ray              */
    float        slack; /* [height] by which looks may misjudge the gap to a patch   */
    float        least; /* [height] that marching keeps above a surface in any case  */

    /* (x.cells + 1) * (y.cells + 1) corners: hc_fast_corner */
    int    stride_heights;
    int    last_window[2]; /* of heights, HC_FAST_WINDOW a side: where it begins; below 0: none */
    float *heights;

    /* The lowest heights of squares of 2^low_bits cells a side, in steps of 2^-16 and two in a
     * word, row by row, few enough for the second-level cache: rays that ask for any hit are looked
     * at there first. stride_lows, in words, is 0 and there are none on sparse and on rough ground,
     * where they say little, and where rays have other things to see to (hc_fast_plain). */
    int       low_bits, stride_lows, rows_lows;
    uint32_t *lows;

    /* All levels, the finest first: hc_fast_block_at; and so for each quadrant. Each level has one
     * more block at the ends of its rows, and one more row: rays at an edge may be put beyond
     * it. */
    int            levels, first_level;   /* where marching begins            */
    int32_t        plane;                 /* blocks of a quadrant             */
    int32_t        stride[16], start[16]; /* of levels; 16 for one vector register */
    hc_fast_block *blocks;

    hc_fast_towers towers;
};

static inline int hc_fast_lesser(int a, int b)
{
    return a < b ? a : b;
}

/* Cells along a side of a level's blocks, and blocks along an axis without the one more. */
static inline int hc_fast_block_side(int level)
{
    return 1 << (HC_FAST_BASE_BITS + HC_FAST_RATIO_BITS * level);
}

static inline int hc_fast_block_count(const hc_fast_axis *axis, int level)
{
    const int side = hc_fast_block_side(level);
    return (axis->cells + side - 1) / side;
}

/* One period, closed sides, patches: rays have nothing to see to on their way. */
static inline bool hc_fast_plain(const hc_fast *fast)
{
    return !fast->steps && !fast->open_sides && !fast->x.wrapped && !fast->y.wrapped;
}

/* Where the height of a corner stands; where a block does, from the start of its level on. */
static inline size_t hc_fast_corner(const hc_fast *fast, int x, int y)
{
    return (((size_t)(y >> HC_FAST_HEIGHT_BITS) * (size_t)fast->stride_heights + (size_t)x)
            << HC_FAST_HEIGHT_BITS)
           + (size_t)(y & ((1 << HC_FAST_HEIGHT_BITS) - 1));
}

static inline size_t hc_fast_block_at(const hc_fast *fast, int level, int x, int y)
{
    return (((size_t)(y >> HC_FAST_BLOCK_BITS) * (size_t)fast->stride[level] + (size_t)x)
            << HC_FAST_BLOCK_BITS)
           + (size_t)(y & ((1 << HC_FAST_BLOCK_BITS) - 1));
}

/* Later hits round to infinity as floats. */
static const double HC_FAST_T_MAX = 0x1.fffffefffffffp127;

typedef struct hc_fast_found {
    double   t;
    double   cell_x, cell_y; /* not yet wrapped */
    uint32_t flags;
} hc_fast_found;

/* A ray in cell coordinates, cut to where it can hit. Double: what comes out of it does not depend
 * on how the marching found the place. */
typedef struct hc_fast_ray {
    double        origin[3], direction[3], inverse[2];
    double        from, to; /* t, less t0 */
    double        t0;
    double        turns[2]; /* periods to be added to u and v                               */
    bool          inside;   /* the ray itself starts at `from`, not at an edge of the field */
    bool          begun;    /* at `from` it is above the surface, and at no side            */
    hc_fast_found at_once;  /* where it hits, if it is not to be marched               */
} hc_fast_ray;

/* Cells that it goes sideways per t. */
static inline double hc_fast_run(const hc_fast_ray *r)
{
    return fabs(r->direction[0]) + fabs(r->direction[1]);
}

/* Fill heights and blocks. */
hc_result hc_fast_build(hc_fast *fast, const hc_field *field, int threads, hc_log *log);

/* Squares of how many cells have their lowest heights kept: returns the words that these take. Find
 * them, where they are of use. */
size_t hc_fast_plan_lows(hc_fast *fast);
void   hc_fast_find_lows(hc_fast *fast, int threads, hc_log *log);

/* The room that towers take, in words; what they make of it; list them. */
size_t hc_fast_plan_towers(hc_fast *fast);
void   hc_fast_place_towers(hc_fast *fast, uint32_t *room);
void   hc_fast_list_towers(hc_fast *fast);

typedef enum hc_fast_fate { HC_FAST_MISSES, HC_FAST_HITS, HC_FAST_MARCHES } hc_fast_fate;

/* Begin a ray as the other methods do: for those that may come in under the surface through an open
 * side, and those that reach a repeating field so far away that rounding loses their place. */
hc_fast_fate hc_fast_enter(hc_fast_ray *r, const hc_fast *fast, const hc_ray *ray);

typedef struct hc_fast_answer {
    hc_hit  *hits; /* or NULL */
    uint8_t *any;  /* or NULL */
} hc_fast_answer;

typedef void  hc_fast_march(const hc_fast *fast, hc_fast_answer answer, const hc_ray *rays,
                            size_t count);
hc_fast_march hc_fast_march_one, hc_fast_march_scalar, hc_fast_march_avx2, hc_fast_march_avx512;

#endif
