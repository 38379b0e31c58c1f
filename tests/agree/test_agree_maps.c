/* Whole maps in every layout and depth: the heights are the nearest codes, the ratios are those of
 * the stored heights, rounded down by less than one code; extremes and slopes likewise. */
#include "support.h"

#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>

typedef struct variant {
    hc_map_kind kind;
    hc_layout   layout;
    hc_cones    cones;
    int         bits;
    float       max_ratio;
} variant;

static const variant cone_variants[] = {
    { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L2, 8, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L1, 16, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L1, 8, 0.3F },
    { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L1, 32, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_RG, HC_CONES_L2, 16, 7.5F },
    { HC_MAP_CONE, HC_LAYOUT_DUMMER, HC_CONES_L2, 8, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_DUMMER, HC_CONES_L1, 8, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_QUAD, HC_CONES_QUAD, 8, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_QUAD, HC_CONES_QUAD, 16, 2.0F },
    { HC_MAP_CONE, HC_LAYOUT_QUAD, HC_CONES_QUAD, 32, 2.0F },
    { HC_MAP_CONE, HC_LAYOUT_ANISO, HC_CONES_ANISO, 8, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_ANISO, HC_CONES_ANISO, 16, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_ANISO, HC_CONES_ANISO, 32, 0.0F },
    { HC_MAP_CONE, HC_LAYOUT_HEIGHT, HC_CONES_L2, 16, 0.0F },
    { HC_MAP_RELAXED, HC_LAYOUT_RG, HC_CONES_L2, 8, 0.0F },
    { HC_MAP_RELAXED, HC_LAYOUT_DUMMER, HC_CONES_L2, 8, 0.0F },
};

