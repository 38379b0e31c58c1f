/* Pyramids, bounding maps, cell ratios and gradients against their definitions. */
#include "small_fields.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static float pick(float a, float b, hc_extreme extreme)
{
    return extreme == HC_MAXIMUM ? fmaxf(a, b) : fminf(a, b);
}

/* Which texel of a level is above a base column or row: maps.h. */
static int above(int place, int level, int level_side)
{
    return place >> level < level_side - 1 ? place >> level : level_side - 1;
}

/* Each level from the base alone. */
static void expect_pyramid(const hc_pyramid *pyramid, const float *heights, hc_extreme extreme)
{
    static float wanted[SMALL_TEXELS];
    for (int level = 0; level < pyramid->levels; level++) {
        int          width, height;
        const float *values = hc_pyramid_level(pyramid, level, &width, &height);
        for (int i = 0; i < width * height; i++) {
            wanted[i] = extreme == HC_MAXIMUM ? -INFINITY : INFINITY;
        }
        for (int p = 0; p < pyramid->width * pyramid->height; p++) {
            const int x           = above(p % pyramid->width, level, width);
            const int y           = above(p / pyramid->width, level, height);
            wanted[y * width + x] = pick(wanted[y * width + x], heights[p], extreme);
        }
        assert_memory_equal(values, wanted, sizeof(float) * (size_t)(width * height));
    }
}

static void test_pyramids(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 2; i++) {
        static float     values[2 * SMALL_TEXELS + 64];
        const hc_extreme extreme = (hc_extreme)(i % 2);
        hc_pyramid       pyramid;
        small_case       small;
        small_make(&small, i / 2, 0, NOISE, HC_CONES_L2);
        hc_bake_pyramid(&pyramid, values, small.heights, small.job.width, small.job.height,
                        extreme);
        assert_int_equal(pyramid.levels, hc_pyramid_levels(small.job.width, small.job.height));
        expect_pyramid(&pyramid, small.heights, extreme);
        assert_true(hc_pyramid_size(small.job.width, small.job.height)
                    <= sizeof values / sizeof *values);
    }
}

static void test_base_in_place(void **state)
{
    (void)state;
    static float values[2 * SMALL_TEXELS];
    hc_pyramid   pyramid;
    small_case   small;
    small_make(&small, 8, 0, NOISE, HC_CONES_L2);
    memcpy(values, small.heights, sizeof small.heights);
    hc_bake_pyramid(&pyramid, values, values, small.job.width, small.job.height, HC_MAXIMUM);
    expect_pyramid(&pyramid, small.heights, HC_MAXIMUM);
}

/* Random rectangles, from empty to everything, heights going up and down. */
static void test_updates(void **state)
{
    (void)state;
    uint32_t random = 7;
    for (int i = 0; i < SMALL_SIZES * 20; i++) {
        static float     values[2 * SMALL_TEXELS + 64];
        const hc_extreme extreme = (hc_extreme)(i % 2);
        hc_pyramid       pyramid;
        small_case       small;
        small_make(&small, i / 20, 0, NOISE, HC_CONES_L2);
        const int width  = small.job.width;
        const int height = small.job.height;
        hc_bake_pyramid(&pyramid, values, small.heights, width, height, extreme);
        hc_rect part = { .x = (int)(small_random(&random) % (uint32_t)width),
                         .y = (int)(small_random(&random) % (uint32_t)height) };
        part.width   = (int)(small_random(&random) % (uint32_t)(width - part.x + 1));
        part.height  = (int)(small_random(&random) % (uint32_t)(height - part.y + 1));
        for (int p = 0; p < part.width * part.height; p++) {
            const int at      = (part.y + p / part.width) * width + part.x + p % part.width;
            small.heights[at] = (float)(small_random(&random) % 1000) / 999.0F;
        }
        hc_update_pyramid(&pyramid, small.heights, part, extreme);
        expect_pyramid(&pyramid, small.heights, extreme);
    }
}

/* What lies outside the rectangle is not read again: the cost follows the rectangle. */
static void test_updates_leave_the_rest(void **state)
{
    (void)state;
    static float values[2 * SMALL_TEXELS];
    hc_pyramid   pyramid;
    small_case   small;
    small_make(&small, 7, 0, NOISE, HC_CONES_L2);
    hc_bake_pyramid(&pyramid, values, small.heights, 8, 8, HC_MAXIMUM);
    const float before = hc_pyramid_level(&pyramid, 1, NULL, NULL)[15];
    small.heights[0]   = 1.0F;
    small.heights[63]  = 0.0F; /* not announced */
    hc_update_pyramid(&pyramid, small.heights, (hc_rect){ 0, 0, 1, 1 }, HC_MAXIMUM);
    assert_true(hc_pyramid_level(&pyramid, 1, NULL, NULL)[0] == 1.0F);
    assert_true(hc_pyramid_level(&pyramid, 3, NULL, NULL)[0] == 1.0F);
    assert_true(hc_pyramid_level(&pyramid, 1, NULL, NULL)[15] == before);
}

