/* Names, distances, surfaces and the check of fields. */
#include <heightcast/bake.h>
#include <heightcast/field.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* In double: cmocka's own comparison rounds to float first. */
static void assert_near(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance)) {
        fail_msg("%.17g is not %.17g", value, wanted);
    }
}

static void test_names(void **state)
{
    (void)state;
    assert_string_equal(hc_wrap_name(HC_WRAP_NONE), "none");
    assert_string_equal(hc_wrap_name(HC_WRAP_U), "u");
    assert_string_equal(hc_wrap_name(HC_WRAP_V), "v");
    assert_string_equal(hc_wrap_name(HC_WRAP_UV), "uv");
    assert_string_equal(hc_wrap_name((hc_wrap)4), "unknown");
    assert_string_equal(hc_registration_name(HC_TEXEL), "texel");
    assert_string_equal(hc_registration_name(HC_GRID), "grid");
    assert_string_equal(hc_registration_name((hc_registration)2), "unknown");
}

static void test_sample_sizes(void **state)
{
    (void)state;
    static const size_t sizes[] = { 1, 2, 2, 4, 4, 4, 8, 0 };
    for (int i = 0; i < 8; i++) {
        assert_true(hc_sample_size((hc_sample_type)i) == sizes[i]);
    }
}

static void test_steps(void **state)
{
    (void)state;
    hc_field field = { .width = 5, .height = 1 };
    assert_true(hc_field_step_u(&field) == 1.0 / 5.0);
    assert_true(hc_field_step_v(&field) == 1.0);
    field.registration = HC_GRID;
    assert_true(hc_field_step_u(&field) == 1.0 / 4.0);
    assert_true(hc_field_step_v(&field) == 1.0); /* one sample: never a division by zero */
    field.wrap = HC_WRAP_U;
    assert_true(hc_field_step_u(&field) == 1.0 / 5.0);
    field.wrap   = HC_WRAP_V;
    field.height = 3;
    assert_true(hc_field_step_u(&field) == 1.0 / 4.0);
    assert_true(hc_field_step_v(&field) == 1.0 / 3.0);
    field.wrap = HC_WRAP_NONE;
    assert_true(hc_field_step_v(&field) == 1.0 / 2.0);
}

static const float four_by_two[] = { 0.0F, 0.25F, 1.0F, 0.5F, 0.5F, 0.75F, 0.0F, 1.0F };

static void test_surface_goes_through_samples(void **state)
{
    (void)state;
    hc_field field = { .heights = four_by_two, .width = 4, .height = 2 };
    for (int registration = 0; registration < 2; registration++) {
        field.registration = (hc_registration)registration;
        for (unsigned wrap = 0; wrap < 4; wrap++) {
            field.wrap            = (hc_wrap)wrap;
            const double offset_u = registration == HC_TEXEL ? 0.5 : 0.0;
            for (int i = 0; i < 8; i++) {
                const double u = (i % 4 + offset_u) * hc_field_step_u(&field);
                const double v = (i / 4 + offset_u) * hc_field_step_v(&field);
                assert_near(hc_field_surface(&field, u, v), (double)four_by_two[i], 1e-14);
            }
        }
    }
}

static void test_surface_between_samples(void **state)
{
    (void)state;
    const hc_field field = { .heights = four_by_two, .width = 4, .height = 2 };
    /* The middle of the four samples 0, 0.25, 0.5, 0.75; then a quarter of the way from 0.25 to
     * 1. */
    assert_near(hc_field_surface(&field, 1.0 / 4.0, 0.5), 0.375, 1e-15);
    assert_near(hc_field_surface(&field, 1.75 / 4.0, 0.25), 0.4375, 1e-15);
}

static void test_surface_outside_continues_with_the_edge(void **state)
{
    (void)state;
    hc_field field = { .heights = four_by_two, .width = 4, .height = 2 };
    assert_true(hc_field_surface(&field, 0.0, 0.0) == 0.0);
    assert_true(hc_field_surface(&field, 1.0, -1e300) == 0.5);
    assert_true(hc_field_surface(&field, 1e308, 1e308) == 1.0);
    assert_true(hc_field_surface(&field, -1e308, 1.0) == 0.5);
    field.registration = HC_GRID;
    assert_true(hc_field_surface(&field, 1.0, 0.0) == 0.5);
    assert_true(hc_field_surface(&field, 7.0, 1.0) == 1.0);
}

static void test_surface_outside_repeats(void **state)
{
    (void)state;
    hc_field field = { .heights = four_by_two, .width = 4, .height = 2, .wrap = HC_WRAP_U };
    /* Half way between the last and the first sample of row 0. */
    assert_near(hc_field_surface(&field, 0.0, 0.0), 0.25, 1e-15);
    assert_near(hc_field_surface(&field, 1.0, 0.0), 0.25, 1e-15);
    field.wrap = HC_WRAP_UV;
    for (int period = -3; period <= 3; period++) {
        const double here = hc_field_surface(&field, 0.3125, 0.8125);
        assert_near(hc_field_surface(&field, 0.3125 + period, 0.8125 - period), here, 1e-14);
    }
    field.registration = HC_GRID;
    assert_near(hc_field_surface(&field, 7.0 / 8.0, 0.0), 0.25, 1e-15);
    assert_near(hc_field_surface(&field, 7.0 / 8.0 - 5.0, 4.0), 0.25, 1e-15);
    /* The largest double below 0 rounds to a whole period. */
    assert_near(hc_field_surface(&field, -1e-300, 0.0), 0.0, 1e-15);
    assert_true(isfinite(hc_field_surface(&field, 1e308, -1e308)));
}

