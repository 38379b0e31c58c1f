/* Whole maps: what options come to, what is refused, and that the promise survives rounding. */
#include "small_fields.h"

#include "bake/compat2006.h"
#include "bake/quantise.h"
#include "maps/codes.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* ---- options --------------------------------------------------------------------------------- */

static const float eight[8] = { 0.0F, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 1.0F };

static hc_field field_of_eight(void)
{
    return (hc_field){ .heights = eight, .width = 4, .height = 2, .wrap = HC_WRAP_U };
}

static hc_map_info resolved(const hc_map_options *options)
{
    hc_map_info    info;
    hc_log         log   = { .warn = NULL };
    const hc_field field = field_of_eight();
    if (hc_map_info_for(&info, &field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    assert_int_equal(hc_map_info_check(&info, NULL), HC_OK);
    return info;
}

static void test_defaults(void **state)
{
    (void)state;
    hc_map_info info = resolved(NULL);
    assert_int_equal(info.kind, HC_MAP_CONE);
    assert_int_equal(info.layout, HC_LAYOUT_RG);
    assert_int_equal(info.bits, 32);
    assert_int_equal(info.channels, 2);
    assert_int_equal(info.levels, 1);
    assert_int_equal(info.wrap, HC_WRAP_U);
    assert_true(info.max_ratio == 0.0F);
    assert_string_equal(info.method, "exact");
    info = resolved(&(hc_map_options){ .layout = HC_LAYOUT_DUMMER });
    assert_int_equal(info.bits, 8);
    assert_true(info.max_ratio == 1.0F);
    info = resolved(&(hc_map_options){ .bits = 16, .cone = { .cones = HC_CONES_QUAD } });
    assert_int_equal(info.layout, HC_LAYOUT_QUAD);
    assert_true(info.max_ratio == 1.0F);
    info = resolved(&(hc_map_options){ .cone = { .cones = HC_CONES_ANISO, .max_ratio = 3.0F } });
    assert_int_equal(info.layout, HC_LAYOUT_ANISO);
    assert_int_equal(info.channels, 4);
    assert_true(info.max_ratio == 3.0F);
    info = resolved(&(hc_map_options){ .kind = HC_MAP_RELAXED });
    assert_string_equal(info.method, "falling-edge");
    info =
        resolved(&(hc_map_options){ .kind = HC_MAP_RELAXED, .cone = { .method = HC_METHOD_GEMS } });
    assert_string_equal(info.method, "gems");
    info = resolved(&(hc_map_options){ .kind = HC_MAP_PYRAMID });
    assert_int_equal(info.layout, HC_LAYOUT_MINMAX);
    assert_int_equal(info.levels, 3);
    assert_string_equal(info.method, "");
    assert_true(info.max_ratio == 0.0F);
    info = resolved(&(hc_map_options){ .kind = HC_MAP_GRADIENT, .bits = 8 });
    assert_int_equal(info.layout, HC_LAYOUT_GRADIENT);
    info = resolved(&(hc_map_options){ .compat2006 = true });
    assert_int_equal(info.layout, HC_LAYOUT_DUMMER);
    assert_string_equal(info.method, "2006");
}

static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        hc_map_options options;
        const char    *says;
    } cases[] = {
        { { .kind = (hc_map_kind)9 }, "kind" },
        { { .bits = 12 }, "12 bits" },
        { { .layout = HC_LAYOUT_DUMMER, .bits = 16 }, "16 bits" },
        { { .layout = HC_LAYOUT_DUMMER, .cone = { .cones = HC_CONES_QUAD } }, "dummer" },
        { { .layout = HC_LAYOUT_DUMMER, .cone = { .max_ratio = 2.0F } }, "max_ratio is 2" },
        { { .cone = { .max_ratio = -1.0F } }, "max_ratio is -1" },
        { { .layout = HC_LAYOUT_RG, .kind = HC_MAP_PYRAMID }, "pyramid" },
        { { .layout = HC_LAYOUT_MINMAX }, "minmax" },
        { { .cone = { .method = HC_METHOD_GEMS } }, "gems makes relaxed" },
        { { .kind = HC_MAP_RELAXED, .cone = { .method = HC_METHOD_QUICK } }, "quick does not" },
        { { .kind = HC_MAP_RELAXED, .cone = { .cones = HC_CONES_L1 } }, "relaxed cones are l2" },
        { { .cone = { .method = HC_METHOD_RING, .cones = HC_CONES_QUAD } }, "ring does not" },
        { { .cone = { .method = (hc_method)77 } }, "method is 77" },
        { { .compat2006 = true, .cone = { .method = HC_METHOD_RING } }, "compat2006" },
        { { .compat2006 = true, .cone = { .cones = HC_CONES_L1 } }, "compat2006" },
        { { .compat2006 = true, .cone = { .max_ratio = 0.5F } }, "compat2006 has 1" },
        { { .compat2006 = true, .kind = HC_MAP_PYRAMID }, "dummer" },
    };
    const hc_field field = field_of_eight();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        hc_map_info info;
        hc_log      log = { .warn = NULL };
        assert_int_equal(hc_map_info_for(&info, &field, &cases[i].options, &log),
                         HC_ERROR_ARGUMENT);
        if (strstr(log.text, cases[i].says) == NULL) {
            fail_msg("\"%s\" does not say \"%s\"", log.text, cases[i].says);
        }
    }
}

