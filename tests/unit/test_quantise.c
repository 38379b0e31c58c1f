/* Codes and what they stand for: each rounded to its safe side, none further than it must. */
#include "small_fields.h"

#include "bake/quantise.h"
#include "maps/codes.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static float random_unit(uint32_t *state)
{
    return (float)small_random(state) / (float)0xFFFFFF;
}

/* All of these on one height: nearest, and the tightest from above and below. */
static void expect_height(float height, int bits)
{
    const int    most  = hc_code_max(bits);
    const int    near  = hc_height_code(height, bits);
    const int    up    = hc_height_code_up(height, bits);
    const int    down  = hc_height_code_down(height, bits);
    const double exact = (double)height * most;
    assert_in_range(near, 0, most);
    assert_in_range(up, 0, most);
    assert_in_range(down, 0, most);
    assert_true(fabs(near - exact) <= 0.5);
    assert_true(hc_code_height(up, bits) >= height);
    assert_true(up == 0 || hc_code_height(up - 1, bits) < height);
    assert_true(hc_code_height(down, bits) <= height);
    assert_true(down == most || hc_code_height(down + 1, bits) > height);
}

static void test_heights(void **state)
{
    (void)state;
    uint32_t random = 3;
    for (int bits = 8; bits <= 16; bits += 8) {
        expect_height(0.0F, bits);
        expect_height(1.0F, bits);
        expect_height(0x1p-149F, bits);
        expect_height(1.0F - 0x1p-24F, bits);
        for (int i = 0; i < 100000; i++) {
            expect_height(random_unit(&random), bits);
        }
        for (int code = 0; code <= hc_code_max(bits); code++) {
            const float height =
                hc_code_height(code, bits); /* stays exact, also rounded outwards */
            assert_int_equal(hc_height_code(height, bits), code);
            assert_int_equal(hc_height_code_up(height, bits), code);
            assert_int_equal(hc_height_code_down(height, bits), code);
            expect_height(nextafterf(height, 0.0F), bits);
            expect_height(nextafterf(height, 1.0F), bits);
        }
    }
    assert_int_equal(hc_height_code(0.5F, 8), 128); /* 127.5: halves up */
}

static void test_rounded_heights(void **state)
{
    (void)state;
    float       rounded[4];
    const float heights[4] = { 0.0F, 0.001F, 0.003F, 1.0F };
    hc_round_heights(rounded, heights, 4, 8);
    const float wanted[4] = { 0.0F, 0.0F, 1.0F / 255.0F, 1.0F };
    assert_memory_equal(rounded, wanted, sizeof wanted);
}

/* The code's ratio is not wider, the next code's would be. */
static void expect_ratio(float ratio, int bits, float limit)
{
    const int most = hc_code_max(bits);
    const int code = hc_ratio_code(ratio, bits, limit);
    assert_in_range(code, 0, most);
    assert_true(hc_code_ratio(code, bits, limit) <= ratio);
    assert_true(code == most || hc_code_ratio(code + 1, bits, limit) > ratio);
}

static void test_ratios(void **state)
{
    (void)state;
    static const float limits[] = { 1.0F, 0.3F, 17.25F, 1e-30F, 3e38F };
    uint32_t           random   = 9;
    for (int n = 0; n < 10; n++) {
        const int   bits  = n % 2 == 0 ? 8 : 16;
        const float limit = limits[n / 2];
        expect_ratio(INFINITY, bits, limit);
        expect_ratio(limit, bits, limit);
        expect_ratio(nextafterf(limit, 0.0F), bits, limit);
        assert_int_equal(hc_ratio_code(limit, bits, limit), hc_code_max(bits));
        assert_int_equal(hc_ratio_code(INFINITY, bits, limit), hc_code_max(bits));
        for (int i = 0; i < 50000; i++) {
            const float root = random_unit(&random);
            expect_ratio(limit * (root * root) + 0x1p-140F, bits, limit);
        }
        for (int code = 1; code <= hc_code_max(bits); code++) {
            const float ratio = hc_code_ratio(code, bits, limit);
            assert_int_equal(hc_ratio_code(ratio, bits, limit), code);
            expect_ratio(nextafterf(ratio, 0.0F), bits, limit);
        }
    }
    /* 0 only below what code 1 stands for */
    assert_int_equal(hc_ratio_code(1.6e-5F, 8, 1.0F), 1);
    assert_int_equal(hc_ratio_code(1.5e-5F, 8, 1.0F), 0);
}

static void test_slopes(void **state)
{
    (void)state;
    assert_int_equal(hc_slope_bias(8), 127);
    assert_int_equal(hc_slope_bias(16), 32767);
    assert_int_equal(hc_slope_code(0.0, 8), 127);
    assert_int_equal(hc_slope_code(0.5, 8), 127);
    assert_int_equal(hc_slope_code(-0.5, 8), 127);
    assert_int_equal(hc_slope_code(0.51, 8), 128);
    assert_int_equal(hc_slope_code(-0.51, 8), 126);
    assert_int_equal(hc_slope_code(1.5, 8), 128);
    assert_int_equal(hc_slope_code(-1.75, 8), 125);
    assert_int_equal(hc_slope_code(127.0, 8), 254);
    assert_int_equal(hc_slope_code(255.0, 8), 254);
    assert_int_equal(hc_slope_code(-255.0, 8), 0);
    assert_int_equal(hc_slope_code(-40000.0, 16), 0);
    /* inside, where nothing saturates: what integer division by two gives */
    for (int difference = -255; difference <= 255; difference++) {
        assert_int_equal(hc_slope_code(difference / 2.0, 8), 127 + difference / 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_heights),
        cmocka_unit_test(test_rounded_heights),
        cmocka_unit_test(test_ratios),
        cmocka_unit_test(test_slopes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