static hc_map bake(const hc_field *field, const hc_map_options *options)
{
    hc_log log = { .text = "" };
    hc_map map = { .texels = NULL };
    if (hc_map_info_for(&map.info, field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    map.texels = malloc(hc_map_bytes(&map.info));
    if (hc_bake_map(&map, field, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    return map;
}

static int code_at(const hc_map *map, int level, int x, int y, int channel)
{
    int          width;
    const void  *texels = hc_map_level(map, level, &width, NULL);
    const size_t at =
        ((size_t)y * (size_t)width + (size_t)x) * (size_t)map->info.channels + (size_t)channel;
    return map->info.bits == 8 ? ((const uint8_t *)texels)[at] : ((const uint16_t *)texels)[at];
}

/* Heights as the map has them; the field's own where it has none. */
static float *stored_heights(const hc_map *map, const hc_field *field)
{
    float *heights = malloc(agree_count(field, HC_CONES_L2) * sizeof *heights);
    for (int y = 0; y < field->height; y++) {
        for (int x = 0; x < field->width; x++) {
            const float own               = field->heights[y * field->width + x];
            const float stored            = hc_map_height_at(map, x, y);
            heights[y * field->width + x] = isnan(stored) ? own : stored;
            if (map->info.bits == 32) {
                assert_true(isnan(stored) || stored == own);
            } else if (!isnan(stored)) {
                assert_int_equal(code_at(map, 0, x, y, 0),
                                 hc_ref_height_code((double)own, map->info.bits));
            }
        }
    }
    return heights;
}

/* Decoded `stored` may not be wider than `ratio`, and the next code would be. */
static void check_ratio(const hc_map *map, const char *what, float stored, float ratio, int x,
                        int y)
{
    const int    bits  = map->info.bits;
    const float  limit = map->info.layout == HC_LAYOUT_DUMMER ? 1.0F : map->info.max_ratio;
    const double kept  = 1.0 - 0x1p-18;
    bool         good  = stored == ratio;
    if (bits != 32) {
        const int least =
            hc_ref_ratio_code((double)fminf(ratio, limit) * kept, (double)limit, bits);
        good = stored <= ratio
               && (double)stored >= hc_ref_ratio_of_code(least, (double)limit, bits) * kept;
    }
    if (!good) {
        fail_msg("%s, %s %d bits: ratio[%d, %d] is stored as %.9g for %.9g", what,
                 hc_layout_name(map->info.layout), bits, x, y, (double)stored, (double)ratio);
    }
}

static void check_cone_map(const hc_field *field, const char *kind, const variant *v)
{
    const hc_map_options options = { .kind   = v->kind,
                                     .layout = v->layout,
                                     .bits   = v->bits,
                                     .cone   = { .cones = v->cones, .max_ratio = v->max_ratio } };
    hc_map               map     = bake(field, &options);
    float               *heights = stored_heights(&map, field);
    hc_field             stored  = *field;
    stored.heights               = heights;
    hc_cone_options cone         = options.cone;
    cone.max_ratio               = map.info.max_ratio;
    cone.method        = v->kind == HC_MAP_RELAXED ? HC_METHOD_FALLING_EDGE : HC_METHOD_EXACT;
    const int channels = hc_cones_channels(v->cones);
    float    *ratios   = agree_bake(&stored, &cone);
    for (int i = 0; i < field->width * field->height * channels; i++) {
        const int x = i / channels % field->width;
        const int y = i / channels / field->width;
        if (v->layout != HC_LAYOUT_HEIGHT) {
            check_ratio(&map, agree_describe(kind, field),
                        hc_map_ratio_at(&map, x, y, i % channels), ratios[i], x, y);
        }
    }
    free(ratios);
    free(heights);
    free(map.texels);
}

static void every_layout_and_depth_rounds_to_the_safe_side(void **state)
{
    (void)state;
    const int variants = sizeof cone_variants / sizeof *cone_variants;
    for (int i = 0; i < agree_field_count(&agree_small); i += AGREE_STRIDE) {
        hc_field field = agree_field(&agree_small, i);
        /* not in step with the kinds: each meets every variant */
        check_cone_map(&field, agree_kind_of(i), &cone_variants[(i + i / AGREE_KINDS) % variants]);
        agree_free(&field);
    }
}

/* A map's own heights and ratios against the real numbers: safe after decoding, in all pairs. */
static void decoded_ratios_are_never_wider_than_the_truth(void **state)
{
    (void)state;
    for (int i = 0; i < 4 * AGREE_KINDS; i++) {
        hc_field field =
            agree_make_field((agree_shape){ 12, 9 }, i % AGREE_KINDS, (uint64_t)i,
                             (hc_wrap)(i / AGREE_KINDS), i % 5 < 3 ? HC_TEXEL : HC_GRID);
        const hc_cones       cones   = i % 2 == 0 ? HC_CONES_L2 : HC_CONES_L1;
        const hc_ref_cone    cone    = { .metric = i % 2 == 0 ? HC_REF_ROUND : HC_REF_DIAMOND };
        const hc_map_options options = { .bits = i % 3 == 0 ? 16 : 8, .cone = { .cones = cones } };
        hc_map               map     = bake(&field, &options);
        float               *heights = stored_heights(&map, &field);
        hc_field             stored  = field;
        stored.heights               = heights;
        for (int at = 0; at < 12 * 9; at++) {
            const double truth = hc_ref_ratio(&stored, &cone, at % 12, at / 12);
            assert_true((double)hc_map_ratio_at(&map, at % 12, at / 12, 0) <= truth);
        }
        free(heights);
        free(map.texels);
        agree_free(&field);
    }
}

/* The largest (least) of block (bx, by) of a level, over samples or over cells. */
static float true_extreme(const hc_field *field, bool cells, int level, int bx, int by,
                          hc_ref_extreme extreme)
{
    const int width  = field->width;
    float    *values = malloc(agree_count(field, HC_CONES_L2) * sizeof *values);
    for (int i = 0; i < width * field->height; i++) {
        values[i] = cells ? hc_ref_cell_extreme(field->heights, 1, 0, width, field->height,
                                                field->wrap, i % width, i / width, extreme)
                          : field->heights[i];
    }
    const float found = hc_ref_block_extreme(values, width, field->height, level, bx, by, extreme);
    free(values);
    return found;
}

/* One code tighter would no longer bound. */
static void check_extreme_texel(const hc_map *map, const hc_field *field, int level, int x, int y)
{
    const bool  cells = map->info.kind == HC_MAP_BOUNDS;
    const float high  = true_extreme(field, cells, level, x, y, HC_REF_MAXIMUM);
    const float low   = true_extreme(field, cells, level, x, y, HC_REF_MINIMUM);
    if (map->info.bits == 32) {
        int          width;
        const float *texels = hc_map_level(map, level, &width, NULL);
        assert_true(texels[2 * (y * width + x)] == high);
        assert_true(texels[2 * (y * width + x) + 1] == low);
        return;
    }
    const float n    = (float)((1 << map->info.bits) - 1);
    const int   up   = code_at(map, level, x, y, 0);
    const int   down = code_at(map, level, x, y, 1);
    assert_true((float)up / n >= high && (float)(up - 1) / n < high);
    assert_true((float)down / n <= low && (float)(down + 1) / n > low);
}

static void extremes_bound_every_block_on_every_level(void **state)
{
    (void)state;
    static const int bits[] = { 8, 16, 32 };
    for (int i = 0; i < agree_field_count(&agree_small); i += 5) {
        const hc_map_options options = { .kind = i % 2 == 0 ? HC_MAP_PYRAMID : HC_MAP_BOUNDS,
                                         .bits = bits[i % 3] };
        hc_field             field   = agree_field(&agree_small, i);
        hc_map               map     = bake(&field, &options);
        for (int level = 0; level < map.info.levels; level++) {
            int width;
            int height;
            (void)hc_map_level(&map, level, &width, &height);
            for (int at = 0; at < width * height; at++) {
                check_extreme_texel(&map, &field, level, at % width, at / width);
            }
        }
        assert_true(hc_ref_level_size(field.width, map.info.levels - 1) == 1
                    && hc_ref_level_size(field.height, map.info.levels - 1) == 1);
        free(map.texels);
        agree_free(&field);
    }
}

/* Height codes per step, from the stored heights, v upwards. */
static void check_dummer_slopes(const hc_map *map, const hc_field *stored)
{
    for (int y = 0; y < stored->height; y++) {
        for (int x = 0; x < stored->width; x++) {
            double g[2];
            hc_ref_gradient(g, stored, x, y);
            /* back to codes per step; exact halves survive the rounding that this undoes */
            const double u = rint(g[0] * hc_field_step_u(stored) * 255.0 * 2.0) / 2.0;
            const double v = rint(g[1] * hc_field_step_v(stored) * 255.0 * 2.0) / 2.0;
            assert_int_equal(code_at(map, 0, x, y, 2), hc_ref_slope_code(u, 8));
            assert_int_equal(code_at(map, 0, x, y, 3), hc_ref_slope_code(-v, 8));
        }
    }
}

static void check_gradient_codes(const hc_map *map, const hc_field *field)
{
    const double n = (1 << map->info.bits) - 1;
    for (int y = 0; y < field->height; y++) {
        for (int x = 0; x < field->width; x++) {
            double g[2];
            hc_ref_gradient(g, field, x, y);
            const double u = g[0] * hc_field_step_u(field) * n;
            const double v = g[1] * hc_field_step_v(field) * n;
            /* rounding in double may move what lies on a boundary: half a code, and 2^-20 of one */
            const int    bias  = (1 << map->info.bits) / 2 - 1;
            const double off_u = code_at(map, 0, x, y, 0) - bias - fmax(fmin(u, bias), -bias);
            const double off_v = code_at(map, 0, x, y, 1) - bias - fmax(fmin(v, bias), -bias);
            assert_true(fabs(off_u) <= 0.5 + 0x1p-20 && fabs(off_v) <= 0.5 + 0x1p-20);
        }
    }
}

static void slopes_are_the_nearest_codes(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_small); i += 5) {
        const hc_map_options dummer   = { .layout = HC_LAYOUT_DUMMER };
        const hc_map_options gradient = { .kind = HC_MAP_GRADIENT, .bits = i % 2 == 0 ? 8 : 16 };
        hc_field             field    = agree_field(&agree_small, i);
        hc_map               map      = bake(&field, &dummer);
        float               *heights  = stored_heights(&map, &field);
        hc_field             stored   = field;
        stored.heights                = heights;
        check_dummer_slopes(&map, &stored);
        free(heights);
        free(map.texels);
        map = bake(&field, &gradient);
        check_gradient_codes(&map, &field);
        free(map.texels);
        agree_free(&field);
    }
}

static void check_compat2006(const hc_field *field, const char *kind)
{
    const hc_map_options options = { .layout = HC_LAYOUT_DUMMER, .compat2006 = true };
    const int            samples = field->width * field->height;
    hc_map               map     = bake(field, &options);
    uint8_t             *heights = malloc((size_t)samples);
    for (int i = 0; i < samples; i++) {
        heights[i] = (uint8_t)hc_ref_height_code((double)field->heights[i], 8);
    }
    for (int i = 0; i < samples * 4; i++) {
        const int x = i / 4 % field->width;
        const int y = i / 4 / field->width;
        int       rgba[4];
        hc_ref_dummer2006(rgba, heights, field->width, field->height, field->wrap, x, y);
        if (code_at(&map, 0, x, y, i % 4) != rgba[i % 4]) {
            fail_msg("%s: compat2006 texel [%d, %d] channel %d is %d instead of %d",
                     agree_describe(kind, field), x, y, i % 4, code_at(&map, 0, x, y, i % 4),
                     rgba[i % 4]);
        }
    }
    free(heights);
    free(map.texels);
}

static void compat_has_the_bytes_of_2006(void **state)
{
    (void)state;
    for (int i = 0; i < agree_field_count(&agree_small); i += AGREE_STRIDE) {
        hc_field field = agree_field(&agree_small, i);
        if (field.width >= 2 && field.height >= 2) {
            check_compat2006(&field, agree_kind_of(i));
        }
        agree_free(&field);
    }
    hc_field dem = agree_named_field("dem", 70, 53, 0, HC_WRAP_UV);
    check_compat2006(&dem, "dem");
    agree_free(&dem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_and_depth_rounds_to_the_safe_side),
        cmocka_unit_test(decoded_ratios_are_never_wider_than_the_truth),
        cmocka_unit_test(extremes_bound_every_block_on_every_level),
        cmocka_unit_test(slopes_are_the_nearest_codes),
        cmocka_unit_test(compat_has_the_bytes_of_2006),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
