/* Filling holes in linear time.
 *
 * A distance transform in two sweeps gives every hole its Chebyshev distance d to the nearest
 * valid height. The square of radius d around the hole then holds valid heights on its rim only,
 * so their sum and count are those of the whole square, and a summed-area table gives both at
 * once however large d is. */
#include "holes.h"

#include "base/fail.h"

#include <stdlib.h>

/* Heights in the table are multiples of 2^-41: exact for all floats from 2^-17 up. Entries may
 * wrap around, differences of them may not: a rim has less than 2^22 samples. */
#define TABLE_ONE 0x1p41

typedef struct rect {
    int left, top, right, bottom; /* inclusive */
} rect;

typedef struct table {
    rect      area;
    size_t    pitch; /* entries per row: one more than the area has columns */
    uint64_t *sums;  /* entry (i, j): of all samples above and left of it   */
    uint32_t *counts;
} table;

/* Distance of a sample as the sweeps keep it: holes as -distance, in place of the height they
 * lack. */
static float distance_of(float sample)
{
    return sample < 0.0F ? -sample : 0.0F;
}

static float nearer(float distance, float neighbour)
{
    const float through = distance_of(neighbour) + 1.0F;
    return through < distance ? through : distance;
}

/* One row of a sweep: `beside` is -1 or 1, the side already swept; `before` the row already
 * swept, or NULL. */
static void sweep_row(float *row, const float *before, int width, int beside)
{
    for (int i = 0; i < width; i++) {
        const int x = beside < 0 ? i : width - 1 - i;
        if (row[x] >= 0.0F) {
            continue;
        }
        float distance = distance_of(row[x]);
        if (i > 0) {
            distance = nearer(distance, row[x + beside]);
        }
        for (int k = x > 0 ? x - 1 : 0; before != NULL && k <= x + 1 && k < width; k++) {
            distance = nearer(distance, before[k]);
        }
        row[x] = -distance;
    }
}

static void measure_distances(float *heights, int width, int height)
{
    const size_t samples = (size_t)width * (size_t)height;
    for (size_t i = 0; i < samples; i++) {
        if (heights[i] < 0.0F) {
            heights[i] = -(float)HC_SIDE_MAX;
        }
    }
    for (int y = 0; y < height; y++) {
        float *row = heights + (size_t)y * (size_t)width;
        sweep_row(row, y > 0 ? row - width : NULL, width, -1);
    }
    for (int y = height - 1; y >= 0; y--) {
        float *row = heights + (size_t)y * (size_t)width;
        sweep_row(row, y < height - 1 ? row + width : NULL, width, 1);
    }
}

static int min_int(int a, int b)
{
    return a < b ? a : b;
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}

/* Square around a sample, cut to the limits. */
static rect square(int x, int y, int radius, rect limits)
{
    return (rect){ max_int(x - radius, limits.left), max_int(y - radius, limits.top),
                   min_int(x + radius, limits.right), min_int(y + radius, limits.bottom) };
}

/* The rectangle around the squares of all holes: what the table has to cover. */
static rect find_area(const float *heights, int width, int height)
{
    const rect whole = { 0, 0, width - 1, height - 1 };
    rect       area  = { width, height, -1, -1 };
    for (int y = 0; y < height; y++) {
        const float *row = heights + (size_t)y * (size_t)width;
        for (int x = 0; x < width; x++) {
            if (row[x] < 0.0F) {
                const rect needed = square(x, y, (int)distance_of(row[x]), whole);
                area = (rect){ min_int(area.left, needed.left), min_int(area.top, needed.top),
                               max_int(area.right, needed.right),
                               max_int(area.bottom, needed.bottom) };
            }
        }
    }
    return area;
}

static void build_table(table *sat, const float *heights, int width)
{
    for (int y = sat->area.top; y <= sat->area.bottom; y++) {
        const float *row   = heights + (size_t)y * (size_t)width;
        const size_t above = (size_t)(y - sat->area.top) * sat->pitch;
        const size_t here  = above + sat->pitch;
        uint64_t     sum   = 0;
        uint32_t     count = 0;
        for (int x = sat->area.left; x <= sat->area.right; x++) {
            const size_t column = (size_t)(x - sat->area.left) + 1;
            if (row[x] >= 0.0F) {
                sum += (uint64_t)((double)row[x] * TABLE_ONE);
                count++;
            }
            sat->sums[here + column]   = sat->sums[above + column] + sum;
            sat->counts[here + column] = sat->counts[above + column] + count;
        }
    }
}

static float rim_mean(const table *sat, rect part)
{
    const size_t   above = (size_t)(part.top - sat->area.top) * sat->pitch;
    const size_t   below = (size_t)(part.bottom - sat->area.top + 1) * sat->pitch;
    const size_t   left  = (size_t)(part.left - sat->area.left);
    const size_t   right = (size_t)(part.right - sat->area.left + 1);
    const uint64_t sum   = sat->sums[below + right] - sat->sums[below + left]
                         - sat->sums[above + right] + sat->sums[above + left];
    const uint32_t count = sat->counts[below + right] - sat->counts[below + left]
                           - sat->counts[above + right] + sat->counts[above + left];
    return (float)((double)sum / (double)count / TABLE_ONE);
}

static void fill_from_table(const table *sat, float *heights, int width)
{
    for (int y = sat->area.top; y <= sat->area.bottom; y++) {
        float *row = heights + (size_t)y * (size_t)width;
        for (int x = sat->area.left; x <= sat->area.right; x++) {
            if (row[x] < 0.0F) {
                row[x] = rim_mean(sat, square(x, y, (int)distance_of(row[x]), sat->area));
            }
        }
    }
}

hc_result hc_fill_holes(float *heights, int width, int height, hc_log *log)
{
    measure_distances(heights, width, height);
    const rect area = find_area(heights, width, height);
    if (area.right < 0) {
        return HC_OK;
    }
    table        sat     = { .area = area, .pitch = (size_t)(area.right - area.left + 2) };
    const size_t entries = sat.pitch * (size_t)(area.bottom - area.top + 2);
    sat.sums             = calloc(entries, sizeof *sat.sums);
    sat.counts           = calloc(entries, sizeof *sat.counts);
    const bool enough    = sat.sums != NULL && sat.counts != NULL;
    if (enough) {
        build_table(&sat, heights, width);
        fill_from_table(&sat, heights, width);
    }
    free(sat.sums);
    free(sat.counts);
    return enough
               ? HC_OK
               : hc_fail(log, HC_ERROR_MEMORY, "no memory to fill holes: %zu entries of %zu bytes",
                         entries, sizeof *sat.sums + sizeof *sat.counts);
}

void hc_lower_holes(float *heights, int width, int height)
{
    const size_t samples = (size_t)width * (size_t)height;
    float        lowest  = 1.0F;
    for (size_t i = 0; i < samples; i++) {
        lowest = heights[i] >= 0.0F && heights[i] < lowest ? heights[i] : lowest;
    }
    for (size_t i = 0; i < samples; i++) {
        heights[i] = heights[i] < 0.0F ? lowest : heights[i];
    }
}
