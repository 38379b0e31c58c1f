/* The judge itself, on fields small enough to work out by hand. */
#include "support.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>

#define EQUAL(a, b) assert_true(fabs((a) - (b)) < 1e-12)

static const hc_ref_cone round_cone = { .metric = HC_REF_ROUND };
static const hc_ref_cone diamond    = { .metric = HC_REF_DIAMOND };

static hc_ref_cone quadrant(int number)
{
    return (hc_ref_cone){ .metric = HC_REF_DIAMOND, .quadrant = number };
}

/* Two samples, a quarter of the height apart: run 1/2, rise 1/4. */
static void two_samples(void **state)
{
    (void)state;
    const float    heights[] = { 0.25F, 0.5F };
    const hc_field field     = { .heights = heights, .width = 2, .height = 1 };
    const hc_field grid = { .heights = heights, .width = 2, .height = 1, .registration = HC_GRID };
    EQUAL(hc_ref_ratio(&field, &round_cone, 0, 0), 2.0);
    EQUAL(hc_ref_ratio(&grid, &round_cone, 0, 0), 4.0);
    assert_true(hc_ref_ratio(&field, &round_cone, 1, 0) == INFINITY);
    const hc_ref_cone away = quadrant(2);
    assert_true(hc_ref_ratio(&field, &away, 0, 0) == INFINITY);
}

/* A tower in the corner of 4x4, seen from the sample opposite: 3 and 3 away, or 1 and 1 where the
 * border wraps. */
static void images(void **state)
{
    (void)state;
    float    heights[16] = { 0.0F };
    hc_field field       = { .heights = heights, .width = 4, .height = 4 };
    heights[0]           = 1.0F;
    EQUAL(hc_ref_ratio(&field, &diamond, 3, 3), 1.5);
    EQUAL(hc_ref_ratio(&field, &round_cone, 3, 3), sqrt(2.0) * 0.75);
    field.wrap = HC_WRAP_U;
    EQUAL(hc_ref_ratio(&field, &diamond, 3, 3), 1.0);
    field.wrap = HC_WRAP_UV;
    EQUAL(hc_ref_ratio(&field, &diamond, 3, 3), 0.5);
    const double in_quadrants[] = { 0.5, 1.0, 1.0, 1.5 };
    for (int i = 0; i < 4; i++) {
        const hc_ref_cone cone = quadrant(i + 1);
        EQUAL(hc_ref_ratio(&field, &cone, 3, 3), in_quadrants[i]);
    }
}

/* A wall to the right and nothing above or below: cones stretched along v are the better ones. */
static void elongations(void **state)
{
    (void)state;
    const float    heights[] = { 0.0F, 1.0F, 0.0F, 1.0F };
    const hc_field field     = { .heights = heights, .width = 2, .height = 2 };
    double         ratios[HC_REF_ELONGATIONS];
    for (int i = 0; i < HC_REF_ELONGATIONS; i++) {
        const hc_ref_cone cone = { .metric = HC_REF_DIAMOND, .elongation = hc_ref_elongation[i] };
        ratios[i]              = hc_ref_ratio(&field, &cone, 0, 0);
        EQUAL(ratios[i], 0.5 * hc_ref_elongation[i]);
    }
    /* slope_u is 2 for all of them, slope_v = 2 / a^2 least for a = 4 */
    assert_int_equal(hc_ref_best_elongation(ratios), 4);
}

/* Eight in a row, apex at 0, a tower of 1 at sample 3. Level 0 sees sample 1; level 1 sees samples
 * 2 and 3 as one block, from 2; from level 2 on it is the block's samples 4 to 7. */
