#include "judge.h"

#include "support.h"

#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>

enum { RUN = 32, LANES = 16 };

/* One search: all directions (signs 0) or one quadrant. */
typedef struct judge {
    const hc_field *field;
    bool            round;
    int             sign_u, sign_v;
    int             channel, channels;
    int             first, step; /* rows judged */
    float          *ratios;
    int             runs;       /* in a row                                                       */
    float          *weight;     /* [row distance][column offset + width - 1]: 0 where none counts */
    float          *run_weight; /* largest of RUN offsets from that one on                        */
    float          *row_weight; /* largest of the row distance, and of all larger ones            */
    float          *run_top, *row_top;
    float           top;
    float          *best; /* rows of `width`, one a worker */
} judge;

static float larger(float a, float b)
{
    return a > b ? a : b;
}

/* Samples to the nearest image on the side asked for, or -1. */
static int nearest(int offset, int size, bool wraps, int sign)
{
    if (sign != 0) {
        const int ahead = offset * sign;
        return ahead >= 0 ? ahead : wraps ? ahead + size : -1;
    }
    const int apart = abs(offset);
    return wraps && size - apart < apart ? size - apart : apart;
}

static float weight_of(const judge *j, int columns, int rows)
{
    const float x = (float)columns * (float)hc_field_step_u(j->field);
    const float y = (float)rows * (float)hc_field_step_v(j->field);
    if (columns < 0 || (columns == 0 && rows == 0)) {
        return 0.0F;
    }
    return j->round ? 1.0F / sqrtf(x * x + y * y) : 1.0F / (x + y);
}

static void fill_weights(void *context, int rows, int worker)
{
    (void)worker;
    const judge *j     = context;
    const int    width = j->field->width;
    const bool   wraps = (j->field->wrap & HC_WRAP_U) != 0;
    float       *row   = j->weight + (ptrdiff_t)rows * 2 * width;
    float       *runs  = j->run_weight + (ptrdiff_t)rows * 2 * width;
    for (int offset = 1 - width; offset < width; offset++) {
        row[offset + width - 1] = weight_of(j, nearest(offset, width, wraps, j->sign_u), rows);
    }
    row[2 * width - 1] = 0.0F;
    for (int first = 0; first < 2 * width; first++) {
        runs[first] = 0.0F;
        for (int i = first; i < first + RUN && i < 2 * width; i++) {
            runs[first] = larger(runs[first], row[i]);
        }
    }
}

static void fill_tops(judge *j)
{
    const int width = j->field->width;
    for (int y = 0; y < j->field->height; y++) {
        const float *row  = j->field->heights + (ptrdiff_t)y * width;
        float       *tops = j->run_top + (ptrdiff_t)y * j->runs;
        j->row_top[y]     = row[0];
        for (int run = 0; run < j->runs; run++) {
            tops[run] = row[run * RUN];
            for (int x = run * RUN; x < (run + 1) * RUN && x < width; x++) {
                tops[run] = larger(tops[run], row[x]);
            }
            j->row_top[y] = larger(j->row_top[y], tops[run]);
        }
        j->top = larger(j->top, j->row_top[y]);
    }
}

static void fill_row_weights(judge *j)
{
    const int width       = j->field->width;
    float     larger_ones = 0.0F;
    for (int rows = j->field->height - 1; rows >= 0; rows--) {
        for (int i = 0; i < 2 * width; i++) {
            larger_ones = larger(larger_ones, j->weight[(ptrdiff_t)rows * 2 * width + i]);
        }
        j->row_weight[rows] = larger_ones;
    }
}

/* Element by element in a few lanes, which compilers turn into vectors. */
static float scan(const float *others, const float *weights, int count, float height, float best)
{
    float lanes[LANES];
    for (int i = 0; i < LANES; i++) {
        lanes[i] = best;
    }
    int at = 0;
    for (; at + LANES <= count; at += LANES) {
        for (int i = 0; i < LANES; i++) {
            lanes[i] = larger((others[at + i] - height) * weights[at + i], lanes[i]);
        }
    }
    for (; at < count; at++) {
        lanes[0] = larger((others[at] - height) * weights[at], lanes[0]);
    }
    for (int i = 0; i < LANES; i++) {
        best = larger(lanes[i], best);
    }
    return best;
}

