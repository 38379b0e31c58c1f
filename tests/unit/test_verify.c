/* The judge itself: honest maps pass, each kind of fault is found and placed. */
#include "small_fields.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { WIDTH = 29, HEIGHT = 17, TEXELS = WIDTH * HEIGHT };

static float heights[TEXELS];

/* A map of the field in `heights`. */
static hc_map baked(const hc_map_options *options, hc_wrap wrap, hc_field *field)
{
    hc_map map;
    hc_log log = { .warn = NULL };
    small_fill(heights, WIDTH, HEIGHT, SLOPE, 11);
    *field = (hc_field){ .heights = heights, .width = WIDTH, .height = HEIGHT, .wrap = wrap };
    if (hc_map_info_for(&map.info, field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    map.texels = malloc(hc_map_bytes(&map.info));
    assert_non_null(map.texels);
    assert_int_equal(hc_bake_map(&map, field, options, &log), HC_OK);
    return map;
}

static hc_verdict verdict_on(const hc_map *map, const hc_field *field, size_t texels, int threads)
{
    hc_verdict verdict;
    hc_log     log = { .warn = NULL };
    if (hc_verify_map(&verdict, map, field, texels, threads, (hc_progress){ NULL, NULL }, &log)
        != HC_OK) {
        fail_msg("%s", log.text);
    }
    return verdict;
}

static void test_exact_maps_pass(void **state)
{
    (void)state;
    for (int i = 0; i < 4 * 3 * 2; i++) {
        hc_field             field;
        const hc_map_options options = { .bits = 8 << i / 4 % 3,
                                         .cone = { .cones = (hc_cones)(i % 4) } };
        hc_map               map     = baked(&options, i < 12 ? HC_WRAP_NONE : HC_WRAP_UV, &field);
        const hc_verdict     verdict = verdict_on(&map, &field, 0, 2);
        assert_int_equal(verdict.checked, TEXELS * hc_cones_channels(options.cone.cones));
        assert_int_equal(verdict.wider, 0);
        assert_true(verdict.widest_factor == 1.0);
        assert_int_equal(verdict.height_differs, 0);
        assert_true(verdict.mean_kept <= 1.0 + 1e-12);
        assert_true(verdict.mean_kept > (options.bits == 8 ? 0.98 : 0.9999));
        if (options.bits == 32) {
            assert_true(fabs(verdict.mean_kept - 1.0) < 1e-12);
        }
        free(map.texels);
    }
}

/* One unit in the last place wider is too wide. */
static void test_finds_one_wide_texel(void **state)
{
    (void)state;
    hc_field field;
    hc_map   map       = baked(NULL, HC_WRAP_V, &field);
    float   *at        = &((float *)map.texels)[2 * (7 * WIDTH + 5) + 1];
    *at                = nextafterf(*at, INFINITY);
    hc_verdict verdict = verdict_on(&map, &field, 0, 1);
    assert_int_equal(verdict.wider, 1);
    assert_int_equal(verdict.worst_x, 5);
    assert_int_equal(verdict.worst_y, 7);
    assert_true(verdict.widest_factor > 1.0 && verdict.widest_factor < 1.000001);
    *at *= 2.0F;
    verdict = verdict_on(&map, &field, 0, 1);
    assert_true(fabs(verdict.widest_factor - 2.0) < 1e-6);
    *at     = NAN;
    verdict = verdict_on(&map, &field, 0, 1);
    assert_int_equal(verdict.wider, 1);
    assert_true(isinf(verdict.widest_factor));
    *at     = 0.0F; /* no free space known: narrow, not wrong */
    verdict = verdict_on(&map, &field, 0, 1);
    assert_int_equal(verdict.wider, 0);
    assert_true(verdict.mean_kept < 1.0 - 0.5 / TEXELS);
    free(map.texels);
}

static void test_finds_a_wide_code(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        hc_field             field;
        const hc_map_options options = { .bits = 16,
                                         .cone = { .cones = (hc_cones)i, .max_ratio = 64.0F } };
        hc_map               map     = baked(&options, HC_WRAP_NONE, &field);
        const int            last    = map.info.channels - 1;
        uint16_t            *at      = map.texels;
        size_t               wider   = 0;
        for (int texel = 0; texel < TEXELS; texel++) {
            const size_t element = (size_t)(texel * map.info.channels + last);
            wider += at[element] < 65535;
            at[element] = (uint16_t)(at[element] < 65535 ? at[element] + 1 : 65535);
        }
        assert_true(wider > TEXELS / 2);
        assert_int_equal(verdict_on(&map, &field, 0, 2).wider, wider);
        free(map.texels);
    }
}

/* Either slope of an elongated diamond made gentler lets a sample in. */
static void test_finds_a_wide_pair(void **state)
{
    (void)state;
    hc_field             field;
    const hc_map_options options = { .cone = { .cones = HC_CONES_ANISO } };
    hc_map               map     = baked(&options, HC_WRAP_NONE, &field);
    float               *texel   = (float *)map.texels + 4 * (3 * WIDTH + 9);
    texel[1] *= 1.5F;
    texel[2] *= 1.5F;
    const hc_verdict verdict = verdict_on(&map, &field, 0, 1);
    assert_int_equal(verdict.wider, 2);
    assert_true(verdict.widest_factor > 1.49 && verdict.widest_factor < 1.51);
    assert_int_equal(verdict.worst_x, 9);
    assert_int_equal(verdict.worst_y, 3);
    free(map.texels);
}

static void test_tells_methods_apart(void **state)
{
    (void)state;
    static const struct {
        hc_method method;
        bool      safe;
    } cases[] = { { HC_METHOD_RING, true },
                  { HC_METHOD_QUICK, true },
                  { HC_METHOD_QUICK_IMPROVED, true },
                  { HC_METHOD_QUICK_CENTRE, false },
                  { HC_METHOD_QUICK_NAIVE_CENTRE, false } };
    for (int i = 0; i < 5; i++) {
        hc_field field;
        hc_map   map =
            baked(&(hc_map_options){ .cone = { .method = cases[i].method } }, HC_WRAP_UV, &field);
        const hc_verdict verdict = verdict_on(&map, &field, 0, 2);
        assert_int_equal(verdict.wider == 0, cases[i].safe);
        assert_int_equal(verdict.widest_factor > 1.0, !cases[i].safe);
        assert_int_equal(fabs(verdict.mean_kept - 1.0) > 0.001, cases[i].method != HC_METHOD_RING);
        free(map.texels);
    }
    /* an elongated diamond of another choice than the canonical is no fault */
    hc_field field;
    hc_map   map = baked(&(hc_map_options){ .cone = { .method = HC_METHOD_QUICK_IMPROVED,
                                                      .cones  = HC_CONES_ANISO } },
                         HC_WRAP_UV, &field);
    assert_int_equal(verdict_on(&map, &field, 0, 2).wider, 0);
    free(map.texels);
}

static void test_relaxed_and_2006_are_wider(void **state)
{
    (void)state;
    hc_field field;
    hc_map   relaxed = baked(&(hc_map_options){ .kind = HC_MAP_RELAXED }, HC_WRAP_NONE, &field);
    assert_true(verdict_on(&relaxed, &field, 0, 2).wider > 0);
    hc_map old = baked(&(hc_map_options){ .compat2006 = true }, HC_WRAP_UV, &field);
    assert_true(verdict_on(&old, &field, 0, 2).wider > 0);
    free(relaxed.texels);
    free(old.texels);
}

static void test_counts_other_heights(void **state)
{
    (void)state;
    hc_field field;
    hc_map   map = baked(&(hc_map_options){ .bits = 8 }, HC_WRAP_NONE, &field);
    ((uint8_t *)map.texels)[0] ^= 1;
    ((uint8_t *)map.texels)[2 * 50] ^= 1;
    assert_int_equal(verdict_on(&map, &field, 3, 1).height_differs, 2);
    free(map.texels);
}

/* A sample is of different texels, grows into all of them, and does not depend on threads. */
static void test_samples(void **state)
{
    (void)state;
    hc_field field;
    hc_map   map = baked(NULL, HC_WRAP_NONE, &field);
    for (int texel = 0; texel < TEXELS; texel++) {
        ((float *)map.texels)[2 * texel + 1] = INFINITY;
    }
    const size_t all = verdict_on(&map, &field, 0, 1).wider; /* all but the highest */
    assert_true(all > 0 && all < TEXELS);
    assert_int_equal(verdict_on(&map, &field, TEXELS, 3).wider, all);
    assert_int_equal(verdict_on(&map, &field, TEXELS - 1, 3).checked, TEXELS - 1);
    assert_in_range(verdict_on(&map, &field, TEXELS - 1, 3).wider, all - 1, all);
    assert_in_range(verdict_on(&map, &field, 100, 3).wider, 100 - (TEXELS - all), 100);
    const hc_verdict one  = verdict_on(&map, &field, 333, 1);
    const hc_verdict four = verdict_on(&map, &field, 333, 4);
    assert_true(one.mean_kept == four.mean_kept && one.wider == four.wider);
    assert_true(one.worst_x == four.worst_x && one.worst_y == four.worst_y);
    free(map.texels);
}

static bool refuse(void *user, double fraction)
{
    (void)user;
    (void)fraction;
    return false;
}

static void expect_refusal(const hc_map *map, const hc_field *field, hc_result wanted,
                           const char *says)
{
    hc_verdict verdict;
    hc_log     log = { .warn = NULL };
    assert_int_equal(hc_verify_map(&verdict, map, field, 0, 1, (hc_progress){ NULL, NULL }, &log),
                     wanted);
    if (strstr(log.text, says) == NULL) {
        fail_msg("\"%s\" does not say \"%s\"", log.text, says);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    hc_field   field;
    hc_verdict verdict;
    hc_map     map     = baked(NULL, HC_WRAP_NONE, &field);
    hc_map     pyramid = baked(&(hc_map_options){ .kind = HC_MAP_PYRAMID }, HC_WRAP_NONE, &field);
    hc_map     bare = baked(&(hc_map_options){ .layout = HC_LAYOUT_HEIGHT }, HC_WRAP_NONE, &field);
    expect_refusal(&pyramid, &field, HC_ERROR_ARGUMENT, "pyramid map");
    expect_refusal(&bare, &field, HC_ERROR_ARGUMENT, "layout height");
    field.width -= 1;
    expect_refusal(&map, &field, HC_ERROR_ARGUMENT, "29 x 17");
    field.width += 1;
    heights[5] = 2.0F;
    expect_refusal(&map, &field, HC_ERROR_FIELD, "heights[5, 0]");
    heights[5] = 0.0F;
    assert_int_equal(
        hc_verify_map(&verdict, &map, &field, 0, 1, (hc_progress){ refuse, NULL }, NULL),
        HC_ERROR_CANCELLED);
    free(map.texels);
    free(pyramid.texels);
    free(bare.texels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_maps_pass),
        cmocka_unit_test(test_finds_one_wide_texel),
        cmocka_unit_test(test_finds_a_wide_code),
        cmocka_unit_test(test_finds_a_wide_pair),
        cmocka_unit_test(test_tells_methods_apart),
        cmocka_unit_test(test_relaxed_and_2006_are_wider),
        cmocka_unit_test(test_counts_other_heights),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
