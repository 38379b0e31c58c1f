/* Names, level arithmetic, sizes, checks and decoding of maps. */
#include <heightcast/maps.h>

#include "maps/codes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
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
    assert_string_equal(hc_cones_name(HC_CONES_L2), "l2");
    assert_string_equal(hc_cones_name(HC_CONES_L1), "l1");
    assert_string_equal(hc_cones_name(HC_CONES_QUAD), "quad");
    assert_string_equal(hc_cones_name(HC_CONES_ANISO), "aniso");
    assert_string_equal(hc_map_kind_name(HC_MAP_CONE), "cone");
    assert_string_equal(hc_map_kind_name(HC_MAP_GRADIENT), "gradient");
    assert_string_equal(hc_layout_name(HC_LAYOUT_AUTO), "auto");
    assert_string_equal(hc_layout_name(HC_LAYOUT_DUMMER), "dummer");
    assert_string_equal(hc_layout_name(HC_LAYOUT_GRADIENT), "gradient");
    assert_string_equal(hc_cones_name((hc_cones)4), "unknown");
    assert_string_equal(hc_map_kind_name((hc_map_kind)5), "unknown");
    assert_string_equal(hc_layout_name((hc_layout)8), "unknown");
}

static void test_channels(void **state)
{
    (void)state;
    static const int cones[]   = { 1, 1, 4, 3, 0 };
    static const int layouts[] = { 0, 4, 2, 4, 4, 1, 2, 2, 0 };
    for (int i = 0; i < 5; i++) {
        assert_int_equal(hc_cones_channels((hc_cones)i), cones[i]);
    }
    for (int i = 0; i < 9; i++) {
        assert_int_equal(hc_layout_channels((hc_layout)i), layouts[i]);
    }
}

static void test_pyramid_sizes(void **state)
{
    (void)state;
    static const struct {
        int    width, height, levels;
        size_t size;
    } cases[] = {
        { 1, 1, 1, 1 },
        { 2, 1, 2, 2 + 1 },
        { 1, 3, 2, 3 + 1 },
        { 4, 4, 3, 16 + 4 + 1 },
        { 5, 3, 3, 15 + 2 + 1 },
        { 7, 1, 3, 7 + 3 + 1 },
        { 403, 344, 9,
          403 * 344 + 201 * 172 + 100 * 86 + 50 * 43 + 25 * 21 + 12 * 10 + 6 * 5 + 3 * 2 + 1 },
        { HC_SIDE_MAX, 1, 21, 2 * (size_t)HC_SIDE_MAX - 1 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(hc_pyramid_levels(cases[i].width, cases[i].height), cases[i].levels);
        assert_true(hc_pyramid_size(cases[i].width, cases[i].height) == cases[i].size);
    }
    static const int bad[][2] = { { 0, 1 }, { 1, 0 }, { -4, 4 }, { HC_SIDE_MAX + 1, 1 } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(hc_pyramid_levels(bad[i][0], bad[i][1]), 0);
        assert_true(hc_pyramid_size(bad[i][0], bad[i][1]) == 0);
    }
}

/* Levels follow one another without gaps, and halve as graphics APIs count. */
static void test_pyramid_levels(void **state)
{
    (void)state;
    static const int sizes[][2] = { { 1, 1 }, { 13, 6 }, { 1, 9 }, { 64, 64 }, { 255, 2 } };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        int              width = sizes[i][0], height = sizes[i][1];
        float           *values   = calloc(hc_pyramid_size(width, height), sizeof *values);
        const hc_pyramid pyramid  = { values, width, height, hc_pyramid_levels(width, height) };
        float           *expected = values;
        for (int level = 0; level < pyramid.levels; level++) {
            int level_width, level_height;
            assert_ptr_equal(hc_pyramid_level(&pyramid, level, &level_width, &level_height),
                             expected);
            assert_ptr_equal(hc_pyramid_level(&pyramid, level, NULL, NULL), expected);
            assert_int_equal(level_width, width);
            assert_int_equal(level_height, height);
            expected += (size_t)width * (size_t)height;
            width  = width > 1 ? width / 2 : 1;
            height = height > 1 ? height / 2 : 1;
        }
        assert_ptr_equal(expected, values + hc_pyramid_size(pyramid.width, pyramid.height));
        assert_true(expected[-1] == 0.0F); /* the last level ends inside the allocation */
        free(values);
    }
}