static void test_refused_fields(void **state)
{
    (void)state;
    hc_map_info info;
    const float bad[4]  = { 0.0F, 0.5F, NAN, 0.0F };
    hc_field    field   = { .heights = bad, .width = 2, .height = 2 };
    hc_log      log     = { .warn = NULL };
    uint8_t     room[8] = { 0 };
    assert_int_equal(hc_map_info_for(&info, &field, NULL, &log), HC_ERROR_FIELD);
    assert_int_equal(hc_map_info_for(&info, NULL, NULL, &log), HC_ERROR_ARGUMENT);
    field = (hc_field){ .heights = eight, .width = 1, .height = 8 };
    assert_int_equal(hc_map_info_for(&info, &field, &(hc_map_options){ .compat2006 = true }, &log),
                     HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "1 x 8"));
    /* a map that was made for something else */
    field      = field_of_eight();
    hc_map map = { .texels = room };
    assert_int_equal(hc_map_info_for(&map.info, &field, &(hc_map_options){ .bits = 8 }, NULL),
                     HC_OK);
    assert_int_equal(hc_bake_map(&map, &field, &(hc_map_options){ .bits = 16 }, &log),
                     HC_ERROR_ARGUMENT);
    map.texels = NULL;
    assert_int_equal(hc_bake_map(&map, &field, &(hc_map_options){ .bits = 8 }, &log),
                     HC_ERROR_ARGUMENT);
    assert_non_null(strstr(log.text, "NULL"));
}

/* ---- cone maps ------------------------------------------------------------------------------- */

static hc_field field_of(const small_case *small)
{
    return (hc_field){ .heights = small->heights,
                       .width   = small->job.width,
                       .height  = small->job.height,
                       .wrap =
                           (hc_wrap)((small->job.wrap_u ? 1 : 0) + (small->job.wrap_v ? 2 : 0)) };
}

