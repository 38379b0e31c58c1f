#include "blocks.h"

#include "terrain.h"

#include "../vec.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HIDDEN = -1 }; /* a level */

/* ---- what coarse blocks get wrong ------------------------------------------------------------ */

static float sample_at(const hc_field *field, int x, int y)
{
    return field->heights[(size_t)y * (size_t)field->width + (size_t)x];
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* A square of a block as it is drawn, cut at the field's last samples. */
typedef struct square {
    int   x, y, next_x, next_y;
    float heights[4]; /* of (x, y), (next_x, y), (x, next_y), (next_x, next_y) */
} square;

static square square_at(const hc_field *field, int x, int y, int step)
{
    square s     = { .x      = x,
                     .y      = y,
                     .next_x = least(x + step, field->width - 1),
                     .next_y = least(y + step, field->height - 1) };
    s.heights[0] = sample_at(field, s.x, s.y);
    s.heights[1] = sample_at(field, s.next_x, s.y);
    s.heights[2] = sample_at(field, s.x, s.next_y);
    s.heights[3] = sample_at(field, s.next_x, s.next_y);
    return s;
}

/* Its two triangles meet from (next_x, y) to (x, next_y). */
static float height_in(const square *s, float across, float along)
{
    const float *h = s->heights;
    return across + along <= 1.0F
               ? h[0] + across * (h[1] - h[0]) + along * (h[2] - h[0])
               : h[3] + (1.0F - across) * (h[2] - h[3]) + (1.0F - along) * (h[1] - h[3]);
}

static float square_error(const hc_field *field, const square *s)
{
    const float across = s->next_x > s->x ? 1.0F / (float)(s->next_x - s->x) : 0.0F;
    const float along  = s->next_y > s->y ? 1.0F / (float)(s->next_y - s->y) : 0.0F;
    float       error  = 0.0F;
    for (int y = s->y; y <= s->next_y; y++) {
        for (int x = s->x; x <= s->next_x; x++) {
            const float drawn = height_in(s, across * (float)(x - s->x), along * (float)(y - s->y));
            error             = fmaxf(error, fabsf(sample_at(field, x, y) - drawn));
        }
    }
    return error;
}

static float level_error(const hc_field *field, int left, int top, int level)
{
    const int right  = least(left + HC_BLOCK_SIDE, field->width);
    const int bottom = least(top + HC_BLOCK_SIDE, field->height);
    float     error  = 0.0F;
    for (int y = top; y < bottom; y += 1 << level) {
        for (int x = left; x < right; x += 1 << level) {
            const square s = square_at(field, x, y, 1 << level);
            error          = fmaxf(error, square_error(field, &s));
        }
    }
    return error;
}

static void find_range(hc_block *block, const hc_field *field, int left, int top)
{
    block->low  = INFINITY;
    block->high = -INFINITY;
    for (int y = top; y <= least(top + HC_BLOCK_SIDE, field->height - 1); y++) {
        for (int x = left; x <= least(left + HC_BLOCK_SIDE, field->width - 1); x++) {
            block->low  = fminf(block->low, sample_at(field, x, y));
            block->high = fmaxf(block->high, sample_at(field, x, y));
        }
    }
}

typedef struct job {
    hc_blocks      *blocks;
    const hc_field *field;
} job;

static void fill_row(void *context, int row, int worker)
{
    const job *j = context;
    (void)worker;
    for (int column = 0; column < j->blocks->columns; column++) {
        hc_block *block = &j->blocks->blocks[row * j->blocks->columns + column];
        find_range(block, j->field, column * HC_BLOCK_SIDE, row * HC_BLOCK_SIDE);
        block->errors[0] = 0.0F;
        for (int level = 1; level < HC_BLOCK_LEVELS; level++) {
            block->errors[level] =
                fmaxf(block->errors[level - 1],
                      level_error(j->field, column * HC_BLOCK_SIDE, row * HC_BLOCK_SIDE, level));
        }
    }
}

static int blocks_of(int samples)
{
    return samples > 1 ? (samples - 2) / HC_BLOCK_SIDE + 1 : 1;
}

hc_result hc_blocks_make(hc_blocks *blocks, const hc_terrain *terrain, hc_log *log)
{
    const hc_field *field = &terrain->scene.field;
    *blocks = (hc_blocks){ .columns = blocks_of(field->width), .rows = blocks_of(field->height) };
    const size_t count = (size_t)blocks->columns * (size_t)blocks->rows;
    job          j     = { blocks, field };
    blocks->blocks     = malloc(count * sizeof *blocks->blocks);
    blocks->levels     = malloc(count * sizeof *blocks->levels);
    if (blocks->blocks == NULL || blocks->levels == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for %zu blocks of triangles", count);
    }
    return hc_parallel_for(blocks->rows, hc_threads_resolve(terrain->options.threads), fill_row, &j,
                           terrain->options.progress, log);
}

void hc_blocks_free(hc_blocks *blocks)
{
    free(blocks->blocks);
    free(blocks->levels);
}

/* ---- what an eye sees ------------------------------------------------------------------------ */

typedef struct box {
    double low[3], high[3];
} box;

static box box_of(const hc_blocks *blocks, const hc_terrain *terrain, int index)
{
    const hc_placement *p     = &terrain->placement;
    const hc_field     *field = &terrain->scene.field;
    const hc_block     *block = &blocks->blocks[index];
    const int           left  = index % blocks->columns * HC_BLOCK_SIDE;
    const int           top   = index / blocks->columns * HC_BLOCK_SIDE;
    const double        right = least(left + HC_BLOCK_SIDE, field->width - 1);
    const double        foot  = least(top + HC_BLOCK_SIDE, field->height - 1);
    return (box){ .low  = { p->offset[0] + p->spacing_x * left, p->offset[1] + p->spacing_y * foot,
                            p->offset[2] + p->scale_z * (double)block->low },
                  .high = { p->offset[0] + p->spacing_x * right, p->offset[1] + p->spacing_y * top,
                            p->offset[2] + p->scale_z * (double)block->high } };
}

/* Is all of it where dot(normal, p - eye) < at_least? */
static bool is_beyond(const box *b, const hc_eye *eye, const double normal[3], double at_least)
{
    double most = 0.0;
    for (int k = 0; k < 3; k++) {
        most += normal[k] * ((normal[k] > 0.0 ? b->high[k] : b->low[k]) - eye->place[k]);
    }
    return most < at_least;
}

/* Beyond one of the planes through the picture's edges, or behind the eye. */
static bool is_out_of_view(const box *b, const hc_eye *eye)
{
    const double *edges[2] = { eye->right, eye->down };
    for (int i = 0; i < 4; i++) {
        const double *edge   = edges[i / 2];
        const double  length = hc_dot(edge, edge);
        const double  side   = i % 2 == 0 ? 1.0 / length : -1.0 / length;
        double        normal[3];
        for (int k = 0; k < 3; k++) {
            normal[k] = side * edge[k] + (eye->parallel ? 0.0 : eye->forward[k]);
        }
        if (is_beyond(b, eye, normal, eye->parallel ? -1.0 : 0.0)) {
            return true;
        }
    }
    return is_beyond(b, eye, eye->forward, 0.0);
}

static double distance_to(const box *b, const double point[3])
{
    double away[3];
    for (int k = 0; k < 3; k++) {
        away[k] = fmax(fmax(b->low[k] - point[k], point[k] - b->high[k]), 0.0);
    }
    return sqrt(hc_dot(away, away));
}

static int level_of(const hc_block *block, const box *b, const hc_terrain *terrain,
                    const hc_eye *eye)
{
    const double across = 2.0 * sqrt(hc_dot(eye->right, eye->right)) / eye->width;
    const double pixel  = across * (eye->parallel ? 1.0 : distance_to(b, eye->place));
    int          level  = 0;
    while (level + 1 < HC_BLOCK_LEVELS
           && (double)block->errors[level + 1] * terrain->placement.scale_z <= pixel) {
        level++;
    }
    return level;
}

static float error_at(const hc_blocks *blocks, int column, int row)
{
    const int index = row * blocks->columns + column;
    return column >= 0 && row >= 0 && column < blocks->columns && row < blocks->rows
                   && blocks->levels[index] != HIDDEN
               ? blocks->blocks[index].errors[blocks->levels[index]]
               : 0.0F;
}

/* A gap is at most what both sides of it get wrong. */
static float hem_of(const hc_blocks *blocks, int column, int row)
{
    const float beside =
        fmaxf(error_at(blocks, column - 1, row), error_at(blocks, column + 1, row));
    const float ahead = fmaxf(error_at(blocks, column, row - 1), error_at(blocks, column, row + 1));
    return error_at(blocks, column, row) + fmaxf(beside, ahead);
}

static int take_level(hc_block_place *places, const hc_blocks *blocks, int level)
{
    int count = 0;
    for (int i = 0; i < blocks->columns * blocks->rows; i++) {
        const int column = i % blocks->columns;
        const int row    = i / blocks->columns;
        if (blocks->levels[i] == level) {
            places[count++] =
                (hc_block_place){ (float)(column * HC_BLOCK_SIDE), (float)(row * HC_BLOCK_SIDE),
                                  hem_of(blocks, column, row) };
        }
    }
    return count;
}

void hc_blocks_choose(hc_block_place *places, int counts[HC_BLOCK_LEVELS], const hc_blocks *blocks,
                      const hc_terrain *terrain, const hc_eye *eye, bool lod)
{
    for (int i = 0; i < blocks->columns * blocks->rows; i++) {
        const box b       = box_of(blocks, terrain, i);
        blocks->levels[i] = !lod ? 0
                            : is_out_of_view(&b, eye)
                                ? HIDDEN
                                : level_of(&blocks->blocks[i], &b, terrain, eye);
    }
    for (int level = 0; level < HC_BLOCK_LEVELS; level++) {
        counts[level] = take_level(places, blocks, level);
        places += counts[level];
    }
}