static hc_map_info good_info(void)
{
    return (hc_map_info){ .kind      = HC_MAP_CONE,
                          .layout    = HC_LAYOUT_RG,
                          .bits      = 8,
                          .width     = 5,
                          .height    = 3,
                          .channels  = 2,
                          .levels    = 1,
                          .max_ratio = 1.0F };
}

static void test_bytes(void **state)
{
    (void)state;
    hc_map_info info = good_info();
    assert_true(hc_map_bytes(&info) == 5 * 3 * 2);
    info.bits = 16;
    assert_true(hc_map_bytes(&info) == 5 * 3 * 2 * 2);
    info.bits   = 32;
    info.levels = 3;
    assert_true(hc_map_bytes(&info) == (15 + 2 + 1) * 2 * 4);
    info.levels = 2; /* neither one nor all */
    assert_true(hc_map_bytes(&info) == 0);
}

static void test_bytes_of_huge_and_bad_maps(void **state)
{
    (void)state;
    hc_map_info info = good_info();
    info.width = info.height = HC_SIDE_MAX;
    info.bits                = 32;
    info.channels            = 4;
    info.levels              = 21;
    const uint64_t texels    = (((uint64_t)1 << 42) - 1) / 3;
    const uint64_t expected  = texels * 16;
    assert_true(hc_map_bytes(&info) == (expected <= PTRDIFF_MAX ? expected : 0));
    for (int i = 0; i < 6; i++) {
        hc_map_info bad = good_info();
        switch (i) {
        case 0: bad.width = 0; break;
        case 1: bad.height = HC_SIDE_MAX + 1; break;
        case 2: bad.channels = 0; break;
        case 3: bad.channels = 5; break;
        case 4: bad.bits = 24; break;
        default: bad.levels = 0; break;
        }
        assert_true(hc_map_bytes(&bad) == 0);
    }
}

static void test_map_level(void **state)
{
    (void)state;
    uint16_t texels[(15 + 2 + 1) * 2];
    hc_map   map    = { .info = good_info(), .texels = texels };
    map.info.kind   = HC_MAP_PYRAMID;
    map.info.layout = HC_LAYOUT_MINMAX;
    map.info.bits   = 16;
    map.info.levels = 3;
    int width, height;
    assert_ptr_equal(hc_map_level(&map, 0, NULL, NULL), texels);
    assert_ptr_equal(hc_map_level(&map, 1, &width, &height), texels + 15 * 2);
    assert_int_equal(width, 2);
    assert_int_equal(height, 1);
    assert_ptr_equal(hc_map_level(&map, 2, &width, &height), texels + 17 * 2);
    assert_int_equal(width * height, 1);
}

static void expect_refused(const hc_map_info *info, const char *words)
{
    hc_log log = { 0 };
    assert_int_equal(hc_map_info_check(info, &log), HC_ERROR_ARGUMENT);
    if (strstr(log.text, words) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, words);
    }
    assert_int_equal(hc_map_info_check(info, NULL), HC_ERROR_ARGUMENT);
}

static void test_check_accepts(void **state)
{
    (void)state;
    static const struct {
        hc_map_kind kind;
        hc_layout   layout;
        hc_cones    cones;
        int         bits, levels;
        float       max_ratio;
    } good[] = {
        { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L2, 8, 1, 2.0F },
        { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L1, 32, 1, 0.0F },
        { HC_MAP_CONE, HC_LAYOUT_DUMMER, HC_CONES_L2, 8, 1, 1.0F },
        { HC_MAP_CONE, HC_LAYOUT_QUAD, HC_CONES_QUAD, 16, 1, 1.0F },
        { HC_MAP_CONE, HC_LAYOUT_ANISO, HC_CONES_ANISO, 32, 1, 0.0F },
        { HC_MAP_CONE, HC_LAYOUT_HEIGHT, HC_CONES_QUAD, 8, 1, 0.0F },
        { HC_MAP_RELAXED, HC_LAYOUT_RG, HC_CONES_L2, 16, 1, 1.0F },
        { HC_MAP_RELAXED, HC_LAYOUT_DUMMER, HC_CONES_L2, 8, 1, 1.0F },
        { HC_MAP_PYRAMID, HC_LAYOUT_MINMAX, HC_CONES_L2, 8, 3, 0.0F },
        { HC_MAP_PYRAMID, HC_LAYOUT_HEIGHT, HC_CONES_L2, 16, 1, 0.0F },
        { HC_MAP_BOUNDS, HC_LAYOUT_MINMAX, HC_CONES_L2, 32, 3, 0.0F },
        { HC_MAP_GRADIENT, HC_LAYOUT_GRADIENT, HC_CONES_L2, 8, 1, 0.0F },
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        hc_map_info info = good_info();
        info.kind        = good[i].kind;
        info.layout      = good[i].layout;
        info.cones       = good[i].cones;
        info.channels    = hc_layout_channels(info.layout);
        info.bits        = good[i].bits;
        info.levels      = good[i].levels;
        info.max_ratio   = good[i].max_ratio;
        hc_log log       = { 0 };
        if (hc_map_info_check(&info, &log) != HC_OK) {
            fail_msg("case %zu: %s", i, log.text);
        }
    }
}