/* A baked map in memory of exactly its size, so that a sanitizer sees what is written beyond. */
static hc_map bake(const small_case *small, const hc_map_options *options)
{
    hc_map         map;
    const hc_field field = field_of(small);
    hc_log         log   = { .warn = NULL };
    if (hc_map_info_for(&map.info, &field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    map.texels = malloc(hc_map_bytes(&map.info));
    assert_non_null(map.texels);
    memset(map.texels, 0x5A, hc_map_bytes(&map.info));
    assert_int_equal(hc_bake_map(&map, &field, options, &log), HC_OK);
    return map;
}

/* The codes are the highest that are not wider than the truth of the heights that are stored. */
static void expect_ratios(const hc_map *map, const small_case *small)
{
    small_case stored = *small;
    const int  bits   = map->info.bits;
    const int  texels = map->info.width * map->info.height;
    for (int p = 0; p < texels && map->info.layout != HC_LAYOUT_QUAD; p++) {
        const int   x      = p % map->info.width;
        const int   y      = p / map->info.width;
        const float own    = small->heights[p];
        stored.heights[p]  = hc_map_height_at(map, x, y);
        const float wanted = bits == 32 ? own : hc_code_height(hc_height_code(own, bits), bits);
        assert_true(same_bits(stored.heights[p], wanted));
    }
    stored.job.heights = stored.heights;
    stored.job.cones   = map->info.cones;
    for (int p = 0; p < texels; p++) {
        float truth[4];
        oracle_ratios(&stored.job, p % map->info.width, p / map->info.width, truth);
        for (int c = 0; c < hc_cones_channels(map->info.cones); c++) {
            const float limit = map->info.max_ratio > 0.0F ? map->info.max_ratio : INFINITY;
            const float most  = fminf(truth[c], limit);
            const float scale = map->info.layout == HC_LAYOUT_DUMMER ? 1.0F : limit;
            const float found = hc_map_ratio_at(map, p % map->info.width, p / map->info.width, c);
            assert_true(found <= truth[c]);
            assert_true(same_bits(
                found,
                bits == 32 ? most : hc_code_ratio(hc_ratio_code(most, bits, scale), bits, scale)));
        }
    }
}

static void test_cone_maps(void **state)
{
    (void)state;
    static const hc_layout layouts[] = { HC_LAYOUT_RG, HC_LAYOUT_RG, HC_LAYOUT_QUAD,
                                         HC_LAYOUT_ANISO };
    for (int i = 0; i < SMALL_SIZES * 4 * 3; i++) {
        small_case           small;
        const hc_map_options options = { .layout = layouts[i % 4],
                                         .bits   = 8 << i / 4 % 3,
                                         .cone   = { .cones     = (hc_cones)(i % 4),
                                                     .max_ratio = i % 5 == 0 ? 0.375F : 0.0F,
                                                     .threads   = 1 + i % 2 } };
        small_make(&small, i / 12, i % 3 + i % 2, (small_kind)(i % SMALL_KINDS), HC_CONES_L2);
        hc_map map = bake(&small, &options);
        expect_ratios(&map, &small);
        free(map.texels);
    }
}

static void test_safe_methods_stay_safe_in_codes(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 3; i++) {
        small_case           small;
        const hc_map_options options = {
            .bits = 8, .cone = { .method = (hc_method)(HC_METHOD_RING + i % 3) }
        };
        small_make(&small, i / 3, i % 4, NOISE, HC_CONES_L2);
        hc_map map = bake(&small, &options);
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            small.heights[p] =
                hc_code_height(hc_height_code(small.heights[p], 8), 8); /* what is stored */
        }
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            float     truth[4];
            const int x = p % small.job.width;
            const int y = p / small.job.width;
            oracle_ratios(&small.job, x, y, truth);
            assert_true(hc_map_ratio_at(&map, x, y, 0) <= truth[0]);
        }
        free(map.texels);
    }
}

/* ---- layout dummer --------------------------------------------------------------------------- */

static int at_most(int value, int most)
{
    return value > most ? most : value < -most ? -most : value;
}

/* Differences of codes: two-sided ones halved towards level, one-sided ones whole, at most 127. */
static int dummer_slope(const small_case *small, int place, int side, bool wraps, int first,
                        int stride)
{
    int code[2];
    int from = place > 0 ? place - 1 : wraps ? side - 1 : place;
    int to   = place < side - 1 ? place + 1 : wraps ? 0 : place;
    code[0]  = hc_height_code(small->heights[first + from * stride], 8);
    code[1]  = hc_height_code(small->heights[first + to * stride], 8);
    return wraps || to - from == 2 ? (code[1] - code[0]) / 2 : at_most(code[1] - code[0], 127);
}

static void test_dummer(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 4; i++) {
        small_case small;
        small_make(&small, i / 4, i % 4, i % 2 ? LEVELS : NOISE, HC_CONES_L2);
        hc_map         map    = bake(&small, &(hc_map_options){ .layout = HC_LAYOUT_DUMMER });
        const uint8_t *texels = map.texels;
        const int      width  = small.job.width;
        expect_ratios(&map, &small);
        for (int p = 0; p < width * small.job.height; p++) {
            const int x = p % width;
            const int y = p / width;
            assert_int_equal(texels[4 * p], hc_height_code(small.heights[p], 8));
            assert_int_equal(texels[4 * p + 2],
                             127 + dummer_slope(&small, x, width, small.job.wrap_u, y * width, 1));
            assert_int_equal(
                texels[4 * p + 3],
                127 - dummer_slope(&small, y, small.job.height, small.job.wrap_v, x, width));
        }
        free(map.texels);
    }
}