static void quick_blocks(void **state)
{
    (void)state;
    float          heights[8] = { 0.0F };
    const hc_field field      = { .heights = heights, .width = 8, .height = 1 };
    heights[3]                = 1.0F;
    EQUAL(hc_ref_ratio(&field, &diamond, 0, 0), 3.0 / 8);
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_IMPROVED, 0, 0), 2.0 / 8);
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_CENTRE, 0, 0), 2.5 / 8);
    /* sample 4: level 0 meets the tower itself */
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_IMPROVED, 4, 0), 1.0 / 8);
    /* sample 5: block 2..3 on level 1 from 3; on level 2 block 0..3 has 0..1 left, 4 away */
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_IMPROVED, 5, 0), 2.0 / 8);
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_NAIVE_CENTRE, 5, 0), 2.5 / 8);
    /* sample 7: level 1 stops at 4; level 2 meets 0..3 whole in both variants */
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_NAIVE, 7, 0), 4.0 / 8);
}

/* Three in a row: level 1 is one block of three, and sample 2 is seen from sample 0 only as the
 * rest of the own block. */
static void quick_leaves_nothing_over_at_odd_sizes(void **state)
{
    (void)state;
    const float    heights[] = { 0.0F, 0.0F, 1.0F };
    const hc_field field     = { .heights = heights, .width = 3, .height = 1 };
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_NAIVE, 0, 0), 2.0 / 3);
    EQUAL(hc_ref_quick_ratio(&field, &diamond, HC_REF_QUICK_IMPROVED, 0, 0), 2.0 / 3);
}

/* A step up never falls outwards, a ridge does behind its top. */
static void falling_edges(void **state)
{
    (void)state;
    const float    step[]  = { 0.0F, 0.0F, 1.0F, 1.0F };
    const float    ridge[] = { 0.0F, 0.5F, 1.0F, 0.0F };
    const hc_field rises   = { .heights = step, .width = 4, .height = 1 };
    const hc_field falls   = { .heights = ridge, .width = 4, .height = 1 };
    assert_true(hc_ref_falling_edge_ratio(&rises, 0, 0) == INFINITY);
    EQUAL(hc_ref_falling_edge_ratio(&falls, 0, 0), 2.0 / 4);
    EQUAL(hc_ref_ratio(&falls, &round_cone, 1, 0), 2.0 / 4);
    EQUAL(hc_ref_falling_edge_ratio(&falls, 1, 0), 2.0 / 4);
}

/* Wall of height 1/2 at sample 2 of 8, nothing behind. The ray from (sample 0, 1) through its top
 * falls 1/4 per sample, in four steps of 1/8; the wall's far side is the line from (2, 1/2) to
 * (3, 0), so the first step, at (2.5, 3/8), is above it. */
static void gems_rays(void **state)
{
    (void)state;
    float          heights[8] = { 0.0F };
    const hc_field field      = { .heights = heights, .width = 8, .height = 1 };
    heights[2]                = 0.5F;
    EQUAL(hc_ref_gems_ratio(&field, 4, 0.0, 0, 0), 2.5 / 8 / 0.375);
    EQUAL(hc_ref_ratio(&field, &round_cone, 0, 0), 0.5);
}

/* Bilinear values and who owns a place. */
static void surface(void **state)
{
    (void)state;
    const float heights[] = { 0.0F, 1.0F, 0.5F, 0.25F };
    hc_field    field     = { .heights = heights, .width = 2, .height = 2 };
    int         x;
    int         y;
    EQUAL(hc_ref_surface(&field, 0.25, 0.25), 0.0);
    EQUAL(hc_ref_surface(&field, 0.5, 0.5), 1.75 / 4);
    EQUAL(hc_ref_surface(&field, 0.9, -3.0), 1.0);
    hc_ref_cell_at(&field, 0.9, 0.3, &x, &y);
    assert_true(x == 1 && y == 0);
    field.wrap = HC_WRAP_UV;
    EQUAL(hc_ref_surface(&field, 1.0, 0.25), 0.5);
    EQUAL(hc_ref_surface(&field, -4.0, 2.25), 0.5);
    hc_ref_cell_at(&field, 0.0, 0.3, &x, &y);
    assert_true(x == 1 && y == 0);
}

