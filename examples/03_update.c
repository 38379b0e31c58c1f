/* Terrain that changes: dig a crater and bring the cone map up to date at the cost of what the
 * crater affects, then see that it equals a full bake. */
#include <heightcast/heightcast.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 256, RADIUS = 12 };

static float heights[SIDE * SIDE];
static float ratios[SIDE * SIDE];
static float expected[SIDE * SIDE];

static hc_rect dig(int centre_x, int centre_y)
{
    for (int y = -RADIUS; y <= RADIUS; y++) {
        for (int x = -RADIUS; x <= RADIUS; x++) {
            const float inside = (float)(RADIUS * RADIUS - x * x - y * y) / (RADIUS * RADIUS);
            if (inside > 0.0F) {
                heights[(centre_y + y) * SIDE + centre_x + x] *= 1.0F - 0.8F * inside;
            }
        }
    }
    return (hc_rect){ centre_x - RADIUS, centre_y - RADIUS, 2 * RADIUS + 1, 2 * RADIUS + 1 };
}

static hc_result run(hc_cone_baker **baker, size_t *rebaked, hc_log *log)
{
    const hc_field        field   = { .heights = heights, .width = SIDE, .height = SIDE };
    const hc_cone_options options = { .cones = HC_CONES_L1 };

    hc_result result = hc_synth(heights, SIDE, SIDE, "fbm", 1, log);
    if (result == HC_OK) {
        result = hc_cone_baker_create(baker, ratios, &field, &options, log);
    }
    if (result == HC_OK) {
        const hc_rect crater = dig(90, 150);
        result               = hc_cone_baker_update(*baker, ratios, heights, crater, rebaked, log);
    }
    if (result == HC_OK) {
        result = hc_bake_cone_map(expected, &field, &options, log);
    }
    return result;
}

int main(void)
{
    hc_log          log     = { 0 };
    hc_cone_baker  *baker   = NULL;
    size_t          rebaked = 0;
    const hc_result result  = run(&baker, &rebaked, &log);
    hc_cone_baker_destroy(baker);
    if (result != HC_OK) {
        (void)fprintf(stderr, "%s: %s\n", hc_result_name(result), log.text);
        return EXIT_FAILURE;
    }
    const bool same = memcmp(ratios, expected, sizeof ratios) == 0;
    (void)printf("a crater of %d samples, %zu of %d searched again, %s a full bake\n",
                 (2 * RADIUS + 1) * (2 * RADIUS + 1), rebaked, SIDE * SIDE,
                 same ? "the same bytes as" : "OTHER bytes than");
    return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
