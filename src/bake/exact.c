/* Exact cone maps: the passes that each kind of cone needs, over all tiles. */
#include "exact.h"

#include "base/fail.h"
#include "base/parallel.h"
#include "canonical.h"

#include <stdlib.h>
#include <string.h>

/* ---- tables of weights ---- */

static bool in_quadrant(const hc_exact_pass *pass, int dx, int dy)
{
    return dx * pass->sign_u >= 0 && dy * pass->sign_v >= 0;
}

/* Weights by distance; 0 for the sample itself. */
typedef struct weights {
    float at[HC_NEAR_REACH + 4][HC_NEAR_REACH + 4]; /* [rows][columns] */
} weights;

static void find_weights(weights *w, const hc_exact_pass *pass)
{
    for (int y = 0; y < HC_NEAR_REACH + 4; y++) {
        for (int x = 0; x < HC_NEAR_REACH + 4; x++) {
            w->at[y][x] = pass->diamond ? hc_weight_l1(x, y, pass->step_u, pass->step_v)
                                        : hc_weight_l2(x, y, pass->step_u, pass->step_v);
        }
    }
    w->at[0][0] = 0.0F;
}

static void fill_table(hc_near_table *table, const hc_exact_pass *pass)
{
    weights w;
    find_weights(&w, pass);
    for (int dy = 0; dy <= HC_AROUND_REACH; dy++) {
        memcpy(table->around[dy], w.at[dy], sizeof table->around[dy]);
    }
    for (int column = 0; column < HC_NEAR_SIDE; column++) {
        for (int group = 0; group < HC_NEAR_GROUPS; group++) {
            for (int lane = 0; lane < 4; lane++) {
                const int dx = column - HC_NEAR_REACH - lane;
                const int dy = HC_NEAR_REACH + 3 - group;
                table->sample[column][group][lane] =
                    in_quadrant(pass, dx, dy) ? w.at[abs(dy)][abs(dx)] : 0.0F;
            }
        }
    }
}

/* ---- passes ---- */

static void set_passes(hc_exact_plan *plan, const hc_cone_job *job, const hc_cone_search *searches)
{
    for (int i = 0; i < plan->count; i++) {
        const hc_cone_search *search = &searches[i];
        plan->passes[i]              = (hc_exact_pass){ .tree    = &plan->tree,
                                                        .near    = &plan->tables[i],
                                                        .step_u  = search->step_u,
                                                        .step_v  = search->step_v,
                                                        .diamond = job->cones != HC_CONES_L2,
                                                        .sign_u  = search->sign_u,
                                                        .sign_v  = search->sign_v,
                                                        .wrap_u  = job->wrap_u,
                                                        .wrap_v  = job->wrap_v };
        fill_table(&plan->tables[i], &plan->passes[i]);
    }
}

static hc_exact_tile tile_kernel(hc_isa isa)
{
#if defined(__x86_64__) && !defined(HC_FORCE_SCALAR)
    if (isa == HC_ISA_AVX512) {
        return hc_exact_tile_avx512;
    }
    if (isa == HC_ISA_AVX2) {
        return hc_exact_tile_avx2;
    }
#endif
    (void)isa;
    return hc_exact_tile_scalar;
}

hc_result hc_exact_plan_init(hc_exact_plan *plan, const hc_cone_job *job)
{
    *plan = (hc_exact_plan){ .kernel = tile_kernel(job->isa), .cones = job->cones };
    hc_cone_search searches[HC_CONE_SEARCHES_MAX];
    plan->count         = hc_cone_searches(searches, job);
    const size_t n      = (size_t)plan->count;
    plan->tables        = aligned_alloc(64, n * sizeof *plan->tables);
    plan->scratch       = aligned_alloc(64, (size_t)job->threads * n * sizeof *plan->scratch);
    plan->scratch_count = (size_t)job->threads * n;
    if (plan->tables == NULL || plan->scratch == NULL) {
        hc_exact_plan_finish(plan);
        return hc_fail(job->log, HC_ERROR_MEMORY, "no memory for the tables of %zu searches", n);
    }
    hc_exact_plan_forget(plan);
    const hc_result built =
        hc_tree_build(&plan->tree, job->heights, job->width, job->height, job->threads, job->log);
    if (built != HC_OK) {
        hc_exact_plan_finish(plan);
        return built;
    }
    set_passes(plan, job, searches);
    return HC_OK;
}

void hc_exact_plan_finish(hc_exact_plan *plan)
{
    hc_tree_free(&plan->tree);
    free(plan->tables);
    free(plan->scratch);
    *plan = (hc_exact_plan){ 0 };
}

void hc_exact_plan_forget(hc_exact_plan *plan)
{
    memset(plan->scratch, 0, plan->scratch_count * sizeof *plan->scratch);
}

/* ---- tiles ---- */

enum { TILE_SAMPLES = HC_TILE_SIDE * HC_TILE_SIDE };

/* All of the tile at once, for vector code. */
static void find_ratios(float *ratios, const float *found)
{
    for (int i = 0; i < TILE_SAMPLES; i++) {
        ratios[i] = hc_ratio(found[i]);
    }
}