/* On a saddle the surface rises most along the edges; random places find no more than the exact
 * answer, and nearly as much. */
static void excess(void **state)
{
    (void)state;
    uint64_t random = 3;
    hc_field field  = agree_make_field((agree_shape){ 9, 7 }, 2, 4, HC_WRAP_V, HC_GRID);
    for (int i = 0; i < 40; i++) {
        const double u     = agree_uniform(&random);
        const double v     = agree_uniform(&random);
        const double s_u   = agree_uniform(&random) * 3.0;
        const double s_v   = agree_uniform(&random) * 3.0;
        const double exact = hc_ref_surface_excess(&field, 0, s_u, s_v, u, v);
        double       found = 0.0;
        for (int k = 0; k < 4000; k++) {
            const double du = agree_uniform(&random) * 2.0 - 1.0;
            const double dv = agree_uniform(&random) * 2.0 - 1.0;
            const double rise =
                hc_ref_surface(&field, u + du, v + dv) - hc_ref_surface(&field, u, v);
            found = fmax(found, rise - s_u * fabs(du) - s_v * fabs(dv));
        }
        assert_true(found <= exact + 1e-12);
        assert_true(found >= exact - 0.15);
    }
    agree_free(&field);
}

/* Five columns: level 1 has blocks of 2 and 3, level 2 is one. */
static void blocks_and_codes(void **state)
{
    (void)state;
    const float heights[] = { 0.1F, 0.2F, 0.3F, 0.2F, 0.9F };
    assert_int_equal(hc_ref_level_size(5, 1), 2);
    assert_int_equal(hc_ref_block_of(4, 1, 5), 1);
    assert_true(hc_ref_block_extreme(heights, 5, 1, 1, 0, 0, HC_REF_MAXIMUM) == 0.2F);
    assert_true(hc_ref_block_extreme(heights, 5, 1, 1, 1, 0, HC_REF_MAXIMUM) == 0.9F);
    assert_true(hc_ref_cell_extreme(heights, 1, 0, 5, 1, HC_WRAP_U, 4, 0, HC_REF_MINIMUM) == 0.1F);
    assert_true(hc_ref_cell_extreme(heights, 1, 0, 5, 1, HC_WRAP_NONE, 4, 0, HC_REF_MINIMUM)
                == 0.9F);
    assert_int_equal(hc_ref_height_code(0.5, 8), 128);
    assert_int_equal(hc_ref_ratio_code(1.0, 1.0, 8), 255);
    assert_int_equal(hc_ref_ratio_code(0.25, 1.0, 8), 127); /* 127.5^2 / 255^2, down */
    assert_int_equal(hc_ref_ratio_code(1e-9, 1.0, 8), 0);
}

static void gradients(void **state)
{
    (void)state;
    const float heights[] = { 0.0F, 0.5F, 0.25F };
    hc_field    field     = { .heights = heights, .width = 3, .height = 1 };
    double      g[2];
    hc_ref_gradient(g, &field, 0, 0);
    EQUAL(g[0], 1.5);
    EQUAL(g[1], 0.0);
    hc_ref_gradient(g, &field, 1, 0);
    EQUAL(g[0], 0.375);
    field.wrap = HC_WRAP_U;
    hc_ref_gradient(g, &field, 0, 0);
    EQUAL(g[0], 0.375);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_samples),
        cmocka_unit_test(images),
        cmocka_unit_test(elongations),
        cmocka_unit_test(quick_blocks),
        cmocka_unit_test(quick_leaves_nothing_over_at_odd_sizes),
        cmocka_unit_test(falling_edges),
        cmocka_unit_test(gems_rays),
        cmocka_unit_test(surface),
        cmocka_unit_test(excess),
        cmocka_unit_test(blocks_and_codes),
        cmocka_unit_test(gradients),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
