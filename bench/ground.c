#include "ground.h"

#include <stddef.h>

static int mirrored(int i, int side)
{
    const int at = i % (2 * side);
    return at < side ? at : 2 * side - 1 - at;
}

hc_result hc_bench_fill_ground(float *heights, int side, const hc_bench_ground *ground,
                               uint64_t seed, hc_log *log)
{
    const hc_field *tile = ground->tile;
    if (tile == NULL) {
        return hc_synth(heights, side, side, ground->name, seed, log);
    }
    for (int y = 0; y < side; y++) {
        const float *row = tile->heights + (size_t)mirrored(y, tile->height) * (size_t)tile->width;
        for (int x = 0; x < side; x++) {
            heights[(size_t)y * (size_t)side + (size_t)x] = row[mirrored(x, tile->width)];
        }
    }
    return HC_OK;
}
