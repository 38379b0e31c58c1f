#include "judge.h"

#include "support.h"

#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RUN = 32, LANES = 16 };

/* One search: all directions (signs 0) or one quadrant. */
typedef struct judge {
    const hc_field *field;
    bool            round;
    int             sign_u, sign_v;
    int             channel, channels;
    int             first, step; /* rows judged */
    float          *ratios;
    const float    *claimed;
    int             runs, bands; /* of RUN samples in a row; of RUN rows                          */
    float          *weight;     /* [row distance][column offset + width - 1]: 0 where none counts */
    float          *run_weight; /* largest of RUN offsets from that one on                        */
    float          *far_weight; /* largest of the row distance, and of all larger ones            */
    float          *run_top, *band_top;
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
    for (int i = 0; i < j->bands * j->runs; i++) {
        j->band_top[i] = 0.0F;
    }
    for (int y = 0; y < j->field->height; y++) {
        const float *row   = j->field->heights + (ptrdiff_t)y * width;
        float       *tops  = j->run_top + (ptrdiff_t)y * j->runs;
        float       *above = j->band_top + (ptrdiff_t)(y / RUN) * j->runs;
        for (int run = 0; run < j->runs; run++) {
            tops[run] = row[run * RUN];
            for (int x = run * RUN; x < (run + 1) * RUN && x < width; x++) {
                tops[run] = larger(tops[run], row[x]);
            }
            above[run] = larger(above[run], tops[run]);
        }
    }
}

static void fill_far_weights(judge *j)
{
    const ptrdiff_t pitch = 2 * (ptrdiff_t)j->field->width;
    const ptrdiff_t last  = (j->field->height - 1) * pitch;
    memcpy(j->far_weight + last, j->run_weight + last, (size_t)pitch * sizeof *j->far_weight);
    for (ptrdiff_t i = last - 1; i >= 0; i--) {
        j->far_weight[i] = larger(j->run_weight[i], j->far_weight[i + pitch]);
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

/* One texel against a run of samples, row by row of a band. */
static float look_at_band(const judge *j, int band, int run, int y, int x, float best)
{
    const int   width  = j->field->width;
    const int   first  = run * RUN;
    const int   count  = first + RUN < width ? RUN : width - first;
    const int   end    = (band + 1) * RUN;
    const int   last   = end < j->field->height ? end : j->field->height;
    const bool  wraps  = (j->field->wrap & HC_WRAP_V) != 0;
    const float height = j->field->heights[(ptrdiff_t)y * width + x];
    for (int row = band * RUN; row < last; row++) {
        const int       rows = nearest(row - y, j->field->height, wraps, j->sign_v);
        const ptrdiff_t from = (ptrdiff_t)rows * 2 * width + width - 1 - x + first;
        const float     top  = j->run_top[(ptrdiff_t)row * j->runs + run];
        if (rows >= 0 && (top - height) * j->run_weight[from] > best) {
            const float *others = j->field->heights + (ptrdiff_t)row * width + first;
            best                = scan(others, j->weight + from, count, height, best);
        }
    }
    return best;
}

/* Least distance of a row to those of a band, or -1 if none of them is asked for. */
static int band_distance(const judge *j, int band, int y)
{
    const bool wraps = (j->field->wrap & HC_WRAP_V) != 0;
    int        least = -1;
    for (int row = band * RUN; row < (band + 1) * RUN && row < j->field->height; row++) {
        const int rows = nearest(row - y, j->field->height, wraps, j->sign_v);
        least          = rows >= 0 && (least < 0 || rows < least) ? rows : least;
    }
    return least;
}

/* RUN texels of a row, from x on, against a run of samples of a band that is `rows` away. */
static void compare(const judge *j, float *best, int x, int y, int band, int run, int rows)
{
    const int    width   = j->field->width;
    const int    count   = x + RUN < width ? RUN : width - x;
    const float *heights = j->field->heights + (ptrdiff_t)y * width + x;
    const float *weights = j->far_weight + (ptrdiff_t)rows * 2 * width + width - 1 - x + run * RUN;
    const float  top     = j->band_top[band * j->runs + run];
    int          open    = 0;
    for (int i = 0; i < count; i++) {
        open += (top - heights[i]) * weights[-i] > best[x + i];
    }
    for (int i = 0; i < count && open > 0; i++) {
        if ((top - heights[i]) * weights[-i] > best[x + i]) {
            best[x + i] = look_at_band(j, band, run, y, x + i, best[x + i]);
            open--;
        }
    }
}

/* Less steep than what gives the ratio that is claimed, by eight units in the last place. */
static float begin_at(const judge *j, ptrdiff_t texel)
{
    const float slope = (1.0F - 0x1p-19F) / j->claimed[texel * j->channels + j->channel];
    return slope > 0.0F ? slope : 0.0F;
}

static void judge_row(void *context, int item, int worker)
{
    const judge *j     = context;
    const int    y     = j->first + item * j->step;
    const int    width = j->field->width;
    float       *best  = j->best + (ptrdiff_t)worker * width;
    for (int x = 0; x < width; x++) {
        best[x] = begin_at(j, (ptrdiff_t)y * width + x);
    }
    for (int band = 0; band < j->bands; band++) {
        const int rows = band_distance(j, band, y);
        for (int run = 0; run < j->runs && rows >= 0; run++) {
            for (int x = 0; x < width; x += RUN) {
                compare(j, best, x, y, band, run, rows);
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
    j->bands               = (j->field->height + RUN - 1) / RUN;
    j->weight              = floats(height * 2 * width);
    j->run_weight          = floats(height * 2 * width);
    j->far_weight          = floats(height * 2 * width);
    j->run_top             = floats(height * (size_t)j->runs);
    j->band_top            = floats((size_t)j->bands * (size_t)j->runs);
    j->best                = floats((size_t)threads * width);
    const hc_progress none = { .report = NULL };
    (void)hc_parallel_for(j->field->height, threads, fill_weights, j, none, NULL);
    fill_far_weights(j);
    fill_tops(j);
    const int judged = (j->field->height - j->first + j->step - 1) / j->step;
    (void)hc_parallel_for(judged, threads, judge_row, j, none, NULL);
    free(j->weight);
    free(j->run_weight);
    free(j->far_weight);
    free(j->run_top);
    free(j->band_top);
    free(j->best);
}

void agree_judge_rows(float *ratios, const float *claimed, const hc_field *field, hc_cones cones,
                      int first, int step)
{
    judge j = { .field    = field,
                .round    = cones == HC_CONES_L2,
                .channels = hc_cones_channels(cones),
                .first    = first,
                .step     = step,
                .ratios   = ratios,
                .claimed  = claimed };
    assert_true(cones != HC_CONES_ANISO);
    for (j.channel = 0; j.channel < j.channels; j.channel++) {
        if (cones == HC_CONES_QUAD) {
            j.sign_u = j.channel % 2 == 0 ? 1 : -1;
            j.sign_v = j.channel / 2 == 0 ? 1 : -1;
        }
        search(&j);
    }
}