static void test_check_refuses_enums(void **state)
{
    (void)state;
    expect_refused(NULL, "NULL");
    hc_map_info info = good_info();
    info.kind        = (hc_map_kind)5;
    expect_refused(&info, "map kind is 5");
    info       = good_info();
    info.cones = (hc_cones)4;
    expect_refused(&info, "map cones are 4");
    info        = good_info();
    info.layout = HC_LAYOUT_AUTO;
    expect_refused(&info, "map layout is 0");
    info      = good_info();
    info.wrap = (hc_wrap)4;
    expect_refused(&info, "map wrap is 4");
    info              = good_info();
    info.registration = (hc_registration)2;
    expect_refused(&info, "map registration is 2");
}

static void test_check_refuses_layouts(void **state)
{
    (void)state;
    hc_map_info info = good_info();
    info.cones       = HC_CONES_QUAD;
    expect_refused(&info, "layout rg cannot hold a cone map with cones quad");
    info      = good_info();
    info.kind = HC_MAP_PYRAMID;
    expect_refused(&info, "layout rg cannot hold a pyramid map");
    info       = good_info();
    info.kind  = HC_MAP_RELAXED;
    info.cones = HC_CONES_L1;
    expect_refused(&info, "relaxed cones are l2, not l1");
    info          = good_info();
    info.channels = 3;
    expect_refused(&info, "map has 3 channels; layout rg has 2");
    info      = good_info();
    info.bits = 12;
    expect_refused(&info, "map has 12 bits");
    info            = good_info();
    info.compat2006 = true;
    expect_refused(&info, "compat2006");
}

static void test_check_refuses_sizes(void **state)
{
    (void)state;
    hc_map_info info = good_info();
    info.width       = 0;
    expect_refused(&info, "map size is 0 x 3");
    info        = good_info();
    info.levels = 3;
    expect_refused(&info, "cone map has 3 levels; it must have 1");
    info.kind   = HC_MAP_BOUNDS;
    info.layout = HC_LAYOUT_MINMAX;
    info.levels = 2;
    expect_refused(&info, "has 2 levels; it must have 1 or 3");
}

static void test_check_refuses_ratios_and_texts(void **state)
{
    (void)state;
    hc_map_info info = good_info();
    info.max_ratio   = 0.0F;
    expect_refused(&info, "max_ratio is 0");
    info.max_ratio = NAN;
    expect_refused(&info, "max_ratio is");
    info.max_ratio = INFINITY;
    expect_refused(&info, "max_ratio is inf");
    info           = good_info();
    info.layout    = HC_LAYOUT_DUMMER;
    info.channels  = 4;
    info.max_ratio = 1.5F;
    expect_refused(&info, "max_ratio is 1.5");
    info.max_ratio = 1.0F;
    info.bits      = 16;
    expect_refused(&info, "map has 16 bits; layout dummer has 8");
    info = good_info();
    memset(info.method, 'x', sizeof info.method);
    expect_refused(&info, "not terminated");
    info = good_info();
    memset(info.elevation.unit, 'x', sizeof info.elevation.unit);
    expect_refused(&info, "not terminated");
}

