/* Cones that are safe between the samples too, from an array in memory: no files, libheightcast
 * only.
 *
 * Four diamond cones a texel, one for each quadrant of the ray's direction, then the least of each
 * cell's corners. A ray in cell (x, y) that goes to the right and down (+u, +v) with a gap of `gap`
 * between it and the surface below may go |du| + |dv| = gap * ratio without a hit, if it is level;
 * docs/algorithms.md has the step for rays that rise or fall. */
#include <heightcast/heightcast.h>

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 8, HEIGHT = 6, QUADRANTS = 4 };

static const float hill[HEIGHT][WIDTH] = {
    { 0.1F, 0.1F, 0.1F, 0.2F, 0.2F, 0.1F, 0.0F, 0.0F }, /* row 0 is the top */
    { 0.1F, 0.2F, 0.3F, 0.5F, 0.4F, 0.2F, 0.1F, 0.0F },
    { 0.1F, 0.3F, 0.6F, 0.9F, 0.7F, 0.3F, 0.1F, 0.0F },
    { 0.1F, 0.3F, 0.7F, 1.0F, 0.8F, 0.4F, 0.1F, 0.1F },
    { 0.1F, 0.2F, 0.4F, 0.6F, 0.5F, 0.3F, 0.1F, 0.1F },
    { 0.0F, 0.1F, 0.2F, 0.2F, 0.2F, 0.1F, 0.1F, 0.0F },
};

int main(void)
{
    const hc_field        field   = { .heights = hill[0], .width = WIDTH, .height = HEIGHT };
    const hc_cone_options options = { .cones = HC_CONES_QUAD };
    static float          ratios[WIDTH * HEIGHT * QUADRANTS];
    static float          cells[WIDTH * HEIGHT * QUADRANTS];
    hc_log                log = { 0 };

    const hc_result result = hc_bake_cone_map(ratios, &field, &options, &log);
    if (result != HC_OK) {
        (void)fprintf(stderr, "%s: %s\n", hc_result_name(result), log.text);
        return EXIT_FAILURE;
    }
    hc_bake_cell_ratios(cells, ratios, WIDTH, HEIGHT, HC_CONES_QUAD, field.wrap);

    static const char *const names[QUADRANTS] = { "right and down", "left and down", "right and up",
                                                  "left and up" };
    for (int quadrant = 0; quadrant < QUADRANTS; quadrant++) {
        (void)printf("cell ratios for rays that go %s\n", names[quadrant]);
        for (int y = 0; y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                (void)printf(" %6.3f", (double)cells[(y * WIDTH + x) * QUADRANTS + quadrant]);
            }
            (void)printf("\n");
        }
    }
    return EXIT_SUCCESS;
}
