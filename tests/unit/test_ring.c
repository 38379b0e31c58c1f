/* The expanding-squares search equals brute force, to the bit. */
#include "small_fields.h"

#include "bake/canonical.h"
#include "bake/steeper.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void test_equals_brute_force(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4 * SMALL_KINDS * 2; i++) {
        small_case small;
        small_make(&small, i / 2 / SMALL_KINDS / 4, i / 2 / SMALL_KINDS % 4,
                   (small_kind)(i / 2 % SMALL_KINDS), (hc_cones)(i % 2));
        assert_int_equal(hc_cone_ring(&small.job), HC_OK);
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            float truth[4];
            oracle_ratios(&small.job, p % small.job.width, p / small.job.width, truth);
            if (!same_bits(small.ratios[p], truth[0])) {
                fail_msg("%d x %d, wrap %d, texel %d: %a is not %a", small.job.width,
                         small.job.height, i / 2 / SMALL_KINDS % 4, p, (double)small.ratios[p],
                         (double)truth[0]);
            }
        }
    }
}

/* A tower past a wrapped corner is what the 2006 search does not see. */
static void test_sees_past_wrapped_corners(void **state)
{
    (void)state;
    small_case small;
    small_make(&small, 7, 3, NOISE, HC_CONES_L2);
    memset(small.heights, 0, sizeof small.heights);
    small.heights[7 * 8 + 7] = 1.0F;
    assert_int_equal(hc_cone_ring(&small.job), HC_OK);
    const float diagonal = sqrtf(2.0F / 64.0F);
    assert_true(small.ratios[0] <= diagonal && small.ratios[0] >= diagonal * (1.0F - 0x1p-18F));
}

static void test_threads_do_not_show(void **state)
{
    (void)state;
    small_case one, four;
    small_make(&one, 10, 3, NOISE, HC_CONES_L1);
    small_make(&four, 10, 3, NOISE, HC_CONES_L1);
    four.job.threads = 4;
    assert_int_equal(hc_cone_ring(&one.job), HC_OK);
    assert_int_equal(hc_cone_ring(&four.job), HC_OK);
    assert_memory_equal(one.ratios, four.ratios, sizeof one.ratios);
}

static bool refuse(void *user, double fraction)
{
    (void)fraction;
    ++*(int *)user;
    return false;
}

static void test_stops_on_request(void **state)
{
    (void)state;
    int        asked = 0;
    small_case small;
    small_make(&small, 10, 0, NOISE, HC_CONES_L2);
    small.job.progress = (hc_progress){ refuse, &asked };
    assert_int_equal(hc_cone_ring(&small.job), HC_ERROR_CANCELLED);
    assert_int_equal(asked, 1);
}

/* The weight that searches form from reaches is the canonical one. */
static void test_reach_weights(void **state)
{
    (void)state;
    static const float steps[] = { 1.0F, 0.25F, 1.0F / 3.0F, 0x1p-20F, 1.0F / 1000003.0F };
    for (int n = 0; n < 5 * 5 * 40 * 40; n++) {
        const float u = steps[n / 1600 % 5];
        const float v = steps[n / 8000];
        const int   i = n % 40 * 997;
        const int   j = n / 40 % 40 * 31;
        if (i + j > 0) {
            assert_true(
                same_bits(hc_reach_weight(true, hc_reach(true, i, u) + hc_reach(true, j, v)),
                          hc_weight_l2(i, j, u, v)));
            assert_true(
                same_bits(hc_reach_weight(false, hc_reach(false, i, u) + hc_reach(false, j, v)),
                          hc_weight_l1(i, j, u, v)));
        }
    }
}

/* The test without root or division lets every steeper sample pass, also where products are near
 * the smallest numbers and where the difference is one unit in the last place. */
static void test_no_steeper_sample_is_dropped(void **state)
{
    (void)state;
    uint32_t random = 1;
    for (int n = 0; n < 400000; n++) {
        const bool  l2     = (n & 1) != 0;
        const float step_u = 1.0F / (float)(1 + small_random(&random) % (1U << 20));
        const float step_v = 1.0F / (float)(1 + small_random(&random) % (1U << 20));
        const int   i      = 1 + (int)(small_random(&random) % 1000);
        const int   j      = (int)(small_random(&random) % 1000);
        const float rise   = ldexpf((float)(1 + small_random(&random) % 0xFFFFFF),
                                    -24 - (int)(small_random(&random) % 115));
        const float reach  = hc_reach(l2, i, step_u) + hc_reach(l2, j, step_v);
        const float equal  = rise * hc_reach_weight(l2, reach);
        const float below  = nextafterf(equal, 0.0F);
        if (equal > 0.0F) {
            assert_true(hc_may_be_steeper(l2, rise, reach, hc_steepest_of(l2, below)));
            assert_true(
                same_bits(hc_steeper(l2, rise, reach, hc_steepest_of(l2, below)).value, equal));
        }
        if (equal > 0x1p-39F) { /* above the floor it does drop what is flatter */
            assert_false(hc_may_be_steeper(l2, rise, reach, hc_steepest_of(l2, equal * 1.001F)));
        }
    }
    assert_false(hc_may_be_steeper(true, 1.0F, INFINITY, (hc_steepest){ 0.0F, 0.0F }));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equals_brute_force),
        cmocka_unit_test(test_sees_past_wrapped_corners),
        cmocka_unit_test(test_threads_do_not_show),
        cmocka_unit_test(test_stops_on_request),
        cmocka_unit_test(test_reach_weights),
        cmocka_unit_test(test_no_steeper_sample_is_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