/* All channels of the tile's samples side by side. */
static void find_channels(float *ratios, const hc_exact_plan *plan, float (*found)[TILE_SAMPLES])
{
    if (plan->cones == HC_CONES_ANISO) {
        for (int s = 0; s < TILE_SAMPLES; s++) {
            float steepness[HC_ANISO_COUNT];
            for (int i = 0; i < HC_ANISO_COUNT; i++) {
                steepness[i] = found[i][s];
            }
            hc_aniso_choose(ratios + 3 * s, steepness);
        }
        return;
    }
    for (int i = 0; i < plan->count; i++) {
        float plain[TILE_SAMPLES];
        find_ratios(plain, found[i]);
        for (int s = 0; s < TILE_SAMPLES; s++) {
            ratios[s * plan->count + i] = plain[s];
        }
    }
}

void hc_exact_search_tile(const hc_exact_plan *plan, float *ratios, int tile_x, int tile_y,
                          int worker)
{
    float             found[HC_ANISO_COUNT][TILE_SAMPLES];
    hc_exact_scratch *scratch = &plan->scratch[worker * plan->count];
    for (int i = 0; i < plan->count; i++) {
        if (plan->cones == HC_CONES_ANISO) { /* much the same samples limit all five searches */
            scratch[i].recent = scratch[(i + plan->count - 1) % plan->count].recent;
        }
        plan->kernel(found[i], &plan->passes[i], tile_x, tile_y, &scratch[i]);
    }
    float        tile[4 * TILE_SAMPLES];
    const size_t channels = (size_t)hc_cones_channels(plan->cones);
    if (channels == 1) {
        find_ratios(tile, found[0]);
    } else {
        find_channels(tile, plan, found);
    }
    const int    x       = tile_x * HC_TILE_SIDE;
    const int    left    = plan->tree.width - x;
    const size_t columns = (size_t)(left < HC_TILE_SIDE ? left : HC_TILE_SIDE);
    for (int r = 0; r < HC_TILE_SIDE && tile_y * HC_TILE_SIDE + r < plan->tree.height; r++) {
        const size_t y    = (size_t)tile_y * HC_TILE_SIDE + (size_t)r;
        float       *to   = ratios + (y * (size_t)plan->tree.width + (size_t)x) * channels;
        const float *from = tile + (size_t)r * HC_TILE_SIDE * channels;
        memcpy(to, from, columns * channels * sizeof *to);
        hc_limit_ratios(to, columns * channels, plan->max_ratio);
    }
}

/* Tiles of a strip's row. Strips are narrow enough for what their tiles look at to stay in the
 * second-level cache from one row to the next. */
enum { STRIP_TILES = 32 };

/* Tiles that one thread does one after the other, so that it finds what it looks at in its own
 * cache: rows of a strip, fewer where they would not go round. */
enum { PIECE_ROWS = 32, PIECES_EACH = 16 };

typedef struct bake {
    const hc_exact_plan *plan;
    float               *ratios;
    int                  rows;                     /* of tiles            */
    int                  piece_rows, strip_pieces; /* of a piece; a strip */
} bake;

/* Every other row backwards: the next tile is nearly always a neighbour, whose first guesses are
 * good. */
static void bake_row(const bake *b, int strip, int row, int worker)
{
    const int tiles = (b->plan->tree.width + HC_TILE_SIDE - 1) / HC_TILE_SIDE;
    const int first = strip * STRIP_TILES;
    const int count = tiles - first < STRIP_TILES ? tiles - first : STRIP_TILES;
    for (int i = 0; i < count; i++) {
        const int tile_x = first + (row % 2 == 0 ? i : count - 1 - i);
        hc_exact_search_tile(b->plan, b->ratios, tile_x, row, worker);
    }
}

static void bake_piece(void *context, int item, int worker)
{
    const bake *b     = context;
    const int   first = item % b->strip_pieces * b->piece_rows;
    for (int row = first; row < first + b->piece_rows && row < b->rows; row++) {
        bake_row(b, item / b->strip_pieces, row, worker);
    }
}

hc_result hc_exact_plan_run(const hc_exact_plan *plan, const hc_cone_job *job)
{
    const int strip  = STRIP_TILES * HC_TILE_SIDE;
    const int strips = (job->width + strip - 1) / strip;
    const int rows   = (job->height + HC_TILE_SIDE - 1) / HC_TILE_SIDE;
    const int fair   = (int)((int64_t)strips * rows / (PIECES_EACH * job->threads));
    bake      b      = { .plan       = plan,
                         .ratios     = job->ratios,
                         .rows       = rows,
                         .piece_rows = fair < 1            ? 1
                                       : fair > PIECE_ROWS ? PIECE_ROWS
                                                           : fair };
    b.strip_pieces   = (rows + b.piece_rows - 1) / b.piece_rows;
    return hc_parallel_for(strips * b.strip_pieces, job->threads, bake_piece, &b, job->progress,
                           job->log);
}

hc_result hc_cone_exact(const hc_cone_job *job)
{
    hc_exact_plan plan;
    hc_result     result = hc_exact_plan_init(&plan, job);
    if (result == HC_OK) {
        result = hc_exact_plan_run(&plan, job);
        hc_exact_plan_finish(&plan);
    }
    return result;
}