static void test_decode_codes(void **state)
{
    (void)state;
    uint8_t rg[]       = { 0, 0, 255, 255, 51, 127 };
    hc_map  map        = { .info = good_info(), .texels = rg };
    map.info.width     = 3;
    map.info.height    = 1;
    map.info.max_ratio = 4.0F;
    assert_true(hc_map_height_at(&map, 0, 0) == 0.0F);
    assert_true(hc_map_height_at(&map, 1, 0) == 1.0F);
    assert_true(hc_map_height_at(&map, 2, 0) == 0.2F);
    assert_true(hc_map_ratio_at(&map, 0, 0, 0) == 0.0F);
    assert_true(hc_map_ratio_at(&map, 1, 0, 0) == 4.0F);
    assert_near((double)hc_map_ratio_at(&map, 2, 0, 0), 4.0 * 127 * 127 / (255.0 * 255.0), 1e-6);
    assert_true(isnan(hc_map_ratio_at(&map, 0, 0, 1)));
    assert_true(isnan(hc_map_ratio_at(&map, 0, 0, -1)));

    /* The paper's layout squares the code whatever the limit was. */
    uint8_t dummer[]   = { 102, 255, 7, 9 };
    map.info.layout    = HC_LAYOUT_DUMMER;
    map.info.channels  = 4;
    map.info.width     = 1;
    map.info.max_ratio = 0.5F;
    map.texels         = dummer;
    assert_true(hc_map_height_at(&map, 0, 0) == 0.4F);
    assert_true(hc_map_ratio_at(&map, 0, 0, 0) == 1.0F);
}

static void test_decode_wide_layouts(void **state)
{
    (void)state;
    uint16_t quad[]    = { 65535, 0, 32768, 1, 1, 2, 3, 65535 };
    hc_map   map       = { .info = good_info(), .texels = quad };
    map.info.layout    = HC_LAYOUT_QUAD;
    map.info.cones     = HC_CONES_QUAD;
    map.info.channels  = 4;
    map.info.bits      = 16;
    map.info.width     = 1;
    map.info.height    = 2;
    map.info.max_ratio = 2.0F;
    assert_true(isnan(hc_map_height_at(&map, 0, 0)));
    assert_true(hc_map_ratio_at(&map, 0, 0, 0) == 2.0F);
    assert_true(hc_map_ratio_at(&map, 0, 0, 1) == 0.0F);
    assert_true(hc_map_ratio_at(&map, 0, 1, 3) == 2.0F);

    float aniso[]   = { 0.25F, 1.5F, INFINITY, 0.75F };
    map.info.layout = HC_LAYOUT_ANISO;
    map.info.cones  = HC_CONES_ANISO;
    map.info.bits   = 32;
    map.info.height = 1;
    map.texels      = aniso;
    assert_true(hc_map_height_at(&map, 0, 0) == 0.25F);
    assert_true(hc_map_ratio_at(&map, 0, 0, 0) == 1.5F);
    assert_true(hc_map_ratio_at(&map, 0, 0, 1) == INFINITY);
    assert_true(hc_map_ratio_at(&map, 0, 0, 2) == 0.75F);

    float minmax[]    = { 0.75F, 0.5F };
    map.info.kind     = HC_MAP_PYRAMID;
    map.info.layout   = HC_LAYOUT_MINMAX;
    map.info.channels = 2;
    map.texels        = minmax;
    assert_true(hc_map_height_at(&map, 0, 0) == 0.75F);
    assert_true(isnan(hc_map_ratio_at(&map, 0, 0, 0)));
}

/* Codes must rise with what they mean, or rounding down cannot work. */
static void test_codes_rise(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        for (int code = 1; code <= hc_code_max(bits); code++) {
            assert_true(hc_code_height(code, bits) > hc_code_height(code - 1, bits));
            assert_true(hc_code_ratio(code, bits, 3.0F) > hc_code_ratio(code - 1, bits, 3.0F));
        }
        assert_true(hc_code_height(hc_code_max(bits), bits) == 1.0F);
        assert_true(hc_code_ratio(hc_code_max(bits), bits, 3.0F) == 3.0F);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_channels),
        cmocka_unit_test(test_pyramid_sizes),
        cmocka_unit_test(test_pyramid_levels),
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_bytes_of_huge_and_bad_maps),
        cmocka_unit_test(test_map_level),
        cmocka_unit_test(test_check_accepts),
        cmocka_unit_test(test_check_refuses_enums),
        cmocka_unit_test(test_check_refuses_layouts),
        cmocka_unit_test(test_check_refuses_sizes),
        cmocka_unit_test(test_check_refuses_ratios_and_texts),
        cmocka_unit_test(test_decode_codes),
        cmocka_unit_test(test_decode_wide_layouts),
        cmocka_unit_test(test_codes_rise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