static void test_compat2006(void **state)
{
    (void)state;
    small_case small;
    uint8_t    wanted[SMALL_TEXELS * 4];
    small_make(&small, 8, 1, SLOPE, HC_CONES_L2);
    hc_map map = bake(&small, &(hc_map_options){ .compat2006 = true, .cone = { .threads = 3 } });
    for (int p = 0; p < small.job.width * small.job.height; p++) {
        wanted[4 * p] = (uint8_t)hc_height_code(small.heights[p], 8);
    }
    assert_int_equal(hc_compat2006(wanted, small.job.width, small.job.height, HC_WRAP_U, 1,
                                   (hc_progress){ NULL, NULL }, NULL),
                     HC_OK);
    assert_memory_equal(map.texels, wanted, hc_map_bytes(&map.info));
    free(map.texels);
}

/* ---- relaxed, heights, pyramids, gradients --------------------------------------------------- */

static void test_relaxed(void **state)
{
    (void)state;
    for (int gems = 0; gems < 2; gems++) {
        small_case           small;
        const hc_map_options options = {
            .kind = HC_MAP_RELAXED, .cone = { .method = gems ? HC_METHOD_GEMS : HC_METHOD_EXACT }
        };
        small_make(&small, 8, 2, SPIKES, HC_CONES_L2);
        hc_map map = bake(&small, &options);
        assert_int_equal(gems ? hc_cone_gems(&small.job) : hc_cone_falling_edge(&small.job), HC_OK);
        for (int p = 0; p < small.job.width * small.job.height; p++) {
            assert_true(same_bits(((float *)map.texels)[2 * p], small.heights[p]));
            assert_true(same_bits(((float *)map.texels)[2 * p + 1], small.ratios[p]));
        }
        free(map.texels);
    }
}

static void test_heights_alone(void **state)
{
    (void)state;
    small_case small;
    small_make(&small, 8, 0, NOISE, HC_CONES_L2);
    hc_map coded = bake(&small, &(hc_map_options){ .layout = HC_LAYOUT_HEIGHT, .bits = 16 });
    hc_map exact = bake(&small, &(hc_map_options){ .layout = HC_LAYOUT_HEIGHT });
    for (int p = 0; p < small.job.width * small.job.height; p++) {
        assert_int_equal(((uint16_t *)coded.texels)[p], hc_height_code(small.heights[p], 16));
        assert_true(same_bits(((float *)exact.texels)[p], small.heights[p]));
    }
    free(coded.texels);
    free(exact.texels);
}

/* The value of one texel and channel, decoded. */
static float value_at(const hc_map *map, int level, int texel, int channel)
{
    const void *texels  = hc_map_level(map, level, NULL, NULL);
    const int   element = texel * map->info.channels + channel;
    switch (map->info.bits) {
    case 8: return hc_code_height(((const uint8_t *)texels)[element], 8);
    case 16: return hc_code_height(((const uint16_t *)texels)[element], 16);
    default: return ((const float *)texels)[element];
    }
}

static void expect_level(const hc_map *map, int level, int channel, const float *wanted)
{
    int          width, height;
    const double code = map->info.bits == 32 ? 0.0 : 1.001 / hc_code_max(map->info.bits);
    (void)hc_map_level(map, level, &width, &height);
    for (int texel = 0; texel < width * height; texel++) {
        const double outwards =
            (double)value_at(map, level, texel, channel) - (double)wanted[texel];
        assert_true(channel == 0 ? outwards >= 0.0 && outwards <= code
                                 : outwards <= 0.0 && outwards >= -code);
    }
}

