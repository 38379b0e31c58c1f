/* The lowest heights of squares, where rays that ask for any hit are looked at first. */
#include "fast_data.h"

#include "base/parallel.h"

size_t hc_fast_plan_lows(hc_fast *fast)
{
    enum { MOST = 520 * 260 };
    size_t words;
    if (!hc_fast_plain(fast)) {
        return 0;
    }
    fast->low_bits = -1;
    do {
        fast->low_bits++;
        fast->stride_lows = (fast->x.cells >> (fast->low_bits + 1)) + 1;
        fast->rows_lows   = (fast->y.cells >> fast->low_bits) + 1;
        words             = (size_t)fast->stride_lows * (size_t)fast->rows_lows;
    } while (words > MOST);
    return words;
}

/* Of square x of a row, in steps of 2^-16, rounded down; any where the field has ended. */
static uint32_t find_low(const hc_fast *fast, int x, int y)
{
    const int side   = 1 << fast->low_bits;
    const int right  = hc_fast_lesser((x + 1) * side, fast->x.cells);
    const int below  = hc_fast_lesser((y + 1) * side, fast->y.cells);
    float     lowest = 1.0F;
    for (int j = y * side; j <= below; j++) {
        for (int i = x * side; i <= right; i++) {
            const float height = fast->heights[hc_fast_corner(fast, i, j)];
            lowest             = height < lowest ? height : lowest;
        }
    }
    return lowest < 1.0F ? (uint32_t)(lowest * 0x1p16F) : 0xffff;
}

static void find_row(void *context, int y, int worker)
{
    const hc_fast *fast = context;
    uint32_t      *to   = fast->lows + (size_t)y * (size_t)fast->stride_lows;
    (void)worker;
    for (int k = 0; k < fast->stride_lows; k++) {
        to[k] = find_low(fast, 2 * k, y) | find_low(fast, 2 * k + 1, y) << 16;
    }
}

/* The ground rises far above its lowest heights everywhere. */
static bool is_rough(const hc_fast *fast)
{
    const int side = 1 << fast->low_bits;
    double    rise = 0.0;
    for (int y = 0; y < fast->rows_lows; y++) {
        const int j = hc_fast_lesser(y * side + side / 2, fast->y.cells);
        for (int k = 0; k < fast->stride_lows; k++) {
            const int      i   = hc_fast_lesser(2 * k * side + side / 2, fast->x.cells);
            const uint32_t low = fast->lows[(size_t)y * (size_t)fast->stride_lows + (size_t)k];
            rise += (double)fast->heights[hc_fast_corner(fast, i, j)] - 0x1p-16 * (low & 0xffff);
        }
    }
    return rise > 0.25 * fast->highest * (double)fast->rows_lows * (double)fast->stride_lows;
}

void hc_fast_find_lows(hc_fast *fast, int threads, hc_log *log)
{
    if (fast->sparse) {
        fast->stride_lows = 0;
    }
    if (fast->stride_lows > 0) {
        (void)hc_parallel_for(fast->rows_lows, threads, find_row, fast, (hc_progress){ 0 }, log);
        fast->stride_lows = is_rough(fast) ? 0 : fast->stride_lows;
    }
}
