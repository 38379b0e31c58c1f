/* Making the fast caster: sizes, coordinates, the choice of kernel. */
#include "fast.h"

#include "fast_data.h"

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The coarsest level has at most so many blocks a side: the diagonals that fast_build.c looks at
 * reach across it. */
enum { COARSEST = 6 };

/* Rays begin on this level. */
enum { FIRST_LEVEL = 1 };

enum { QUADRANTS = 4 };

typedef struct layout {
    size_t heights, lows, blocks, towers; /* elements, blocks of a quadrant; words */
} layout;

static hc_fast_axis make_axis(int samples, double period, bool wrapped, bool posts,
                              const hc_trace_options *options, double spacing, double offset)
{
    const bool   steps = options->surface == HC_SURFACE_STEPS;
    const double zero  = (posts ? 0.0 : -0.5) + (steps ? 0.5 : wrapped ? 0.0 : 1.0);
    hc_fast_axis axis  = { .cells   = wrapped || (steps && !(posts && samples == 1)) ? samples
                                                                                     : samples + 1,
                           .first   = wrapped || steps ? 0 : -1,
                           .samples = samples,
                           .wrapped = wrapped,
                           .low     = zero,
                           .high    = zero + period,
                           .scale   = period,
                           .shift   = zero,
                           .step    = 1.0 / period,
                           .zero    = zero };
    if (options->placement.scale_z > 0.0) {
        const double first = zero + (posts ? 0.0 : 0.5); /* sample 0 */
        axis.scale         = 1.0 / spacing;
        axis.shift         = first - offset / spacing;
    }
    return axis;
}

static void set_axes(hc_fast *fast, const hc_field *field, const hc_trace_options *options)
{
    const hc_placement *place  = &options->placement;
    const bool          posts  = field->registration == HC_GRID;
    const bool          wrap_u = ((unsigned)field->wrap & HC_WRAP_U) != 0;
    const bool          wrap_v = ((unsigned)field->wrap & HC_WRAP_V) != 0;

    fast->x       = make_axis(field->width, 1.0 / hc_field_step_u(field), wrap_u, posts, options,
                              place->spacing_x, place->offset[0]);
    fast->y       = make_axis(field->height, 1.0 / hc_field_step_v(field), wrap_v, posts, options,
                              place->spacing_y, place->offset[1]);
    fast->scale_z = place->scale_z > 0.0 ? 1.0 / place->scale_z : 1.0;
    fast->shift_z = place->scale_z > 0.0 ? -place->offset[2] / place->scale_z : 0.0;
}

static const hc_fast_axis *longer_of(const hc_fast *fast)
{
    return fast->x.cells > fast->y.cells ? &fast->x : &fast->y;
}

/* Rows, filled up to those that stand together. */
static size_t rows_of(int rows, int bits)
{
    return (size_t)((rows + (1 << bits) - 1) >> bits) << bits;
}

/* Everything but the memory. */
static layout plan(hc_fast *fast, const hc_field *field, const hc_trace_options *options)
{
    *fast = (hc_fast){ .steps      = options->surface == HC_SURFACE_STEPS,
                       .open_sides = options->open_sides };
    set_axes(fast, field, options);
    const hc_fast_axis *longer = longer_of(fast);
    size_t              blocks = 0;
    int                 k;
    do {
        k               = fast->levels++;
        fast->stride[k] = hc_fast_block_count(&fast->x, k) + 1;
        fast->start[k]  = (int32_t)blocks;
        blocks += (size_t)fast->stride[k]
                  * rows_of(hc_fast_block_count(&fast->y, k) + 1, HC_FAST_BLOCK_BITS);
    } while (hc_fast_block_count(longer, k) > COARSEST);
    fast->plane          = (int32_t)blocks;
    fast->first_level    = fast->levels > FIRST_LEVEL ? FIRST_LEVEL : fast->levels - 1;
    fast->blur           = 0x1p-21F * (float)longer->cells;
    fast->stride_heights = fast->x.cells + 1;
    fast->last_window[0] = fast->stride_heights - HC_FAST_WINDOW;
    fast->last_window[1] = (fast->y.cells + 1 - HC_FAST_WINDOW) & ~((1 << HC_FAST_HEIGHT_BITS) - 1);
    return (layout){ (size_t)fast->stride_heights * rows_of(fast->y.cells + 1, HC_FAST_HEIGHT_BITS),
                     hc_fast_plan_lows(fast), blocks, hc_fast_plan_towers(fast) };
}

static float highest_of(const hc_field *field)
{
    const size_t count = (size_t)field->width * (size_t)field->height;
    float        most  = 0.0F;
    for (size_t i = 0; i < count; i++) {
        most = field->heights[i] > most ? field->heights[i] : most;
    }
    return most;
}