/* Outwards, by less than a code; float ones exactly. Of all levels. */
static void test_pyramids(void **state)
{
    (void)state;
    for (int i = 0; i < SMALL_SIZES * 12; i++) {
        static float         values[2 * SMALL_TEXELS + 64], base[SMALL_TEXELS];
        small_case           small;
        const hc_map_options options = { .kind   = i % 2 ? HC_MAP_BOUNDS : HC_MAP_PYRAMID,
                                         .layout = i / 6 % 2 ? HC_LAYOUT_HEIGHT : HC_LAYOUT_AUTO,
                                         .bits   = 8 << i / 2 % 3 };
        small_make(&small, i / 12, i % 4, NOISE, HC_CONES_L2);
        const hc_field field = field_of(&small);
        hc_map         map   = bake(&small, &options);
        assert_int_equal(map.info.levels, hc_pyramid_levels(field.width, field.height));
        for (int channel = 0; channel < map.info.channels; channel++) {
            const hc_extreme extreme = channel == 0 ? HC_MAXIMUM : HC_MINIMUM;
            hc_pyramid       pyramid;
            memcpy(base, small.heights, sizeof base);
            if (i % 2) {
                hc_bake_bounds(base, &field, extreme);
            }
            hc_bake_pyramid(&pyramid, values, base, field.width, field.height, extreme);
            for (int level = 0; level < map.info.levels; level++) {
                expect_level(&map, level, channel, hc_pyramid_level(&pyramid, level, NULL, NULL));
            }
        }
        free(map.texels);
    }
}

static void test_coded_heights_stay_exact_in_pyramids(void **state)
{
    (void)state;
    small_case small;
    small_make(&small, 8, 0, NOISE, HC_CONES_L2);
    hc_round_heights(small.heights, small.heights, SMALL_TEXELS, 8);
    hc_map map = bake(&small, &(hc_map_options){ .kind = HC_MAP_PYRAMID, .bits = 8 });
    for (int p = 0; p < small.job.width * small.job.height; p++) {
        assert_true(value_at(&map, 0, p, 0) == small.heights[p]);
        assert_true(value_at(&map, 0, p, 1) == small.heights[p]);
    }
    free(map.texels);
}

static void test_gradients(void **state)
{
    (void)state;
    small_case small;
    float      gradients[SMALL_TEXELS * 2];
    small_make(&small, 8, 1, SLOPE, HC_CONES_L2);
    const hc_field field = field_of(&small);
    hc_map         exact = bake(&small, &(hc_map_options){ .kind = HC_MAP_GRADIENT });
    hc_map         coded = bake(&small, &(hc_map_options){ .kind = HC_MAP_GRADIENT, .bits = 16 });
    hc_bake_gradient(gradients, &field);
    assert_memory_equal(exact.texels, gradients, hc_map_bytes(&exact.info));
    for (int i = 0; i < 2 * field.width * field.height; i++) {
        const double step = i % 2 ? hc_field_step_v(&field) : hc_field_step_u(&field);
        const int    code = ((uint16_t *)coded.texels)[i] - 32767;
        assert_true(fabs(code - (double)gradients[i] * step * 65535.0) <= 0.501);
    }
    free(exact.texels);
    free(coded.texels);
}

static bool refuse(void *user, double fraction)
{
    (void)user;
    (void)fraction;
    return false;
}

static void test_stops_on_request(void **state)
{
    (void)state;
    small_case small;
    small_make(&small, 12, 0, NOISE, HC_CONES_L2);
    const hc_field field      = field_of(&small);
    uint8_t        room[1024] = { 0 };
    hc_map         map        = { .texels = room };
    /* one thread: the caller might get no row to report after otherwise */
    hc_map_options options = {
        .bits = 8, .cone = { .method = HC_METHOD_RING, .threads = 1, .progress = { refuse, NULL } }
    };
    assert_int_equal(hc_map_info_for(&map.info, &field, &options, NULL), HC_OK);
    assert_int_equal(hc_bake_map(&map, &field, &options, NULL), HC_ERROR_CANCELLED);
    options.compat2006  = true;
    options.cone.method = HC_METHOD_EXACT;
    assert_int_equal(hc_map_info_for(&map.info, &field, &options, NULL), HC_OK);
    assert_int_equal(hc_bake_map(&map, &field, &options, NULL), HC_ERROR_CANCELLED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_refused_fields),
        cmocka_unit_test(test_cone_maps),
        cmocka_unit_test(test_safe_methods_stay_safe_in_codes),
        cmocka_unit_test(test_dummer),
        cmocka_unit_test(test_compat2006),
        cmocka_unit_test(test_relaxed),
        cmocka_unit_test(test_heights_alone),
        cmocka_unit_test(test_pyramids),
        cmocka_unit_test(test_coded_heights_stay_exact_in_pyramids),
        cmocka_unit_test(test_gradients),
        cmocka_unit_test(test_stops_on_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