static hc_field field_of(const small_case *small, int wrap)
{
    return (hc_field){ .heights = small->heights,
                       .width   = small->job.width,
                       .height  = small->job.height,
                       .wrap    = (hc_wrap)wrap };
}

static int next(int place, int side, bool wraps)
{
    return place + 1 < side ? place + 1 : wraps ? 0 : place;
}

static void test_bounds_and_cells(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4; i++) {
        const int    wrap = i % 4;
        static float highest[SMALL_TEXELS], lowest[SMALL_TEXELS], cells[SMALL_TEXELS * 4];
        small_case   small;
        small_make(&small, i / 4, wrap, NOISE, HC_CONES_QUAD);
        const hc_field field = field_of(&small, wrap);
        small_fill(small.ratios, field.width * 4, field.height, NOISE, 3);
        hc_bake_bounds(highest, &field, HC_MAXIMUM);
        hc_bake_bounds(lowest, &field, HC_MINIMUM);
        hc_bake_cell_ratios(cells, small.ratios, field.width, field.height, HC_CONES_QUAD,
                            field.wrap);
        for (int p = 0; p < field.width * field.height; p++) {
            const int x1         = next(p % field.width, field.width, (wrap & 1) != 0);
            const int y1         = next(p / field.width, field.height, (wrap & 2) != 0);
            const int corners[4] = { p, p / field.width * field.width + x1,
                                     y1 * field.width + p % field.width, y1 * field.width + x1 };
            float     most       = 0.0F;
            float     least      = 1.0F;
            for (int c = 0; c < 4; c++) {
                most  = fmaxf(most, small.heights[corners[c]]);
                least = fminf(least, small.heights[corners[c]]);
            }
            assert_true(highest[p] == most && lowest[p] == least);
            for (int c = 0; c < 4; c++) {
                const float a =
                    fminf(small.ratios[corners[0] * 4 + c], small.ratios[corners[1] * 4 + c]);
                const float b =
                    fminf(small.ratios[corners[2] * 4 + c], small.ratios[corners[3] * 4 + c]);
                assert_true(cells[p * 4 + c] == fminf(a, b));
            }
        }
    }
}

/* Along u: the two neighbours, one-sided at open edges. Exact for these numbers. */
static void expect_slopes(const float *heights, int width, hc_wrap wrap, hc_registration posts,
                          const float *wanted)
{
    float    gradients[16];
    hc_field field = {
        .heights = heights, .width = width, .height = 1, .wrap = wrap, .registration = posts
    };
    hc_bake_gradient(gradients, &field);
    for (int x = 0; x < width; x++) {
        assert_true(gradients[2 * x] == wanted[x]);
        assert_true(gradients[2 * x + 1] == 0.0F);
    }
    field.width  = 1;
    field.height = width;
    field.wrap   = wrap == HC_WRAP_U ? HC_WRAP_V : HC_WRAP_NONE;
    hc_bake_gradient(gradients, &field);
    for (int y = 0; y < width; y++) {
        assert_true(gradients[2 * y] == 0.0F);
        assert_true(gradients[2 * y + 1] == wanted[y]); /* downwards */
    }
}

static void test_gradients(void **state)
{
    (void)state;
    const float ramp[4] = { 0.0F, 0.25F, 0.75F, 1.0F };
    expect_slopes(ramp, 4, HC_WRAP_NONE, HC_TEXEL, (float[]){ 1.0F, 1.5F, 1.5F, 1.0F });
    expect_slopes(ramp, 4, HC_WRAP_U, HC_TEXEL, (float[]){ -1.5F, 1.5F, 1.5F, -1.5F });
    expect_slopes(ramp, 4, HC_WRAP_NONE, HC_GRID, (float[]){ 0.75F, 1.125F, 1.125F, 0.75F });
    expect_slopes(ramp, 2, HC_WRAP_NONE, HC_TEXEL, (float[]){ 0.5F, 0.5F });
    expect_slopes(ramp, 2, HC_WRAP_U, HC_TEXEL, (float[]){ 0.0F, 0.0F });
    expect_slopes(ramp, 1, HC_WRAP_NONE, HC_TEXEL, (float[]){ 0.0F });
    expect_slopes(ramp, 1, HC_WRAP_U, HC_TEXEL, (float[]){ 0.0F });
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pyramids),         cmocka_unit_test(test_base_in_place),
        cmocka_unit_test(test_updates),          cmocka_unit_test(test_updates_leave_the_rest),
        cmocka_unit_test(test_bounds_and_cells), cmocka_unit_test(test_gradients),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