static void test_surface_of_one_sample(void **state)
{
    (void)state;
    const float height = 0.625F;
    for (unsigned wrap = 0; wrap < 4; wrap++) {
        for (int registration = 0; registration < 2; registration++) {
            const hc_field field = { .heights      = &height,
                                     .width        = 1,
                                     .height       = 1,
                                     .wrap         = (hc_wrap)wrap,
                                     .registration = (hc_registration)registration };
            assert_true(hc_field_surface(&field, 0.1, 0.9) == 0.625);
            assert_true(hc_field_surface(&field, -3.7, 12.0) == 0.625);
        }
    }
}

static void expect_refused(const hc_field *field, hc_result result, const char *words)
{
    hc_log log = { 0 };
    assert_int_equal(hc_field_check(field, &log), result);
    if (strstr(log.text, words) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, words);
    }
    assert_int_equal(hc_field_check(field, NULL), result);
}

static void test_check_shape(void **state)
{
    (void)state;
    const hc_field good = { .heights = four_by_two, .width = 4, .height = 2 };
    assert_int_equal(hc_field_check(&good, NULL), HC_OK);
    expect_refused(NULL, HC_ERROR_ARGUMENT, "field is NULL");
    hc_field bad = good;
    bad.heights  = NULL;
    expect_refused(&bad, HC_ERROR_ARGUMENT, "field.heights is NULL");
    bad       = good;
    bad.width = 0;
    expect_refused(&bad, HC_ERROR_ARGUMENT, "0 x 2");
    bad        = good;
    bad.height = HC_SIDE_MAX + 1;
    expect_refused(&bad, HC_ERROR_ARGUMENT, "4 x 1048577");
    bad      = good;
    bad.wrap = (hc_wrap)4;
    expect_refused(&bad, HC_ERROR_ARGUMENT, "field.wrap is 4");
    bad              = good;
    bad.registration = (hc_registration)2;
    expect_refused(&bad, HC_ERROR_ARGUMENT, "field.registration is 2");
}

static void test_check_heights(void **state)
{
    (void)state;
    static const float bad_heights[] = { NAN, INFINITY, -INFINITY, -0x1p-149F, 0x1.000002p0F };
    for (size_t i = 0; i < sizeof bad_heights / sizeof *bad_heights; i++) {
        float          heights[] = { 0.0F, 1.0F, 0.5F, 0.25F, 0.0F, 1.0F };
        const hc_field field     = { .heights = heights, .width = 3, .height = 2 };
        assert_int_equal(hc_field_check(&field, NULL), HC_OK);
        heights[5] = bad_heights[i];
        expect_refused(&field, HC_ERROR_FIELD, "field.heights[2, 1]");
        heights[1] = bad_heights[i]; /* the first one is named */
        expect_refused(&field, HC_ERROR_FIELD, "field.heights[1, 0]");
    }
}

/* A field large enough for threads to share the check. */
static void test_threads_name_the_first_height(void **state)
{
    (void)state;
    enum { WIDTH = 2100, HEIGHT = 2000 };
    float *heights = calloc((size_t)WIDTH * HEIGHT, sizeof *heights);
    float *ratios  = malloc((size_t)WIDTH * HEIGHT * sizeof *ratios);
    assert_non_null(heights);
    assert_non_null(ratios);
    const hc_field        field   = { .heights = heights, .width = WIDTH, .height = HEIGHT };
    const hc_cone_options options = { .method = HC_METHOD_QUICK, .threads = 3 };
    for (int y = HEIGHT - 1; y > 0; y -= 199) {
        hc_log log             = { 0 };
        heights[y * WIDTH + 7] = NAN;
        assert_int_equal(hc_bake_cone_map(ratios, &field, &options, &log), HC_ERROR_FIELD);
        hc_log alone = { 0 };
        assert_int_equal(hc_field_check(&field, &alone), HC_ERROR_FIELD);
        assert_string_equal(log.text, alone.text);
        char place[40];
        (void)snprintf(place, sizeof place, "field.heights[7, %d] is nan", y);
        assert_non_null(strstr(log.text, place));
    }
    free(heights);
    free(ratios);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_sample_sizes),
        cmocka_unit_test(test_steps),
        cmocka_unit_test(test_surface_goes_through_samples),
        cmocka_unit_test(test_surface_between_samples),
        cmocka_unit_test(test_surface_outside_continues_with_the_edge),
        cmocka_unit_test(test_surface_outside_repeats),
        cmocka_unit_test(test_surface_of_one_sample),
        cmocka_unit_test(test_check_shape),
        cmocka_unit_test(test_check_heights),
        cmocka_unit_test(test_threads_name_the_first_height),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