/* The lowest heights stand behind all others. */
static size_t height_bytes(const layout *sizes)
{
    return sizes->heights * sizeof(float) + sizes->lows * sizeof(uint32_t);
}

/* Towers stand behind the blocks, where the last page has room for most of them. */
static size_t block_bytes(const layout *sizes)
{
    return QUADRANTS * sizes->blocks * sizeof(hc_fast_block) + sizes->towers * sizeof(uint32_t);
}

/* Lanes count corners and blocks in 32 bits. */
static bool fits(const layout *sizes)
{
    return sizes->heights <= INT32_MAX && QUADRANTS * sizes->blocks <= INT32_MAX;
}

size_t hc_fast_bytes(const hc_field *field, const hc_trace_options *options)
{
    hc_fast      fast;
    const layout sizes = plan(&fast, field, options);
    return fits(&sizes) ? sizeof fast + hc_memory_taken(height_bytes(&sizes))
                              + hc_memory_taken(block_bytes(&sizes))
                        : 0;
}

/* By what caches of today hold: up to 3 MiB, 32 MiB. */
static hc_fast_ask find_ask(const layout *sizes)
{
    enum { SECOND = 3 << 20, LAST = 32 << 20 };
    const size_t bytes = height_bytes(sizes) + block_bytes(sizes);
    return bytes <= SECOND ? HC_FAST_ASK_NOTHING
           : bytes <= LAST ? HC_FAST_ASK_ALL
                           : HC_FAST_ASK_CLIMBING;
}

hc_result hc_fast_create(hc_fast **fast, const hc_tracer *tracer, const hc_field *field,
                         const hc_trace_options *options, hc_log *log)
{
    hc_fast *made = malloc(sizeof *made);
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a caster");
    }
    const layout sizes = plan(made, field, options);
    if (!fits(&sizes)) {
        free(made);
        return hc_fail(log, HC_ERROR_LIMIT,
                       "%d x %d samples are too many for fast: cut the field, or take maxmip",
                       field->width, field->height);
    }
    made->tracer  = tracer;
    made->isa     = hc_isa_resolve(options->isa);
    made->ask     = find_ask(&sizes);
    made->highest = (double)highest_of(field);
    made->heights = hc_take_memory(height_bytes(&sizes));
    made->blocks  = hc_take_memory(block_bytes(&sizes));
    if (made->heights != NULL) {
        made->lows = (uint32_t *)(made->heights + sizes.heights);
    }
    if (made->blocks != NULL) {
        hc_fast_place_towers(made, made->blocks + QUADRANTS * sizes.blocks);
    }
    hc_result result = made->heights != NULL && made->blocks != NULL
                           ? hc_fast_build(made, field, hc_threads_resolve(options->threads), log)
                           : hc_fail(log, HC_ERROR_MEMORY, "no memory for a caster");
    if (result != HC_OK) {
        hc_fast_destroy(made);
        return result;
    }
    *fast = made;
    return HC_OK;
}

void hc_fast_destroy(hc_fast *fast)
{
    if (fast != NULL) {
        free(fast->heights);
        free(fast->blocks);
        free(fast);
    }
}

/* What is decided is decided in double precision: rounding of rays 2^-30 of the field's sides away
 * from it, and what far origins add. The patch is solved in cell coordinates, so a ray is as good
 * as one moved by its rounding there. */
void hc_fast_tolerance(const hc_fast *fast, double *rise, double *reach)
{
    *rise  = 0x1p-30;
    *reach = 0x1p-30 * longer_of(fast)->cells;
}

/* Fewer rays than this are sooner done one by one than in sixteen lanes. */
enum { FEW = 5 };

static hc_fast_march *kernel_of(const hc_fast *fast, size_t count)
{
    if (count < FEW) {
        return hc_fast_march_one;
    }
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
    if (fast->isa == HC_ISA_AVX512) {
        return hc_fast_march_avx512;
    }
    if (fast->isa == HC_ISA_AVX2) {
        return hc_fast_march_avx2;
    }
#else
    (void)fast;
#endif
    return hc_fast_march_scalar;
}

/* Kernels count rays in 32 bits. */
static const size_t most_at_once = (size_t)1 << 30;

void hc_fast_nearest(const hc_fast *fast, hc_hit *hits, const hc_ray *rays, size_t count)
{
    for (size_t i = 0; i < count; i += most_at_once) {
        const size_t part = count - i < most_at_once ? count - i : most_at_once;
        kernel_of(fast, part)(fast, (hc_fast_answer){ .hits = hits + i }, rays + i, part);
    }
}

void hc_fast_any(const hc_fast *fast, uint8_t *any, const hc_ray *rays, size_t count)
{
    for (size_t i = 0; i < count; i += most_at_once) {
        const size_t part = count - i < most_at_once ? count - i : most_at_once;
        kernel_of(fast, part)(fast, (hc_fast_answer){ .any = any + i }, rays + i, part);
    }
}