static float look_at_row(const judge *j, int row, int rows, int x, float height, float best)
{
    const int    width  = j->field->width;
    const float *others = j->field->heights + (ptrdiff_t)row * width;
    const float *tops   = j->run_top + (ptrdiff_t)row * j->runs;
    const float *from_x = j->weight + (ptrdiff_t)rows * 2 * width + width - 1 - x;
    const float *run_x  = j->run_weight + (ptrdiff_t)rows * 2 * width + width - 1 - x;
    for (int run = 0; run < j->runs; run++) {
        const int first = run * RUN;
        if ((tops[run] - height) * run_x[first] > best) {
            const int count = first + RUN < width ? RUN : width - first;
            best            = scan(others + first, from_x + first, count, height, best);
        }
    }
    return best;
}

/* One row of samples against another, `rows` away. */
static void compare_rows(const judge *j, float *best, int y, int row, int rows)
{
    const float *heights = j->field->heights + (ptrdiff_t)y * j->field->width;
    const float  top     = j->row_top[row];
    const float  weight  = j->row_weight[rows];
    for (int x = 0; x < j->field->width; x++) {
        if ((top - heights[x]) * weight > best[x]) {
            best[x] = look_at_row(j, row, rows, x, heights[x], best[x]);
        }
    }
}

static bool all_are_done(const judge *j, const float *best, int y, int rows)
{
    const float *heights = j->field->heights + (ptrdiff_t)y * j->field->width;
    int          open    = 0;
    for (int x = 0; x < j->field->width; x++) {
        open += (j->top - heights[x]) * j->row_weight[rows] > best[x];
    }
    return open == 0;
}

static void judge_row(void *context, int item, int worker)
{
    const judge *j      = context;
    const int    y      = j->first + item * j->step;
    const int    width  = j->field->width;
    const int    height = j->field->height;
    const bool   wraps  = (j->field->wrap & HC_WRAP_V) != 0;
    float       *best   = j->best + (ptrdiff_t)worker * width;
    for (int x = 0; x < width; x++) {
        best[x] = 0.0F;
    }
    for (int rows = 0; rows < height && !all_are_done(j, best, y, rows); rows++) {
        for (int row = 0; row < height; row++) {
            if (nearest(row - y, height, wraps, j->sign_v) == rows) {
                compare_rows(j, best, y, row, rows);
            }
        }
    }
    for (int x = 0; x < width; x++) {
        const float ratio = 1.0F / best[x];
        j->ratios[((ptrdiff_t)y * width + x) * j->channels + j->channel] =
            ratio > 0x1p60F ? INFINITY : ratio * (1.0F - 0x1p-20F);
    }
}

static float *floats(size_t count)
{
    float *made = malloc(count * sizeof *made);
    assert_non_null(made);
    return made;
}

static void search(judge *j)
{
    const size_t width     = (size_t)j->field->width;
    const size_t height    = (size_t)j->field->height;
    const int    threads   = hc_threads_resolve(0);
    j->runs                = (j->field->width + RUN - 1) / RUN;
    j->weight              = floats(height * 2 * width);
    j->run_weight          = floats(height * 2 * width);
    j->row_weight          = floats(height);
    j->run_top             = floats(height * (size_t)j->runs);
    j->row_top             = floats(height);
    j->best                = floats((size_t)threads * width);
    const hc_progress none = { .report = NULL };
    (void)hc_parallel_for(j->field->height, threads, fill_weights, j, none, NULL);
    fill_row_weights(j);
    fill_tops(j);
    const int judged = (j->field->height - j->first + j->step - 1) / j->step;
    (void)hc_parallel_for(judged, threads, judge_row, j, none, NULL);
    free(j->weight);
    free(j->run_weight);
    free(j->row_weight);
    free(j->run_top);
    free(j->row_top);
    free(j->best);
}

void agree_judge_rows(float *ratios, const hc_field *field, hc_cones cones, int first, int step)
{
    judge j = { .field    = field,
                .round    = cones == HC_CONES_L2,
                .channels = hc_cones_channels(cones),
                .first    = first,
                .step     = step,
                .ratios   = ratios };
    assert_true(cones != HC_CONES_ANISO);
    for (j.channel = 0; j.channel < j.channels; j.channel++) {
        if (cones == HC_CONES_QUAD) {
            j.sign_u = j.channel % 2 == 0 ? 1 : -1;
            j.sign_v = j.channel / 2 == 0 ? 1 : -1;
        }
        search(&j);
    }
}
