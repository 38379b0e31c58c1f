/* Exact against brute force on terraces: many samples as high as each other, whose lines are level,
 * and ranges of heights that are small or begin anywhere. */
#include "support.h"

#include <stdlib.h>

enum { SIDE_MOST = 37, LEVELS_MOST = 5 };

/* Levels that differ by single units of float, by little, or by much. */
static float some_level(uint64_t *random, float low, int kind, int level)
{
    static const float STEPS[] = { 0x1p-24F, 0x1p-31F, 0x1p-12F, 0.01F, 0.1F };
    const float        jitter  = kind % 2 == 0 ? 0.0F : 0x1p-26F * (float)agree_uniform(random);
    const float        height  = low + STEPS[kind % 5] * (float)level + jitter;
    return height < 1.0F ? height : 1.0F;
}

static hc_field terraces(uint64_t *random)
{
    static const float LOWS[]  = { 0.0F, 0x1p-40F, 0.0031F, 0.0156F, 0.3F, 0.99F };
    const int          width   = agree_range(random, 1, SIDE_MOST);
    const int          height  = agree_range(random, 1, SIDE_MOST);
    const int          kind    = agree_range(random, 0, 9);
    const float        low     = LOWS[agree_range(random, 0, 5)];
    const int          patch   = agree_range(random, 1, 12);
    float             *heights = malloc((size_t)width * (size_t)height * sizeof *heights);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            uint64_t  place        = (uint64_t)(y / patch * SIDE_MOST + x / patch + kind * 4096);
            const int level        = agree_range(&place, 0, LEVELS_MOST);
            heights[y * width + x] = some_level(random, low, kind, level);
        }
    }
    return (hc_field){ .heights = heights,
                       .width   = width,
                       .height  = height,
                       .wrap    = (hc_wrap)agree_range(random, 0, 3) };
}

static void terraces_are_exact(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int i = 0; i < 600 / AGREE_STRIDE; i++) {
        hc_field        field   = terraces(&random);
        hc_cone_options options = { .cones = (hc_cones)(i % 4), .threads = 1 };
        float          *fast    = agree_bake(&field, &options);
        options.method          = HC_METHOD_BRUTE;
        float *slow             = agree_bake(&field, &options);
        assert_memory_equal(fast, slow, agree_count(&field, options.cones) * sizeof *fast);
        free(fast);
        free(slow);
        agree_free(&field);
    }
}

/* Two peaks that differ by one unit of float, above a ground whose own unit is finer: less the
 * ground both would round to the same. */
static void the_higher_of_two_like_peaks_counts(void **state)
{
    (void)state;
    enum { WIDTH = 64, LOWER_PEAK = 2, HIGHER_PEAK = 50 };
    float heights[WIDTH];
    for (int x = 0; x < WIDTH; x++) {
        heights[x] = 0x1p-32F;
    }
    heights[LOWER_PEAK]     = 0x1p-8F + 0x1p-30F;
    heights[HIGHER_PEAK]    = 0x1p-8F + 0x1p-30F + 0x1p-31F;
    const hc_field  field   = { .heights = heights, .width = WIDTH, .height = 1 };
    hc_cone_options options = { .threads = 1 };
    float          *fast    = agree_bake(&field, &options);
    options.method          = HC_METHOD_BRUTE;
    float *slow             = agree_bake(&field, &options);
    assert_memory_equal(fast, slow, sizeof heights);
    assert_true(fast[LOWER_PEAK] < 1e30F && fast[HIGHER_PEAK] > 1e30F);
    free(fast);
    free(slow);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(terraces_are_exact),
                                        cmocka_unit_test(the_higher_of_two_like_peaks_counts) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
